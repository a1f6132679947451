"""Objects for checks, and how far they are from what they were, measured in the world."""

from __future__ import annotations

import bpy
import numpy as np
from harness import addon

#: Of the objects that save.py writes, in percent of the size.
SAVED_TOLERANCE = 1.0


def sphere(name: str = "Ball", segments: int = 32, **options) -> bpy.types.Object:
    bpy.ops.mesh.primitive_uv_sphere_add(segments=segments, ring_count=segments // 2, **options)
    return _named(name)


def cube(name: str = "Box", **options) -> bpy.types.Object:
    bpy.ops.mesh.primitive_cube_add(**options)
    return _named(name)


def suzanne(levels: int = 2) -> bpy.types.Object:
    bpy.ops.mesh.primitive_monkey_add()
    obj = _named("Suzanne")
    obj.modifiers.new("Subdivision", "SUBSURF").levels = levels
    bpy.ops.object.shade_smooth()
    return obj


def _named(name: str) -> bpy.types.Object:
    obj = bpy.context.object
    obj.name = obj.data.name = name
    return obj


def copy_of(obj: bpy.types.Object, name: str, scale=(1, 1, 1), location=(0, 0, 0)) -> bpy.types.Object:
    """Another object of the same mesh."""
    made = bpy.data.objects.new(name, obj.data)
    made.scale, made.location = scale, location
    bpy.context.collection.objects.link(made)
    return made


def select(*objects: bpy.types.Object) -> None:
    bpy.context.view_layer.update()
    for obj in bpy.context.view_layer.objects:
        obj.select_set(obj in objects)
    bpy.context.view_layer.objects.active = objects[0]
    bpy.context.view_layer.update()


def world_mesh(obj: bpy.types.Object) -> tuple[np.ndarray, np.ndarray]:
    """What the object shows, in the world; read without the add-on."""
    evaluated = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = evaluated.to_mesh()
    mesh.calc_loop_triangles()
    vertices = np.empty(3 * len(mesh.vertices))
    mesh.vertices.foreach_get("co", vertices)
    faces = np.empty(3 * len(mesh.loop_triangles), np.int32)
    mesh.loop_triangles.foreach_get("vertices", faces)
    evaluated.to_mesh_clear()
    matrix = np.array(obj.matrix_world)
    return vertices.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3], faces.reshape(-1, 3)


def size(mesh) -> float:
    return float(np.linalg.norm(np.ptp(mesh[0][mesh[1].reshape(-1)], axis=0)))


def own_size(obj, mesh) -> float:
    """Diagonal of the object's own box, under its scale."""
    matrix = np.array(obj.matrix_world)
    local = (mesh[0] - matrix[:3, 3]) @ np.linalg.inv(matrix[:3, :3]).T
    return float(np.linalg.norm(np.ptp(local, axis=0) * np.linalg.norm(matrix[:3, :3], axis=0)))


def rounding(mesh) -> float:
    """What single precision can move a vertex by, there and back."""
    return 4 * float(np.abs(mesh[0]).max()) * 2.0**-24


def deviation(a, b) -> float:
    """Two-sided maximum: a proved bound."""
    return addon("core.native").pfgeom().compare(a, b, samples=20_000).max_bound


def figures(obj: bpy.types.Object) -> dict:
    store = addon("scene.store")
    return store.figures_of(store.holder_of(obj))


def is_closed(mesh: bpy.types.Mesh) -> bool:
    """Every edge has two faces."""
    corners = np.empty(len(mesh.loops), np.int32)
    mesh.loops.foreach_get("vertex_index", corners)
    triangles = corners.reshape(-1, 3)
    edges = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    return bool((np.unique(edges, axis=0, return_counts=True)[1] == 2).all())


def datablocks() -> dict[str, int]:
    """How many of each kind there are."""
    kinds = [p.identifier for p in bpy.data.bl_rna.properties if p.type == "COLLECTION"]
    return {kind: len(getattr(bpy.data, kind)) for kind in kinds}
