"""Data sets of robot learning and logs of other producers: equal to what was written, and what they do not say is "
"asked."""

import json

import numpy as np
import pytest
from dmpcpp import recordings
from dmpcpp.errors import InvalidArgument, MissingDependency, NotStated
from dmpcpp.inspection import inspect
from scipy.spatial.transform import Rotation

COUNT = 50
TIME = 0.05 * np.arange(COUNT)


def position(episode=0):
    return np.column_stack(
        [0.4 + 0.1 * np.sin(TIME + episode), 0.2 * np.cos(2 * TIME), 0.3 + 0.05 * TIME + 0.02 * episode]
    )


def turn(episode=0):
    return Rotation.from_rotvec(np.column_stack([0.5 * np.sin(TIME), 0.3 * TIME, 0.2 + 0.1 * episode + 0 * TIME]))


def matrices(episode=0):
    poses = np.tile(np.eye(4), (COUNT, 1, 1))
    poses[:, :3, :3], poses[:, :3, 3] = turn(episode).as_matrix(), position(episode)
    return poses


def check(found, episode=0, tolerance=1e-9, rate=20.0):
    assert len(found) == COUNT and found.rate == pytest.approx(rate)
    np.testing.assert_allclose(found.position, position(episode), atol=tolerance)
    np.testing.assert_allclose(found.rotation, turn(episode).as_matrix(), atol=10 * tolerance)


# ---------------------------------------------------------------- LeRobot

NAMES = ["x", "y", "z", "rx", "ry", "rz", "gripper"]


def lerobot(folder, version, names=NAMES, columns=None, fps=20):
    pyarrow = pytest.importorskip("pyarrow")
    from pyarrow import parquet

    folder.mkdir()
    (folder / "meta").mkdir()
    features = {"observation.state": {"dtype": "float32", "shape": [7], "names": names}, "timestamp": {"names": None}}
    info = {"codebase_version": version, "fps": fps, "features": features}
    (folder / "meta" / "info.json").write_text(json.dumps(info))
    data = folder / "data" / "chunk-000"
    data.mkdir(parents=True)

    def table(episodes):
        states = [
            np.column_stack([position(e), turn(e).as_rotvec(), np.linspace(0, 1, COUNT)])
            if columns is None
            else columns(e)
            for e in episodes
        ]
        state = np.concatenate(states).astype(np.float32)
        return pyarrow.table(
            {
                "observation.state": pyarrow.FixedSizeListArray.from_arrays(state.reshape(-1), state.shape[1]),
                "timestamp": pyarrow.array(np.tile(TIME, len(episodes)).astype(np.float32)),
                "episode_index": pyarrow.array(np.repeat(episodes, COUNT)),
            }
        )

    if version == "v3.0":
        parquet.write_table(table([0, 1, 2]), data / "file-000.parquet")
    else:
        for episode in (0, 1, 2):
            parquet.write_table(table([episode]), data / f"episode_{episode:06d}.parquet")
    return folder


@pytest.mark.parametrize("version", ["v2.1", "v3.0"])
def test_an_episode_of_a_lerobot_set_is_read_once_its_rotation_is_named(tmp_path, version):
    folder = lerobot(tmp_path / "set", version)
    with pytest.raises(NotStated, match="a LeRobot data set of 3 episodes, 0 to 2. Specify one: episode=2"):
        recordings.load(folder)
    with pytest.raises(NotStated, match="rotation vector"):
        recordings.load(folder, episode=1)
    report = inspect(folder)
    assert {"episode", "euler_order"} <= set(report.needed) and not report.ok
    found = recordings.load(folder, episode=1, rotation="rotvec")
    check(found, 1, 1e-6)
    np.testing.assert_array_equal(found.position, position(1).astype(np.float32))
    np.testing.assert_allclose(found.channels["gripper"], np.linspace(0, 1, COUNT), atol=1e-7)
    file = sorted(folder.rglob("*.parquet"))[-1]
    last = recordings.load(file, episode=2, rotation="rotvec")
    np.testing.assert_array_equal(last.position, position(2).astype(np.float32))
    with pytest.raises(InvalidArgument, match="episode: 7, but a LeRobot data set holds 3 episodes"):
        recordings.load(folder, episode=7)


