"""The report: one page that shows a mesh beside the functions it became, and how far they are from each other."""

from __future__ import annotations

import base64
import html
import os
from collections import Counter
from collections.abc import Iterable
from importlib.resources import files
from pathlib import Path
from string import Template
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _core
from .deviation import Deviation, compare
from .encoder import compress
from .meshes import Mesh, as_mesh, native_path, read_mesh
from .model import Model, load
from .pictures import png_bytes
from .report_figures import Histogram, Size, histogram, sizes
from .report_pictures import BETWEEN, HEIGHT, INSIDE, OUTSIDE, VIEWS, WIDTH, draw, heat_map
from .tasks import CancelToken, Progress, check_task

_DEPTH_BUFFERS = 512  # pixels across
_LEAST = 1e-9  # of the diagonal: the end of a scale for what does not deviate


def report(
    path: str | os.PathLike[str],
    mesh: Any,
    model: Model | str | os.PathLike[str] | None = None,
    *,
    tolerance: float = 1e-3,
    title: str | None = None,
    threads: int = 0,
    progress: Progress | None = None,
    cancel: CancelToken | None = None,
) -> None:
    """Write one self-contained HTML page about a mesh and the functions it became. It needs no network.

    It shows both from two sides with a slider between them, a heat map and a histogram of the deviation, the figures
    of `pfgeom.compare` with depth buffers, what the bytes and the functions are, and the sizes of other codings (of
    Draco where the optional package DracoPy is installed).

    Parameters
    ----------
    path
        Of the page. It is whole or absent, whatever happens.
    mesh
        Path of a mesh file, a pair (vertices, faces), or a mesh object as `pfgeom.compress` takes them.
    model
        The model, or the path of its ``.pfg`` file; without it the mesh is compressed.
    tolerance
        For that, and for depth buffers: a share of the diagonal of the mesh's bounding box.
    title
        Of the page; by default the name of the mesh's file.
    threads, progress, cancel
        As for `pfgeom.compress`.

    Raises
    ------
    ValueError, TypeError
        The mesh or an option is not valid, or the model has no surface.
    OSError, FormatError
        A file cannot be read or written.
    Cancelled
        The token was set.
    """
    check_task(threads, progress, cancel)
    tell = progress or (lambda fraction, stage: None)
    is_path = isinstance(mesh, (str, bytes, os.PathLike))
    name = title or (Path(os.fsdecode(mesh)).name if is_path else "mesh")
    original = read_mesh(os.fsdecode(mesh)) if is_path else as_mesh(mesh)
    if model is None:
        made: Model = compress(
            original, tolerance=tolerance, threads=threads, cancel=cancel,
            progress=lambda fraction, stage: tell(0.5 * fraction, stage),
        )  # fmt: skip
    else:
        made = model if isinstance(model, Model) else load(model)
    tell(0.5, "report")
    rebuilt = made.to_mesh(threads=threads, cancel=cancel)
    deviation = compare(
        original, made, depth_buffers=_DEPTH_BUFFERS, tolerance=tolerance if model is None else None,
        threads=threads, cancel=cancel, progress=lambda fraction, stage: tell(0.5 + 0.3 * fraction, stage),
    )  # fmt: skip
    parts = {
        "title": html.escape(name),
        "lead": _lead(original, made, deviation),
        "views": _views(original, made, rebuilt, deviation, threads, cancel),
        "histogram": _histograms(original, rebuilt, deviation, threads, cancel),
        "deviation": _deviation(deviation),
        "depths": _depths(deviation),
        "functions": _functions(made),
        "bytes": _bytes(made),
        "sizes": _sizes(sizes(original, made, deviation.max)),
    }
    tell(0.99, "report")
    template = Template(files(__package__).joinpath("report.html").read_text(encoding="utf-8"))
    _core.write_file(native_path(path), template.substitute(parts).encode())


# --- pictures --------------------------------------------------------------------------------------------------


def _views(
    original: Mesh, model: Model, rebuilt: Mesh, deviation: Deviation, threads: int, cancel: CancelToken | None
) -> str:
    scale = max(deviation.p99, _LEAST * deviation.diagonal)  # the largest alone would leave the rest pale
    shown = []
    for number, view in enumerate(VIEWS):
        before, after = (draw(shape, original, view, threads, cancel) for shape in (original, model))
        heat = heat_map(before, rebuilt, scale, threads, cancel)
        images = (before.picture.colours, after.picture.colours, heat)
        label = f"The mesh and its functions, {view.name}"
        shown.append(
            f"<figure><div class=compare data-compare>"
            f"{_image(images[0], f'The original mesh, {view.name}', 'before')}"
            f"{_image(images[1], f'The functions, {view.name}', 'after')}"
            f'<span class="tag left">mesh</span><span class="tag right">functions</span></div>'
            f'<input type=range min=0 max=100 value=50 step=0.5 aria-label="{label}: how much is the mesh" '
            f"id=slide{number}><figcaption>{label}</figcaption></figure>"
            f"<figure>{_image(images[2], f'Heat map of the deviation, {view.name}', 'heat')}"
            f"{_legend(scale, deviation.diagonal)}</figure>"
        )
    return "".join(shown)


