"""A page in headless Chromium: what it says of itself after a script has run in it, and what it looks like."""

from __future__ import annotations

import json
import re
import shutil
import struct
import subprocess
import zlib
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
_SWITCHES = ("--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--enable-logging=stderr")


class Seen(NamedTuple):
    answer: Any  # what the script returned
    console: list[str]  # errors, and whatever else was logged
    pixels: np.ndarray  # (height, width, 3)


def look(page: Path, script: str, folder: Path, size: tuple[int, int] = (1000, 700), dark: bool = False) -> Seen:
    """The page with the body of a function run at its end."""
    asked = folder / "asked.html"
    run = f"document.documentElement.dataset.answer = JSON.stringify((() => {{ {script} }})());"
    asked.write_text(page.read_text(encoding="utf-8") + f"<script>{run}</script>", encoding="utf-8")
    shot = folder / "shot.png"
    common = (
        str(CHROMIUM), *_SWITCHES, f"--user-data-dir={folder / 'profile'}", f"--window-size={size[0]},{size[1]}",
        *(("--blink-settings=preferredColorScheme=0",) if dark else ()),
    )  # fmt: skip
    dom = _run([*common, "--dump-dom", asked.as_uri()])
    drawn = _run([*common, f"--screenshot={shot}", asked.as_uri()])
    answer = re.search(r'<html[^>]*data-answer="([^"]*)"', dom.stdout)
    assert answer, dom.stderr
    console = [line for line in (dom.stderr + drawn.stderr).splitlines() if ":CONSOLE" in line]
    return Seen(json.loads(answer[1].replace("&quot;", '"').replace("&amp;", "&")), console, read_png(shot))


def _run(command: list[str]) -> subprocess.CompletedProcess[str]:
    return subprocess.run(command, capture_output=True, text=True, timeout=120, check=True)


def read_png(path: Path) -> np.ndarray:
    """Of eight bits a channel, red, green and blue first."""
    data, at, packed = path.read_bytes(), 8, b""
    while at < len(data):
        length, name = struct.unpack(">I4s", data[at : at + 8])
        body = data[at + 8 : at + 8 + length]
        if name == b"IHDR":
            width, height, depth, kind = struct.unpack(">IIBB", body[:10])
            assert (depth, kind) in ((8, 2), (8, 6))
            channels = 3 if kind == 2 else 4
        packed += body if name == b"IDAT" else b""
        at += 12 + length
    rows = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(height, 1 + width * channels)
    out = np.zeros((height + 1, width + 1, channels), np.int64)  # a row above, a column to the left
    for y, row in enumerate(rows, 1):
        values = row[1:].reshape(width, channels).astype(np.int64)
        above = out[y - 1]
        if row[0] == 0:
            out[y, 1:] = values
        elif row[0] == 1:
            out[y, 1:] = np.cumsum(values, axis=0) % 256
        elif row[0] == 2:
            out[y, 1:] = (values + above[1:]) % 256
        else:
            for x in range(1, width + 1):
                a, b, c = out[y, x - 1], above[x], above[x - 1]
                if row[0] == 3:
                    guess = (a + b) // 2
                else:
                    pa, pb, pc = np.abs(b - c), np.abs(a - c), np.abs(a + b - 2 * c)
                    guess = np.where((pa <= pb) & (pa <= pc), a, np.where(pb <= pc, b, c))
                out[y, x] = (values[x - 1] + guess) % 256
    return out[1:, 1:, :3].astype(np.uint8)
