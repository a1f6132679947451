# SPDX-License-Identifier: GPL-3.0-or-later
"""File > Import and Export of `.pfg` files, and dropping them into the window."""

from __future__ import annotations

from pathlib import Path

import bpy
from bpy.props import CollectionProperty, StringProperty
from bpy_extras.io_utils import ExportHelper, ImportHelper

from .. import compat
from ..core import native, texts
from ..scene import files, store
from .running import LongWork


class IMPORT_OT_pfgeom(LongWork, bpy.types.Operator, ImportHelper):  # noqa: N801
    """Make objects of .pfg files"""

    bl_idname = "import_mesh.pfgeom"
    bl_label = "Import PF Geometry"
    bl_options = {"UNDO"}  # noqa: RUF012

    verb = "Imported"

    filename_ext = ".pfg"
    filter_glob: StringProperty(default="*.pfg", options={"HIDDEN"})  # type: ignore[valid-type]
    directory: StringProperty(subtype="DIR_PATH", options={"HIDDEN", "SKIP_SAVE"})  # type: ignore[valid-type]
    files: CollectionProperty(  # type: ignore[valid-type]
        type=bpy.types.OperatorFileListElement, options={"HIDDEN", "SKIP_SAVE"}
    )

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if self.directory and len(self.files):  # dropped
            return self.start(context)
        self._asked = True
        return ImportHelper.invoke(self, context, event)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Beside the window if it comes from the file browser."""
        return self.start(context) if getattr(self, "_asked", False) else LongWork.execute(self, context)

    def plan(self, context: bpy.types.Context) -> files.ImportPlan:
        names = [entry.name for entry in self.files if entry.name]
        paths = [Path(self.directory, name) for name in names] if names else [Path(self.filepath)]
        return files.ImportPlan(paths, [])

    def finish(self, context: bpy.types.Context, plan: files.ImportPlan, job) -> list[str]:
        made = files.finish_import(plan, job, context)
        if made:
            for obj in context.selected_objects:
                obj.select_set(False)
            for obj in made:
                obj.select_set(True)
            context.view_layer.objects.active = made[0]
        return [obj.name for obj in made]


class EXPORT_OT_pfgeom(bpy.types.Operator, ExportHelper):  # noqa: N801
    """Write the functions of the selected objects to .pfg files: one object to the named file, several beside it"""

    bl_idname = "export_mesh.pfgeom"
    bl_label = "Export PF Geometry"

    filename_ext = ".pfg"
    filter_glob: StringProperty(default="*.pfg", options={"HIDDEN"})  # type: ignore[valid-type]

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if native.why_missing():
            cls.poll_message_set("The native module is not loaded; the panel says why")
            return False
        if not any(store.holder_of(obj) for obj in context.selected_objects):
            cls.poll_message_set("No selected object has functions: compress it first")
            return False
        return True

    def execute(self, context: bpy.types.Context) -> set[str]:
        written = []
        chosen = [obj for obj in context.selected_objects if obj.type == "MESH"]
        for obj, path in files.paths_for(chosen, Path(self.filepath)):
            reason = files.export(obj, path)
            if reason:
                self.report({"WARNING"}, f"{obj.name} {reason}")
            else:
                written.append(path.name)
        if not written:
            return {"CANCELLED"}
        self.report({"INFO"}, f"Wrote {texts.listing(written)}")
        return {"FINISHED"}


classes = (IMPORT_OT_pfgeom, EXPORT_OT_pfgeom)

if compat.HAS_FILE_HANDLERS:

    class IO_FH_pfgeom(bpy.types.FileHandler):  # noqa: N801
        bl_idname = "IO_FH_pfgeom"
        bl_label = "PF Geometry"
        bl_import_operator = IMPORT_OT_pfgeom.bl_idname
        bl_export_operator = EXPORT_OT_pfgeom.bl_idname
        bl_file_extensions = ".pfg"

        @classmethod
        def poll_drop(cls, context: bpy.types.Context) -> bool:
            return context.area is not None and context.area.type in ("VIEW_3D", "OUTLINER")

    classes = (*classes, IO_FH_pfgeom)


def _import_menu(self, context: bpy.types.Context) -> None:
    self.layout.operator(IMPORT_OT_pfgeom.bl_idname, text="PF Geometry (.pfg)")


def _export_menu(self, context: bpy.types.Context) -> None:
    self.layout.operator(EXPORT_OT_pfgeom.bl_idname, text="PF Geometry (.pfg)")


def register() -> None:
    bpy.types.TOPBAR_MT_file_import.append(_import_menu)
    bpy.types.TOPBAR_MT_file_export.append(_export_menu)


def unregister() -> None:
    bpy.types.TOPBAR_MT_file_export.remove(_export_menu)
    bpy.types.TOPBAR_MT_file_import.remove(_import_menu)
