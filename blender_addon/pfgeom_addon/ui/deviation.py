# SPDX-License-Identifier: GPL-3.0-or-later
"""Show how far objects are from what they stand for."""

from __future__ import annotations

import bpy

from ..scene import deviation
from .running import LongWork


class PFGEOM_OT_deviation(LongWork, bpy.types.Operator):  # noqa: N801
    """Measure how far the shown meshes are from their originals or their functions, and colour them by it"""

    bl_idname = "pfgeom.deviation"
    bl_label = "Show Deviation"
    bl_options = {"UNDO"}  # noqa: RUF012

    verb = "Measured"

    def plan(self, context: bpy.types.Context) -> deviation.Plan:
        return deviation.plan(context.selected_objects, context.evaluated_depsgraph_get())

    def finish(self, context: bpy.types.Context, plan: deviation.Plan, job) -> list[str]:
        measured = deviation.finish(plan, job)
        space = context.space_data
        if measured and space is not None and space.type == "VIEW_3D":
            space.shading.color_type = "VERTEX"
        return measured


classes = (PFGEOM_OT_deviation,)
