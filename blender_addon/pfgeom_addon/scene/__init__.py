# SPDX-License-Identifier: GPL-3.0-or-later
"""The only place that reads and writes Blender's data. No operators here: scripts and tests can call all of it."""
