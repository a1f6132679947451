#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Build dist/pfgeom-VERSION-blender-PLATFORM.zip: one folder that is a legacy add-on and an extension, with its wheels.

usage: build.py WHEEL... --out FOLDER
"""

from __future__ import annotations

import argparse
import re
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
ADDON = Path(__file__).resolve().parent / "pfgeom_addon"

#: Blender's names of platforms by the wheels' tags.
PLATFORMS = {
    r"manylinux.*_x86_64": "linux-x64",
    r"win_amd64": "windows-x64",
    r"win_arm64": "windows-arm64",
    r"macosx.*_arm64": "macos-arm64",
    r"macosx.*_x86_64": "macos-x64",
}
#: One date for all members, so that equal contents make equal files.
DATE = (2020, 1, 1, 0, 0, 0)


def version() -> str:
    found = re.search(r"project\(pfgeom VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))
    assert found, "CMakeLists.txt names no version"
    return found[1]


def platform_of(wheel: Path) -> str:
    tag = wheel.stem.rsplit("-", 1)[1]
    for pattern, name in PLATFORMS.items():
        if re.search(pattern, tag):
            return name
    raise SystemExit(f"{wheel.name}: Blender has no platform for {tag}; was it repaired?")


def with_version(name: str, text: str, platforms: list[str], wheels: list[Path]) -> str:
    """The texts that hold a version, with the project's."""
    if name == "__init__.py":
        return _replaced(text, "(0, 0, 0)", f"({', '.join(version().split('.'))})")
    text = _replaced(text, '"0.0.0"', f'"{version()}"')
    text = _replaced(text, "platforms = []", f"platforms = {_strings(platforms)}")
    return _replaced(text, "wheels = []", f"wheels = {_strings([f'./wheels/{wheel.name}' for wheel in wheels])}")


def _replaced(text: str, old: str, new: str) -> str:
    assert text.count(old) == 1, old
    return text.replace(old, new)


def _strings(values: list[str]) -> str:
    return "[" + ", ".join(f'"{value}"' for value in values) + "]"


def build(wheels: list[Path], out: Path) -> Path:
    platforms = sorted({platform_of(wheel) for wheel in wheels})
    path = out / f"pfgeom-{version()}-blender-{'-'.join(platforms)}.zip"
    out.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for file in sorted(p for p in ADDON.rglob("*") if p.is_file() and not _is_made(p)):
            name = file.relative_to(ADDON.parent).as_posix()
            content = file.read_bytes()
            if name in ("pfgeom_addon/__init__.py", "pfgeom_addon/blender_manifest.toml"):
                content = with_version(file.name, content.decode(), platforms, wheels).encode()
            archive.writestr(zipfile.ZipInfo(name, DATE), content, zipfile.ZIP_DEFLATED)
        for wheel in wheels:
            name = f"pfgeom_addon/wheels/{wheel.name}"
            archive.writestr(zipfile.ZipInfo(name, DATE), wheel.read_bytes(), zipfile.ZIP_STORED)
    return path


def _is_made(path: Path) -> bool:
    return bool({"__pycache__", "_vendor", "wheels"} & set(path.relative_to(ADDON).parts))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("wheels", nargs="+", type=Path)
    parser.add_argument("--out", type=Path, required=True)
    arguments = parser.parse_args()
    fitting = [wheel for wheel in arguments.wheels if wheel.name.startswith(f"pfgeom-{version()}-")]
    if not fitting:
        raise SystemExit(f"none of these is a wheel of version {version()}: {', '.join(map(str, arguments.wheels))}")
    path = build(sorted(fitting), arguments.out)
    print(f"{path}: {path.stat().st_size:,} bytes, with {', '.join(wheel.name for wheel in sorted(fitting))}")


if __name__ == "__main__":
    main()
