"""The grammar of the command line."""

from __future__ import annotations

import argparse
import math
from pathlib import Path
from typing import Any

from ._core import __version__

MESH_SUFFIXES = (".ply", ".obj", ".stl", ".off")


def build_parser() -> argparse.ArgumentParser:
    """The parsed arguments hold the name of the command as ``command``."""
    parser = argparse.ArgumentParser(
        prog="pfgeom", description="Polygon meshes as the smallest set of functions within a tolerance."
    )
    parser.add_argument("--version", action="version", version=f"pfgeom {__version__}")
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    _add_compress(commands)
    _add_decompress(commands)
    _add_info(commands)
    _add_compare(commands)
    _add_render(commands)
    _add_report(commands)
    _add_combine(commands)
    _add_transform(commands)
    _add_offset(commands)
    return parser


def _add_compress(commands: Any) -> None:
    command = commands.add_parser("compress", help="a mesh into a .pfg file")
    command.add_argument("input", metavar="IN", help="OBJ, PLY, STL or OFF file")
    command.add_argument("output", metavar="OUT.pfg", type=_path_ending(".pfg"))
    _add_tolerance(command, "allowed deviation, as a share of the bounding box's diagonal")
    _add_fit(command)
    command.add_argument("--no-materials", dest="materials", action="store_false", help="leave materials out")
    _add_common(command)


def _add_decompress(commands: Any) -> None:
    command = commands.add_parser("decompress", help="a .pfg file into a mesh")
    command.add_argument("input", metavar="IN.pfg")
    command.add_argument("output", metavar="OUT.{ply,obj,stl,off}", type=_path_ending(*MESH_SUFFIXES))
    detail = command.add_mutually_exclusive_group()
    detail.add_argument(
        "--tolerance", type=_positive, metavar="T",
        help="extra error of the mesh against the functions, as a share of the diagonal",
    )  # fmt: skip
    detail.add_argument("--resolution", type=_count, metavar="N", help="cells along the longest side, 8 to 4096")
    _add_absolute(command)
    _add_common(command)


def _add_info(commands: Any) -> None:
    command = commands.add_parser("info", help="what a .pfg file holds and promises")
    command.set_defaults(quiet=False)
    command.add_argument("input", metavar="IN.pfg")
    _add_json(command)


def _add_compare(commands: Any) -> None:
    command = commands.add_parser("compare", help="how far two surfaces are from each other")
    command.add_argument("a", metavar="A", help="mesh or .pfg file")
    command.add_argument("b", metavar="B", help="mesh or .pfg file")
    command.add_argument("--samples", type=_count, default=200_000, metavar="N", help="a side (default 200000)")
    command.add_argument("--no-bound", dest="bound", action="store_false", help="leave out the proof of the maximum")
    command.add_argument(
        "--depth-buffers", type=_count, nargs="?", const=1024, metavar="R",
        help="also draw both from 14 sides, R x R pixels (default 1024), and compare the depths; a .pfg is drawn from "
        "its functions, while the other figures are about its default mesh",
    )  # fmt: skip
    command.add_argument(
        "--tolerance", type=_positive, metavar="T",
        help="three of which count as a difference of depths, as a share of A's diagonal (default: that of the .pfg, "
        "or 1e-3)",
    )  # fmt: skip
    _add_common(command)


def _add_render(commands: Any) -> None:
    command = commands.add_parser("render", help="a picture of a .pfg file, straight from its functions")
    command.add_argument("input", metavar="IN.pfg")
    command.add_argument("output", metavar="OUT.png", type=_path_ending(".png"))
    command.add_argument(
        "--size", type=_size, default=(1024, 1024), metavar="N|WxH", help="in pixels, up to 8192 (default 1024)"
    )
    command.add_argument(
        "--direction", type=float, nargs=3, default=(-1.0, -1.0, -1.0), metavar=("X", "Y", "Z"),
        help="where the camera looks (default -1 -1 -1); it stands where all is seen",
    )  # fmt: skip
    command.add_argument(
        "--up", type=float, nargs=3, default=(0.0, 0.0, 1.0), metavar=("X", "Y", "Z"),
        help="what is up in the picture (default 0 0 1)",
    )  # fmt: skip
    command.add_argument(
        "--field-of-view", type=float, default=28.0, metavar="DEG",
        help="across the shorter side, up to 150 degrees (default 28); 0 is orthographic",
    )  # fmt: skip
    command.add_argument(
        "--samples", type=_count, default=2, metavar="N", help="N x N rays a pixel, up to 16 (default 2)"
    )
    _add_common(command)


