"""A model in the browser: drag its goal and its start, change time, gains and kernels, and see what an arm would do.

`Session` computes, without a browser; `serve` shows. viser and yourdfpy come with the extra `view`.
"""

from dmpcpp.show.view._page import serve
from dmpcpp.show.view._session import Choice, Session, Shown

__all__ = ["Choice", "Session", "Shown", "serve"]
