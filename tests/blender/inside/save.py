"""Writes .blend files: an empty one, one with twenty objects, one with their functions alone. Then reload.py."""

import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

import bpy
import harness
import numpy as np
import scenes


def save(name: str) -> int:
    path = harness.folder() / f"{name}.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path), compress=True)
    return path.stat().st_size


def objects() -> list[bpy.types.Object]:
    made = []
    for i in range(20):
        where = {"location": (3 * (i % 5), 3 * (i // 5), 0), "rotation": (0.1 * i, 0.2, 0.3)}
        if i % 4 == 0:
            made.append(scenes.sphere(f"Ball {i}", 32, **where))
        elif i % 4 == 1:
            bpy.ops.mesh.primitive_cylinder_add(vertices=48, **where)
            made.append(bpy.context.object)
        elif i % 4 == 2:
            bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=4, scale=(1, 0.7, 0.4), **where)
            made.append(bpy.context.object)
        else:
            bpy.ops.mesh.primitive_torus_add(major_segments=48, minor_segments=16, **where)
            made.append(bpy.context.object)
        made[-1].name = f"Object {i}"
    return made


harness.install(harness.arguments()[0])
harness.clear()
sizes = {"empty": save("empty")}
made = objects()
sizes["originals"] = save("originals")
scenes.select(*made)
before = {obj.name: scenes.world_mesh(obj) for obj in made}
np.savez(harness.folder() / "before.npz", **{f"{n}{i}": a for n, mesh in before.items() for i, a in enumerate(mesh)})
bpy.ops.pfgeom.compress(share=scenes.SAVED_TOLERANCE, effort="fast", display="NONE", keep_original=False)
sizes["functions"] = save("functions")
bpy.ops.pfgeom.rebuild(detail="PREVIEW")
sizes["previews"] = save("previews")
(harness.folder() / "sizes.json").write_text(json.dumps(sizes))
print(sizes)
harness.leave(0)
