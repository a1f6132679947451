"""Rules of the tree that a compiler does not hold."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from tree import NATIVE, ROOT, all_files, native_files, stage_of, text_of, where, without_comments

SOURCES = {".h", ".cpp", ".py", ".pyi", ".cmake", ".md", ".txt", ".toml", ".json", ""}


def matches(pattern: str, paths: list[Path], *, code_only: bool) -> list[str]:
    found = []
    for path in paths:
        text = text_of(path)
        if text is None:
            continue
        if code_only:
            text = without_comments(text)
        found += [f"{where(path, text, m.start())}: {m[0].strip()}" for m in re.finditer(pattern, text)]
    return found


def test_no_file_mentions_somebodys_folders() -> None:
    folders = "|".join(["home", "root", "tmp", "work", "opt", "Users", "mnt"])
    pattern = r"(?<![\w.~})\]/*-])/(?:" + folders + r")/[\w.]"
    files = [p for p in all_files() if p.suffix in SOURCES]
    assert not matches(pattern, files, code_only=False)


def test_nothing_is_left_for_later() -> None:
    words = "|".join(["TO" + "DO", "FIX" + "ME", "X" + "XX", "HA" + "CK"])
    files = [p for p in all_files() if p.suffix in SOURCES]
    assert not matches(rf"\b(?:{words})\b", files, code_only=False)


def test_the_library_never_prints_exits_or_aborts() -> None:
    pattern = r"std::c(?:out|err|log)\b|\b(?:printf|puts|fprintf|abort|terminate|_?exit|quick_exit|assert)\s*\("
    assert not matches(pattern, native_files(), code_only=True)


def test_nothing_depends_on_the_machine() -> None:
    """No libm beyond sqrt, no fused or unordered arithmetic, no clock, no std:: random numbers (docs/DESIGN.md)."""
    libm = r"(?:a?(?:sin|cos|tan)h?|atan2|exp2?|expm1|log(?:2|10|1p)?|pow|hypot|cbrt|fma|tgamma|lgamma|erfc?)"
    pattern = (
        rf"\bstd::{libm}\s*\("
        r"|\bstd::(?:reduce|transform_reduce|execution|chrono|random_device|mt19937(?:_64)?|shuffle)\b"
        r"|\bstd::\w+_distribution\b"
    )
    assert not matches(pattern, native_files(), code_only=True)


def test_threads_only_in_one_place() -> None:
    files = [p for p in native_files() if p.name not in {"parallel.h", "parallel.cpp"}]
    assert not matches(r"\bstd::(?:j?thread|async)\b", files, code_only=True)


def test_one_version_number() -> None:
    version = re.search(r"project\(pfgeom VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))
    assert version
    files = [p for p in all_files() if p.suffix in {".py", ".toml", ".cpp", ".h"}]
    assert not matches(rf"(?<![\d.]){re.escape(version[1])}(?![\d.])", files, code_only=False)
    assert f"## [{version[1]}]" in (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    "path", [p for p in native_files() if p.suffix == ".h"], ids=lambda p: f"{stage_of(p)}/{p.name}"
)
def test_a_header_opens_with_what_it_is(path: Path) -> None:
    assert path.read_text(encoding="utf-8").startswith("// "), "begin with a comment that says what this is for"


def test_links_in_documents_lead_somewhere() -> None:
    broken = []
    for path in (p for p in all_files() if p.suffix == ".md"):
        for target in re.findall(r"\]\(([^)#\s]+)[^)]*\)", path.read_text(encoding="utf-8")):
            if "://" not in target and not (path.parent / target).exists():
                broken.append(f"{path.relative_to(ROOT)}: {target}")
    assert not broken


def test_every_type_has_one_header() -> None:
    """Two types of one name are one to the linker, which keeps the functions of either (a silent wrong read)."""
    homes: dict[str, list[str]] = {}
    for path in (p for p in native_files() if p.suffix == ".h"):
        source = without_comments(path.read_text(encoding="utf-8"))
        for name in re.findall(r"^(?:class|struct|enum class) (\w+)\b[^;{]*\{", source, flags=re.MULTILINE):
            homes.setdefault(name, []).append(str(path.relative_to(NATIVE)))
    twice = {name: files for name, files in homes.items() if len(files) > 1}
    assert not twice, twice
