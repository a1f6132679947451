# SPDX-License-Identifier: GPL-3.0-or-later
"""Arrays to meshes, and meshes to objects."""

from __future__ import annotations

import bpy

from .. import compat
from ..core.shapes import Rebuilt
from . import store

ORIGINALS = "PF Geometry Originals"

#: Angle between faces, in radians, above which a mesh without normals of its own has a sharp edge: Blender's default.
_CREASE = 0.5236


def fill(mesh: bpy.types.Mesh, rebuilt: Rebuilt | None) -> None:
    """Replace the mesh's geometry; its materials, properties and users stay. None: it shows nothing."""
    mesh.clear_geometry()
    if rebuilt is None:
        mesh.update()
        return
    surface = rebuilt.surface
    compat.fill_mesh(mesh, surface.vertices, surface.faces)
    mesh.update(calc_edges=True)
    if rebuilt.normals is None:
        compat.smooth_by_angle(mesh, _CREASE)  # makes faces smooth in later versions: their own shading comes after it
    mesh.polygons.foreach_set("use_smooth", surface.smooth)
    mesh.polygons.foreach_set("material_index", surface.materials)
    if rebuilt.normals is not None:
        compat.set_corner_normals(mesh, rebuilt.normals)


def add_materials(mesh: bpy.types.Mesh, names: tuple[str, ...]) -> None:
    """A slot for each name: the material that has it already, or a new one; none for no name."""
    for name in names:
        mesh.materials.append((bpy.data.materials.get(name) or bpy.data.materials.new(name)) if name else None)


def new_mesh_like(mesh: bpy.types.Mesh, name: str) -> bpy.types.Mesh:
    """Empty, with the same material slots and custom properties."""
    made = bpy.data.meshes.new(name)
    for material in mesh.materials:
        made.materials.append(material)
    for key in mesh.keys():  # noqa: SIM118 - an ID iterates over no keys
        if not key.startswith("pfgeom_"):
            made[key] = mesh[key]
    return made


def show(obj: bpy.types.Object, mesh: bpy.types.Mesh, keep_original: bool) -> None:
    """Let the object show a mesh that is made of its evaluated one; its modifiers are applied in it."""
    if keep_original:
        obj[store.ORIGINAL] = put_aside(obj)
    elif store.ORIGINAL in obj:
        del obj[store.ORIGINAL]
    store.point_to(obj, None)
    slots = [(slot.link, slot.material) for slot in obj.material_slots]
    obj.modifiers.clear()
    obj.data = mesh
    for slot, (link, material) in zip(obj.material_slots, slots, strict=False):
        slot.link = link
        if link == "OBJECT":
            slot.material = material


def put_aside(obj: bpy.types.Object) -> bpy.types.Object:
    """A copy of the object, with its mesh and modifiers, in a hidden collection."""
    original = obj.copy()
    original.name = f"{obj.name} original"
    for key in (store.HOLDER, store.ORIGINAL):
        if key in original:
            del original[key]
    _originals_collection().objects.link(original)
    return original


def _originals_collection() -> bpy.types.Collection:
    collection = bpy.data.collections.get(ORIGINALS)
    if collection is None or collection.library is not None:
        collection = bpy.data.collections.new(ORIGINALS)
        collection.hide_viewport = collection.hide_render = True
    scene = bpy.context.scene
    if collection.name not in scene.collection.children:
        scene.collection.children.link(collection)
    return collection
