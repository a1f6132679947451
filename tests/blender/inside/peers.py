"""What Blender itself offers against the add-on, at the same measured deviation: the table of docs/blender.md.

    python peers.py ADDON.zip FOLDER SHARE MESH...

on the module bpy. SHARE: the tolerance in percent of the size. Peers: Decimate (collapse), by bisection down to the
fewest faces whose two-sided root mean square is within what the add-on's mesh measured (Decimate knows no maximum);
that mesh as GLB, and as GLB with Draco at the fewest position bits that keep within it too; and the unreduced mesh with
Draco at 14 bits. Columns: triangles; rms and maximum of the add-on's mesh, in percent of the size; bytes of its
functions; triangles and maximum of Decimate; bytes of the three GLB files.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

import bpy
import harness
import scenes

READERS = {".ply": bpy.ops.wm.ply_import, ".stl": bpy.ops.wm.stl_import, ".obj": bpy.ops.wm.obj_import}
ROUNDS = 9  # of the bisection: a ratio to one part in 500


def deviation(a, b):
    return harness.addon("core.native").pfgeom().compare(a, b, samples=100_000, bound=False)


def glb(obj: bpy.types.Object, bits: int | None = None) -> Path:
    scenes.select(obj)
    path = harness.folder() / "peer.glb"
    options = {"export_draco_mesh_compression_enable": True, "export_draco_position_quantization": bits} if bits else {}
    bpy.ops.export_scene.gltf(
        filepath=str(path),
        use_selection=True,
        export_apply=True,
        export_normals=False,
        export_texcoords=False,
        export_materials="NONE",
        **options,
    )
    return path


def back(path: Path):
    """The file's mesh in the world, read again by Blender."""
    before = set(bpy.data.objects)
    bpy.ops.import_scene.gltf(filepath=str(path))
    obj = next(obj for obj in set(bpy.data.objects) - before if obj.type == "MESH")
    mesh = scenes.world_mesh(obj)
    bpy.data.objects.remove(obj)
    return mesh


def decimate(obj: bpy.types.Object, before, allowed: float) -> None:
    """Leaves the object with the modifier at the smallest ratio that keeps within what is allowed."""
    modifier = obj.modifiers.new("Decimate", "DECIMATE")
    low, high = 0.0, 1.0
    for _ in range(ROUNDS):
        modifier.ratio = (low + high) / 2
        bpy.context.view_layer.update()
        mesh = scenes.world_mesh(obj)
        good = len(mesh[1]) >= 4 and deviation(before, mesh).rms <= allowed
        low, high = (low, modifier.ratio) if good else (modifier.ratio, high)
    modifier.ratio = high
    bpy.context.view_layer.update()


def measure(path: Path, share: float) -> None:
    harness.clear()
    READERS[path.suffix.lower()](filepath=str(path))
    obj = bpy.context.selected_objects[0]
    obj.rotation_euler = (0, 0, 0)
    scenes.select(obj)
    before = scenes.world_mesh(obj)
    whole = glb(obj, 14).stat().st_size
    scenes.select(obj)
    bpy.ops.pfgeom.compress(share=share)
    holder = harness.addon("scene.store").holder_of(obj)
    content = harness.addon("scene.store").content_of(holder)
    pfgeom = harness.addon("core.native").pfgeom()
    ours = deviation(before, pfgeom.from_bytes(content).to_mesh())
    decimate(obj, before, ours.rms)
    decimated = scenes.world_mesh(obj)
    plain = glb(obj).stat().st_size
    for bits in range(8, 17):
        reduced = glb(obj, bits)
        if deviation(before, back(reduced)).rms <= 1.02 * ours.rms:
            break
    size = scenes.size(before) / 100
    print(
        f"| {path.name} | {len(before[1]):,} | {ours.rms / size:.3f} | {ours.max / size:.3f} | {len(content):,} | "
        f"{len(decimated[1]):,} | {deviation(before, decimated).max / size:.3f} | {plain:,} | "
        f"{reduced.stat().st_size:,} ({bits} bits) | {whole:,} |",
        flush=True,
    )


harness.install(harness.arguments()[0])
for name in harness.arguments()[3:]:
    measure(Path(name), float(harness.arguments()[2]))
harness.leave(0)
