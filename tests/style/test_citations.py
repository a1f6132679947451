"""Every source that a comment names ("Source: ...") is in docs/references.bib, and nothing else is."""

from __future__ import annotations

import re
import unicodedata
from typing import NamedTuple

from tree import ROOT, native_files

YEAR = r"\b(?:19|20)\d\d\b"


class Reference(NamedTuple):
    key: str
    surnames: list[str]
    year: str


def plain(text: str) -> str:
    """Without accents, so that a comment may write a name either way."""
    return "".join(c for c in unicodedata.normalize("NFKD", text) if not unicodedata.combining(c))


def references() -> list[Reference]:
    text = (ROOT / "docs" / "references.bib").read_text(encoding="utf-8")
    found = []
    for entry in re.finditer(r"@\w+\{(\w+),(.*?)\n\}", text, flags=re.DOTALL):
        fields = dict(re.findall(r"^\s*(\w+)\s*=\s*\{(.*?)\},?$", entry[2], flags=re.MULTILINE))
        authors = [name.split(",")[0] for name in fields["author"].split(" and ")]
        found.append(Reference(entry[1], [plain(name.strip()) for name in authors], fields["year"]))
    return found


def comments() -> list[tuple[str, str]]:
    """(file, comment block) of the native sources, line breaks and slashes taken out."""
    blocks = []
    for path in native_files():
        for block in re.findall(r"(?:^[ \t]*//.*\n)+", path.read_text(encoding="utf-8"), flags=re.MULTILINE):
            words = " ".join(line.strip().lstrip("/<! ") for line in block.splitlines())
            blocks.append((str(path.relative_to(ROOT)), plain(words)))
    return blocks


def cites(block: str, reference: Reference) -> bool:
    return reference.year in block and any(name in block for name in reference.surnames)


def test_every_named_source_has_a_reference() -> None:
    known = references()
    missing = []
    for path, block in comments():
        for source in re.findall(r"Sources?: (.*)", block):
            years = set(re.findall(YEAR, source))
            covered = {r.year for r in known if cites(source, r)}
            missing += [f"{path}: {year} in '{source[:80]}'" for year in sorted(years - covered)]
    assert not missing


def test_every_reference_is_cited() -> None:
    blocks = [block for _, block in comments()]
    blocks += [plain(p.read_text(encoding="utf-8")) for p in (ROOT / "docs").glob("*.md")]
    unused = [r.key for r in references() if not any(cites(block, r) for block in blocks)]
    assert not unused