@pytest.mark.parametrize(
    "names", [{"motors": NAMES}, [NAMES], {name: k for k, name in reversed(list(enumerate(NAMES)))}]
)
def test_the_names_of_a_lerobot_feature_come_in_several_forms(tmp_path, names):
    check(recordings.load(lerobot(tmp_path / "set", "v3.0", names), episode=0, rotation="rotvec"), 0, 1e-6)


def test_two_arms_are_two_bodies_and_joints_are_no_pose(tmp_path):
    def both(episode):
        quaternion = turn(episode).as_quat()
        return np.column_stack([position(episode), quaternion, position(episode) + 1.0, quaternion])

    parts = ("x", "y", "z", "qx", "qy", "qz", "qw")
    names = [f"ee_{part}_{side}" for side in "lr" for part in parts]
    folder = lerobot(tmp_path / "set", "v3.0", names, both)
    assert recordings.bodies(folder, episode=0) == ("left", "right")
    check(recordings.load(folder, "left", episode=2), 2, 1e-6)
    joints = lerobot(tmp_path / "joints", "v2.1", [f"shoulder_{k}.pos" for k in range(7)])
    with pytest.raises(NotStated, match="look like joints, not the pose of a hand"):
        recordings.load(joints, episode=0)
    named = {"dataset": "observation.state", "layout": "x,y,z,rotvec,gripper"}
    check(recordings.load(joints, episode=0, **named), 0, 1e-6)


# ---------------------------------------------------------------- HDF5


def hdf5(path, arrays, attributes=None):
    h5py = pytest.importorskip("h5py")
    with h5py.File(path, "w") as file:
        for name, values in arrays.items():
            file[name] = values
        for name, value in (attributes or {}).items():
            file["data"].attrs[name] = value
    return path


def robomimic(path, attributes=None):
    arrays = {}
    for episode in range(3):
        group = f"data/demo_{episode}/"
        arrays[group + "obs/robot0_eef_pos"] = position(episode)
        arrays[group + "obs/robot0_eef_quat"] = turn(episode).as_quat()
        arrays[group + "actions"] = np.zeros((COUNT, 7))
    return hdf5(path, arrays, attributes)


def test_a_robomimic_file_is_known_by_its_groups(tmp_path):
    path = robomimic(tmp_path / "a.hdf5")
    with pytest.raises(NotStated, match="a robomimic file of 3 episodes"):
        recordings.load(path)
    with pytest.raises(NotStated, match="robomimic: the file holds no rate and no times. Specify it, usually rate=20"):
        recordings.load(path, episode=2)
    found = recordings.load(path, episode=2, rate=20.0)
    check(found, 2)
    assert found.up_axis == "z" and any("90 deg about z" in note for note in found.history)
    told = robomimic(tmp_path / "b.hdf5", {"env_args": json.dumps({"env_kwargs": {"control_freq": 20}})})
    check(recordings.load(told, episode=1), 1)


def test_an_egodex_file_holds_joints_in_a_world_whose_y_is_up(tmp_path):
    confidence = np.ones(COUNT)
    confidence[10:13] = 0.01
    arrays = {"transforms/rightHand": matrices(), "transforms/leftHand": matrices(1), "transforms/camera": matrices(2)}
    path = hdf5(tmp_path / "a.hdf5", {**arrays, "confidences/rightHand": confidence})
    assert set(recordings.bodies(path)) == {"rightHand", "leftHand", "camera"}
    check(recordings.load(path, "leftHand", rate=20.0), 1)
    found = recordings.load(path, "rightHand", rate=20.0)
    assert np.flatnonzero(found.missing).tolist() == [10, 11, 12] and found.up_axis == "y"


