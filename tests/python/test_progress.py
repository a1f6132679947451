"""The progress bar, alone and on a terminal."""

from __future__ import annotations

import contextlib
import io
import os
import subprocess
import sys

import pfgeom
import pytest
import shapes
from pfgeom.progress import ProgressBar, clock, render


@pytest.mark.parametrize(("seconds", "text"), [(0, "0:00"), (59.6, "1:00"), (61, "1:01"), (3723, "1:02:03")])
def test_clock(seconds, text):
    assert clock(seconds) == text


def test_line():
    assert render(0.25, "fit", 10) == "[#######---------------------]  25%     0:30 left  fit"
    assert "left" not in render(0.0, "fit", 1)
    assert "100%" in render(1.0, "done", 1)


def test_bar_wipes_its_line():
    stream = io.StringIO()
    with ProgressBar(stream) as bar:
        bar(0.5, "fit")
    assert stream.getvalue().endswith("\r\x1b[K")
    assert "\n" not in stream.getvalue()


def test_bar_on_a_terminal_only(tmp_path):
    pty = pytest.importorskip("pty")
    mesh = tmp_path / "torus.ply"
    pfgeom.write_mesh(mesh, shapes.torus(32, 16))
    ours, theirs = pty.openpty()
    command = [sys.executable, "-m", "pfgeom", "compress", str(mesh), str(tmp_path / "torus.pfg")]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=theirs, text=True) as process:
        os.close(theirs)
        shown = everything(ours)
        table = process.stdout.read()
    assert process.returncode == 0
    assert "%" in shown
    assert "[#" in shown
    assert "\n" not in shown
    assert "%" not in table


def everything(terminal: int) -> str:
    """What comes until the other end is closed, which Linux reports as an input error."""
    pieces = []
    with contextlib.suppress(OSError):
        while piece := os.read(terminal, 4096):
            pieces.append(piece)
    os.close(terminal)
    return b"".join(pieces).decode()
