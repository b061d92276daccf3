"""Collision meshes cut into convex pieces: nothing is lost, hollows stay open."""

import itertools
import os
import struct

import numpy as np
import pytest
from dmpcpp.robot._convex_pieces import convex_pieces
from scipy.spatial import ConvexHull, Delaunay


def box(lower, upper):
    """The eight corners and twelve triangles of a box."""
    corners = np.array(list(itertools.product(*zip(lower, upper, strict=True))), dtype=float)
    return corners[ConvexHull(corners).simplices]


def grid(triangles, rounds=3):
    """Every triangle in four, several times over: cuts go between triangles."""
    for _ in range(rounds):
        a, b, c = triangles.transpose(1, 0, 2)
        ab, bc, ca = (a + b) / 2, (b + c) / 2, (c + a) / 2
        triangles = np.concatenate([np.stack(t, axis=1) for t in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))])
    return triangles


ANGLE = np.concatenate([grid(box((0, 0, 0), (1, 0.2, 0.2))), grid(box((0, 0, 0), (0.2, 0.2, 1)))])


def write_obj(path, triangles):
    lines = [f"v {x} {y} {z}" for x, y, z in triangles.reshape(-1, 3)]
    lines += [f"f {3 * k + 1}/1/1 {3 * k + 2}//2 {3 * k + 3}" for k in range(len(triangles))]
    path.write_text("# mesh\n" + "\n".join(lines))
    return path


def write_binary_stl(path, triangles):
    body = b"".join(struct.pack("<12fH", 0, 0, 0, *triangle.ravel(), 0) for triangle in triangles)
    path.write_bytes(b"solid pretends to be text".ljust(80) + struct.pack("<I", len(triangles)) + body)
    return path


def write_text_stl(path, triangles):
    facet = "facet normal 0 0 0\nouter loop\n{}\nendloop\nendfacet"
    corners = ["\n".join("vertex {} {} {}".format(*corner) for corner in triangle) for triangle in triangles]
    path.write_text("solid a\n" + "\n".join(facet.format(corner) for corner in corners) + "\nendsolid a\n")
    return path


def hulls(pieces):
    vertices = [[line.split()[1:] for line in piece.splitlines() if line.startswith("v ")] for piece in pieces]
    return [np.array(piece, dtype=float) for piece in vertices]


@pytest.mark.parametrize("write, name", [(write_obj, "a.obj"), (write_binary_stl, "a.STL"), (write_text_stl, "a.stl")])
def test_an_angle_iron_becomes_two_legs_with_the_corner_left_open(tmp_path, write, name):
    pieces = hulls(convex_pieces(write(tmp_path / name, ANGLE)))
    assert 2 <= len(pieces) <= 4
    assert sum(ConvexHull(piece).volume for piece in pieces) < 0.1  # the hull of the whole has 0.136, the iron 0.072
    assert not any(Delaunay(piece).find_simplex([0.45, 0.1, 0.45]) >= 0 for piece in pieces)


def test_every_corner_of_the_mesh_is_in_a_piece(tmp_path):
    pieces = hulls(convex_pieces(write_obj(tmp_path / "a.obj", ANGLE)))
    halfspaces = [ConvexHull(piece).equations for piece in pieces]
    for triangle in ANGLE:
        inside = [(h[:, :3] @ triangle.T + h[:, 3:] <= 1e-9).all() for h in halfspaces]
        assert any(inside)


def test_a_convex_mesh_stays_whole(tmp_path):
    pieces = hulls(convex_pieces(write_obj(tmp_path / "a.obj", grid(box((0, 0, 0), (1, 2, 3))))))
    assert len(pieces) == 1
    assert len(pieces[0]) == 8


def test_a_mesh_that_changed_is_read_again(tmp_path):
    path = write_obj(tmp_path / "a.obj", box((0, 0, 0), (1, 1, 1)))
    before = convex_pieces(path)
    write_obj(path, box((0, 0, 0), (2, 2, 2)))
    os.utime(path, ns=(1, 1))
    assert convex_pieces(path) != before


@pytest.mark.parametrize(("name", "text"), [("a.obj", ""), ("a.obj", "v 0 0 0\n"), ("a.stl", "solid")])
def test_a_mesh_without_triangles_has_no_pieces(tmp_path, name, text):
    (tmp_path / name).write_text(text)
    assert convex_pieces(tmp_path / name) is None
