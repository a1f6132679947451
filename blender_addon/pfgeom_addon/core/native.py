# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds the package pfgeom, or says why it cannot be had."""

from __future__ import annotations

import importlib
import importlib.util
import platform
import sys
import sysconfig
import tempfile
import zipfile
from functools import lru_cache
from pathlib import Path
from types import ModuleType

_FOLDER = Path(__file__).resolve().parents[1]


class Missing(RuntimeError):
    """The native module cannot be loaded; the text says why."""


@lru_cache(maxsize=1)
def _load() -> tuple[ModuleType | None, str]:
    try:
        return importlib.import_module("pfgeom"), ""
    except ImportError as why:
        reason = str(why)
    if _is_extension():  # its wheels were installed by Blender, or none fits
        return None, reason
    try:
        return _from_own_wheel(), ""
    except (ImportError, OSError, zipfile.BadZipFile) as why:
        return None, str(why)


def pfgeom() -> ModuleType:
    """The package. Raises Missing."""
    module, reason = _load()
    if module is None:
        raise Missing(reason)
    return module


def why_missing() -> str:
    """Empty if the package is there."""
    return _load()[1]


def versions() -> list[tuple[str, str]]:
    """What decides whether a wheel fits, for people who ask why it does not."""
    found, _ = _load()
    wheels = ", ".join(sorted(wheel.name.split("-", 2)[2][:-4] for wheel in _wheels())) or "none"
    return [
        ("Python", f"{platform.python_version()} ({_tag()}, {sysconfig.get_platform()})"),
        ("Wheels in the add-on", wheels),
        ("pfgeom", str(found.__version__) if found else "not loaded"),
    ]


def _is_extension() -> bool:
    return __package__.startswith("bl_ext.")


def _tag() -> str:
    return f"cp{sys.version_info.major}{sys.version_info.minor}"


def _wheels() -> list[Path]:
    return sorted((_FOLDER / "wheels").glob("pfgeom-*.whl"))


def _unpack(wheel: Path, folder: Path) -> None:
    """Whole or not at all."""
    folder.parent.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory(dir=folder.parent) as half_done:
        with zipfile.ZipFile(wheel) as archive:
            archive.extractall(Path(half_done) / "whole")
        (Path(half_done) / "whole").rename(folder)


def _from_own_wheel() -> ModuleType:
    """Legacy Blender does not install wheels: unpack the fitting one beside this file, once, and import it from there.

    The search path stays as it is, so no other add-on can meet what lies in that folder.
    """
    fitting = [wheel for wheel in _wheels() if f"-{_tag()}-" in wheel.name]
    if not fitting:
        raise ImportError(f"the add-on holds no wheel for {_tag()}")
    folder = _FOLDER / "_vendor" / fitting[-1].stem
    if not folder.is_dir():
        _unpack(fitting[-1], folder)
    package = folder / "pfgeom"
    spec = importlib.util.spec_from_file_location(
        "pfgeom", package / "__init__.py", submodule_search_locations=[str(package)]
    )
    if spec is None or spec.loader is None:
        raise ImportError(f"{package} is no package")
    module = importlib.util.module_from_spec(spec)
    sys.modules["pfgeom"] = module
    try:
        spec.loader.exec_module(module)
    except BaseException:
        for name in [name for name in sys.modules if name == "pfgeom" or name.startswith("pfgeom.")]:
            del sys.modules[name]
        raise
    return module
