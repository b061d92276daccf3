"""Damaged files: whatever happens to a file, only the two errors of the library come out of reading it."""

import json
import resource
import signal
import struct
import warnings
from contextlib import contextmanager, suppress

import numpy as np
import pytest
from dmpcpp import recordings
from dmpcpp.errors import FileError, InvalidArgument
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

FRAMES = 12
DAMAGED, DAMAGED_SLOWLY = 300, 3000  # files of every kind, without and with --slow
MOST_MEMORY = 1 << 30  # bytes that reading a small file may take
MOST_SECONDS = 5  # that reading a small file may take: a hang, not a measurement

POSE = {"x": "tx", "y": "ty", "z": "tz", "rx": "r1", "ry": "r2", "rz": "r3"}
STATED = {
    "deepmimic": {"body": "right_hand"},
    "tum": {},
    "table": {},
    "arrays": {"rate": 30.0, "quat_order": "xyzw"},
    "bvh": {"body": "Hand", "unit": "cm"},
    "c3d": {"markers": ["a", "b", "c"]},
    "ros": {},
    "qualisys": {"markers": ["a", "b", "c"]},
    "qualisys 6D": {"body": "hand"},
    "motive": {"body": "hand"},
    "vicon": {"markers": ["a", "b", "c"]},
    "trc": {"markers": ["a", "b", "c"]},
    "opensim": {"columns": POSE, "euler_order": "XYZ"},
    "euroc": {},
    "aria": {},
    "c3d rotation": {"body": "hand"},
    "hdf5": {"rate": 30.0, "quat_order": "xyzw"},
    "lerobot": {"dataset": "observation.state", "layout": "x,y,z,quat_xyzw", "rate": 30.0},
    "zarr": {"rate": 30.0, "episode": 0},
    "mvnx": {},
    "hot3d": {},
    "vicon segments": {"body": "hand", "rotation": "rotvec"},
    "table long": {"where": "hand=left"},
}


def clip() -> bytes:
    frame = np.zeros(44)
    frame[[0, 4, 8, 12, 16, 21, 25, 30, 35, 39]] = [1 / 30, 1, 1, 1, 1, 1, 1, 1, 1, 1]
    frames = np.tile(frame, (FRAMES, 1))
    frames[:, 1] = 0.01 * np.arange(FRAMES)
    return json.dumps({"Loop": "none", "Frames": frames.tolist()}, indent=0).encode()


def rows() -> np.ndarray:
    time = np.arange(FRAMES) / 30
    return np.column_stack([time, np.sin(time), np.cos(time), time, np.tile([0.0, 0.0, 0.6, 0.8], (FRAMES, 1))])


def tum() -> bytes:
    return b"# t tx ty tz qx qy qz qw\n" + b"".join(" ".join(map(str, r)).encode() + b"\n" for r in rows())


def table() -> bytes:
    return b"time,x,y,z,qx,qy,qz,qw\n" + b"".join(",".join(map(str, r)).encode() + b"\n" for r in rows())


def arrays(tmp_path) -> bytes:
    np.savez_compressed(tmp_path / "seed.npz", time=rows()[:, 0], pose=rows()[:, 1:])
    return (tmp_path / "seed.npz").read_bytes()


def npy(tmp_path) -> bytes:
    np.save(tmp_path / "seed.npy", rows())
    return (tmp_path / "seed.npy").read_bytes()


def lines(head, table, separator) -> bytes:
    return "\n".join([*head, *(separator.join(map(str, row)) for row in table)]).encode() + b"\n"


def corners() -> np.ndarray:
    """Return three markers (T, 9) in mm on a plate that moves."""
    shift = np.repeat(100.0 * rows()[:, 1:4], 3, axis=0).reshape(FRAMES, 9)
    return (shift + np.array([0, 0, 0, 80, 0, 0, 20, 50, 0])).round(3)


def counted() -> np.ndarray:
    return np.column_stack([np.arange(1, FRAMES + 1), rows()[:, 0]])


def bvh() -> bytes:
    head = """HIERARCHY
ROOT Hips
{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT Hand
  {
    OFFSET 5 0 0
    CHANNELS 3 Xrotation Yrotation Zrotation
    End Site
    {
      OFFSET 0 0 1
    }
  }
}
MOTION
Frames: 12
Frame Time: 0.033""".splitlines()
    return lines(head, corners(), " ")


