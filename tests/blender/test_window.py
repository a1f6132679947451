"""The add-on in a real window: Debian's Blender on a virtual screen, with simulated mouse and keyboard."""

from __future__ import annotations

import json
import os
import shutil
from pathlib import Path

import pytest
from conftest import ROOT, World, debian_blender, why_not

#: Where the pictures go, to be looked at.
SHOTS = ROOT / "build" / "blender" / "shots"


@pytest.fixture
def window(tmp_path: Path) -> World:
    blender = debian_blender()
    if shutil.which("xvfb-run") is None:
        pytest.skip(why_not("xvfb-run"))
    screen = ("xvfb-run", "-a", "-s", "-screen 0 1280x800x24")
    arguments = ("--factory-startup", "--enable-event-simulate", "--window-geometry", "0", "0", "1280", "800")
    folders = {"BLENDER_USER_SCRIPTS": str(tmp_path / "scripts"), "BLENDER_USER_CONFIG": str(tmp_path / "config")}
    environment = {**folders, "LIBGL_ALWAYS_SOFTWARE": "1"}
    return World((*screen, blender, *arguments, "--python"), environment)


def test_what_an_artist_does(window: World, archive: Path) -> None:
    """Tab, button, bar, Esc, again, dialog, heat map, undo, export, import, save, reload, rebuild."""
    shutil.rmtree(SHOTS, ignore_errors=True)
    os.makedirs(SHOTS)
    window.run("window.py", archive, SHOTS)
    figures = json.loads((SHOTS / "figures.json").read_text())
    assert figures["cancel_seconds"] <= 0.2
    shots = sorted(SHOTS.glob("*.png"))
    assert len(shots) == 9
    assert all(shot.stat().st_size > 20_000 for shot in shots), "a picture with little in it"
