"""Real meshes, read by Blender's own importers; the names stand in the environment."""

from __future__ import annotations

import os
from pathlib import Path

import bpy
import scenes
from harness import addon, folder

_READERS = {".ply": bpy.ops.wm.ply_import, ".stl": bpy.ops.wm.stl_import, ".obj": bpy.ops.wm.obj_import}


def check_real_meshes():
    """Within the tolerance in the world; both meshes are written for an independent judge."""
    for name in os.environ["PFGEOM_MESHES"].split(":"):
        bpy.ops.wm.read_homefile(use_empty=True)
        path = Path(name)
        _READERS[path.suffix.lower()](filepath=str(path))
        obj = bpy.context.selected_objects[0]
        scenes.select(obj)
        before = scenes.world_mesh(obj)
        bpy.ops.pfgeom.compress(share=1.0, effort="fast", display="REBUILT", keep_original=False)
        after = scenes.world_mesh(obj)
        found = addon("core.native").pfgeom().compare(before, after, samples=100_000, bound=False)
        assert found.max <= 0.01 * scenes.size(before) + scenes.rounding(before), (name, found)
        figures = scenes.figures(obj)
        print(f"{path.name}: {len(before[1])} triangles, {figures['bytes']} bytes, max {found.max:.9g}")
        for when, mesh in (("before", before), ("after", after)):
            addon("core.native").pfgeom().write_mesh(folder() / f"{path.stem}-{when}.ply", *mesh)
