"""Files that ask for more than they should: refused before memory is taken, and nothing but numbers is opened."""

import io
import json
import pickle
import resource
import zipfile
import zlib
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest
from dmpcpp import recordings
from dmpcpp.errors import InvalidArgument
from dmpcpp.recordings._numpy_files import read_arrays

COUNT = 60
TIME = 0.05 * np.arange(COUNT)
MORE = 160 << 20  # bytes that a refusal may take, an arena of malloc among them


def poses(shift=0.0):
    made = np.tile(np.eye(4), (COUNT, 1, 1))
    made[:, :3, 3] = np.column_stack([0.3 + 0.1 * np.sin(TIME) + shift, 0.2 * np.cos(TIME), 0.5 + 0.05 * TIME])
    return made


@contextmanager
def little_memory():
    """Let what takes much more memory than there is by now end in a MemoryError, which is none of the errors here."""
    pages = int(Path("/proc/self/statm").read_text().split()[0])
    soft, hard = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (pages * resource.getpagesize() + MORE, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_AS, (soft, hard))


# ---------------------------------------------------------------- NumPy


def test_a_pickle_in_a_npz_is_named_and_never_opened(tmp_path):
    class Trap:
        def __reduce__(self):
            return open, (str(tmp_path / "opened"), "w")

    np.savez(tmp_path / "a.npz", log=np.array([Trap()], dtype=object), other=np.zeros(3))
    with pytest.raises(InvalidArgument, match="Pickles, never opened: log"):
        recordings.load(tmp_path / "a.npz", rate=20.0)
    with pytest.raises(InvalidArgument, match="'log' is a pickle, which can run any code and is never opened"):
        read_arrays(tmp_path / "a.npz")
    assert not (tmp_path / "opened").exists()
    np.savez(tmp_path / "b.npz", log=np.array([Trap()], dtype=object), pose=poses(), time=TIME)
    assert len(recordings.load(tmp_path / "b.npz")) == COUNT and not (tmp_path / "opened").exists()


def test_arrays_that_are_not_needed_are_not_read(tmp_path):
    np.savez_compressed(tmp_path / "a.npz", pose=poses(), time=TIME, images=np.zeros((240, 1 << 20), np.uint8))
    with little_memory():
        assert len(recordings.load(tmp_path / "a.npz")) == COUNT


def test_all_arrays_of_a_npz_together_are_bounded(tmp_path):
    np.savez_compressed(tmp_path / "a.npz", **{f"a{k}": np.zeros(1 << 22, np.int8) for k in range(9)})
    with pytest.raises(InvalidArgument, match="a8: 33554432 bytes in memory, expected at most 268435456"):
        read_arrays(tmp_path / "a.npz")


def test_a_small_array_of_bytes_that_becomes_large_is_refused(tmp_path):
    np.savez_compressed(tmp_path / "a.npz", pose=np.zeros((5_000_000, 7), np.int8))
    with little_memory(), pytest.raises(InvalidArgument, match="pose: 280000000 bytes in memory"):
        recordings.load(tmp_path / "a.npz", rate=20.0, quat_order="xyzw")


def npz(path, members, packing=zipfile.ZIP_STORED):
    with zipfile.ZipFile(path, "w", packing) as archive:
        for name, array in members:
            content = io.BytesIO()
            np.save(content, array)
            archive.writestr(f"{name}.npy", content.getvalue())
    return path


@pytest.mark.filterwarnings("ignore:Duplicate name")
def test_a_name_that_stands_twice_in_a_npz_is_refused(tmp_path):
    path = npz(tmp_path / "a.npz", [("pose", poses()), ("pose", poses(0.1)), ("time", TIME)])
    with pytest.raises(InvalidArgument, match="the array 'pose' stands twice"):
        recordings.load(path)


@pytest.mark.parametrize("packing", [zipfile.ZIP_BZIP2, zipfile.ZIP_LZMA])
def test_a_npz_is_packed_as_numpy_packs_it(tmp_path, packing):
    with pytest.raises(InvalidArgument, match="packed as no NumPy file is"):
        recordings.load(npz(tmp_path / "a.npz", [("pose", poses()), ("time", TIME)], packing))


# ---------------------------------------------------------------- HDF5

h5py = pytest.importorskip("h5py")


def dataset(path, **how):
    """Write a file whose data set hand_pos is made by what is given, beside rotations that are sound."""
    with h5py.File(path, "w") as file:
        file["hand_rotvec"] = np.zeros((COUNT, 3))
        data = file.create_dataset("hand_pos", **how)
        if "compression" in how:
            data.id.write_direct_chunk((0, 0), zlib.compress(bytes(200 << 20), 9))
    return path