def _add_report(commands: Any) -> None:
    command = commands.add_parser("report", help="a page that shows a mesh beside the functions it became")
    command.add_argument("mesh", metavar="MESH", help="OBJ, PLY, STL or OFF file")
    command.add_argument("model", metavar="MESH.pfg", nargs="?", help="without it the mesh is compressed")
    command.add_argument("output", metavar="OUT.html", type=_path_ending(".html", ".htm"))
    command.add_argument(
        "--tolerance", type=_positive, default=1e-3, metavar="T",
        help="for a mesh without its .pfg: allowed deviation, as a share of the diagonal (default 1e-3)",
    )  # fmt: skip
    _add_common(command)


def _add_combine(commands: Any) -> None:
    command = commands.add_parser("combine", help="union, intersection or difference of two .pfg files, as functions")
    command.add_argument("a", metavar="A.pfg")
    command.add_argument("operation", choices=("union", "intersection", "difference"))
    command.add_argument("b", metavar="B.pfg")
    _add_output(command)
    _add_json(command)
    command.add_argument("--quiet", action="store_true", help="no table")


def _add_transform(commands: Any) -> None:
    command = commands.add_parser(
        "transform", help="a .pfg file moved, still as functions: mirrored, scaled, rotated and moved, in this order"
    )
    command.add_argument("input", metavar="IN.pfg")
    _add_output(command)
    command.add_argument("--mirror", choices=("x", "y", "z"), help="this coordinate becomes its negative")
    command.add_argument("--scale", type=_positive, default=1.0, metavar="S")
    command.add_argument(
        "--rotate", type=float, nargs=4, metavar=("X", "Y", "Z", "DEG"), help="about an axis through the origin"
    )
    command.add_argument("--move", type=float, nargs=3, default=(0.0, 0.0, 0.0), metavar=("X", "Y", "Z"))
    command.add_argument(
        "--matrix", type=float, nargs=12, metavar="M", help="instead of these: three rows of four numbers"
    )
    _add_json(command)
    command.add_argument("--quiet", action="store_true", help="no table")


def _add_offset(commands: Any) -> None:
    command = commands.add_parser("offset", help="a .pfg file grown or shrunk by a distance, as functions fitted anew")
    command.add_argument("input", metavar="IN.pfg")
    command.add_argument("output", metavar="OUT.pfg", type=_path_ending(".pfg"))
    command.add_argument(
        "--distance", type=float, required=True, metavar="D", help="in the model's units; negative: shrunk"
    )
    _add_tolerance(command, "allowed deviation from the exact offset, as a share of the model's diagonal")
    _add_fit(command)
    _add_common(command)


def _add_output(command: argparse.ArgumentParser) -> None:
    command.add_argument("-o", "--output", metavar="OUT.pfg", type=_path_ending(".pfg"), required=True)


def _add_tolerance(command: argparse.ArgumentParser, what: str) -> None:
    command.add_argument("--tolerance", type=_positive, default=1e-3, metavar="T", help=f"{what} (default 1e-3)")
    _add_absolute(command)


def _add_fit(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "--metric", choices=("max", "rms"), default="max", help="what the tolerance limits (default max)"
    )
    command.add_argument(
        "--effort", choices=("fast", "normal", "best"), default="normal",
        help="how long to look for fewer bytes within the same tolerance (default normal); changes set trees only",
    )  # fmt: skip


def _add_absolute(command: argparse.ArgumentParser) -> None:
    command.add_argument("--absolute", action="store_true", help="the tolerance is a length in the mesh's units")


def _add_common(command: argparse.ArgumentParser) -> None:
    command.add_argument("--threads", type=_threads, default=0, metavar="N", help="default: all")
    _add_json(command)
    command.add_argument("--quiet", action="store_true", help="no table and no progress bar")


def _add_json(command: argparse.ArgumentParser) -> None:
    command.add_argument("--json", action="store_true", help="print one JSON object")


def _positive(text: str) -> float:
    value = float(text)
    if not (math.isfinite(value) and value > 0):
        raise argparse.ArgumentTypeError(f"must be positive: {text}")
    return value


def _count(text: str) -> int:
    value = int(text)
    if value < 1:
        raise argparse.ArgumentTypeError(f"must be 1 or more: {text}")
    return value


def _size(text: str) -> tuple[int, int]:
    sides = [_count(side) for side in text.lower().split("x")]
    if len(sides) > 2:
        raise argparse.ArgumentTypeError(f"must be N or WxH: {text}")
    return sides[0], sides[-1]


def _threads(text: str) -> int:
    value = int(text)
    if value < 0:
        raise argparse.ArgumentTypeError(f"must be 0 (all) or more: {text}")
    return value


class _path_ending:  # noqa: N801 - used like a function, and argparse shows its name
    """A path with one of the given extensions, in any case."""

    def __init__(self, *suffixes: str) -> None:
        self._suffixes = suffixes

    def __call__(self, text: str) -> str:
        if Path(text).suffix.lower() not in self._suffixes:
            raise argparse.ArgumentTypeError(f"{text!r} must end in {' or '.join(self._suffixes)}")
        return text
