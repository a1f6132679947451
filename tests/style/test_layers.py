"""Arrows go one way: a stage includes only what CMakeLists.txt lets it use, and that stands above it."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from tree import NATIVE, ROOT, includes, native_files, stage_of


def declared_stages() -> dict[str, list[str]]:
    lines = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    return {m[1]: m[2].split() for m in re.finditer(r"^pfgeom_stage\((\w+)([\w ]*)\)", lines, flags=re.MULTILINE)}


STAGES = declared_stages()


def test_every_folder_is_a_declared_stage() -> None:
    folders = {p.name for p in NATIVE.iterdir() if any(p.rglob("*.h"))}
    assert folders <= set(STAGES), f"not in CMakeLists.txt: {sorted(folders - set(STAGES))}"


def test_stages_stand_below_what_they_use() -> None:
    order = list(STAGES)
    for stage, uses in STAGES.items():
        below = [other for other in uses if order.index(other) >= order.index(stage)]
        assert not below, f"{stage} uses {below}, which do not stand above it"


def test_the_decoder_never_reaches_the_fitter() -> None:
    def reach(stage: str) -> set[str]:
        return {stage}.union(*(reach(other) for other in STAGES[stage]))

    for stage in ("function", "eval", "codec", "polygonize"):
        assert "fit" not in reach(stage), f"{stage} reaches fit"
        assert "compress" not in reach(stage), f"{stage} reaches compress"


@pytest.mark.parametrize("path", native_files(), ids=lambda p: str(p.relative_to(NATIVE)))
def test_includes_go_up(path: Path) -> None:
    stage = stage_of(path)
    allowed = {stage, *STAGES[stage]}
    for name in includes(path):
        if name.startswith("pfgeom/"):
            other = name.split("/")[1]
            assert other in allowed, f"{stage} may not include {other}: {name}"
            assert (ROOT / "native" / name).is_file(), f"no such header: {name}"
        else:
            assert "/" not in name or name.split("/")[0] in {"Eigen", "OpenMesh", "sys"}, (
                f"include from native/: {name}"
            )


@pytest.mark.parametrize(
    "path", [p for p in native_files() if p.suffix == ".h"], ids=lambda p: str(p.relative_to(NATIVE))
)
def test_headers_are_installable(path: Path) -> None:
    """Headers need nothing but the standard library and each other, and are guarded."""
    assert not [name for name in includes(path) if name.startswith(("Eigen", "OpenMesh"))]
    assert "#pragma once" in path.read_text(encoding="utf-8")
