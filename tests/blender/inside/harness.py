"""Runs inside Blender (or on the module bpy): installs the add-on from its zip, then calls check functions."""

from __future__ import annotations

import contextlib
import importlib
import io
import sys
import time
import traceback
from pathlib import Path

import bpy

LEGACY = bpy.app.version < (4, 2, 0)
#: Of the installed add-on's package.
MODULE = "pfgeom_addon" if LEGACY else "bl_ext.user_default.pfgeom_addon"


def arguments() -> list[str]:
    """What stands after `--`, or after the script's name."""
    return sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else sys.argv[1:]


def install(archive: str) -> None:
    """As a user does: from the zip, by Blender's own installer."""
    if LEGACY:
        bpy.ops.preferences.addon_install(filepath=archive, overwrite=True)
        bpy.ops.preferences.addon_enable(module=MODULE)
    else:
        bpy.ops.preferences.addon_enable(module="bl_pkg")
        bpy.ops.extensions.package_install_files(filepath=archive, repo="user_default", enable_on_install=True)
    assert MODULE in bpy.context.preferences.addons, "the add-on is not enabled"


def enable() -> None:
    bpy.ops.preferences.addon_enable(module=MODULE)


def disable() -> None:
    bpy.ops.preferences.addon_disable(module=MODULE)


def addon(name: str):
    """A module of the installed add-on: addon("scene.store")."""
    return importlib.import_module(f"{MODULE}.{name}")


def clear() -> None:
    """An empty scene."""
    bpy.ops.wm.read_homefile(use_empty=True)


def call(operator, *modes: str, **options) -> tuple[set[str], str]:
    """The operator's result and what it reported; an error report is a RuntimeError, as everywhere in scripts."""
    said = io.StringIO()
    with contextlib.redirect_stdout(said):
        result = operator(*modes, **options)
    return result, said.getvalue()


def run(modules: list[str]) -> None:
    """Calls every function `check_*` of the modules, each in an empty scene; leaves with 1 if one failed."""
    failed = []
    for name in modules:
        module = importlib.import_module(name)
        for check, function in list(vars(module).items()):
            if not check.startswith("check_"):
                continue
            start = time.monotonic()
            try:
                clear()
                function()
                result = "ok"
            except BaseException:
                traceback.print_exc()
                failed.append(check)
                result = "FAILED"
            print(f"{result:6} {time.monotonic() - start:5.1f} s  {name}.{check}", flush=True)
    if failed:
        print(f"failed: {', '.join(failed)}", flush=True)
    leave(1 if failed else 0)


def leave(code: int) -> None:
    """bpy may end with a crash of its own after all is done; the result is ours."""
    import os

    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(code)


def folder() -> Path:
    """For files of a check; made and removed by the test that runs this."""
    return Path(arguments()[1])
