# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators, panels, menus and preferences: thin, the work is in `scene` and `core`."""

from __future__ import annotations

import bpy

from . import compress, deviation, files, legend, panel, preferences, rebuild, running, settings

#: In the order of registering; each has `classes`, and `register`/`unregister` if it hooks into anything else.
_MODULES = (settings, preferences, compress, rebuild, deviation, files, panel, legend, running)


def register() -> None:
    for module in _MODULES:
        for cls in module.classes:
            bpy.utils.register_class(cls)
        if hasattr(module, "register"):
            module.register()


def unregister() -> None:
    for module in reversed(_MODULES):
        if hasattr(module, "unregister"):
            module.unregister()
        for cls in reversed(module.classes):
            bpy.utils.unregister_class(cls)
