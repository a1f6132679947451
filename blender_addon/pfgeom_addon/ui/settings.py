# SPDX-License-Identifier: GPL-3.0-or-later
"""What a person chooses, written once: for the panel's settings and for the operators."""

from __future__ import annotations

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, PointerProperty

from ..scene.compress import Options


class CompressProperties:
    unit: EnumProperty(  # type: ignore[valid-type]
        name="Unit",
        items=[
            ("SHARE", "Share of size", "The tolerance is a share of each object's size"),
            ("LENGTH", "Length", "The tolerance is a length in the scene, the same for all objects"),
        ],
        default="SHARE",
    )
    share: FloatProperty(  # type: ignore[valid-type]
        name="Tolerance",
        description="Largest deviation allowed, in percent of the diagonal of the object's bounding box",
        subtype="PERCENTAGE",
        default=0.1,
        min=0.0001,
        max=10.0,
        soft_min=0.005,
        precision=3,
    )
    length: FloatProperty(  # type: ignore[valid-type]
        name="Tolerance",
        description="Largest deviation allowed, as a length in the scene",
        subtype="DISTANCE",
        default=0.001,
        min=1e-9,
        precision=5,
    )
    metric: EnumProperty(  # type: ignore[valid-type]
        name="Limits",
        items=[
            ("max", "Maximum", "No point of either surface is farther than the tolerance from the other"),
            ("rms", "Root mean square", "The root mean square of the deviation is within the tolerance"),
        ],
        default="max",
    )
    effort: EnumProperty(  # type: ignore[valid-type]
        name="Effort",
        description="How long to look for fewer bytes; the tolerance holds either way",
        items=[("fast", "Fast", ""), ("normal", "Normal", ""), ("best", "Best", "")],
        default="normal",
    )
    display: EnumProperty(  # type: ignore[valid-type]
        name="Then show",
        items=[
            ("ORIGINAL", "Original", "The object stays as it is; the functions are stored besides"),
            ("REBUILT", "Rebuilt mesh", "The object shows the mesh made of the functions, within the tolerance"),
            ("PREVIEW", "Light preview", "The object shows a coarse mesh made of the functions"),
            ("NONE", "Nothing", "The object keeps its functions alone, the smallest file"),
        ],
        default="ORIGINAL",
    )
    keep_original: BoolProperty(  # type: ignore[valid-type]
        name="Keep original",
        description="Put the original into a hidden collection before something else is shown",
        default=True,
    )

    def chosen(self) -> Options:
        return Options(
            share=self.share / 100 if self.unit == "SHARE" else None,
            length=self.length,
            metric=self.metric,
            effort=self.effort,
            display=self.display,
            keep_original=self.keep_original,
        )


NAMES = tuple(CompressProperties.__annotations__)


def draw(layout: bpy.types.UILayout, chosen: CompressProperties) -> None:
    column = layout.column()
    column.use_property_split = True
    column.use_property_decorate = False
    column.prop(chosen, "unit")
    column.prop(chosen, "share" if chosen.unit == "SHARE" else "length")
    column.prop(chosen, "metric")
    column.prop(chosen, "effort")
    column.prop(chosen, "display")
    if chosen.display != "ORIGINAL":
        column.prop(chosen, "keep_original")


def copy(source: CompressProperties, target) -> None:
    """To an operator's properties, as a layout gives them, or a dict."""
    for name in NAMES:
        if isinstance(target, dict):
            target[name] = getattr(source, name)
        else:
            setattr(target, name, getattr(source, name))


class PFGEOM_PG_settings(CompressProperties, bpy.types.PropertyGroup):  # noqa: N801
    """The panel's settings; they are saved with the scene."""


classes = (PFGEOM_PG_settings,)


def register() -> None:
    bpy.types.Scene.pfgeom = PointerProperty(type=PFGEOM_PG_settings)


def unregister() -> None:
    del bpy.types.Scene.pfgeom
