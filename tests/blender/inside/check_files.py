"""Import and export, whole files and damaged ones."""

from __future__ import annotations

import random

import bpy
import numpy as np
import scenes
from harness import call, folder


def _exported(name: str) -> bytes:
    path = folder() / f"{name}.pfg"
    bpy.ops.export_mesh.pfgeom(filepath=str(path))
    return path.read_bytes()


def check_round_trip():
    """Name, place and shape come back."""
    ball = scenes.sphere("Bällchen 球")
    ball.location, ball.rotation_euler, ball.scale = (1, 2, 3), (0.1, 0.2, 0.3), (2, -1, 0.5)
    scenes.select(ball)
    bpy.ops.pfgeom.compress(share=1.0, effort="fast", display="REBUILT")
    before, matrix = scenes.world_mesh(ball), np.array(ball.matrix_world)
    _exported("ball")
    bpy.ops.wm.read_homefile(use_empty=True)
    bpy.ops.import_mesh.pfgeom(filepath=str(folder() / "ball.pfg"))
    back = bpy.context.object
    assert back.name == "Bällchen 球"
    bpy.context.view_layer.update()
    assert np.abs(np.array(back.matrix_world) - matrix).max() < 1e-6
    after = scenes.world_mesh(back)
    assert np.array_equal(before[1], after[1]) and np.abs(before[0] - after[0]).max() < 1e-5
    assert scenes.figures(back)["functions"][0] == 1


def check_materials_come_with_the_file():
    """By their names; faces have them where they had them."""
    box = scenes.cube("Box")
    for name in ("Red", "Blue"):
        box.data.materials.append(bpy.data.materials.new(name))
    box.data.materials.append(None)
    for polygon in box.data.polygons:
        polygon.material_index = int(polygon.center.z > 0.9) + 2 * int(polygon.center.x > 0.9)
    scenes.select(box)
    bpy.ops.pfgeom.compress(share=1.0, effort="fast")
    _exported("box")
    bpy.ops.wm.read_homefile(use_empty=True)
    known = bpy.data.materials.new("Blue")
    bpy.ops.import_mesh.pfgeom(filepath=str(folder() / "box.pfg"))
    mesh = bpy.context.object.data
    slots = list(mesh.materials)
    assert [slot.name if slot else None for slot in slots] == ["Red", "Blue", None] and slots[1] == known
    for polygon in mesh.polygons:
        if sum(abs(c) > 0.9 for c in polygon.center) > 1:
            continue  # beside an edge of the box, where a border may be off by the tolerance
        wanted = int(polygon.normal.z > 0.9) + 2 * int(polygon.normal.x > 0.9)
        assert polygon.material_index == wanted, (tuple(polygon.normal), polygon.material_index)


def check_several_at_once():
    balls = [scenes.sphere(name) for name in ("a/b", "a:b", "c")]
    scenes.select(*balls)
    bpy.ops.pfgeom.compress(share=1.0, effort="fast")
    where = folder() / "several"
    where.mkdir()
    bpy.ops.export_mesh.pfgeom(filepath=str(where / "any.pfg"))
    names = sorted(path.name for path in where.iterdir())
    assert names == ["a_b 2.pfg", "a_b.pfg", "c.pfg"], names
    bpy.ops.wm.read_homefile(use_empty=True)
    bpy.ops.import_mesh.pfgeom(directory=str(where), files=[{"name": name} for name in names])
    assert sorted(obj.name for obj in bpy.context.selected_objects) == ["a/b", "a:b", "c"]


def check_damaged_files_leave_nothing():
    """200 files, each damaged in its own way: one readable line each, nothing else."""
    ball = scenes.sphere()
    scenes.select(ball)
    bpy.ops.pfgeom.compress(share=1.0, effort="fast")
    content = _exported("whole")
    bpy.ops.wm.read_homefile(use_empty=True)
    before = scenes.datablocks()
    path = folder() / "damaged.pfg"
    random.seed(5)
    for damaged in _damaged(content):
        path.write_bytes(damaged)
        result, said = call(bpy.ops.import_mesh.pfgeom, filepath=str(path))
        lines = [line for line in said.splitlines() if "damaged.pfg" in line]
        assert result == {"CANCELLED"} and len(lines) == 1, (result, said)
        assert "Traceback" not in said and "{" not in lines[0] and len(lines[0]) < 200, said
        assert scenes.datablocks() == before
    result, said = call(bpy.ops.import_mesh.pfgeom, filepath=str(folder() / "absent.pfg"))
    assert result == {"CANCELLED"} and "No such file" in said, said


def _damaged(content: bytes):
    yield b""
    yield bytes(1000)
    yield content + b"\0"
    yield content.replace(b"\r\n", b"\n")
    for _ in range(50):
        yield content[: random.randrange(len(content))]
    for _ in range(50):
        yield random.randbytes(random.randrange(1, 400))
    for _ in range(96):
        changed = bytearray(content)
        changed[random.randrange(len(content))] ^= 1 << random.randrange(8)
        yield bytes(changed)
