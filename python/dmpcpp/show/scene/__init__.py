"""An arm in a browser, by viser: shown at any joints, beside paths; as a page that stands alone or served live;
and its shape for pictures on paper.

viser and yourdfpy (the extra `view`) are imported when they are first needed; without them `MissingDependency` is
raised. Shown are the collision meshes: a tenth of the size of what is made for rendering, and what is checked.
"""

from dmpcpp.show.scene._replay import replay_page
from dmpcpp.show.scene._robot import ShownArm
from dmpcpp.show.scene._server import serving
from dmpcpp.show.scene._shape import triangles

__all__ = ["ShownArm", "replay_page", "serving", "triangles"]
