"""Reads what save.py wrote, rebuilds, and compares with what there was."""

import sys
import traceback
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

import bpy
import harness
import numpy as np
import scenes

harness.install(harness.arguments()[0])
try:
    bpy.ops.wm.open_mainfile(filepath=str(harness.folder() / "functions.blend"))
    before = np.load(harness.folder() / "before.npz")
    made = [obj for obj in bpy.data.objects if obj.name.startswith("Object")]
    assert len(made) == 20
    scenes.select(*made)
    bpy.ops.pfgeom.rebuild()
    for obj in made:
        mesh = before[f"{obj.name}0"], before[f"{obj.name}1"]
        allowed = scenes.SAVED_TOLERANCE / 100 * scenes.own_size(obj, mesh) + scenes.rounding(mesh)
        found = scenes.deviation(mesh, scenes.world_mesh(obj))
        assert found <= allowed, (obj.name, found, allowed)
except BaseException:
    traceback.print_exc()
    harness.leave(1)
harness.leave(0)
