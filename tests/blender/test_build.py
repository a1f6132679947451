"""blender_addon/build.py: which wheels go into the zip, and what it is called."""

from __future__ import annotations

import re
import subprocess
import sys
import zipfile
from pathlib import Path

from conftest import ROOT

VERSION = re.search(r"project\(pfgeom VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text())[1]


def build(folder: Path, *names: str) -> subprocess.CompletedProcess[str]:
    wheels = [folder / name for name in names]
    for wheel in wheels:
        wheel.write_bytes(wheel.name.encode())
    command = [sys.executable, ROOT / "blender_addon" / "build.py", *wheels, "--out", folder / "out"]
    return subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)


def test_every_python_in_one_zip_and_the_same_bytes_each_time(tmp_path: Path) -> None:
    names = [f"pfgeom-{VERSION}-{python}-{python}-manylinux_2_28_x86_64.whl" for python in ("cp310", "cp311", "cp313")]
    assert build(tmp_path, *names).returncode == 0
    archive = tmp_path / "out" / f"pfgeom-{VERSION}-blender-linux-x64.zip"
    first = archive.read_bytes()
    with zipfile.ZipFile(archive) as content:
        manifest = content.read("pfgeom_addon/blender_manifest.toml").decode()
        assert [content.read(f"pfgeom_addon/wheels/{name}").decode() for name in names] == names
    assert all(f'"./wheels/{name}"' in manifest for name in names) and 'platforms = ["linux-x64"]' in manifest
    assert build(tmp_path, *reversed(names)).returncode == 0
    assert archive.read_bytes() == first


def test_wheels_of_other_versions_stay_out(tmp_path: Path) -> None:
    other = "pfgeom-9.9.9-cp311-cp311-manylinux_2_28_x86_64.whl"
    done = build(tmp_path, other)
    assert done.returncode != 0 and "none of these is a wheel" in done.stderr


def test_a_wheel_that_was_not_repaired_is_refused(tmp_path: Path) -> None:
    done = build(tmp_path, f"pfgeom-{VERSION}-cp311-cp311-linux_x86_64.whl")
    assert done.returncode != 0 and "was it repaired?" in done.stderr
