"""Normals by the gradient; a place in the world and names, which the file keeps."""

from __future__ import annotations

import numpy as np
import pfgeom
import pytest
import shapes
from pfgeom.normals import corner_normals


def degrees_between(a, b):
    return np.degrees(np.arccos(np.clip((a * b).sum(axis=-1), -1, 1)))


def face_normals(mesh):
    a, b, c = (mesh.vertices[mesh.faces[:, i]] for i in range(3))
    normals = np.cross(b - a, c - a)
    return normals / np.linalg.norm(normals, axis=1, keepdims=True)


def test_smooth_normals_are_those_of_the_function(sphere_model):
    """Of a ball: along the radius, at a resolution whose faces are degrees off."""
    mesh = sphere_model.to_mesh(resolution=12)
    normals = sphere_model.corner_normals(mesh)
    radial = mesh.vertices[mesh.faces] / np.linalg.norm(mesh.vertices[mesh.faces], axis=2, keepdims=True)
    assert normals.shape == (len(mesh.faces), 3, 3)
    assert np.linalg.norm(normals, axis=2) == pytest.approx(1)
    assert degrees_between(normals, radial).max() < 0.5
    assert degrees_between(normals, face_normals(mesh)[:, None]).max() > 3


def test_creases_stay_sharp(gear_model):
    """Top and bottom of a gear are flat up to their rim, where the sides stand at a right angle."""
    mesh = gear_model.to_mesh()
    faces = face_normals(mesh)
    off = degrees_between(gear_model.corner_normals(mesh), faces[:, None])
    caps = np.abs(faces[:, 2]) > 0.99
    assert caps.any() and off[caps].max() < 0.1
    assert off.max() <= 30.1


def test_mesh_parts_take_their_faces(soup_model):
    mesh = soup_model.to_mesh()
    assert degrees_between(soup_model.corner_normals(mesh), face_normals(mesh)[:, None]).max() < 1e-3


def test_mesh_parts_keep_their_creases():
    """A long box: at its corners the long sides outweigh the others, and must not pull their normals along."""
    corners, faces = shapes.cube()
    box = pfgeom.Mesh(corners * [1, 1, 5], faces.astype(np.int32))
    normals = corner_normals(np.zeros_like, False, box, 30.0)
    assert degrees_between(normals, face_normals(box)[:, None]).max() < 1e-3


def test_mesh_parts_are_smooth_between_creases():
    """A tin of 24 facets: round its side as a cylinder, its lids flat up to the rim."""
    turn = 2 * np.pi * np.arange(24) / 24
    ring = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    points = np.concatenate([np.c_[ring, np.zeros(24)], np.c_[ring, np.ones(24)], [[0, 0, 0], [0, 0, 1]]])
    here, there = np.arange(24), np.roll(np.arange(24), -1)
    lids = [np.stack([np.full(24, 48), there, here], 1), np.stack([np.full(24, 49), here + 24, there + 24], 1)]
    side = [np.stack([here, there, there + 24], 1), np.stack([here, there + 24, here + 24], 1)]
    tin = pfgeom.Mesh(points, np.concatenate(lids + side).astype(np.int32))
    normals = corner_normals(np.zeros_like, False, tin, 30.0)
    radial = points[tin.faces] * [1, 1, 0]
    assert degrees_between(normals[48:], radial[48:]).max() < 8  # the two triangles of a facet weigh as two
    assert degrees_between(normals[:48], face_normals(tin)[:48, None]).max() < 1e-3


def test_faces_that_look_inwards():
    """A cavity's faces, and so their normals, look into it."""
    model = pfgeom.compress(*shapes.hollow_sphere(), tolerance=1e-2)
    mesh = model.to_mesh()
    cosines = (model.corner_normals(mesh) * face_normals(mesh)[:, None]).sum(axis=2)
    assert cosines.min() > 0.8
    inner = np.linalg.norm(mesh.vertices[mesh.faces].mean(axis=1), axis=1) < 0.75
    towards = (model.corner_normals(mesh) * mesh.vertices[mesh.faces]).sum(axis=2)
    assert inner.any() and (towards[inner] < 0).all() and (towards[~inner] > 0).all()


def test_place_and_names_survive_the_file(sphere_model, tmp_path):
    matrix = [[2, 0, 0, 1], [0, -1, 0.5, 2], [0, 0, 3, -4.25], [0, 0, 0, 1]]
    placed = sphere_model.placed(matrix, ["Bällchen 球"])
    placed.save(tmp_path / "placed.pfg")
    back = pfgeom.load(tmp_path / "placed.pfg")
    assert back.names == ("Bällchen 球",)
    assert np.array_equal(back.world_transform, matrix)
    assert np.array_equal(back.to_mesh().vertices, sphere_model.to_mesh().vertices)
    assert back.placed() == sphere_model
    assert sphere_model.names == () and sphere_model.world_transform is None


@pytest.mark.parametrize(
    ("matrix", "names", "match"),
    [
        (np.eye(3), [], r"\(4, 4\)"),
        (np.full((4, 4), np.nan), [], "matrix|transform"),
        (np.ones((4, 4)), [], "row|transform"),
        (None, ["a", "b", "c"], "names"),
        (None, ["x" * 256], "name"),
    ],
)
def test_bad_places_and_names(sphere_model, matrix, names, match):
    with pytest.raises(ValueError, match=match):
        sphere_model.placed(matrix, names)