def test_a_droid_file_says_its_angles_and_times(tmp_path):
    cartesian = np.column_stack([position(), turn().as_euler("xyz")])
    arrays = {
        "observation/robot_state/cartesian_position": cartesian,
        "observation/robot_state/gripper_position": np.linspace(0, 1, COUNT),
        "observation/timestamp/robot_state/read_start": (1_700_000_000_000 + 50 * np.arange(COUNT)),
        "action/cartesian_position": cartesian + 1.0,
    }
    found = recordings.load(hdf5(tmp_path / "trajectory.h5", arrays))
    check(found)
    np.testing.assert_allclose(found.channels["gripper_position"], np.linspace(0, 1, COUNT))


def test_any_other_file_says_what_it_holds_and_takes_the_arrays_by_path(tmp_path):
    arrays = {"a/where": position(), "a/turned": turn().as_quat(), "observations/qpos": np.zeros((COUNT, 14))}
    path = hdf5(tmp_path / "a.h5", arrays)
    with pytest.raises(NotStated, match="qpos and qp_arm are joints.*a/where"):
        recordings.load(path)
    check(recordings.load(path, dataset="a/where,a/turned", quat_order="xyzw", rate=20.0))


def test_links_out_of_a_file_are_never_followed(tmp_path):
    h5py = pytest.importorskip("h5py")
    hdf5(tmp_path / "secret.h5", {"hand_pos": position(), "hand_quat": turn().as_quat()})
    with h5py.File(tmp_path / "a.h5", "w") as file:
        file["x"] = np.zeros(3)
        file["hand_pos"] = h5py.ExternalLink("secret.h5", "hand_pos")
        file["hand_quat"] = h5py.SoftLink("/x")
        layout = h5py.VirtualLayout(shape=(COUNT, 3), dtype="f8")
        layout[:] = h5py.VirtualSource(str(tmp_path / "secret.h5"), "hand_pos", shape=(COUNT, 3))
        file.create_virtual_dataset("other_pos", layout)
        file["again"] = file.create_group("group")
        file["group/round"] = file["group"]
    with pytest.raises(NotStated, match=r"The file holds: x \(3,\)\."):
        recordings.load(tmp_path / "a.h5", rate=20.0)


# ---------------------------------------------------------------- zarr


@pytest.mark.parametrize("zipped", [False, True])
@pytest.mark.parametrize("version", [2, 3])
def test_an_episode_of_a_umi_buffer_is_the_rows_up_to_its_end(tmp_path, zipped, version):
    zarr = pytest.importorskip("zarr")
    path = tmp_path / ("a.zarr.zip" if zipped else "a.zarr")
    store = zarr.storage.ZipStore(path, mode="w") if zipped else zarr.storage.LocalStore(path)
    root = zarr.open_group(store, mode="w", zarr_format=version)
    arrays = {
        "data/robot0_eef_pos": np.concatenate([position(0), position(1)]),
        "data/robot0_eef_rot_axis_angle": np.concatenate([turn(0).as_rotvec(), turn(1).as_rotvec()]),
        "data/robot0_gripper_width": np.full((2 * COUNT, 1), 0.04),
        "data/robot0_demo_start_pose": np.zeros((2 * COUNT, 6)),
        "meta/episode_ends": np.array([COUNT, 2 * COUNT]),
    }
    for name, values in arrays.items():
        root.create_array(name, data=values, chunks=(37, *values.shape[1:]))
    if zipped:
        store.close()
    with pytest.raises(NotStated, match="zarr replay buffer of 2 episodes"):
        recordings.load(path)
    with pytest.raises(NotStated, match="no rate and no times.*rate=59.94"):
        recordings.load(path, episode=1)
    found = recordings.load(path, episode=1, rate=20.0)
    check(found, 1)
    np.testing.assert_allclose(found.channels["robot0_gripper_width"], 0.04)