def c3d() -> bytes:
    def parameter(name, kind, shape, data):
        body = struct.pack("bB", kind, len(shape)) + bytes(shape) + data + b"\0"
        return struct.pack("bb", len(name), 1) + name + struct.pack("<h", len(body) + 2) + body

    section = b"\1\x50\1\x54" + struct.pack("<bb5shb", 5, -1, b"POINT", 3, 0)
    section += parameter(b"UNITS", -1, (2,), b"mm") + parameter(b"LABELS", -1, (1, 3), b"abc")
    section += parameter(b"RATE", 4, (), struct.pack("<f", 30.0))
    header = b"\2\x50" + struct.pack("<5HfHHf", 3, 0, 1, FRAMES, 10, -1.0, 3, 0, 30.0)
    points = np.concatenate([corners().reshape(FRAMES, 3, 3), np.zeros((FRAMES, 3, 1))], axis=2)
    return header.ljust(512, b"\0") + section.ljust(512, b"\0") + points.astype("<f4").tobytes()


def qualisys() -> bytes:
    head = ["NO_OF_FRAMES\t12", "FREQUENCY\t30", "DATA_INCLUDED\t3D", "MARKER_NAMES\ta\tb\tc"]
    return lines(head, np.column_stack([counted(), corners()]), "\t")


def qualisys_6d() -> bytes:
    head = ["NO_OF_FRAMES\t12", "FREQUENCY\t30", "DATA_INCLUDED\t6D", "BODY_NAMES\thand"]
    pose = np.column_stack([corners()[:, :3], np.zeros((FRAMES, 4)), np.tile(np.eye(3).flatten(), (FRAMES, 1))])
    return lines(head, np.column_stack([counted(), pose]), "\t")


def motive() -> bytes:
    head = [
        "Format Version,1.23,Rotation Type,Quaternion,Length Units,Millimeters,Coordinate Space,Global",
        "",
        ",Type" + 7 * ",Rigid Body",
        ",Name" + 7 * ",hand",
        ",ID" + 7 * ",1",
        "," + 4 * ",Rotation" + 3 * ",Position",
        "Frame,Time (Seconds),X,Y,Z,W,X,Y,Z",
    ]
    return lines(head, np.column_stack([counted(), rows()[:, 4:], corners()[:, :3]]), ",")


def vicon() -> bytes:
    head = ["Trajectories", "30", ",,a,,,b,,,c", "Frame,Sub Frame" + 3 * ",X,Y,Z", "," + 9 * ",mm"]
    return lines(head, np.column_stack([counted(), corners()]).astype(object), ",")


def trc() -> bytes:
    head = [
        "PathFileType\t4\t(X/Y/Z)\ta.trc",
        "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits",
        "30\t30\t12\t3\tmm",
        "Frame#\tTime\ta\t\t\tb\t\t\tc",
        "\t\tX1\tY1\tZ1\tX2\tY2\tZ2\tX3\tY3\tZ3",
    ]
    return lines(head, np.column_stack([counted(), corners()]), "\t")


def opensim() -> bytes:
    head = ["Coordinates", "nRows=12", "inDegrees=yes", "endheader", "time\ttx\tty\ttz\tr1\tr2\tr3"]
    return lines(head, rows()[:, :7], "\t")


def euroc() -> bytes:
    head = ["#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z []"]
    stamps = [1_700_000_000_000_000_000 + 33_000_000 * k for k in range(FRAMES)]
    return lines(head, [[stamp, *row[1:]] for stamp, row in zip(stamps, rows(), strict=True)], ",")


def aria() -> bytes:
    head = ["tracking_timestamp_us," + ",".join(f"{what}_world_device" for what in POSES)]
    return lines(head, np.column_stack([(33e3 * np.arange(FRAMES)).astype(int), rows()[:, 1:]]), ",")


def table_long() -> bytes:
    twice = [[hand, *row] for row in rows() for hand in ("left", "right")]
    return lines(["hand,time,x,y,z,qx,qy,qz,qw"], twice, ",")


def vicon_segments() -> bytes:
    head = ["Segments", "30", ",,S:hand", "Frame,Sub Frame,RX,RY,RZ,TX,TY,TZ", ",,rad,rad,rad,mm,mm,mm"]
    turn = np.tile([0.1, 0.2, 0.3], (FRAMES, 1))
    return lines(head, np.column_stack([counted(), turn, corners()[:, :3]]).astype(object), ",")


