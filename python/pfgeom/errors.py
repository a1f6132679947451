"""What pfgeom raises beside ``ValueError``, ``TypeError`` and ``OSError``."""

from __future__ import annotations


class PfgeomError(Exception):
    """Base of pfgeom's own exceptions."""


class FormatError(PfgeomError, ValueError):
    """Bytes that are not a whole, undamaged ``.pfg`` file.

    Attributes
    ----------
    status : str
        The reason as a word, one of those that ``docs/FORMAT.md`` lists: ``not_a_pfg``, ``truncated``,
        ``checksum_mismatch``, ``limit_exceeded`` ...
    """

    def __init__(self, status: str, sentence: str) -> None:
        super().__init__(status, sentence)
        self.status = status

    def __str__(self) -> str:
        return str(self.args[1])


class Cancelled(PfgeomError):
    """The call's `CancelToken` was set."""


class LimitError(PfgeomError):
    """What was asked for exceeds a cap, such as the number of triangles of one mesh."""
