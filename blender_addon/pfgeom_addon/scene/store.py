# SPDX-License-Identifier: GPL-3.0-or-later
"""Where functions live in a .blend: on a mesh data-block, as plain custom properties that need no add-on to survive.

An object that shows what was rebuilt has them on its own mesh. One that still shows its original points to an otherwise
empty mesh that holds them, so that objects of one mesh share one copy.
"""

from __future__ import annotations

import json
from typing import Any

import bpy

from ..core import storage

FUNCTIONS = "pfgeom_functions"  # on a mesh: sealed bytes
FIGURES = "pfgeom_figures"  # on a mesh: JSON, what the panel shows
HOLDER = "pfgeom_holder"  # on an object: the mesh that has its functions
SHOWS = "pfgeom_shows"  # on a mesh with functions that is shown: REBUILT, PREVIEW or NONE
ORIGINAL = "pfgeom_original"  # on an object: where its original was put


def put(mesh: bpy.types.Mesh, content: bytes, figures: dict[str, Any]) -> None:
    mesh[FUNCTIONS] = storage.seal(content)
    mesh[FIGURES] = json.dumps(figures)


def holder_of(obj: bpy.types.Object | None) -> bpy.types.Mesh | None:
    """The mesh with the object's functions, if it has any."""
    if obj is None or obj.type != "MESH":
        return None
    if FUNCTIONS in obj.data:
        return obj.data
    holder = obj.get(HOLDER)
    return holder if isinstance(holder, bpy.types.Mesh) and FUNCTIONS in holder else None


def shows(obj: bpy.types.Object) -> str:
    """ORIGINAL, REBUILT, PREVIEW or NONE."""
    return str(obj.data.get(SHOWS, "REBUILT")) if FUNCTIONS in obj.data else "ORIGINAL"


def point_to(obj: bpy.types.Object, holder: bpy.types.Mesh | None) -> None:
    """Let the object's functions be those of this mesh; a holder that nobody needs any more goes."""
    before = obj.get(HOLDER)
    if holder is not None:
        obj[HOLDER] = holder
    elif before is not None:
        del obj[HOLDER]
    if isinstance(before, bpy.types.Mesh) and before.users == 0:
        bpy.data.meshes.remove(before)


def content_of(holder: bpy.types.Mesh) -> bytes:
    """Bytes of the .pfg file. Raises storage.Damaged."""
    stored = holder[FUNCTIONS]
    if not isinstance(stored, bytes):
        raise storage.Damaged("the functions stored in this file are damaged")
    return storage.unseal(stored)


def figures_of(holder: bpy.types.Mesh) -> dict[str, Any]:
    """Empty if there are none that can be read."""
    try:
        figures = json.loads(holder.get(FIGURES, "{}"))
    except (TypeError, ValueError):
        return {}
    return figures if isinstance(figures, dict) else {}


def original_of(obj: bpy.types.Object) -> bpy.types.Object | None:
    """The object that was put aside, if it is still there."""
    original = obj.get(ORIGINAL)
    return original if isinstance(original, bpy.types.Object) and original.type == "MESH" else None
