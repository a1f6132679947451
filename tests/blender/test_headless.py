"""The add-on in Debian's Blender 3.4 and as an extension in the module bpy 4.5, installed from its zip."""

from __future__ import annotations

import json
import re
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
from conftest import BPY, ROOT, World, why_not

CHECKS = ["check_compress", "check_rebuild", "check_files", "check_lifecycle"]


def test_checks(world: World, archive: Path, tmp_path: Path) -> None:
    world.run("run.py", archive, tmp_path, *CHECKS)


def test_a_file_keeps_the_functions(world: World, archive: Path, saved: Path) -> None:
    """Twenty objects as functions alone, a fifth of the size at most; a new process rebuilds them in tolerance."""
    sizes = json.loads((saved / "sizes.json").read_text())
    functions, originals = sizes["functions"] - sizes["empty"], sizes["originals"] - sizes["empty"]
    assert 5 * functions <= originals, sizes
    world.run("reload.py", archive, saved)


def test_the_extension_is_valid(archive: Path) -> None:
    """By Blender's own tool."""
    tools = list(BPY.parents[1].glob("lib/python*/site-packages/bpy/*/scripts/addons_core/bl_pkg/cli/blender_ext.py"))
    if not tools:
        pytest.skip(why_not("the module bpy"))
    done = subprocess.run(
        [BPY, tools[0], "validate", archive], capture_output=True, text=True, timeout=120, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "Success" in done.stdout, done.stdout


def test_one_version(archive: Path) -> None:
    with zipfile.ZipFile(archive) as content:
        names = content.namelist()
        manifest = content.read("pfgeom_addon/blender_manifest.toml").decode()
        source = content.read("pfgeom_addon/__init__.py").decode()
    assert {name.split("/")[0] for name in names} == {"pfgeom_addon"}
    version = re.search(r"project\(pfgeom VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text())[1]
    assert f'\nversion = "{version}"\n' in manifest
    assert f'"version": ({version.replace(".", ", ")})' in source
    wheels = re.findall(r'"\./(wheels/[^"]+\.whl)"', manifest)
    assert wheels and all(version in wheel and f"pfgeom_addon/{wheel}" in names for wheel in wheels)
    assert not any("numpy" in name for name in names)


def test_core_knows_no_blender() -> None:
    """It can be imported where there is no bpy."""
    modules = ["deviation", "job", "native", "shapes", "storage", "texts", "tolerance"]
    code = "import " + ", ".join(f"pfgeom_addon.core.{name}" for name in modules)
    subprocess.run([sys.executable, "-c", code], cwd=ROOT / "blender_addon", check=True, timeout=60)
    found = [p for p in (ROOT / "blender_addon/pfgeom_addon/core").glob("*.py") if "import bpy" in p.read_text()]
    assert not found
    assert sorted(p.stem for p in (ROOT / "blender_addon/pfgeom_addon/core").glob("[a-z]*.py")) == modules


def test_versions_are_looked_at_in_one_place() -> None:
    package = ROOT / "blender_addon/pfgeom_addon"
    found = [p for p in package.rglob("*.py") if "app.version" in p.read_text() and p.name != "compat.py"]
    assert not found
