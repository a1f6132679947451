"""Compress: tolerances in the world, what stays, what is skipped."""

from __future__ import annotations

import bpy
import numpy as np
import scenes
from harness import addon, call


def check_every_display():
    """The original, the rebuilt mesh, a preview, nothing: what the object shows, and that its functions are there."""
    for display in ("ORIGINAL", "REBUILT", "PREVIEW", "NONE"):
        ball = scenes.sphere(f"Ball {display}")
        before = ball.data
        scenes.select(ball)
        bpy.ops.pfgeom.compress(share=1.0, effort="fast", display=display, keep_original=False)
        assert (ball.data == before) == (display == "ORIGINAL")
        assert (len(ball.data.polygons) == 0) == (display == "NONE")
        assert scenes.figures(ball)["functions"][0] == 1, scenes.figures(ball)
        assert scenes.figures(ball)["bytes"] < 100


def check_original_is_not_touched():
    ball = scenes.sphere()
    before = scenes.world_mesh(ball)
    scenes.select(ball)
    bpy.ops.pfgeom.compress(share=1.0, effort="fast")
    after = scenes.world_mesh(ball)
    assert np.array_equal(before[0], after[0]) and np.array_equal(before[1], after[1])


def check_length_in_the_world():
    """A length holds in the world whatever the scale, and is no finer than it need be."""
    for scale in ((1, 1, 1), (20, 20, 20), (-0.1, 0.1, 0.1), (1, 5, 0.2)):
        ball = scenes.sphere(segments=48)
        ball.scale = scale
        scenes.select(ball)
        before = scenes.world_mesh(ball)
        length = 0.01 * scenes.size(before)
        bpy.ops.pfgeom.compress(unit="LENGTH", length=length, effort="fast", display="REBUILT")
        found = scenes.deviation(before, scenes.world_mesh(ball))
        assert found <= length + scenes.rounding(before), (scale, found, length)
        assert scenes.figures(ball)["tolerance"] * max(map(abs, scale)) >= 0.99 * length


def check_objects_keep_what_is_theirs():
    """Parent, collections, transform, materials, shading, visibility, custom properties."""
    parent = scenes.cube("Parent")
    other = bpy.data.collections.new("Other")
    bpy.context.scene.collection.children.link(other)
    ball = scenes.sphere()
    ball.parent, ball.location, ball.scale = parent, (1, 2, 3), (1, -2, 0.5)
    other.objects.link(ball)
    ball.data.materials.append(bpy.data.materials.new("Red"))
    ball.data.materials.append(bpy.data.materials.new("Blue"))
    ball.material_slots[1].link = "OBJECT"
    ball.material_slots[1].material = bpy.data.materials.new("Own")
    ball["answer"], ball.data["question"] = 42, "why"
    ball.hide_render = True
    for polygon in ball.data.polygons:
        polygon.material_index = int(polygon.center.z > 0)
    matrix = ball.matrix_world.copy()
    scenes.select(ball)
    bpy.context.view_layer.update()
    matrix = ball.matrix_world.copy()
    bpy.ops.pfgeom.compress(share=1.0, effort="fast", display="REBUILT", keep_original=False)
    bpy.context.view_layer.update()
    assert ball.parent == parent and ball.matrix_world == matrix
    assert {c.name for c in ball.users_collection} == {bpy.context.collection.name, "Other"}
    assert [(s.link, s.material.name) for s in ball.material_slots] == [("DATA", "Red"), ("OBJECT", "Own")]
    assert ball["answer"] == 42 and ball.data["question"] == "why" and ball.hide_render
    upper = np.array([polygon.center.z > 0.1 for polygon in ball.data.polygons])
    lower = np.array([polygon.center.z < -0.1 for polygon in ball.data.polygons])
    index = np.array([polygon.material_index for polygon in ball.data.polygons])
    assert upper.any() and (index[upper] == 1).all() and (index[lower] == 0).all()
    assert not any(polygon.use_smooth for polygon in ball.data.polygons)


def check_keep_original():
    """It lies in a hidden collection, with its mesh and modifiers; without it only Undo brings it back."""
    monkey = scenes.suzanne(1)
    mesh = monkey.data
    scenes.select(monkey)
    bpy.ops.pfgeom.compress(share=1.0, effort="fast", display="REBUILT", keep_original=True)
    original = addon("scene.store").original_of(monkey)
    assert original.data == mesh and len(original.modifiers) == 1 and len(monkey.modifiers) == 0
    assert [c.name for c in original.users_collection] == [addon("scene.write").ORIGINALS]
    assert not original.visible_get()