def _image(colours: NDArray[np.uint8], text: str, kind: str) -> str:
    data = base64.b64encode(png_bytes(colours)).decode()
    return f'<img class={kind} width={WIDTH} height={HEIGHT} alt="{text}" src="data:image/png;base64,{data}">'


def _legend(scale: float, diagonal: float) -> str:
    stops = ", ".join(f"rgb{colour}" for colour in (INSIDE, BETWEEN, OUTSIDE))
    return (
        f"<figcaption><span class=scale style='background:linear-gradient(90deg, {stops})'></span>"
        f"<span class=ends><span>−{scale:.2e}</span><span>0</span><span>+{scale:.2e}</span></span>"
        f"Blue: the rebuilt surface lies inside the mesh; red: outside. In the mesh's units; the ends are the 99th "
        f"percentile, {scale / diagonal:.1e} of the diagonal.</figcaption>"
    )


def _histograms(original: Mesh, rebuilt: Mesh, deviation: Deviation, threads: int, cancel: CancelToken | None) -> str:
    reach = max(deviation.max, _LEAST * deviation.diagonal)
    ways = (("mesh to functions", original, rebuilt), ("functions to mesh", rebuilt, original))
    return "".join(
        f"<figure>{_bars(histogram(a, b, reach, threads, cancel), label)}<figcaption>{label}, by area"
        f"</figcaption></figure>"
        for label, a, b in ways
    )


def _bars(found: Histogram, label: str) -> str:
    """An SVG: one bar a bin, the highest as high as the picture."""
    width, height, most = 480, 150, max(float(found.shares.max()), 1e-12)
    step = width / len(found.shares)
    bars = "".join(
        f"<rect x={i * step:.2f} y={height * (1 - share / most):.2f} width={step - 1:.2f} "
        f"height={height * share / most:.2f}><title>{low:.2e} to {high:.2e}: {share:.2%}</title></rect>"
        for i, (share, low, high) in enumerate(zip(found.shares, found.edges, found.edges[1:], strict=False))
    )
    low, high = found.edges[0], found.edges[-1]
    labels = ((0, "start", f"−{-low:.2e}"), (width / 2, "middle", "0"), (width, "end", f"+{high:.2e}"))
    ends = "".join(f"<text x={x} y={height + 16} text-anchor={anchor}>{text}</text>" for x, anchor, text in labels)
    text = f"Histogram of the signed deviation, {label}; the highest bar is {most:.1%} of the area"
    return (
        f'<svg viewBox="0 0 {width} {height + 22}" role=img aria-label="{text}">{bars}'
        f"<line x1=0 x2={width} y1={height} y2={height} />{ends}</svg>"
    )


# --- tables ----------------------------------------------------------------------------------------------------


def _table(caption: str, heads: Iterable[str], rows: Iterable[Iterable[str]]) -> str:
    head = "".join(f"<th scope=col>{text}</th>" for text in heads)
    body = "".join(
        "<tr>" + "".join(f"<td>{text}</td>" if i else f"<th scope=row>{text}</th>" for i, text in enumerate(row))
        for row in rows
    )
    return f"<table><caption>{caption}</caption><thead><tr>{head}</thead><tbody>{body}</tbody></table>"


def _counted(number: int, what: str) -> str:
    return f"{number:,} {what}{'' if number == 1 else 's'}"


def _lead(mesh: Mesh, model: Model, deviation: Deviation) -> str:
    raw = 12 * (len(mesh.vertices) + len(mesh.faces))
    proof = "proved" if deviation.certified else "sampled"
    cards = (
        (f"{model.nbytes:,}", "bytes", f"of {raw:,}, {raw / model.nbytes:,.0f} : 1"),
        (str(model.functions), "functions", "surface + separators + perturbations" + _faces(model)),
        (f"{deviation.max / deviation.diagonal:.2e}", "largest deviation", f"of the diagonal, {proof}, both ways"),
        (f"{deviation.rms / deviation.diagonal:.2e}", "root mean square", "of the diagonal, the worse direction"),
    )
    return "".join(f"<li><b>{figure}</b><span>{what}</span><small>{note}</small>" for figure, what, note in cards)


def _faces(model: Model) -> str:
    count = model.functions
    parts = ((count.patches, "patches"), (count.mesh_part_faces, "triangles"))
    return "".join(f", and {n:,} {what}" for n, what in parts if n)


