"""Where Blender is, and how a script runs in it. Each test is skipped, with its reason, where its Blender is not."""

from __future__ import annotations

import os
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
INSIDE = Path(__file__).parent / "inside"
BPY = ROOT / "build" / "blender" / "bpy" / "bin" / "python"
LOG = ROOT / "build" / "blender" / "setup.log"


@dataclass(frozen=True)
class World:
    """One Blender, with settings of its own."""

    command: tuple[str, ...]
    environment: dict[str, str]

    def run(self, script: str, *arguments: object, seconds: int = 300) -> str:
        """What the script prints; fails with it unless it ends well."""
        command = [*self.command, str(INSIDE / script), "--", *map(str, arguments)]
        done = subprocess.run(
            command,
            env={**os.environ, **self.environment},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            errors="replace",
            timeout=seconds,
        )
        print(done.stdout)
        assert done.returncode == 0, f"{script} ended with {done.returncode}:\n{done.stdout[-6000:]}"
        return done.stdout


def why_not(what: str) -> str:
    said = LOG.read_text(errors="replace").strip().splitlines() if LOG.exists() else []
    return f"{what} is not here" + (f": {said[-1]}" if said else " (`make test` gets it)")


@pytest.fixture(scope="session")
def archive() -> Path:
    """The add-on as `make blender` built it."""
    found = sorted((ROOT / "dist").glob("pfgeom-*-blender-*.zip"), key=lambda path: path.stat().st_mtime)
    if not found:
        pytest.skip("no add-on in dist/: `make blender` builds it")
    return found[-1]


def debian_blender() -> str:
    """Path of a Blender before extensions, whose Python a wheel fits."""
    path = shutil.which("blender")
    if path is None:
        pytest.skip(why_not("Blender"))
    said = subprocess.run([path, "--version"], capture_output=True, text=True, timeout=120).stdout
    if not said.startswith("Blender 3."):
        pytest.skip(f"{said.splitlines()[0] if said else path} is no legacy Blender")
    return path


def legacy(home: Path) -> World:
    """Debian's Blender 3.4, without a window."""
    arguments = ("-b", "--factory-startup", "--python-exit-code", "1", "--python")
    folders = {"BLENDER_USER_SCRIPTS": str(home / "scripts"), "BLENDER_USER_CONFIG": str(home / "config")}
    return World((debian_blender(), *arguments), folders)


def extension(home: Path) -> World:
    """The module bpy 4.5."""
    if not BPY.exists() or not list(BPY.parents[1].glob("lib/python*/site-packages/bpy")):
        pytest.skip(why_not("the module bpy"))
    return World((str(BPY),), {"BLENDER_USER_RESOURCES": str(home)})


WORLDS = {"legacy": legacy, "extension": extension}


@pytest.fixture(scope="session", params=list(WORLDS))
def world(request, tmp_path_factory) -> World:
    return WORLDS[request.param](tmp_path_factory.mktemp(request.param))


@pytest.fixture(scope="session")
def saved(archive, tmp_path_factory) -> Path:
    """Files by save.py, written by the oldest Blender that is here: every one reads those."""
    folder = tmp_path_factory.mktemp("saved")
    for make in WORLDS.values():
        try:
            world = make(tmp_path_factory.mktemp("saving"))
        except pytest.skip.Exception:
            continue
        world.run("save.py", archive, folder)
        return folder
    pytest.skip(why_not("Blender"))
