# SPDX-License-Identifier: GPL-3.0-or-later
"""Arrays in, arrays out: nothing here knows Blender, and algorithms are in the package pfgeom alone."""