# ---------------------------------------------------------------- Xsens MVNX


def mvnx(path, head="", frames=COUNT):
    quaternion = turn().as_quat(scalar_first=True)
    pose = "<orientation>1 0 0 0 1 0 0 0</orientation><position>0 0 0 0 0 0</position>"
    lines = [f'<frame time="0" type="tpose">{pose}</frame>']
    for k in range(frames):
        wxyz, xyz = (" ".join(map(repr, map(float, row[k]))) for row in (quaternion, position()))
        lines.append(
            f'<frame time="{round(50 * k)}" index="{k}" type="normal"><orientation>1 0 0 0 {wxyz}</orientation>'
            f"<position>0 0 1 {xyz}</position></frame>"
        )
    path.write_text(
        f'<?xml version="1.0"?>{head}<mvnx version="4" xmlns="http://www.xsens.com/mvn/mvnx">'
        '<subject label="Jane Doe" frameRate="20" segmentCount="2"><segments><segment label="Pelvis" id="1"/>'
        f'<segment label="RightHand" id="2"/></segments><frames>{"".join(lines)}</frames></subject></mvnx>'
    )
    return path


def test_segments_of_an_mvnx_are_bodies_and_no_name_of_a_person_is_kept(tmp_path):
    path = mvnx(tmp_path / "a.mvnx")
    assert recordings.bodies(path) == ("Pelvis", "RightHand")
    found = recordings.load(path, "RightHand")
    check(found)
    assert found.up_axis == "z" and not any("Jane" in note for note in found.history)


def test_an_entity_is_never_opened(tmp_path):
    path = mvnx(tmp_path / "a.mvnx", '<!DOCTYPE x [<!ENTITY a SYSTEM "file:///etc/hostname">]>')
    with pytest.raises(InvalidArgument, match="document type"):
        recordings.load(path, "RightHand")


# ---------------------------------------------------------------- HOT3D


def test_hands_of_hot3d_are_two_bodies_and_an_unseen_one_is_missing(tmp_path):
    lines = []
    for k in range(COUNT):
        wrist = {"t_xyz": position()[k].tolist(), "q_wxyz": turn().as_quat(scalar_first=True)[k].tolist()}
        other = {"t_xyz": position(1)[k].tolist(), "q_wxyz": turn(1).as_quat(scalar_first=True)[k].tolist()}
        hands = {"0": {"wrist_xform": wrist}, **({"1": {"wrist_xform": other}} if k not in (5, 6) else {})}
        lines.append(json.dumps({"timestamp_ns": 10**12 + 50_000_000 * k, "hand_poses": hands}))
    path = tmp_path / "hands.jsonl"
    path.write_text("\n".join(lines))
    assert recordings.bodies(path) == ("0", "1")
    check(recordings.load(path, "left"))
    assert np.flatnonzero(recordings.load(path, "1").missing).tolist() == [5, 6]


# ---------------------------------------------------------------- MCAP


@pytest.mark.parametrize("encoding", ["json", "protobuf"])
def test_poses_of_foxglove_in_an_mcap_are_read(tmp_path, encoding):
    writer_of = pytest.importorskip("mcap.writer")
    path = tmp_path / "a.mcap"
    quaternion = turn().as_quat()
    with path.open("wb") as file:
        writer = writer_of.Writer(file)
        writer.start()
        schema, encode = _json_pose() if encoding == "json" else _protobuf_pose()
        kind = "jsonschema" if encoding == "json" else "protobuf"
        schema_id = writer.register_schema("foxglove.PoseInFrame", kind, schema)
        channel = writer.register_channel("/hand", encoding, schema_id)
        for k in range(COUNT):
            stamp = 10**18 + 50_000_000 * k
            data = encode(stamp, position()[k].tolist(), quaternion[k].tolist())
            writer.add_message(channel, log_time=stamp, publish_time=stamp, data=data)
        writer.finish()
    check(recordings.load(path))
    check(recordings.load(path, times="received"))


