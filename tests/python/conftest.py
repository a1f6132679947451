"""What several tests share."""

from __future__ import annotations

import signal
import subprocess
import sys
from pathlib import Path

import hypothesis
import numpy as np
import pfgeom
import pytest
import shapes

ROOT = Path(__file__).resolve().parents[2]
DATA = ROOT.parent / "shared" / "data"

hypothesis.settings.register_profile("pfgeom", deadline=None, derandomize=True, max_examples=50)
hypothesis.settings.load_profile("pfgeom")

# A job in a shell's background inherits SIGINT as ignored, and would hand that on to the tests of interrupts.
signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.fixture(scope="session")
def root() -> Path:
    """The source tree."""
    return ROOT


@pytest.fixture(scope="session")
def data_mesh():
    """Path of a real mesh by its file name; the test is skipped where the meshes are not."""

    def find(name: str) -> Path:
        path = DATA / name
        if not path.is_file():
            pytest.skip(f"no real meshes here: {path} is absent")
        return path

    return find


@pytest.fixture(scope="session")
def sphere_model() -> pfgeom.Model:
    """Is one quadric."""
    return pfgeom.compress(*shapes.sphere(), tolerance=5e-3)


@pytest.fixture(scope="session")
def torus_model() -> pfgeom.Model:
    """Has a hierarchy of perturbations."""
    return pfgeom.compress(*shapes.bumpy_torus(), tolerance=2e-3, metric="rms")


@pytest.fixture(scope="session")
def gear_model() -> pfgeom.Model:
    """Is a set tree, with a proof of the functions themselves."""
    return pfgeom.compress(*shapes.gear(), tolerance=1e-2)


@pytest.fixture(scope="session")
def soup_model() -> pfgeom.Model:
    """Is a mesh part."""
    return pfgeom.compress(*shapes.soup(), tolerance=1e-3)


@pytest.fixture(scope="session")
def long_mesh() -> tuple[np.ndarray, np.ndarray]:
    """A bumpy torus that takes long enough to be interrupted at a fine tolerance."""
    vertices, faces = shapes.torus(240, 120)
    bumps = 1 + 0.03 * np.sin(vertices @ [[17.0], [13.0], [19.0]])
    return vertices * bumps, faces


@pytest.fixture
def command_line(tmp_path):
    """Runs `python -m pfgeom ARGUMENTS` in a folder of its own; stdout and stderr are pipes."""

    def run(*arguments, **options) -> subprocess.CompletedProcess[str]:
        command = [sys.executable, "-m", "pfgeom", *map(str, arguments)]
        return subprocess.run(command, capture_output=True, text=True, cwd=tmp_path, timeout=120, **options)

    return run
