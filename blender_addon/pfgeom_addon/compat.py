# SPDX-License-Identifier: GPL-3.0-or-later
"""Every difference between Blender's versions, and nothing else looks at the version."""

from __future__ import annotations

from typing import Any

import blf
import bpy
import numpy as np

_VERSION = bpy.app.version

#: The lengths of polygons follow from their starts, and layers are attributes.
_ATTRIBUTES = _VERSION >= (3, 6, 0)
#: Smooth groups and custom normals need no switch on the mesh.
_NO_AUTO_SMOOTH = _VERSION >= (4, 1, 0)
#: Custom normals may be plain vectors in an attribute.
_FREE_NORMALS = _VERSION >= (4, 5, 0)
_PROGRESS_BAR = _VERSION >= (4, 0, 0)
HAS_FILE_HANDLERS = _VERSION >= (4, 1, 0)
SMOOTH_COLOUR_2D = "SMOOTH_COLOR" if _VERSION >= (4, 0, 0) else "2D_SMOOTH_COLOR"


def fill_mesh(mesh: bpy.types.Mesh, vertices: Any, faces: Any) -> None:
    """Give an empty mesh its triangles: (n, 3) float32 and (m, 3) int32."""
    count = len(faces)
    starts = np.arange(0, 3 * count, 3, dtype=np.int32)
    mesh.vertices.add(len(vertices))
    mesh.loops.add(3 * count)
    mesh.polygons.add(count)
    if _ATTRIBUTES:
        mesh.attributes["position"].data.foreach_set("vector", vertices.reshape(-1))
        mesh.attributes[".corner_vert"].data.foreach_set("value", faces.reshape(-1))
        mesh.polygons.foreach_set("loop_start", starts)
    else:
        mesh.vertices.foreach_set("co", vertices.reshape(-1))
        mesh.loops.foreach_set("vertex_index", faces.reshape(-1))
        mesh.polygons.foreach_set("loop_start", starts)
        mesh.polygons.foreach_set("loop_total", np.full(count, 3, np.int32))


def set_corner_normals(mesh: bpy.types.Mesh, normals: Any) -> None:
    """(3 m, 3) float32 unit vectors, once the mesh has its edges."""
    if _FREE_NORMALS:
        layer = mesh.attributes.new("custom_normal", "FLOAT_VECTOR", "CORNER")
        layer.data.foreach_set("vector", normals.reshape(-1))
        return
    if not _NO_AUTO_SMOOTH:
        mesh.use_auto_smooth = True
        mesh.auto_smooth_angle = np.pi
    mesh.normals_split_custom_set(normals)


def smooth_by_angle(mesh: bpy.types.Mesh, angle: float) -> None:
    """Smooth faces look smooth but for edges sharper than this, in radians."""
    if _NO_AUTO_SMOOTH:
        mesh.set_sharp_from_angle(angle=angle)
    else:
        mesh.use_auto_smooth = True
        mesh.auto_smooth_angle = angle


def corner_normals(mesh: bpy.types.Mesh) -> np.ndarray:
    """(3 m, 3) normals as they are shown."""
    values = np.empty(3 * len(mesh.loops), np.float32)
    if _NO_AUTO_SMOOTH:
        mesh.corner_normals.foreach_get("vector", values)
    else:
        mesh.calc_normals_split()
        mesh.loops.foreach_get("normal", values)
    return values.reshape(-1, 3)


def draw_progress(layout: bpy.types.UILayout, fraction: float, text: str) -> None:
    if _PROGRESS_BAR:
        layout.progress(factor=fraction, text=text)
        return
    filled = round(20 * fraction)
    layout.label(text="\u2588" * filled + "\u2591" * (20 - filled))
    layout.label(text=text)


def font_size(points: float) -> None:
    if _VERSION >= (4, 0, 0):
        blf.size(0, points)
    else:
        blf.size(0, round(points), 72)