def c3d_rotation() -> bytes:
    def parameter(group, name, kind, shape, data):
        body = struct.pack("bB", kind, len(shape)) + bytes(shape) + data + b"\0"
        return struct.pack("bb", len(name), group) + name + struct.pack("<h", len(body) + 2) + body

    section = b"\1\x50\1\x54" + struct.pack("<bb5shb", 5, -1, b"POINT", 3, 0)
    section += struct.pack("<bb8shb", 8, -2, b"ROTATION", 3, 0)
    section += parameter(1, b"UNITS", -1, (2,), b"mm") + parameter(1, b"USED", 2, (), struct.pack("<h", 0))
    for name, value in ((b"USED", 1), (b"RATIO", 1), (b"DATA_START", 3)):
        section += parameter(2, name, 2, (), struct.pack("<h", value))
    section += parameter(2, b"RATE", 4, (), struct.pack("<f", 30.0)) + parameter(2, b"LABELS", -1, (8,), b"hand_4X4")
    header = b"\2\x50" + struct.pack("<5HfHHf", 0, 0, 1, FRAMES, 10, -1.0, 3, 0, 30.0)
    numbers = np.zeros((FRAMES, 17))
    numbers[:, [0, 5, 10, 15]] = 1.0
    numbers[:, 12:15] = corners()[:, :3]
    return header.ljust(512, b"\0") + section.ljust(512, b"\0") + numbers.astype("<f4").tobytes()


def mvnx() -> bytes:
    frames = "".join(
        f'<frame index="{k}" type="normal"><orientation>{row[7]} {row[4]} {row[5]} {row[6]}</orientation>'
        f"<position>{row[1]} {row[2]} {row[3]}</position></frame>\n"
        for k, row in enumerate(rows())
    )
    head = '<mvnx version="4"><subject frameRate="30" segmentCount="1"><segments><segment label="Hand"/></segments>'
    return f"{head}<frames>{frames}</frames></subject></mvnx>".encode()


def hot3d() -> bytes:
    def line(row):
        wrist = {"t_xyz": row[1:4].tolist(), "q_wxyz": np.roll(row[4:], 1).tolist()}
        return json.dumps({"timestamp_ns": int(1e9 * row[0]), "hand_poses": {"0": {"wrist_xform": wrist}}})

    return "\n".join(map(line, rows())).encode()


def hdf5(folder, **packed) -> bytes:
    h5py = pytest.importorskip("h5py")
    with h5py.File(folder / "seed.h5", "w") as file:
        file.create_dataset("data/demo_0/obs/robot0_eef_pos", data=rows()[:, 1:4], **packed)
        file.create_dataset("data/demo_0/obs/robot0_eef_quat", data=rows()[:, 4:], **packed)
    return (folder / "seed.h5").read_bytes()


def hdf5_packed(folder) -> bytes:
    return hdf5(folder, chunks=(5, 3), compression="gzip", shuffle=True, fletcher32=True)


def lerobot(folder) -> bytes:
    pyarrow = pytest.importorskip("pyarrow")
    from pyarrow import parquet

    state = pyarrow.FixedSizeListArray.from_arrays(rows()[:, 1:].astype(np.float32).reshape(-1), 7)
    table = {"observation.state": state, "episode_index": pyarrow.array(np.zeros(FRAMES, dtype=int))}
    parquet.write_table(pyarrow.table(table), folder / "seed.parquet")
    return (folder / "seed.parquet").read_bytes()


def zarr_3(folder) -> bytes:
    return zarr(folder, version=3)


def zarr(folder, version=2) -> bytes:
    package = pytest.importorskip("zarr")
    path = folder / "seed.zarr.zip"
    path.unlink(missing_ok=True)
    with package.storage.ZipStore(path, mode="w") as store:
        root = package.open_group(store, mode="w", zarr_format=version)
        root.create_array("data/robot0_eef_pos", data=rows()[:, 1:4])
        root.create_array("data/robot0_eef_rot_axis_angle", data=0.1 * rows()[:, 1:4])
        root.create_array("meta/episode_ends", data=np.array([FRAMES]))
    return path.read_bytes()


