"""Rebuild and deviation: closed, shaded by the gradient, at any resolution."""

from __future__ import annotations

import bpy
import numpy as np
import scenes
from harness import MODULE, addon, call


def _compat():
    return addon("compat")


def _compressed(obj, **options):
    scenes.select(obj)
    bpy.ops.pfgeom.compress(**{"share": 1.0, "effort": "fast", **options})
    return obj


def check_closed_at_every_detail():
    ball = _compressed(scenes.sphere(), display="NONE", keep_original=False)
    counts = []
    for options in (
        {"detail": "PREVIEW"},
        {"detail": "DEFAULT"},
        {"detail": "RESOLUTION", "resolution": 60},
        {"detail": "TOLERANCE", "tolerance": 0.02},
    ):
        bpy.ops.pfgeom.rebuild(**options)
        assert scenes.is_closed(ball.data), options
        assert not ball.data.validate(), options
        counts.append(len(ball.data.polygons))
    assert counts[3] > counts[0], counts
    bpy.ops.pfgeom.rebuild(detail="NONE")
    assert len(ball.data.polygons) == 0


def check_normals_are_the_gradients():
    """On a smooth ball they point along the radius, nearer than the chords' angles; and Blender shows them."""
    ball = scenes.sphere()
    bpy.ops.object.shade_smooth()
    _compressed(ball, display="REBUILT")
    bpy.ops.pfgeom.rebuild(detail="RESOLUTION", resolution=16)
    corners = np.array([ball.data.vertices[loop.vertex_index].co for loop in ball.data.loops])
    radial = corners / np.linalg.norm(corners, axis=1, keepdims=True)
    shown = _compat().corner_normals(ball.data)
    assert len(np.unique(shown.round(3), axis=0)) > 20
    assert np.degrees(np.arccos(np.clip((radial * shown).sum(axis=1), -1, 1))).max() < 2.0


def check_creases_are_sharp():
    """A cube shaded smooth, as functions, has flat sides and sharp edges."""
    box = scenes.cube()
    bpy.ops.object.shade_smooth()
    _compressed(box, display="REBUILT")
    shown = _compat().corner_normals(box.data)
    faces = np.repeat([polygon.normal for polygon in box.data.polygons], 3, axis=0)
    assert np.abs((shown * faces).sum(axis=1) - 1).max() < 1e-3


def check_many_at_once():
    """One copy of functions for two objects: rebuilt once, both show it; objects without functions are named."""
    ball = scenes.sphere()
    copy = scenes.copy_of(ball, "Copy")
    scenes.select(ball, copy)
    bpy.ops.pfgeom.compress(share=1.0, effort="fast")
    assert addon("scene.store").holder_of(ball) == addon("scene.store").holder_of(copy)
    box = scenes.cube()
    scenes.select(ball, copy, box)
    _, said = call(bpy.ops.pfgeom.rebuild, keep_original=False)
    assert ball.data == copy.data and addon("scene.store").shows(ball) == "REBUILT"
    assert "Box has no functions" in said


def check_deviation_of_originals_and_of_rebuilt():
    """Attributes by vertex in the scene's units; the figures agree with pfgeom.compare in the world."""
    for display in ("ORIGINAL", "REBUILT"):
        ball = scenes.sphere()
        ball.scale = (2, 2, 2)
        scenes.select(ball)
        before = scenes.world_mesh(ball)
        _compressed(ball, display=display, keep_original=True)
        bpy.ops.pfgeom.deviation()
        mesh = ball.data
        distances = np.empty(len(mesh.vertices), np.float32)
        mesh.attributes["pfgeom_deviation"].data.foreach_get("value", distances)
        assert mesh.color_attributes.active_color.name == "pfgeom_heat"
        tolerance = 0.01 * scenes.size(before)
        assert 0 < distances.max() <= tolerance and abs(mesh["pfgeom_heat_top"] - tolerance) < 1e-4
        bpy.ops.pfgeom.rebuild(keep_original=False)
        found = scenes.deviation(before, scenes.world_mesh(ball))
        assert abs(mesh["pfgeom_measured"][0] - found) <= 0.01 * found if display == "REBUILT" else True
        assert mesh["pfgeom_measured"][0] >= distances.max() * 0.999


def check_deviation_says_what_it_cannot():
    ball = _compressed(scenes.sphere(), display="REBUILT", keep_original=False)
    result, said = call(bpy.ops.pfgeom.deviation)
    assert result == {"CANCELLED"} and "lost its original" in said, said
    assert "pfgeom_heat" not in ball.data.attributes


def check_damage_is_seen():
    """Stored functions with one byte changed are refused in one sentence."""
    ball = _compressed(scenes.sphere(), display="NONE", keep_original=False)
    stored = bytearray(ball.data["pfgeom_functions"])
    stored[len(stored) // 2] ^= 1
    ball.data["pfgeom_functions"] = bytes(stored)
    result, said = call(bpy.ops.pfgeom.rebuild)
    assert result == {"CANCELLED"} and "damaged" in said and "Traceback" not in said, said


def check_without_the_native_module():
    """The add-on registers, its panel can say why, and its operators say so too."""
    native = addon("core.native")
    load = native._load
    try:
        native._load = lambda: (None, "no wheel for cp399")
        scenes.select(scenes.sphere())
        assert not bpy.ops.pfgeom.compress.poll()
        assert native.why_missing() == "no wheel for cp399" and dict(native.versions())["pfgeom"] == "not loaded"
    finally:
        native._load = load
    assert bpy.ops.pfgeom.compress.poll() and MODULE in bpy.context.preferences.addons
