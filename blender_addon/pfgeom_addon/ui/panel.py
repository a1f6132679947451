# SPDX-License-Identifier: GPL-3.0-or-later
"""The tab in the sidebar: what to do, and what it came to."""

from __future__ import annotations

import bpy

from .. import compat
from ..core import native, texts
from ..core.tolerance import stretch
from ..scene import deviation, read, store
from . import running, settings


def length(context: bpy.types.Context, value: float) -> str:
    """In the scene's units."""
    units = context.scene.unit_settings
    if units.system == "NONE":
        return f"{value:.4g}"
    return bpy.utils.units.to_string(units.system, "LENGTH", value * units.scale_length, precision=4)


def draw_missing(layout: bpy.types.UILayout) -> None:
    """Why there is no native module, with the versions that decide it."""
    layout.label(text="The native module is not loaded", icon="ERROR")
    layout.label(text=native.why_missing())
    for name, value in native.versions():
        layout.label(text=f"{name}: {value}")


class _Panel:
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "PF Geometry"


class PFGEOM_PT_compress(_Panel, bpy.types.Panel):  # noqa: N801
    bl_label = "Compress"

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        if native.why_missing():
            draw_missing(layout)
            return
        chosen = context.scene.pfgeom
        now = running.status()
        if now is not None:
            compat.draw_progress(layout, now.fraction, texts.progress(now.fraction, now.seconds_left))
            layout.label(text=f"{now.name}: {now.stage}")
            layout.label(text="Esc stops it")
            return
        settings.draw(layout, chosen)
        row = layout.row()
        row.scale_y = 1.4
        row.operator_context = "INVOKE_DEFAULT"
        settings.copy(chosen, row.operator("pfgeom.compress", text="Compress Selected"))


class PFGEOM_PT_object(_Panel, bpy.types.Panel):  # noqa: N801
    bl_label = "Active Object"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return not native.why_missing() and store.holder_of(context.object) is not None

    def draw(self, context: bpy.types.Context) -> None:
        obj = context.object
        holder = store.holder_of(obj)
        figures = store.figures_of(holder)
        column = self.layout.column(align=True)
        _draw_lines(column, _lines(context, obj, figures))
        layout = self.layout.column(align=True)
        layout.operator_context = "INVOKE_DEFAULT"
        layout.operator("pfgeom.rebuild")
        layout.operator("pfgeom.deviation")


class PFGEOM_PT_selection(_Panel, bpy.types.Panel):  # noqa: N801
    bl_label = "Selection"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return not native.why_missing() and len(context.selected_objects) > 1

    def draw(self, context: bpy.types.Context) -> None:
        holders = {holder.name: holder for obj in context.selected_objects if (holder := store.holder_of(obj))}
        figures = [store.figures_of(holder) for holder in holders.values()]
        stored = sum(entry.get("bytes", 0) for entry in figures)
        raw = sum(entry.get("raw_bytes", 0) for entry in figures)
        objects = sum(store.holder_of(obj) is not None for obj in context.selected_objects)
        lines = [
            ("Compressed", f"{objects} of {len(context.selected_objects)} objects"),
            ("Shapes", str(len(holders))),
            ("Functions", str(sum(sum(entry.get("functions", [0])[:3]) for entry in figures))),
            ("Stored", texts.size(stored)),
            ("Raw", texts.size(raw)),
            ("Ratio", texts.ratio(raw, stored)),
        ]
        _draw_lines(self.layout.column(align=True), lines)


def _draw_lines(column: bpy.types.UILayout, lines: list[tuple[str, str]]) -> None:
    for name, value in lines:
        row = column.split(factor=0.45)
        row.label(text=name)
        row.label(text=value)


def _lines(context: bpy.types.Context, obj: bpy.types.Object, figures: dict) -> list[tuple[str, str]]:
    if not figures:
        return [("Functions", "no figures stored")]
    surfaces, separators, perturbations, mesh_faces = (*figures.get("functions", ()), 0, 0, 0, 0)[:4]
    world = stretch(read.matrix_of(obj))
    proof = "Proved" if figures.get("certified") else "Sampled"
    shown = {"ORIGINAL": "original", "REBUILT": "rebuilt mesh", "PREVIEW": "light preview", "NONE": "nothing"}
    lines = [
        ("Shows", shown.get(store.shows(obj), "")),
        ("Functions", f"{surfaces} + {separators} + {perturbations}"),
        ("Coded faces", str(mesh_faces)) if mesh_faces else None,
        ("Stored", texts.size(figures.get("bytes", 0))),
        ("Ratio", texts.ratio(figures["raw_bytes"], figures["bytes"])) if figures.get("raw_bytes") else None,
        ("Tolerance", f"{length(context, world * figures.get('tolerance', 0.0))} ({figures.get('metric', '')})"),
        (f"{proof} max", length(context, world * figures.get("max", 0.0))),
        ("RMS", length(context, world * figures.get("rms", 0.0))),
    ]
    measured = deviation.figures_of(obj.data)
    if measured is not None:
        lines += [
            ("Measured", f"{length(context, measured[0])} max"),
            ("", f"{length(context, measured[1])} rms"),
            ("", f"{measured[2]:.2f}\u00b0 normals"),
        ]
    return [line for line in lines if line is not None]


classes = (PFGEOM_PT_compress, PFGEOM_PT_object, PFGEOM_PT_selection)