def foxglove(folder) -> bytes:
    package = pytest.importorskip("mcap.writer")
    with (folder / "foxglove.mcap").open("wb") as file:
        writer = package.Writer(file)
        writer.start()
        channel = writer.register_channel(
            "/hand", "json", writer.register_schema("foxglove.PoseInFrame", "jsonschema", b"{}")
        )
        for k, row in enumerate(rows()):
            pose = {
                "position": dict(zip("xyz", row[1:4], strict=True)),
                "orientation": dict(zip("xyzw", row[4:], strict=True)),
            }
            content = {"timestamp": {"sec": k, "nsec": 0}, "frame_id": "world", "pose": pose}
            writer.add_message(channel, log_time=k, publish_time=k, data=json.dumps(content).encode())
        writer.finish()
    return (folder / "foxglove.mcap").read_bytes()


POSES = ("tx", "ty", "tz", "qx", "qy", "qz", "qw")


def bag(folder, kind) -> bytes:
    """Return the file of a bag of stamped poses."""
    pytest.importorskip("rosbags")
    from rosbags import rosbag1, rosbag2
    from rosbags.typesys import Stores, get_typestore

    first = kind == "ros1"
    store = get_typestore(Stores.ROS1_NOETIC if first else Stores.ROS2_HUMBLE)
    path = folder / f"seed.{kind}"
    plugin = None if first else rosbag2.StoragePlugin[kind.upper()]
    writer = rosbag1.Writer(path) if first else rosbag2.Writer(path, version=9, storage_plugin=plugin)
    kinds = {"Header": "std_msgs", "Time": "builtin_interfaces"}
    names = ("Header", "Time", "Point", "Quaternion", "Pose", "PoseStamped")
    types = {name: store.types[f"{kinds.get(name, 'geometry_msgs')}/msg/{name}"] for name in names}
    with writer:
        connection = writer.add_connection("/hand", "geometry_msgs/msg/PoseStamped", typestore=store)
        for k, row in enumerate(rows()):
            stamp = types["Time"](sec=k, nanosec=0)
            header = types["Header"](**({"seq": 0} if first else {}), stamp=stamp, frame_id="world")
            pose = types["Pose"](position=types["Point"](*row[1:4]), orientation=types["Quaternion"](*row[4:]))
            message = types["PoseStamped"](header=header, pose=pose)
            serialize = store.serialize_ros1 if first else store.serialize_cdr
            writer.write(connection, k, serialize(message, message.__msgtype__))
    return (path if first else next(file for file in path.iterdir() if file.suffix != ".yaml")).read_bytes()


class Hang(BaseException):
    """No Exception, so that a reader that meets any damage with one of its two errors does not catch it."""


@contextmanager
def bounded():
    """Stop what takes more memory or time than reading a small file should."""

    def stop(number, frame):
        raise Hang(f"still reading after {MOST_SECONDS} s")

    soft, hard = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (16 * MOST_MEMORY, hard))  # claimed, not taken; spares the machine
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    before = signal.signal(signal.SIGALRM, stop)
    signal.alarm(MOST_SECONDS)
    try:
        yield
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)
        resource.setrlimit(resource.RLIMIT_AS, (soft, hard))
    assert 1024 * (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - peak) < MOST_MEMORY


def attempt(path, content, format, **stated):
    """Read `content`; a Recording or one of the two errors is all that may come out."""
    path.write_bytes(content)
    with warnings.catch_warnings(), bounded():
        warnings.simplefilter("error")
        try:
            recording = recordings.load(path, format=format, **stated)
        except (InvalidArgument, FileError) as error:
            assert str(error)
            return None
    assert np.isfinite(recording.position[~recording.missing]).all()
    return recording


