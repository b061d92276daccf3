"""The arm in a scene: where it is drawn is where KDL says it is."""

import numpy as np
import pytest
from dmpcpp import Arm, arms
from dmpcpp.errors import InvalidArgument

pytest.importorskip("pybullet_data")
pytest.importorskip("viser")
pytest.importorskip("yourdfpy")


def drawn_tip(shown, arm):
    """The tip in the scene's world: the robot's root as it stands, then yourdfpy's kinematics."""
    from scipy.spatial.transform import Rotation

    root = np.eye(4)
    root[:3, 3] = shown._root.position
    root[:3, :3] = Rotation.from_quat(np.asarray(shown._root.wxyz)[[1, 2, 3, 0]]).as_matrix()
    model, collision = shown._shape.model, shown._shape.collision
    return root @ model.get_transform(arm.tip, model.base_link, collision_geometry=collision)


@pytest.mark.parametrize("name, base", [("panda", ""), ("iiwa", ""), ("xarm6", ""), ("panda", "panda_link2")])
def test_the_arm_is_drawn_where_its_kinematics_say(name, base):
    from dmpcpp.scene import ShownArm, serving

    arm = arms.find(name)
    if base:
        arm = Arm.from_urdf(arm.urdf, base=base, tip=arm.tip, folder=arm.folder)
    joints = 0.5 * (arm.lower + arm.upper) + 0.2 * np.arange(arm.joint_count) / arm.joint_count
    with serving() as server:
        shown = ShownArm(server, arm)
        shown.move(joints)
        assert np.abs(drawn_tip(shown, arm) - arm.forward_kinematics(joints)).max() < 1e-5


def test_a_leftover_of_xacro_is_drawn_without_a_word(caplog, capfd):
    from dmpcpp.scene import triangles

    arm = arms.find("panda")
    odd = Arm.from_urdf(
        arm.urdf.replace("</robot>", '<xacro:property name="a" value="1"/></robot>'),
        base=arm.base,
        tip=arm.tip,
        folder=arm.folder,
    )
    middle = 0.5 * (arm.lower + arm.upper)
    assert triangles(odd, [middle]).shape == triangles(arm, [middle]).shape
    assert caplog.text == "" and capfd.readouterr() == ("", "")


def test_joints_that_are_too_few_are_refused():
    from dmpcpp.scene import ShownArm, serving

    with serving() as server:
        shown = ShownArm(server, arms.find("panda"))
        with pytest.raises(InvalidArgument, match=r"joints: shape \(2,\), expected \(7,\)"):
            shown.move([0.0, 0.0])


@pytest.mark.parametrize("base", ["", "panda_link2"])
def test_the_shape_on_paper_is_where_the_kinematics_say(base):
    from dmpcpp.scene import triangles

    panda = arms.find("panda")
    panda = Arm.from_urdf(panda.urdf, base=base or panda.base, tip=panda.tip, folder=panda.folder)
    middle = 0.5 * (panda.lower + panda.upper)
    moved = middle + 0.2 * np.arange(panda.joint_count) / panda.joint_count
    shapes = triangles(panda, [middle, moved])
    assert shapes.ndim == 4 and shapes.shape[0] == 2 and shapes.shape[2:] == (3, 3)
    for shape, joints in zip(shapes, (middle, moved), strict=True):
        hand = panda.forward_kinematics(joints)
        beside = (shape.reshape(-1, 3) - hand[:3, 3]) @ hand[:3, :3]  # as the hand sees it
        near = beside[np.linalg.norm(beside, axis=1) < 0.15]
        assert 0.09 < near[:, 2].max() < 0.13  # the tips of its fingers
    with pytest.raises(InvalidArgument, match=r"joints: shape \(2,\)"):
        triangles(panda, [0.0, 0.0])
