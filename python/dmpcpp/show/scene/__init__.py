"""An arm in a browser, by viser: shown at any joints, beside paths; as a page that stands alone or served live;
and its shape for pictures on paper.

viser and yourdfpy (the extra `view`) are imported when they are first needed; without them `MissingDependency` is
raised. Shown are the collision meshes: a tenth of the size of what is made for rendering, and what is checked.
"""

from dmpcpp.show.scene._replay import draw_path as draw_path
from dmpcpp.show.scene._replay import look_at as look_at
from dmpcpp.show.scene._replay import quaternion as quaternion
from dmpcpp.show.scene._replay import replay_page
from dmpcpp.show.scene._robot import ShownArm, triangles
from dmpcpp.show.scene._server import serving

__all__ = ["ShownArm", "replay_page", "serving", "triangles"]