MADE = {
    "deepmimic": ("a.txt", clip),
    "tum": ("a.tum", tum),
    "table": ("a.csv", table),
    "arrays": ("a.npz", arrays),
    "arrays npy": ("a.npy", npy),
    "bvh": ("a.bvh", bvh),
    "c3d": ("a.c3d", c3d),
    "ros 1": ("a.bag", lambda folder: bag(folder, "ros1")),
    "ros 2 sqlite3": ("a.db3", lambda folder: bag(folder, "sqlite3")),
    "ros 2 mcap": ("a.mcap", lambda folder: bag(folder, "mcap")),
    "qualisys": ("a.tsv", qualisys),
    "qualisys 6D": ("a_6D.tsv", qualisys_6d),
    "motive": ("motive.csv", motive),
    "vicon": ("vicon.csv", vicon),
    "trc": ("a.trc", trc),
    "opensim": ("a.mot", opensim),
    "euroc": ("euroc.csv", euroc),
    "aria": ("aria.csv", aria),
    "table long": ("long.csv", table_long),
    "vicon segments": ("segments.csv", vicon_segments),
    "c3d rotation": ("rotation.c3d", c3d_rotation),
    "mvnx": ("a.mvnx", mvnx),
    "hot3d": ("a.jsonl", hot3d),
    "hdf5": ("a.h5", hdf5),
    "hdf5 packed": ("packed.h5", hdf5_packed),
    "lerobot": ("a.parquet", lerobot),
    "zarr": ("a.zarr.zip", zarr),
    "zarr 3": ("three.zarr.zip", zarr_3),
    "ros foxglove": ("foxglove.mcap", foxglove),
}
KINDS = list(MADE)


def made(kind, folder) -> bytes:
    """Return an undamaged file of a kind; some writers need a folder."""
    make = MADE[kind][1]
    return make(folder) if make.__code__.co_argcount else make()


def stated_of(kind) -> dict[str, object]:
    """Return what is stated about the files of a kind."""
    return STATED.get(kind, STATED.get(kind.split()[0]))


@pytest.fixture(scope="module")
def seeds(tmp_path_factory):
    """An undamaged file of each kind: its path, its content, its format and what is stated about it."""
    folder = tmp_path_factory.mktemp("seeds")

    def seed(kind):
        return folder / MADE[kind][0], made(kind, folder), kind.split()[0], stated_of(kind)

    known = {}
    return lambda kind: known.get(kind) or known.setdefault(kind, seed(kind))


@pytest.mark.parametrize("kind", KINDS)
def test_the_undamaged_file_reads_and_is_recognised(seeds, kind):
    path, content, format, stated = seeds(kind)
    assert len(attempt(path, content, format, **stated)) == FRAMES
    assert recordings.format_of(path) == format


@pytest.mark.parametrize("kind", KINDS)
def test_a_file_cut_off_anywhere_is_read_or_refused(seeds, kind):
    path, content, format, stated = seeds(kind)
    for end in np.unique(np.linspace(0, len(content) - 1, 300).astype(int)):
        attempt(path, content[:end], format, **stated)


SPITE = [
    b"nan",
    b"1e999",
    b"-",
    b"\x00",
    b"\xff\xfe",
    b"1" * 400,
    b"[" * 50,
    b'"',
    b",,",
    b"\r",
    b"\n",
    b"0x1",
    b"e",
]


def damaged(content, random, spiteful) -> bytes:
    changed = bytearray(content)
    for _ in range(random.integers(1, 4)):
        at = int(random.integers(len(changed)))
        if spiteful:
            changed[at : at + int(random.integers(6))] = SPITE[random.integers(len(SPITE))]
        else:
            changed[at] = int(random.integers(256))
    return bytes(changed)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("trials", [DAMAGED, pytest.param(DAMAGED_SLOWLY, marks=pytest.mark.slow)])
def test_a_file_with_damaged_bytes_is_read_or_refused(seeds, kind, trials):
    path, content, format, stated = seeds(kind)
    random = np.random.default_rng(trials)
    for trial in range(trials):
        attempt(path, damaged(content, random, trial % 2), format, **stated)


@pytest.mark.parametrize("kind", ["ros 2 sqlite3", "ros 2 mcap"])
def test_a_bag_folder_with_damaged_metadata_is_read_or_refused(tmp_path, kind):
    bag(tmp_path, kind.split()[-1])
    folder = tmp_path / f"seed.{kind.split()[-1]}"
    metadata = folder / "metadata.yaml"
    content, random = metadata.read_bytes(), np.random.default_rng(5)
    for trial in range(100):
        metadata.write_bytes(damaged(content, random, trial % 2))
        with bounded(), suppress(InvalidArgument, FileError):
            recordings.load(folder)


@pytest.mark.parametrize("kind", KINDS)
@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(content=st.one_of(st.binary(max_size=300), st.text(max_size=200).map(str.encode)))
def test_arbitrary_bytes_are_read_or_refused(tmp_path, kind, content):
    format = kind.split()[0]
    attempt(tmp_path / MADE[kind][0], content, format, **stated_of(kind))
    attempt(tmp_path / "a.csv", content, None)