@pytest.mark.parametrize(
    ("how", "said"),
    [
        ({"shape": (20_000_000, 3), "dtype": "i1"}, "hand_pos: 480000000 bytes in memory"),
        ({"shape": (COUNT, 3), "maxshape": (None, 3), "chunks": (1 << 24, 3), "dtype": "f4"}, "of 201326592 bytes"),
        (
            {"shape": (COUNT, 3), "chunks": (COUNT, 3), "dtype": "f8", "compression": "gzip"},
            "damaged or unpacks to more than 1440 bytes|a chunk of .* bytes for 1440",
        ),
    ],
)
def test_what_an_hdf5_file_unpacks_to_is_bounded(tmp_path, how, said):
    path = dataset(tmp_path / "a.h5", **how)
    with little_memory(), pytest.raises(InvalidArgument, match=said):
        recordings.load(path, rate=20.0, dataset="hand_pos,hand_rotvec")


def test_a_small_chunk_that_unpacks_without_end_is_refused(tmp_path):
    with h5py.File(tmp_path / "a.h5", "w") as file:
        data = file.create_dataset("hand", (1000, 16), chunks=(1000, 16), dtype="f8", compression="gzip")
        data.id.write_direct_chunk((0, 0), zlib.compress(bytes(100 << 20), 9))  # 100 kB, as the numbers might be
    with little_memory(), pytest.raises(InvalidArgument, match="damaged or unpacks to more than 128000 bytes"):
        recordings.load(tmp_path / "a.h5", rate=20.0, dataset="hand", layout="mat16")


@pytest.mark.parametrize("how", [{"compression": "gzip", "shuffle": True, "fletcher32": True}, {"compression": "lzf"}])
def test_usual_filters_are_read(tmp_path, how):
    with h5py.File(tmp_path / "a.h5", "w") as file:
        file.create_dataset("hand", data=poses(), chunks=(7, 4, 4), **how)
    found = recordings.load(tmp_path / "a.h5", rate=20.0)
    np.testing.assert_array_equal(found.position, poses()[:, :3, 3])


def test_other_filters_are_named(tmp_path):
    with h5py.File(tmp_path / "a.h5", "w") as file:
        settings = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
        settings.set_chunk((COUNT, 4, 4))
        settings.set_filter(32015, h5py.h5z.FLAG_OPTIONAL, ())
        space = h5py.h5s.create_simple((COUNT, 4, 4))
        h5py.h5d.create(file.id, b"hand", h5py.h5t.IEEE_F64LE, space, settings)
    with pytest.raises(InvalidArgument, match="packed by HDF5 filter 32015, expected one of gzip.*h5repack"):
        recordings.load(tmp_path / "a.h5", rate=20.0)


# ---------------------------------------------------------------- zarr

zarr = pytest.importorskip("zarr")


def buffer(folder, version=2, codec=None):
    """Write a replay buffer; `codec` packs the positions."""
    root = zarr.open_group(zarr.storage.LocalStore(folder), mode="w", zarr_format=version)
    how = {} if codec is None else {"compressors": [codec]}
    root.create_array("data/hand_pos", data=poses()[:, :3, 3], chunks=(COUNT, 3), **how)
    root.create_array("data/hand_axis_angle", data=np.zeros((COUNT, 3)))
    return folder


def numcodec(name):
    import numcodecs

    return numcodecs.get_codec({"id": name})


@pytest.mark.parametrize("name", ["blosc", "zlib", "gzip", "zstd", "lz4"])
def test_usual_codecs_are_read_and_their_bombs_refused(tmp_path, name):
    folder = buffer(tmp_path / "a.zarr", codec=numcodec(name))
    found = recordings.load(folder, rate=20.0)
    np.testing.assert_array_equal(found.position, poses()[:, :3, 3])
    bomb = numcodec(name).encode(np.zeros(2 << 20))
    assert len(bomb) < 100_000
    (folder / "data" / "hand_pos" / "0.0").write_bytes(bomb[:5000] if name == "blosc" else bomb)
    with little_memory(), pytest.raises(InvalidArgument, match=r"hand_pos: a chunk is damaged|no chunk of at most"):
        recordings.load(folder, rate=20.0)


@pytest.mark.parametrize("name", ["pickle", "json2", "vlen-utf8", "lzma", "bz2"])
def test_other_codecs_are_refused_by_name(tmp_path, name):
    folder = buffer(tmp_path / "a.zarr")
    path = folder / "data" / "hand_pos" / ".zarray"
    content = json.loads(path.read_text())
    path.write_text(json.dumps(content | {"compressor": {"id": name}}))
    opened = tmp_path / "opened"
    (folder / "data" / "hand_pos" / "0.0").write_bytes(pickle.dumps(opened.touch))
    with pytest.raises(InvalidArgument, match=f"hand_pos: packed by {name}, expected one of blosc, zlib, gzip"):
        recordings.load(folder, rate=20.0)


def test_sharded_arrays_are_refused(tmp_path):
    root = zarr.open_group(zarr.storage.LocalStore(tmp_path / "a.zarr"), mode="w", zarr_format=3)
    root.create_array("hand", data=poses(), chunks=(5, 4, 4), shards=(60, 4, 4))
    with pytest.raises(InvalidArgument, match="hand: packed by sharding_indexed"):
        recordings.load(tmp_path / "a.zarr", rate=20.0)


