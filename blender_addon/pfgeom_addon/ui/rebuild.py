# SPDX-License-Identifier: GPL-3.0-or-later
"""Make meshes of stored functions."""

from __future__ import annotations

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty

from ..scene import rebuild
from .running import LongWork


class PFGEOM_OT_rebuild(LongWork, bpy.types.Operator):  # noqa: N801
    """Make meshes of the selected objects' functions, as fine as you like"""

    bl_idname = "pfgeom.rebuild"
    bl_label = "Rebuild from Functions"
    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012

    verb = "Rebuilt"

    detail: EnumProperty(  # type: ignore[valid-type]
        name="Detail",
        items=[
            ("DEFAULT", "As promised", "The mesh that the stored tolerance is about"),
            ("RESOLUTION", "Resolution", "So many cells along the longest side"),
            ("TOLERANCE", "Tolerance", "At most so far from the functions"),
            ("PREVIEW", "Light preview", "A coarse mesh"),
            ("NONE", "Nothing", "No mesh; the functions alone stay"),
        ],
        default="DEFAULT",
    )
    resolution: IntProperty(  # type: ignore[valid-type]
        name="Resolution", description="Cells along the longest side", default=64, min=8, max=4096, soft_max=512
    )
    tolerance: FloatProperty(  # type: ignore[valid-type]
        name="Tolerance",
        description="Extra deviation from the functions, in percent of the size",
        subtype="PERCENTAGE",
        default=0.1,
        min=0.0005,
        max=10.0,
        soft_min=0.01,
        precision=3,
    )
    keep_original: BoolProperty(  # type: ignore[valid-type]
        name="Keep original",
        description="Where the original is shown still: put it into a hidden collection",
        default=True,
    )

    def draw(self, context: bpy.types.Context) -> None:
        column = self.layout.column()
        column.use_property_split = True
        column.prop(self, "detail")
        if self.detail in ("RESOLUTION", "TOLERANCE"):
            column.prop(self, self.detail.lower())
        column.prop(self, "keep_original")

    def plan(self, context: bpy.types.Context) -> rebuild.Plan:
        options = rebuild.Options(
            show=self.detail if self.detail in ("PREVIEW", "NONE") else "REBUILT",
            cells=self.resolution if self.detail == "RESOLUTION" else None,
            tolerance=self.tolerance / 100 if self.detail == "TOLERANCE" else None,
            keep_original=self.keep_original,
        )
        return rebuild.plan(context.selected_objects, context.evaluated_depsgraph_get(), options)

    def finish(self, context: bpy.types.Context, plan: rebuild.Plan, job) -> list[str]:
        return rebuild.finish(plan, job)


classes = (PFGEOM_OT_rebuild,)
