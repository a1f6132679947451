# SPDX-License-Identifier: GPL-3.0-or-later
"""Pieces of native work, done one after the other, here or in a thread; watched and stopped from elsewhere."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from .native import pfgeom

#: Below this share done, an estimate of the rest would jump about.
_UNSETTLED = 0.02

#: What a piece does: work(progress, cancel) -> result.
Work = Callable[[Callable[[float, str], None], Any], Any]


@dataclass(frozen=True)
class Piece:
    name: str  # of the object, for people
    weight: float  # its share of the time, in any unit
    work: Work


@dataclass(frozen=True)
class Status:
    fraction: float
    name: str
    stage: str
    seconds_left: float | None


class Job:
    """`results[i]` is what piece i gave, or the sentence that says why it gave nothing."""

    def __init__(self, pieces: Sequence[Piece]) -> None:
        self.results: list[Any] = [None] * len(pieces)
        self.failures: dict[int, str] = {}
        self.cancelled = False
        self._pieces = list(pieces)
        self._token = pfgeom().CancelToken()
        self._thread: threading.Thread | None = None
        self._start = time.monotonic()
        self._now = (0.0, "", "")  # one assignment, so that the watching thread always sees a whole

    # --- by whoever wants the work done ------------------------------------------------------------------

    def run(self) -> Job:
        """In this thread; returns when all is done or cancelled."""
        total = sum(piece.weight for piece in self._pieces) or 1.0
        before = 0.0
        for i, piece in enumerate(self._pieces):
            if not self._run_piece(i, piece, before / total, piece.weight / total):
                return self
            before += piece.weight
        return self

    def start(self) -> None:
        """In a thread of its own."""
        self._thread = threading.Thread(target=self.run, name="pfgeom", daemon=True)
        self._thread.start()

    def _run_piece(self, i: int, piece: Piece, begin: float, share: float) -> bool:
        def progress(fraction: float, stage: str) -> None:
            self._now = (begin + share * fraction, piece.name, stage)

        progress(0.0, "reading")
        package = pfgeom()
        try:
            if self._token.cancelled:
                raise package.Cancelled()
            self.results[i] = piece.work(progress, self._token)
        except package.Cancelled:
            self.cancelled = True
            return False
        except (package.PfgeomError, ValueError, MemoryError) as why:
            self.failures[i] = str(why) or type(why).__name__
        except Exception as why:  # a thread must not end unseen
            self.failures[i] = f"{type(why).__name__}: {why}"
        return True

    # --- by whoever watches ------------------------------------------------------------------------------

    @property
    def done(self) -> bool:
        return self._thread is not None and not self._thread.is_alive()

    def cancel(self) -> None:
        self._token.cancel()

    def wait(self, seconds: float) -> None:
        if self._thread is not None:
            self._thread.join(seconds)

    def status(self) -> Status:
        fraction, name, stage = self._now
        elapsed = time.monotonic() - self._start
        left = elapsed * (1 - fraction) / fraction if fraction > _UNSETTLED else None
        return Status(fraction, name, stage, left)