def check_losses_are_named():
    monkey = scenes.suzanne()
    monkey.vertex_groups.new(name="Ears")
    monkey.shape_key_add(name="Basis")
    lost = ", ".join(addon("scene.losses").losses_of(monkey))
    for word in ("UV map", "vertex group", "shape key", "modifiers"):
        assert word in lost, lost
    assert addon("scene.losses").losses_of(bpy.data.objects.new("Bare", bpy.data.meshes.new("Bare"))) == []


def check_mixed_objects():
    """Twenty objects: five of one mesh are compressed once; each is within its tolerance; the rest is named."""
    library = bpy.path.abspath(str(_library()))
    ball = scenes.sphere(segments=24)
    scales = [(2, 2, 2), (-1, 1, 1), (0.5, 0.5, 0.5), (1, 1, 3)]
    shared = [ball] + [scenes.copy_of(ball, f"Copy {i}", scale, (3 * i, 0, 0)) for i, scale in enumerate(scales)]
    good = [*shared, *_with_modifiers(), *_plain()]
    bpy.ops.object.empty_add()
    bpy.ops.curve.primitive_bezier_circle_add()
    circle = bpy.context.object
    bare = bpy.data.objects.new("Bare", bpy.data.meshes.new("Bare"))
    bpy.context.collection.objects.link(bare)
    with bpy.data.libraries.load(library, link=True) as (source, target):
        target.objects = source.objects
    linked = target.objects[0]
    bpy.context.collection.objects.link(linked)
    skipped = [bpy.data.objects["Empty"], circle, bare, linked]
    scenes.select(*good, *skipped)
    assert len(bpy.context.selected_objects) == 20
    before = {obj.name: scenes.world_mesh(obj) for obj in good}
    _, said = call(bpy.ops.pfgeom.compress, share=1.0, effort="fast", display="REBUILT", keep_original=False)
    for obj in skipped:
        assert f"{obj.name} is" in said, said
    assert len({obj.data for obj in shared}) == 1
    assert len({obj.data for obj in good}) == len(good) - 4
    for obj in good:
        mesh = before[obj.name]
        found, allowed = scenes.deviation(mesh, scenes.world_mesh(obj)), 0.01 * scenes.own_size(obj, mesh)
        assert found <= allowed + scenes.rounding(mesh), (obj.name, found, allowed)


def _with_modifiers() -> list[bpy.types.Object]:
    bevel = scenes.cube("Bevelled", location=(0, 5, 0))
    bevel.modifiers.new("Bevel", "BEVEL").segments = 2
    mirrored = scenes.sphere("Mirrored", 16, location=(4, 5, 0))
    mirrored.modifiers.new("Mirror", "MIRROR")
    row = scenes.cube("Row", location=(8, 5, 0))
    row.modifiers.new("Array", "ARRAY").count = 3
    twice = scenes.copy_of(bevel, "Same mesh, other modifier", location=(0, 9, 0))
    twice.modifiers.new("Subdivision", "SUBSURF").levels = 2
    return [bevel, mirrored, row, twice]


def _plain() -> list[bpy.types.Object]:
    made = []
    for i, (add, options) in enumerate(
        [
            (bpy.ops.mesh.primitive_cylinder_add, {"rotation": (0.3, 0.2, 0.1)}),
            (bpy.ops.mesh.primitive_cone_add, {"scale": (1, 2, 1)}),
            (bpy.ops.mesh.primitive_torus_add, {}),
            (bpy.ops.mesh.primitive_ico_sphere_add, {"subdivisions": 3}),
            (bpy.ops.mesh.primitive_plane_add, {}),
            (bpy.ops.mesh.primitive_grid_add, {"rotation": (1, 0, 0)}),
            (bpy.ops.mesh.primitive_cube_add, {"scale": (1, 1, 0.01)}),
        ]
    ):
        add(location=(4 * i, -6, 0), **options)
        made.append(bpy.context.object)
    return made


def _library():
    from harness import folder

    path = folder() / "library.blend"
    obj = scenes.cube("Linked")
    bpy.data.libraries.write(str(path), {obj})
    bpy.data.objects.remove(obj)
    return path
