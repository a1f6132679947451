"""A one-line progress bar with the remaining time, for terminals."""

from __future__ import annotations

import shutil
import sys
import time
from contextlib import AbstractContextManager, nullcontext
from typing import TextIO

from .tasks import Progress

_BAR = 28  # characters
_UNSETTLED = 0.02  # below this share done, an estimate of the rest would jump about


def progress_bar(*, quiet: bool = False) -> AbstractContextManager[Progress | None]:
    """A bar on stderr if that is a terminal, else a context that gives None."""
    return nullcontext() if quiet or not sys.stderr.isatty() else ProgressBar(sys.stderr)


class ProgressBar:
    """Callable as ``bar(fraction, stage)``; as a context it wipes its line at the end."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream
        self._start = time.monotonic()

    def __call__(self, fraction: float, stage: str) -> None:
        line = render(fraction, stage, time.monotonic() - self._start)
        columns = shutil.get_terminal_size().columns
        self._write(line[: columns - 1])

    def __enter__(self) -> ProgressBar:
        return self

    def __exit__(self, *_: object) -> None:
        self._write("")

    def _write(self, line: str) -> None:
        self._stream.write(f"\r{line}\x1b[K")
        self._stream.flush()


def render(fraction: float, stage: str, elapsed: float) -> str:
    """One line: bar, percentage, remaining time, stage."""
    done = round(_BAR * fraction)
    rest = f"{clock(elapsed * (1 - fraction) / fraction)} left" if fraction > _UNSETTLED else ""
    return f"[{'#' * done}{'-' * (_BAR - done)}] {fraction:4.0%}  {rest:>12}  {stage}"


def clock(seconds: float) -> str:
    """``m:ss``, or ``h:mm:ss``."""
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{rest:02}" if hours else f"{minutes}:{rest:02}"
