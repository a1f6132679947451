# SPDX-License-Identifier: GPL-3.0-or-later
"""The heat map's legend, in the corner of the 3D view, in the scene's units."""

from __future__ import annotations

import blf
import bpy
import gpu
import numpy as np
from gpu_extras.batch import batch_for_shader

from .. import compat
from ..core.deviation import colours
from ..scene import deviation
from .panel import length

_WIDTH, _HEIGHT, _MARGIN, _STEPS = 18, 180, 24, 64  # pixels at a scale of 1

_handler = None


def _draw() -> None:
    context = bpy.context
    obj = context.object
    if obj is None or obj.type != "MESH" or deviation.RANGE not in obj.data or context.space_data is None:
        return
    if deviation.HEAT not in obj.data.color_attributes or context.space_data.shading.color_type != "VERTEX":
        return
    scale = context.preferences.system.ui_scale
    left, bottom = _MARGIN * scale, _MARGIN * scale
    _draw_bar(left, bottom, _WIDTH * scale, _HEIGHT * scale)
    top = obj.data[deviation.RANGE]
    measured = deviation.figures_of(obj.data)
    notes = [(0.0, "0"), (0.5, length(context, top / 2)), (1.0, f"{length(context, top)} tolerance")]
    if measured is not None:
        notes.append((1.12, f"max {length(context, measured[0])}, rms {length(context, measured[1])}"))
    compat.font_size(12 * scale)
    for at, text in notes:
        blf.color(0, 1.0, 1.0, 1.0, 1.0)
        blf.position(0, left + 1.4 * _WIDTH * scale, bottom + at * _HEIGHT * scale - 4 * scale, 0)
        blf.draw(0, text)


def _draw_bar(left: float, bottom: float, width: float, height: float) -> None:
    levels = np.linspace(0, 1, _STEPS + 1, dtype=np.float32)
    shown = [_encoded(colour) for colour in colours(levels, 1.0)]
    positions = [(left + side * width, bottom + level * height) for level in levels.tolist() for side in (0, 1)]
    shader = gpu.shader.from_builtin(compat.SMOOTH_COLOUR_2D)
    batch = batch_for_shader(
        shader, "TRI_STRIP", {"pos": positions, "color": [colour for colour in shown for _ in (0, 1)]}
    )
    shader.bind()
    batch.draw(shader)


def _encoded(linear: np.ndarray) -> tuple[float, ...]:
    """As the screen takes it: overlays are drawn in sRGB, attributes are linear."""
    rgb = linear[:3].astype(float)
    return (*np.where(rgb <= 0.0031308, 12.92 * rgb, 1.055 * rgb ** (1 / 2.4) - 0.055).tolist(), 1.0)


classes = ()


def register() -> None:
    global _handler
    if not bpy.app.background:
        _handler = bpy.types.SpaceView3D.draw_handler_add(_draw, (), "WINDOW", "POST_PIXEL")


def unregister() -> None:
    global _handler
    if _handler is not None:
        bpy.types.SpaceView3D.draw_handler_remove(_handler, "WINDOW")
        _handler = None
