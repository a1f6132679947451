# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers as people read them."""

from __future__ import annotations

from collections.abc import Sequence


def size(count: float) -> str:
    """Bytes, in units of 1000."""
    for unit in ("bytes", "kB", "MB"):
        if count < 1000:
            return f"{count:.0f} {unit}" if unit == "bytes" else f"{count:.3g} {unit}"
        count /= 1000
    return f"{count:.3g} GB"


def ratio(raw: float, stored: float) -> str:
    if stored <= 0:
        return "-"
    return f"{raw / stored:,.0f} : 1" if raw >= 10 * stored else f"{raw / stored:.1f} : 1"


def clock(seconds: float) -> str:
    """``m:ss``, or ``h:mm:ss``."""
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{rest:02}" if hours else f"{minutes}:{rest:02}"


def progress(fraction: float, seconds_left: float | None) -> str:
    rest = f", {clock(seconds_left)} left" if seconds_left is not None else ""
    return f"{fraction:.0%}{rest}"


def listing(words: Sequence[str], most: int = 6) -> str:
    """`a, b and c`; long ones are cut."""
    shown = list(words[:most])
    if len(words) > most:
        shown.append(f"{len(words) - most} more")
    return shown[0] if len(shown) == 1 else f"{', '.join(shown[:-1])} and {shown[-1]}" if shown else ""
