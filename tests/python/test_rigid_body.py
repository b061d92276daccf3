"""Rigid bodies from markers: the pose that three or more markers tell."""

import numpy as np
import pytest
from dmpcpp import recordings
from dmpcpp.errors import InvalidArgument
from dmpcpp.recordings import Markers, rigid_body
from dmpcpp.recordings._rigid_body import fit_poses
from scipy.spatial.transform import Rotation

COUNT = 60
TIMES = 0.01 * np.arange(COUNT)
SHAPE = np.array([[0.0, 0.0, 0.0], [0.08, 0.0, 0.0], [0.02, 0.05, 0.0], [0.03, 0.02, 0.04]])
TURNS = Rotation.from_rotvec(np.linspace([0.1, 0.0, 0.0], [0.4, -1.0, 2.0], COUNT))
SHIFT = np.column_stack([np.sin(TIMES), np.cos(TIMES), TIMES])
NAMES = ("a", "b", "c", "d")


def moved(noise=0.0, shape=SHAPE, seed=1) -> Markers:
    points = np.einsum("tij,mj->tmi", TURNS.as_matrix(), shape) + SHIFT[:, None]
    points += noise * np.random.default_rng(seed).normal(size=points.shape)
    return Markers(NAMES[: len(shape)], TIMES, points)


def hidden(markers: Markers, frames, names) -> Markers:
    position = markers.position.copy()
    for name in names:
        position[frames, markers.names.index(name)] = np.nan
    return Markers(markers.names, markers.time, position)


def test_a_plate_that_moves_rigidly_is_followed_exactly():
    body = rigid_body(moved(), NAMES, "hand")
    assert body.body == "hand"
    np.testing.assert_allclose(body.rotation, TURNS.as_matrix(), atol=1e-12)
    np.testing.assert_allclose(body.position, SHIFT + TURNS.apply(SHAPE.mean(axis=0)), atol=1e-12)


def test_the_axes_point_from_the_first_marker_to_the_second_and_along_the_normal():
    body = rigid_body(moved(), ["c", "a", "b"])
    points = moved().chosen(["c", "a", "b"]).position
    x = points[:, 1] - points[:, 0]
    normal = np.cross(x, points[:, 2] - points[:, 0])
    np.testing.assert_allclose(body.rotation[:, :, 0], x / np.linalg.norm(x, axis=1)[:, None], atol=1e-12)
    np.testing.assert_allclose(body.rotation[:, :, 2], normal / np.linalg.norm(normal, axis=1)[:, None], atol=1e-12)


def test_every_frame_agrees_with_scipys_least_squares():
    noisy = moved(noise=0.001).position
    rotation, position, residual = fit_poses(SHAPE, noisy)
    for k in range(0, COUNT, 7):
        oracle, distance = Rotation.align_vectors(noisy[k] - noisy[k].mean(axis=0), SHAPE - SHAPE.mean(axis=0))
        np.testing.assert_allclose(rotation[k], oracle.as_matrix(), atol=1e-9)
        np.testing.assert_allclose(position[k], noisy[k].mean(axis=0) - oracle.apply(SHAPE.mean(axis=0)), atol=1e-12)
        assert residual[k] == pytest.approx(distance / np.sqrt(len(SHAPE)), rel=1e-9)


def test_four_markers_in_a_plane_are_not_mirrored():
    flat = SHAPE * [1.0, 1.0, 0.0] + [[0.0, 0.0, 0.0]]
    body = rigid_body(moved(noise=1e-4, shape=flat), NAMES)
    np.testing.assert_allclose(np.linalg.det(body.rotation), 1.0, atol=1e-9)
    turned = (Rotation.from_matrix(body.rotation) * TURNS.inv()).magnitude()
    assert turned.max() < 0.02


