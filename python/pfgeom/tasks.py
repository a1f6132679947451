"""What every long call takes: a number of threads, a progress callback, and a token that stops it."""

from __future__ import annotations

from collections.abc import Callable
from operator import index
from typing import SupportsIndex, TypeAlias

from ._core import CancelToken as CancelToken  # the public name

#: Called with a fraction in [0, 1] that never falls, and the name of the stage.
Progress: TypeAlias = Callable[[float, str], object]


def check_task(threads: SupportsIndex, progress: Progress | None = None, cancel: CancelToken | None = None) -> None:
    """Raise ValueError or TypeError for what the core would not take."""
    if not 0 <= index(threads) < 2**31:
        raise ValueError(f"threads must be 0 (all) or more, not {threads}")
    if not (progress is None or callable(progress)):
        raise TypeError(f"progress must be callable, not {type(progress).__name__}")
    if not (cancel is None or isinstance(cancel, CancelToken)):
        raise TypeError(f"cancel must be a CancelToken, not {type(cancel).__name__}")
