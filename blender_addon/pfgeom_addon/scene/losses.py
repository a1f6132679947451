# SPDX-License-Identifier: GPL-3.0-or-later
"""What an object has that a rebuilt mesh cannot give back yet."""

from __future__ import annotations

import bpy

_BUILT_IN = {"position", "sharp_face", "sharp_edge", "material_index", "custom_normal"}


def losses_of(obj: bpy.types.Object) -> list[str]:
    """In words, such as `2 UV maps`; empty if nothing is lost."""
    mesh = obj.data
    counts = {
        "UV map": len(mesh.uv_layers),
        "colour attribute": len(mesh.color_attributes),
        "vertex group": len(obj.vertex_groups),
        "shape key": len(mesh.shape_keys.key_blocks) if mesh.shape_keys else 0,
        "other attribute": _other_attributes(mesh),
    }
    lost = [f"{count} {word}{'s' if count > 1 else ''}" for word, count in counts.items() if count]
    if mesh.has_custom_normals:
        lost.append("custom normals")
    if len(obj.modifiers):
        lost.append("modifiers (they are applied)")
    return lost


def _other_attributes(mesh: bpy.types.Mesh) -> int:
    known = {layer.name for layer in mesh.uv_layers} | {layer.name for layer in mesh.color_attributes}
    return sum(not (a.name.startswith(".") or a.name in _BUILT_IN or a.name in known) for a in mesh.attributes)
