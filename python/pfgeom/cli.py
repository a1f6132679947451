"""The command line: compress, decompress, info, compare, render, report, combine, transform, offset.

Exit codes: 0 done, 1 failed (one sentence on stderr), 2 wrong usage, 130 interrupted. Results go to stdout, as a
table or with ``--json`` as one object; the progress bar goes to stderr, if that is a terminal.
"""

from __future__ import annotations

import argparse
import errno
import math
import os
import sys
import time
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import tables
from .arguments import build_parser
from .deviation import Deviation, compare
from .encoder import compress
from .errors import PfgeomError
from .meshes import MOST_MATERIALS, Mesh, read_mesh, write_mesh
from .model import Model, load
from .pictures import Picture
from .progress import progress_bar
from .report_page import report


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command; returns the exit code."""
    args = build_parser().parse_args(argv)
    commands = {
        "compress": run_compress,
        "decompress": run_decompress,
        "info": run_info,
        "compare": run_compare,
        "render": run_render,
        "report": run_report,
        "combine": run_combine,
        "transform": run_transform,
        "offset": run_offset,
    }
    try:
        commands[args.command](args)
    except KeyboardInterrupt:
        print("pfgeom: interrupted", file=sys.stderr)
        return 130
    except BrokenPipeError:  # the reader of our stdout has gone: nobody to tell
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1
    except MemoryError:
        return _fail("not enough memory")
    except OSError as why:
        return _fail(f"{os.fsdecode(why.filename)}: {why.strerror}" if why.filename else str(why))
    except (PfgeomError, ValueError) as why:
        return _fail(str(why))
    return 0


def _fail(sentence: str) -> int:
    print(f"pfgeom: error: {sentence}", file=sys.stderr)
    return 1


# --- commands --------------------------------------------------------------------------------------------------


def _fit_options(args: argparse.Namespace) -> dict[str, Any]:
    return {
        "tolerance": args.tolerance,
        "relative": not args.absolute,
        "metric": args.metric,
        "effort": args.effort,
        "threads": args.threads,
    }


def run_compress(args: argparse.Namespace) -> None:
    _check_target(args.output)
    mesh = read_mesh(args.input)
    if mesh.material_names and (not args.materials or len(mesh.material_names) > MOST_MATERIALS):
        mesh = Mesh(*mesh, not_kept=("materials", *mesh.not_kept))
    if mesh.not_kept:
        print(f"pfgeom: note: not kept: {', '.join(mesh.not_kept)}", file=sys.stderr)
    start = time.perf_counter()
    with progress_bar(quiet=args.quiet) as progress:
        model = compress(mesh, **_fit_options(args), progress=progress)
    seconds = time.perf_counter() - start
    model.save(args.output)
    _print(args, compress_figures(args, model, mesh.not_kept, seconds), tables.compressed)


def run_decompress(args: argparse.Namespace) -> None:
    _check_target(args.output)
    start = time.perf_counter()
    model = load(args.input)
    with progress_bar(quiet=args.quiet) as progress:
        mesh = model.to_mesh(
            args.tolerance,
            args.resolution,
            relative=not args.absolute,
            threads=args.threads,
            progress=progress,
        )
    write_mesh(args.output, mesh)
    seconds = time.perf_counter() - start
    _print(args, decompress_figures(args, model, mesh, seconds), tables.decompressed)


def run_info(args: argparse.Namespace) -> None:
    _print(args, {"input": args.input, **load(args.input).info()}, tables.info)


def run_compare(args: argparse.Namespace) -> None:
    with progress_bar(quiet=args.quiet) as progress:
        deviation = compare(
            args.a,
            args.b,
            samples=args.samples,
            bound=args.bound,
            depth_buffers=args.depth_buffers,
            tolerance=args.tolerance,
            threads=args.threads,
            progress=progress,
        )
    _print(args, compare_figures(args, deviation), tables.compared)


def run_render(args: argparse.Namespace) -> None:
    _check_target(args.output)
    model = load(args.input)
    start = time.perf_counter()
    with progress_bar(quiet=args.quiet) as progress:
        picture = model.render(
            *args.size,
            direction=args.direction,
            up=args.up,
            field_of_view=args.field_of_view,
            samples=args.samples,
            threads=args.threads,
            progress=progress,
        )
    seconds = time.perf_counter() - start
    picture.save(args.output)
    _print(args, render_figures(args, model, picture, seconds), tables.rendered)


def run_report(args: argparse.Namespace) -> None:
    _check_target(args.output)
    start = time.perf_counter()
    with progress_bar(quiet=args.quiet) as progress:
        report(
            args.output, args.mesh, args.model, tolerance=args.tolerance, threads=args.threads, progress=progress
        )  # fmt: skip
    _print(args, report_figures(args, time.perf_counter() - start), tables.reported)


def run_combine(args: argparse.Namespace) -> None:
    _check_target(args.output)
    a, b = load(args.a), load(args.b)
    model = {"union": a.__or__, "intersection": a.__and__, "difference": a.__sub__}[args.operation](b)
    model.save(args.output)
    _print(args, {"input": args.output, **model.info()}, tables.info)


def run_transform(args: argparse.Namespace) -> None:
    _check_target(args.output)
    model = load(args.input).transformed(matrix_of(args))
    model.save(args.output)
    _print(args, {"input": args.output, **model.info()}, tables.info)


def run_offset(args: argparse.Namespace) -> None:
    _check_target(args.output)
    model = load(args.input)
    with progress_bar(quiet=args.quiet) as progress:
        result = model.offset(args.distance, **_fit_options(args), progress=progress)
    result.save(args.output)
    _print(args, {"input": args.output, **result.info()}, tables.info)


def matrix_of(args: argparse.Namespace) -> NDArray[np.float64]:
    """Mirrored, scaled, rotated and moved; or the matrix as it is given."""
    if args.matrix:
        return np.reshape(np.array(args.matrix), (3, 4))
    turn = np.eye(3)
    if args.rotate:
        *axis, degrees = args.rotate
        length = math.hypot(*axis)
        if not length > 0:
            raise ValueError("a rotation needs an axis")
        x, y, z = (value / length for value in axis)
        across = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        angle = math.radians(degrees)
        turn = turn + math.sin(angle) * across + (1 - math.cos(angle)) * (across @ across)  # Rodrigues
    sizes = [-args.scale if name == args.mirror else args.scale for name in "xyz"]
    return np.column_stack([turn * sizes, args.move])


# --- figures: what --json prints and the tables show -----------------------------------------------------------


def compress_figures(args: argparse.Namespace, model: Model, not_kept: Sequence[str], seconds: float) -> dict[str, Any]:
    report = model.report or {}
    return {
        "input": args.input,
        "output": args.output,
        "vertices": report["vertices"],
        "triangles": report["faces"],
        "raw_bytes": report["raw_bytes"],
        "file_bytes": model.nbytes,
        "ratio": report["raw_bytes"] / model.nbytes,
        **_promise_figures(model),
        "max": report["deviation"]["max"],
        "mesh_triangles": report["mesh_faces"],
        "islands": len(report["islands"]),
        "candidates": dict(Counter(island["candidate"] for island in report["islands"])),
        "repeated": sum(island["copies"] > 1 for island in report["islands"]),
        "materials": {"count": len(model.material_names), **report["materials"]},
        "not_kept": list(not_kept),
        "defects": report["defects"],
        "seconds": seconds,
    }


def decompress_figures(args: argparse.Namespace, model: Model, mesh: Mesh, seconds: float) -> dict[str, Any]:
    return {
        "input": args.input,
        "output": args.output,
        "file_bytes": model.nbytes,
        **_promise_figures(model),
        "vertices": len(mesh.vertices),
        "triangles": len(mesh.faces),
        "materials": list(mesh.material_names),
        "default_mesh": args.tolerance is None and args.resolution is None,
        "seconds": seconds,
    }


def compare_figures(args: argparse.Namespace, deviation: Deviation) -> dict[str, Any]:
    return {"a": args.a, "b": args.b, "samples": args.samples, **deviation.to_dict()}


def render_figures(args: argparse.Namespace, model: Model, picture: Picture, seconds: float) -> dict[str, Any]:
    return {
        "input": args.input,
        "output": args.output,
        "functions": model.functions._asdict(),
        "width": picture.depth.shape[1],
        "height": picture.depth.shape[0],
        "covered": float((picture.objects >= 0).mean()),
        "seconds": seconds,
    }


def report_figures(args: argparse.Namespace, seconds: float) -> dict[str, Any]:
    size = Path(args.output).stat().st_size
    return {"mesh": args.mesh, "model": args.model, "output": args.output, "page_bytes": size, "seconds": seconds}


def _promise_figures(model: Model) -> dict[str, Any]:
    return {
        "functions": model.functions._asdict(),
        "metric": model.metric,
        "tolerance": model.tolerance,
        "bound_mesh": model.bound_mesh,
        "certified": model.certified,
        "rms": model.rms,
        "bound_functions": model.bound_functions,
        "functions_certified": model.functions_certified,
        "diagonal": model.diagonal,
    }


def _print(args: argparse.Namespace, figures: dict[str, Any], table: tables.Table) -> None:
    if args.json:
        print(tables.as_json(figures))
    elif not args.quiet:
        print(tables.align(table(figures)))


# --- files -----------------------------------------------------------------------------------------------------


def _check_target(path: str) -> None:
    """Fail before the work rather than after it."""
    folder = Path(path).parent
    if Path(path).is_dir():
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), path)
    if not folder.is_dir():
        raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), str(folder))
    if not os.access(folder, os.W_OK):
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES), str(folder))