def test_an_array_described_twice_is_refused(tmp_path):
    folder = buffer(tmp_path / "a.zarr")
    other = buffer(tmp_path / "b.zarr", version=3)
    (folder / "data" / "hand_pos" / "zarr.json").write_bytes((other / "data" / "hand_pos" / "zarr.json").read_bytes())
    with pytest.raises(InvalidArgument, match="two files of metadata"):
        recordings.load(folder, rate=20.0)


def test_a_chunk_that_leads_out_of_the_folder_is_no_chunk(tmp_path):
    folder = buffer(tmp_path / "a.zarr")
    chunk = folder / "data" / "hand_pos" / "0.0"
    chunk.unlink()
    chunk.symlink_to("/dev/zero")
    with pytest.raises(InvalidArgument, match="no chunk of at most"):
        recordings.load(folder, rate=20.0)


# ---------------------------------------------------------------- parquet


@pytest.mark.parametrize(
    ("fixed", "said"),
    [
        (True, "1000 rows of 40000 numbers, expected at most 10000000 rows and 268435456 bytes"),
        (False, "observation.state has more than 268435456 bytes"),
    ],
)
def test_a_column_of_a_parquet_file_is_bounded(tmp_path, fixed, said):
    pyarrow, parquet = pytest.importorskip("pyarrow"), pytest.importorskip("pyarrow.parquet")
    width, rows = 40_000, 1000
    flat = pyarrow.array(np.zeros(rows * width, np.float32))
    ends = pyarrow.array(np.arange(0, rows * width + 1, width, dtype=np.int32))
    lists = pyarrow.FixedSizeListArray.from_arrays(flat, width) if fixed else pyarrow.ListArray.from_arrays(ends, flat)
    table = pyarrow.table({"observation.state": lists, "episode_index": pyarrow.array(np.zeros(rows, int))})
    parquet.write_table(table, tmp_path / "a.parquet")
    with pytest.raises(InvalidArgument, match=said):
        recordings.load(tmp_path / "a.parquet", dataset="observation.state", layout="x,y,z,rotvec,gripper", rate=20.0)


# ---------------------------------------------------------------- names in groups


def grouped(folder, kind):
    """Write two hands whose arrays differ in their group alone, each with times and a gripper of its own."""
    arrays = {}
    for side, shift, delay in (("left", 0.0, 0.0), ("right", 0.5, 1.0)):
        arrays |= {f"{side}/hand": poses(shift), f"{side}/time": TIME * (1.0 + delay), f"{side}/gripper": TIME + shift}
    if kind == "npz":
        np.savez(folder / "a.npz", **{name: array for name, array in arrays.items() if "time" not in name}, rate=20.0)
        return folder / "a.npz"
    if kind == "zarr":
        root = zarr.open_group(zarr.storage.LocalStore(folder / "a.zarr"), mode="w", zarr_format=2)
        for name, array in arrays.items():
            root.create_array(name, data=array)
        return folder / "a.zarr"
    with h5py.File(folder / "a.h5", "w") as file:
        for name, array in arrays.items():
            file[name] = array
    return folder / "a.h5"


@pytest.mark.parametrize("kind", ["npz", "hdf5", "zarr"])
def test_arrays_of_one_name_in_different_groups_are_different_bodies(tmp_path, kind):
    path = grouped(tmp_path, kind)
    assert set(recordings.bodies(path)) == {"left/hand", "right/hand"}
    with pytest.raises(InvalidArgument, match="left/hand, right/hand"):
        recordings.load(path)
    for side, shift, delay in (("left", 0.0, 0.0), ("right", 0.5, 1.0)):
        found = recordings.load(path, f"{side}/hand")
        np.testing.assert_array_equal(found.position, poses(shift)[:, :3, 3])
        if kind != "npz":
            np.testing.assert_allclose(found.time, TIME * (1.0 + delay), atol=1e-12)
        if kind == "hdf5":
            np.testing.assert_array_equal(found.channels[f"{side}/gripper"], TIME + shift)


def test_two_ways_to_write_one_pose_are_two_bodies(tmp_path):
    turn = np.tile([0.0, 0.0, 0.6, 0.8], (COUNT, 1))
    np.savez(tmp_path / "a.npz", hand=poses(), hand_pos=poses(0.1)[:, :3, 3], hand_quat=turn, rate=20.0)
    assert set(recordings.bodies(tmp_path / "a.npz")) == {"hand", "hand_pos"}
    found = recordings.load(tmp_path / "a.npz", "hand_pos", quat_order="xyzw")
    np.testing.assert_array_equal(found.position, poses(0.1)[:, :3, 3])


def test_episodes_of_one_number_in_two_groups_are_all_offered(tmp_path):
    with h5py.File(tmp_path / "a.h5", "w") as file:
        for side, shift in (("left", 0.0), ("right", 0.5)):
            for k in range(2):
                file[f"{side}/demo_{k}/hand"] = poses(shift + 0.1 * k)
    names = {f"{side}/demo_{k}/hand" for side in ("left", "right") for k in range(2)}
    assert set(recordings.bodies(tmp_path / "a.h5")) == names
    found = recordings.load(tmp_path / "a.h5", "right/demo_1/hand", rate=20.0)
    np.testing.assert_array_equal(found.position, poses(0.6)[:, :3, 3])
