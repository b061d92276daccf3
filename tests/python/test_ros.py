"""ROS bags: what rosbags writes comes back exactly."""

import numpy as np
import pytest
from dmpcpp import recordings
from dmpcpp.errors import InvalidArgument, MissingDependency
from scipy.spatial.transform import Rotation

COUNT = 12
START = 1_700_000_000_123_456_789
STAMPS = START + 8_333_333 * np.arange(COUNT)  # ns
POSITIONS = np.random.default_rng(3).normal(size=(COUNT, 3), scale=0.3)
QUATERNIONS = Rotation.from_rotvec(np.linspace([0, 0, 0], [0.4, -1.0, 2.0], COUNT)).as_quat()

KINDS = ["ros1", "sqlite3", "mcap"]


class Bag:
    """Writes messages of poses, by the types of ROS 1 or ROS 2."""

    def __init__(self, path, kind):
        pytest.importorskip("rosbags")
        from rosbags import rosbag1, rosbag2
        from rosbags.typesys import Stores, get_types_from_msg, get_typestore

        self.ros1 = kind == "ros1"
        self.store = get_typestore(Stores.ROS1_NOETIC if self.ros1 else Stores.ROS2_HUMBLE)
        name = "tf2_msgs/msg/TFMessage"
        if name not in self.store.types:
            self.store.register(get_types_from_msg("geometry_msgs/TransformStamped[] transforms", name))
        plugin = {"storage_plugin": rosbag2.StoragePlugin[kind.upper()]} if not self.ros1 else {}
        self.writer = rosbag1.Writer(path) if self.ros1 else rosbag2.Writer(path, version=9, **plugin)
        self.connections = {}

    def type(self, name):
        return self.store.types[name]

    def header(self, stamp, frame="world"):
        time = self.type("builtin_interfaces/msg/Time")(sec=int(stamp // 10**9), nanosec=int(stamp % 10**9))
        sequence = {"seq": 0} if self.ros1 else {}
        return self.type("std_msgs/msg/Header")(stamp=time, frame_id=frame, **sequence)

    def pose(self, k):
        point = self.type("geometry_msgs/msg/Point")(*POSITIONS[k])
        turn = self.type("geometry_msgs/msg/Quaternion")(*QUATERNIONS[k])
        return self.type("geometry_msgs/msg/Pose")(position=point, orientation=turn)

    def pose_stamped(self, k, **header):
        return self.type("geometry_msgs/msg/PoseStamped")(header=self.header(STAMPS[k], **header), pose=self.pose(k))

    def transform(self, k, child="hand", frame="world"):
        shift = self.type("geometry_msgs/msg/Vector3")(*POSITIONS[k])
        turn = self.type("geometry_msgs/msg/Quaternion")(*QUATERNIONS[k])
        transform = self.type("geometry_msgs/msg/Transform")(translation=shift, rotation=turn)
        header = self.header(STAMPS[k], frame)
        return self.type("geometry_msgs/msg/TransformStamped")(header=header, child_frame_id=child, transform=transform)

    def odometry(self, k):
        zero = self.type("geometry_msgs/msg/Vector3")(0.0, 0.0, 0.0)
        twist = self.type("geometry_msgs/msg/Twist")(linear=zero, angular=zero)
        return self.type("nav_msgs/msg/Odometry")(
            header=self.header(STAMPS[k], "odom"),
            child_frame_id="base_link",
            pose=self.type("geometry_msgs/msg/PoseWithCovariance")(pose=self.pose(k), covariance=np.zeros(36)),
            twist=self.type("geometry_msgs/msg/TwistWithCovariance")(twist=twist, covariance=np.zeros(36)),
        )

    def write(self, topic, message, at):
        kind = message.__msgtype__
        if topic not in self.connections:
            self.connections[topic] = self.writer.add_connection(topic, kind, typestore=self.store)
        serialize = self.store.serialize_ros1 if self.ros1 else self.store.serialize_cdr
        self.writer.write(self.connections[topic], int(at), serialize(message, kind))


def bag(tmp_path, kind, fill):
    path = tmp_path / ("a.bag" if kind == "ros1" else "bag")
    made = Bag(path, kind)
    with made.writer:
        fill(made)
    return path


def poses(made):
    for k in range(COUNT):
        made.write("/hand/pose", made.pose_stamped(k), STAMPS[k] + 500)


def assert_exact(found):
    np.testing.assert_array_equal(found.time, 1e-9 * (STAMPS - START).astype(float))
    np.testing.assert_array_equal(found.position, POSITIONS)
    np.testing.assert_allclose(found.rotation, Rotation.from_quat(QUATERNIONS).as_matrix(), atol=1e-15)


@pytest.mark.parametrize("kind", KINDS)
def test_stamped_poses_come_back_exactly(tmp_path, kind):
    path = bag(tmp_path, kind, poses)
    assert recordings.format_of(path) == "ros"
    assert recordings.bodies(path) == ("/hand/pose",)
    found = recordings.load(path, up_axis="z")
    assert_exact(found)
    assert "in the frame 'world'" in found.history
    assert f"time counted from the first stamp at {START} ns" in found.history


@pytest.mark.parametrize("kind", ["sqlite3", "mcap"])
def test_the_file_inside_a_ros_2_bag_reads_alone(tmp_path, kind):
    folder = bag(tmp_path, kind, poses)
    file = next(path for path in folder.iterdir() if path.suffix in (".mcap", ".db3"))
    assert_exact(recordings.load(file))


@pytest.mark.parametrize("kind", KINDS)
def test_transforms_are_bodies_by_their_child_frame(tmp_path, kind):
    def fill(made):
        message = made.type("tf2_msgs/msg/TFMessage")
        for k in range(COUNT):
            both = [made.transform(k), made.transform(k, "cup")]
            made.write("/tf", message(transforms=both), STAMPS[k])
            made.write("/tracker", made.transform(k, "elbow"), STAMPS[k])
        made.write("/tf_static", message(transforms=[made.transform(0, "camera")]), STAMPS[0])

    path = bag(tmp_path, kind, fill)
    assert set(recordings.bodies(path)) == {"hand", "cup", "elbow"}
    for body in ("hand", "cup", "elbow"):
        assert_exact(recordings.load(path, body))


@pytest.mark.parametrize("kind", KINDS)
def test_odometry_is_the_pose_in_its_own_frame(tmp_path, kind):
    def fill(made):
        for k in range(COUNT):
            made.write("/odom", made.odometry(k), STAMPS[k])

    found = recordings.load(bag(tmp_path, kind, fill))
    assert_exact(found)
    assert "in the frame 'odom'" in found.history


def test_messages_out_of_order_and_published_twice_are_put_right_and_said(tmp_path):
    def fill(made):
        for arrival, k in enumerate([1, 0, *range(2, COUNT), COUNT - 1]):
            made.write("/hand", made.pose_stamped(k), START + arrival)

    found = recordings.load(bag(tmp_path, "mcap", fill))
    assert_exact(found)
    assert "1 poses that were published again left out" in found.history
    assert "messages put in the order of their stamps" in found.history


def test_poses_in_two_frames_are_refused(tmp_path):
    def fill(made):
        for k in range(COUNT):
            made.write("/hand", made.pose_stamped(k, frame="map" if k > 5 else "odom"), STAMPS[k])

    with pytest.raises(InvalidArgument, match="poses in several frames: map, odom"):
        recordings.load(bag(tmp_path, "ros1", fill))


def test_a_bag_without_poses_says_what_it_holds(tmp_path):
    def fill(made):
        made.write("/text", made.type("std_msgs/msg/String")(data="hello"), START)

    with pytest.raises(InvalidArgument, match=r"no messages with poses. The bag holds: std_msgs/msg/String"):
        recordings.load(bag(tmp_path, "sqlite3", fill))


def test_a_damaged_bag_is_refused(tmp_path):
    path = bag(tmp_path, "ros1", poses)
    path.write_bytes(path.read_bytes()[:100])
    with pytest.raises(InvalidArgument, match=r"a\.bag: not a readable bag"):
        recordings.load(path)


def test_without_rosbags_the_error_says_what_to_install(tmp_path, monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "rosbags.highlevel", None)
    path = tmp_path / "a.bag"
    path.write_bytes(b"#ROSBAG V2.0\n")
    with pytest.raises(MissingDependency, match=r'pip install "dmpcpp\[formats\]"'):
        recordings.load(path)