def _json_pose():
    def encode(stamp, xyz, xyzw):
        pose = {
            "timestamp": {"sec": stamp // 10**9, "nsec": stamp % 10**9},
            "frame_id": "world",
            "pose": {
                "position": dict(zip("xyz", xyz, strict=True)),
                "orientation": dict(zip("xyzw", xyzw, strict=True)),
            },
        }
        return json.dumps(pose).encode()

    return b"{}", encode


def _protobuf_pose():
    pytest.importorskip("mcap_protobuf")
    from google.protobuf import descriptor_pb2, descriptor_pool, message_factory, timestamp_pb2

    double, message = 1, 11
    file = descriptor_pb2.FileDescriptorProto(name="pose.proto", package="foxglove", syntax="proto3")
    file.dependency.append("google/protobuf/timestamp.proto")

    def add(name, fields):
        made = file.message_type.add(name=name)
        for number, (field, kind) in enumerate(fields, start=1):
            entry = made.field.add(name=field, number=number, label=1, type=kind if isinstance(kind, int) else message)
            if not isinstance(kind, int):
                entry.type_name = kind

    add("Vector3", [(name, double) for name in "xyz"])
    add("Quaternion", [(name, double) for name in "xyzw"])
    add("Pose", [("position", ".foxglove.Vector3"), ("orientation", ".foxglove.Quaternion")])
    fields = [("timestamp", ".google.protobuf.Timestamp"), ("frame_id", 9), ("pose", ".foxglove.Pose")]
    add("PoseInFrame", fields)
    stamps = descriptor_pb2.FileDescriptorProto.FromString(timestamp_pb2.DESCRIPTOR.serialized_pb)
    pool = descriptor_pool.DescriptorPool()
    pool.Add(stamps)
    pool.Add(file)
    kind = message_factory.GetMessageClass(pool.FindMessageTypeByName("foxglove.PoseInFrame"))

    def encode(stamp, xyz, xyzw):
        made = kind()
        made.timestamp.seconds, made.timestamp.nanos = stamp // 10**9, stamp % 10**9
        made.frame_id = "world"
        for name, value in zip("xyz", xyz, strict=True):
            setattr(made.pose.position, name, value)
        for name, value in zip("xyzw", xyzw, strict=True):
            setattr(made.pose.orientation, name, value)
        return made.SerializeToString()

    return descriptor_pb2.FileDescriptorSet(file=[stamps, file]).SerializeToString(), encode


# ---------------------------------------------------------------- what is not read


@pytest.mark.parametrize(
    ("name", "content", "said"),
    [
        ("a.pkl", b"\x80\x04\x95", "a pickle, which can run any code and is never opened"),
        ("a.json", b'{"frames": []}', "JSON of no layout that is known"),
        ("a.fbx", b"Kaydara FBX Binary  \x00", "an FBX file"),
        ("a.mat", b"MATLAB 5.0 MAT-file", "a MATLAB file"),
        ("a.mp4", b"\x00\x00\x00\x18ftypmp42", "a video"),
        ("a.gz", b"\x1f\x8b\x08", "a gzip archive"),
    ],
)
def test_a_file_that_is_not_read_is_named(tmp_path, name, content, said):
    (tmp_path / name).write_bytes(content)
    with pytest.raises(InvalidArgument, match=said):
        recordings.load(tmp_path / name)


@pytest.mark.parametrize("module", ["h5py", "pyarrow.parquet", "zarr"])
def test_without_the_package_the_error_names_the_extra(monkeypatch, module):
    from dmpcpp.recordings import _datasets

    def missing(name):
        raise ImportError(name)

    monkeypatch.setattr(_datasets, "import_module", missing)
    package = module.split(".")[0]
    with pytest.raises(MissingDependency, match=rf'read by {package}. Install it: pip install "dmpcpp\[datasets\]"'):
        _datasets.needed(module, "Such files")