def test_one_hidden_marker_of_four_leaves_no_gap_and_two_do():
    one = rigid_body(hidden(moved(), slice(10, 20), "b"), NAMES)
    assert not one.missing.any()
    np.testing.assert_allclose(one.rotation, TURNS.as_matrix(), atol=1e-12)
    two = rigid_body(hidden(moved(), slice(10, 20), "bc"), NAMES)
    assert np.flatnonzero(two.missing).tolist() == list(range(10, 20))
    assert any("10 of 60 samples are missing: too few markers" in note for note in two.history)


def test_the_residual_is_reported_and_markers_of_two_bodies_are_warned_of():
    quiet = rigid_body(moved(noise=1e-4), NAMES)
    note = next(note for note in quiet.history if note.startswith("markers lie"))
    # four markers have 12 coordinates, a pose takes 6 of them: sqrt(6 / 4) of the noise remains
    assert float(note.split()[2]) == pytest.approx(0.1 * np.sqrt(6 / 4), rel=0.1)
    loose = moved().position.copy()
    loose[:, 3] += 0.05 * np.sin(20 * TIMES)[:, None]
    odd = rigid_body(Markers(NAMES, TIMES, loose), NAMES)
    assert any(note.startswith("WARNING: markers lie") for note in odd.history)


def test_frames_of_mistaken_markers_can_be_taken_out():
    swapped = moved().position.copy()
    swapped[30] = swapped[30][[1, 0, 2, 3]]
    body = rigid_body(Markers(NAMES, TIMES, swapped), NAMES, max_residual=0.005)
    assert np.flatnonzero(body.missing).tolist() == [30]


@pytest.mark.parametrize(
    ("names", "message"),
    [
        (["a", "b"], "three or more that differ"),
        (["a", "b", "b"], "three or more that differ"),
        ("abc", "three or more that differ"),
        (["a", "b", "z"], "no marker 'z'. The file holds: a, b, c, d"),
    ],
)
def test_markers_that_do_not_make_a_body_are_refused(names, message):
    with pytest.raises(InvalidArgument, match=message):
        rigid_body(moved(), names)


def test_markers_in_one_line_or_never_seen_together_are_refused():
    line = np.array([[0.0, 0, 0], [0.1, 0, 0], [0.2, 0.001, 0]])
    with pytest.raises(InvalidArgument, match="lie on one line"):
        rigid_body(moved(shape=line), NAMES[:3])
    with pytest.raises(InvalidArgument, match=r"one is 1e\+308 m from the origin, expected at most 1e\+06 m"):
        rigid_body(moved(shape=1e308 * np.eye(4)[:, :3]), NAMES)
    points = moved(shape=SHAPE[:3]).position.copy()
    points[1::2] = 100.0 * np.array([[0.0, 0, 0], [1, 0, 0], [2, 0, 0]])
    loose = Markers(NAMES[:3], TIMES, points)
    with pytest.raises(InvalidArgument, match="a, b, c do not keep their distances"):
        rigid_body(loose, NAMES[:3])
    apart = hidden(hidden(moved(), slice(0, 30), "a"), slice(30, 60), "b")
    with pytest.raises(InvalidArgument, match=r"no frame shows all of them. Missing: a 50 %, b 50 %"):
        rigid_body(apart, NAMES)
    with pytest.raises(InvalidArgument, match="max_residual: -1"):
        rigid_body(moved(), NAMES, max_residual=-1)


def test_the_recorded_hand_plate_is_rigid_to_a_tenth_of_a_millimetre(recorded):
    path = recorded / "qualisys_dfki" / "recording.tsv"
    hand = recordings.load(path, "hand", markers=["hand_top", "hand_left", "hand_right"], up_axis="z")
    assert (hand.body, len(hand), hand.missing.any()) == ("hand", 6000, False)
    note = next(note for note in hand.history if "mm rms from the rigid body" in note)
    assert float(note.split()[2]) < 0.1


def test_the_wheelchair_hands_are_followed_through_their_gaps(recorded):
    path = recorded / "c3d_ktk" / "sample_propulsion.c3d"
    hand = recordings.load(path, markers=["GloveR1", "GloveR2", "GloveR3"])
    assert hand.missing.sum() == 11
    assert hand.rate == pytest.approx(69.9926, abs=1e-3)
