# SPDX-License-Identifier: GPL-3.0-or-later
"""Functions as they are kept in a .blend: the bytes of a .pfg file behind a mark and a checksum of their own."""

from __future__ import annotations

import hashlib

_MARK = b"PFB1"
_DIGEST = 16  # bytes of SHA-256


class Damaged(ValueError):
    """The stored bytes are not what was stored."""


def seal(content: bytes) -> bytes:
    return _MARK + _digest(content) + content


def unseal(stored: bytes) -> bytes:
    """The content. Raises Damaged."""
    content = stored[len(_MARK) + _DIGEST :]
    if stored[: len(_MARK)] != _MARK or stored[len(_MARK) : len(_MARK) + _DIGEST] != _digest(content):
        raise Damaged("the functions stored in this file are damaged")
    return content


def _digest(content: bytes) -> bytes:
    return hashlib.sha256(content).digest()[:_DIGEST]