def _deviation(d: Deviation) -> str:
    def row(label: str, name: str) -> tuple[str, ...]:
        values = (getattr(d.a_to_b, name), getattr(d.b_to_a, name), getattr(d, name))
        return (label, *(f"{value:.3e}" for value in values), f"{values[2] / d.diagonal:.2e}")

    def angles(label: str, name: str) -> tuple[str, ...]:
        return (label, *(f"{getattr(side, name):.2f}°" for side in (d.a_to_b, d.b_to_a, d)), "")

    gap = f"{max(d.max_bound / d.max - 1, 0):.2%}" if d.max > 0 else "0 %"
    rows = [
        row("largest found", "max"),
        row("proved bound", "max_bound"),
        row("root mean square", "rms"),
        row("mean", "mean"),
        row("99th percentile", "p99"),
        angles("normals, mean", "normal_deg_mean"),
        angles("… away from creases", "smooth_normal_deg_mean"),
        angles("normals, 99th percentile", "normal_deg_p99"),
        angles("… away from creases", "smooth_normal_deg_p99"),
    ]
    caption = f"Between the mesh and the default mesh of the functions; the proof's gap is {gap}"
    return _table(caption, ("", "mesh to functions", "functions to mesh", "the worse", "of the diagonal"), rows)


def _depths(d: Deviation) -> str:
    if d.depth_buffers is None:
        return ""
    depths, total = d.depth_buffers, d.depth_buffers.total
    rows = [
        ("pixels that both cover", f"{total.both:,}", ""),
        ("mean difference", f"{total.mean:.3e}", f"{total.mean / d.diagonal:.2e}"),
        ("… away from discontinuities", f"{total.away_mean:.3e}", f"{total.away_mean / d.diagonal:.2e}"),
        ("largest away", f"{total.away_max:.3e}", f"{total.away_max / d.diagonal:.2e}"),
        ("covered by one alone", f"{total.only_a + total.only_b:,}", ""),
        ("… away from discontinuities", f"{total.silhouette_away:,}", ""),
        ("off by three tolerances", f"{total.differing:,}", ""),
        ("… away from discontinuities", f"{total.differing_away:,}", ""),
    ]
    caption = (
        f"Depth buffers from {len(depths.views)} sides, {depths.side}² pixels, drawn from the functions themselves"
    )
    return _table(caption, ("", "", "of the diagonal"), rows)


def _functions(model: Model) -> str:
    listed = model.function_list
    kinds = Counter((entry["kind"], entry["surface"], entry["perturbations"] > 0) for entry in listed)
    rows = [
        (kind + (" with perturbations" if bumpy else ""), "surface" if surface else "separator or trim", f"{n:,}")
        for (kind, surface, bumpy), n in sorted(kinds.items(), key=lambda item: (-item[1], item[0]))
    ]
    count = model.functions
    rows += [("perturbations", "form factors that are not zero", f"{count.perturbations:,}")] * (
        count.perturbations > 0
    )
    rows += [("curved faces", "mesh parts", f"{count.patches:,}")] * (count.patches > 0)
    rows += [("triangles", "mesh parts", f"{count.mesh_part_faces:,}")] * (count.mesh_part_faces > 0)
    return _table(
        f"{model.functions} functions in {_counted(len(model.objects), 'object')}", ("kind", "serves as", "count"), rows
    )


_MOST_OBJECTS = 12  # that a table names one by one


def _bytes(model: Model) -> str:
    found = model.info()["sizes"]
    objects = [
        (f"object {i}, {entry['kind']}", size)
        for i, (entry, size) in enumerate(zip(model.objects, found["by_object"], strict=False))
    ]
    objects.sort(key=lambda item: -item[1])
    rest = objects[_MOST_OBJECTS:]
    named = objects[:_MOST_OBJECTS] + [(f"{_counted(len(rest), 'other object')}", sum(n for _, n in rest))] * bool(rest)
    levels = [(f"level {i} of the hierarchies", n) for i, n in enumerate(found["by_level"]) if n]
    rows = [("head", float(found["head"])), *named, *levels]
    body = (
        (name, f"{size:,.0f}", f"<meter min=0 max={model.nbytes} value={size:.1f}>{size:.0f}</meter>")
        for name, size in rows
    )
    return _table(f"{model.nbytes:,} bytes; levels are part of their objects", ("section", "bytes", "share"), body)


def _sizes(found: list[Size]) -> str:
    ours = found[-1].bytes
    rows = (
        (
            size.name,
            f"{size.bytes:,}",
            f"{size.bytes / ours:,.1f} ×",
            "exact" if size.deviation is None else f"{size.deviation:.2e}",
        )
        for size in found
    )
    return _table("What the mesh takes in bytes", ("coding", "bytes", "of pfgeom's", "largest deviation"), rows)
