"""blender -b --python run.py -- ADDON.zip FOLDER CHECKS...; or python run.py with the same, on the module bpy."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

import harness

harness.install(harness.arguments()[0])
harness.run(harness.arguments()[2:])
