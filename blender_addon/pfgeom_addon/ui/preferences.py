# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on's entry in the preferences: versions, and what is wrong, if anything is."""

from __future__ import annotations

import bpy

from ..core import native
from .panel import draw_missing

#: `pfgeom_addon`, or `bl_ext.REPOSITORY.pfgeom_addon`.
_ADDON = __package__.rpartition(".")[0]


class PFGEOM_AP_preferences(bpy.types.AddonPreferences):  # noqa: N801
    bl_idname = _ADDON

    def draw(self, context: bpy.types.Context) -> None:
        if native.why_missing():
            draw_missing(self.layout)
            return
        for name, value in native.versions():
            self.layout.label(text=f"{name}: {value}")


classes = (PFGEOM_AP_preferences,)
