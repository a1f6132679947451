# SPDX-License-Identifier: GPL-3.0-or-later
"""Compress the selected objects."""

from __future__ import annotations

import bpy
from bpy.props import BoolProperty

from ..scene import compress, losses
from . import settings
from .running import LongWork


class PFGEOM_OT_compress(settings.CompressProperties, LongWork, bpy.types.Operator):  # noqa: N801
    """Turn the selected meshes into functions that stay within the tolerance, and store these in the file"""

    bl_idname = "pfgeom.compress"
    bl_label = "Compress to Functions"
    # No redo panel: each move of a slider there would do all the work again.
    bl_options = {"UNDO"}  # noqa: RUF012

    verb = "Compressed"

    confirmed: BoolProperty(default=False, options={"HIDDEN", "SKIP_SAVE"})  # type: ignore[valid-type]

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if not self.confirmed and losses_in(context, self.display):
            chosen: dict[str, object] = {}
            settings.copy(self, chosen)
            bpy.ops.pfgeom.compress_options("INVOKE_DEFAULT", **chosen)
            return {"CANCELLED"}
        return self.start(context)

    def plan(self, context: bpy.types.Context) -> compress.Plan:
        return compress.plan(context.selected_objects, context.evaluated_depsgraph_get(), self.chosen())

    def finish(self, context: bpy.types.Context, plan: compress.Plan, job) -> list[str]:
        return compress.finish(plan, job)


class PFGEOM_OT_compress_options(settings.CompressProperties, bpy.types.Operator):  # noqa: N801
    """Choose a tolerance and what to show, then turn the selected meshes into functions"""

    bl_idname = "pfgeom.compress_options"
    bl_label = "Compress to Functions..."
    bl_options = {"INTERNAL"}  # noqa: RUF012

    poll = PFGEOM_OT_compress.poll

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        return context.window_manager.invoke_props_dialog(self, width=360)

    def draw(self, context: bpy.types.Context) -> None:
        settings.draw(self.layout, self)
        lost = losses_in(context, self.display)
        if lost:
            box = self.layout.box().column(align=True)
            box.label(text="The mesh that is shown then does not have:", icon="ERROR")
            for sentence in lost:
                box.label(text=sentence)
            box.label(text="They stay in the kept original." if self.keep_original else "Undo brings them back.")

    def execute(self, context: bpy.types.Context) -> set[str]:
        chosen: dict[str, object] = {}
        settings.copy(self, chosen)
        mode = "EXEC_DEFAULT" if bpy.app.background else "INVOKE_DEFAULT"
        bpy.ops.pfgeom.compress(mode, confirmed=True, **chosen)
        return {"FINISHED"}


#: Objects that the dialog names.
_SHOWN = 8


def losses_in(context: bpy.types.Context, display: str) -> list[str]:
    """A sentence for each selected object that would lose something."""
    if display == "ORIGINAL":
        return []
    found = [(obj.name, losses.losses_of(obj)) for obj in context.selected_objects if not compress.why_not(obj)]
    sentences = [f"{name}: {', '.join(lost)}" for name, lost in found if lost]
    more = len(sentences) - _SHOWN
    return sentences[:_SHOWN] + ([f"and {more} more objects"] if more > 0 else [])


def _menu(self, context: bpy.types.Context) -> None:
    self.layout.separator()
    self.layout.operator_context = "INVOKE_DEFAULT"
    settings.copy(context.scene.pfgeom, self.layout.operator(PFGEOM_OT_compress_options.bl_idname))
    self.layout.operator("pfgeom.rebuild")
    self.layout.operator("pfgeom.deviation")


classes = (PFGEOM_OT_compress, PFGEOM_OT_compress_options)


def register() -> None:
    bpy.types.VIEW3D_MT_object.append(_menu)


def unregister() -> None:
    bpy.types.VIEW3D_MT_object.remove(_menu)
