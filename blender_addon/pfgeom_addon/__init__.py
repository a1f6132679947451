# SPDX-License-Identifier: GPL-3.0-or-later
"""PF Geometry: meshes as functions, inside Blender.

One folder that is a legacy add-on (3.4 to 4.1) and an extension (4.2 and later). `core` knows nothing of Blender,
`scene` alone reads and writes its data, `ui` is thin; every difference between versions stands in `compat`.
"""

# What legacy versions read, without running this file. `make blender` writes the version.
bl_info = {
    "name": "PF Geometry",
    "author": "pfgeom authors",
    "version": (0, 0, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Sidebar > PF Geometry; Object menu; File > Import/Export",
    "description": "Compress meshes to functions within a tolerance, and rebuild them at any resolution",
    "category": "Mesh",
}


def register() -> None:
    from . import ui

    ui.register()


def unregister() -> None:
    from . import ui

    ui.unregister()
