# SPDX-License-Identifier: GPL-3.0-or-later
"""Evaluated meshes to arrays."""

from __future__ import annotations

import hashlib

import bpy
import numpy as np

from ..core.shapes import Surface


def surface_of(obj: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> Surface:
    """The object's triangles in its own space, modifiers applied."""
    evaluated = obj.evaluated_get(depsgraph)
    mesh = evaluated.to_mesh()
    try:
        return surface_of_mesh(mesh)
    finally:
        evaluated.to_mesh_clear()


def surface_of_mesh(mesh: bpy.types.Mesh) -> Surface:
    mesh.calc_loop_triangles()
    vertices = np.empty(3 * len(mesh.vertices), np.float32)
    mesh.vertices.foreach_get("co", vertices)
    faces = np.empty(3 * len(mesh.loop_triangles), np.int32)
    mesh.loop_triangles.foreach_get("vertices", faces)
    polygon_of = np.empty(len(mesh.loop_triangles), np.int32)
    mesh.loop_triangles.foreach_get("polygon_index", polygon_of)
    smooth = np.empty(len(mesh.polygons), np.bool_)
    mesh.polygons.foreach_get("use_smooth", smooth)
    materials = np.empty(len(mesh.polygons), np.int32)
    mesh.polygons.foreach_get("material_index", materials)
    names = tuple(material.name if material else "" for material in mesh.materials)
    return Surface(vertices.reshape(-1, 3), faces.reshape(-1, 3), smooth[polygon_of], materials[polygon_of], names)


def surface_of_hidden(obj: bpy.types.Object) -> Surface:
    """The same for an object in a hidden collection, where modifiers are not evaluated: it is shown for a moment."""
    if len(obj.modifiers) == 0:
        return surface_of_mesh(obj.data)
    bpy.context.scene.collection.objects.link(obj)
    try:
        bpy.context.view_layer.update()
        return surface_of(obj, bpy.context.evaluated_depsgraph_get())
    finally:
        bpy.context.scene.collection.objects.unlink(obj)


def fingerprint(surface: Surface) -> str:
    """Equal for equal geometry and labels."""
    digest = hashlib.blake2b(digest_size=16)
    for array in (surface.vertices, surface.faces, surface.smooth, surface.materials):
        digest.update(array.tobytes())
    digest.update("\0".join(surface.names).encode())
    return digest.hexdigest()


def matrix_of(obj: bpy.types.Object) -> np.ndarray:
    return np.array(obj.matrix_world, dtype=np.float64)
