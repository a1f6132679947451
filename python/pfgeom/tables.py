"""How the command line shows figures: aligned tables and JSON."""

from __future__ import annotations

import json
import math
from collections import Counter
from collections.abc import Callable
from typing import Any, TypeAlias

from .model import FunctionCount

#: Label, figure, remark.
Row: TypeAlias = tuple[str, str, str]
Table: TypeAlias = Callable[[dict[str, Any]], list[Row]]


_NAMED = 12  # materials whose names a table shows


def align(rows: list[Row]) -> str:
    """Labels to the left, figures to the right, remarks behind."""
    label = max(len(row[0]) for row in rows)
    figure = max(len(row[1]) for row in rows)
    return "\n".join(f"{a:<{label}}  {b:>{figure}}  {c}".rstrip() for a, b, c in rows)


def as_json(figures: dict[str, Any]) -> str:
    """One object on one line; what is not finite becomes null."""
    return json.dumps(_finite(figures), allow_nan=False)


def compressed(f: dict[str, Any]) -> list[Row]:
    candidates = ", ".join(f"{kind}: {count:,}" for kind, count in f["candidates"].items())
    return [
        ("triangles", f"{f['triangles']:,}", ""),
        ("raw bytes", f"{f['raw_bytes']:,}", "12 a vertex, 12 a triangle"),
        ("islands", f"{f['islands']:,}", candidates),
        *([("repeated", f"{f['repeated']:,}", "islands that are copies of one another")] if f["repeated"] else []),
        *_defects(f["defects"]),
        _functions(f),
        ("file bytes", f"{f['file_bytes']:,}", f["output"]),
        ("ratio", f"{f['ratio']:,.1f}", ": 1"),
        *([_paint(f["materials"])] if f["materials"]["count"] else []),
        *_promise(f),
        ("mesh triangles", f"{f['mesh_triangles']:,}", "by default"),
        ("seconds", f"{f['seconds']:.2f}", ""),
    ]


def decompressed(f: dict[str, Any]) -> list[Row]:
    about = "the default mesh, which the figures below are about" if f["default_mesh"] else ""
    return [
        ("file bytes", f"{f['file_bytes']:,}", f["input"]),
        _functions(f),
        ("triangles", f"{f['triangles']:,}", about),
        ("vertices", f"{f['vertices']:,}", f["output"]),
        *_materials(f),
        *_promise(f),
        ("seconds", f"{f['seconds']:.2f}", ""),
    ]


def info(f: dict[str, Any]) -> list[Row]:
    kinds = Counter(entry["kind"] for entry in f["objects"])
    low, high = f["bounds"]
    return [
        ("file bytes", f"{f['bytes']:,}", f["input"]),
        _functions(f),
        (
            "objects",
            f"{len(f['objects']):,}",
            ", ".join(f"{kind}: {count:,}" for kind, count in kinds.items()),
        ),
        *_combination(f),
        *_mirrored(f),
        *_copies(f),
        *_quadrics(f),
        *_kinds(f),
        *_materials(f),
        *_promise(f),
        ("diagonal", f"{f['diagonal']:.6g}", "of the input's bounding box"),
        ("bounds", "", f"{_point(low)} to {_point(high)}"),
        ("head bytes", f"{f['sizes']['head']:,}", "neither functions nor mesh parts"),
        *((f"level {depth}", f"{size:,.0f}", "bytes") for depth, size in enumerate(f["sizes"]["by_level"]) if size),
        ("not kept", "", f"no model holds {', '.join(f['not_kept'])}"),
    ]


def compared(f: dict[str, Any]) -> list[Row]:
    proof = "certified" if f["certified"] else "sampled"
    lengths = [
        (name, f"{f[name]:.4e}", f"{f[name] / f['diagonal']:.3e} of the diagonal")
        for name in ("max", "rms", "mean", "p99")
    ]
    label, figure, share = lengths[0]
    return [
        (label, figure, f"{share}, {proof}"),
        *lengths[1:],
        _angles(f, "normals", "normal_deg", ""),
        _angles(f, "smooth normals", "smooth_normal_deg", "; away from creases"),
        ("diagonal", f"{f['diagonal']:.6g}", "of A's bounding box"),
        *((side.upper(), what, f[side]) for side, what in zip("ab", f["surfaces"], strict=True)),
        *(_depths(f) if f["depth_buffers"] else []),
    ]


def rendered(f: dict[str, Any]) -> list[Row]:
    return [
        _functions(f),
        ("pixels", f"{f['width']:,} x {f['height']:,}", f["output"]),
        ("covered", f"{100 * f['covered']:.1f} %", "of the picture"),
        ("seconds", f"{f['seconds']:.2f}", "without writing the file"),
    ]


def reported(f: dict[str, Any]) -> list[Row]:
    return [("page bytes", f"{f['page_bytes']:,}", f["output"]), ("seconds", f"{f['seconds']:.2f}", "")]


def _angles(f: dict[str, Any], label: str, name: str, where: str) -> Row:
    rest = f"p99 {f[f'{name}_p99']:.3f}, max {f[f'{name}_max']:.3f}"
    return (label, f"{f[f'{name}_mean']:.3f}", f"degrees, mean; {rest}{where}")


def _depths(f: dict[str, Any]) -> list[Row]:
    depths, diagonal = f["depth_buffers"], f["diagonal"]
    total = depths["total"]
    silhouette = total["only_a"] + total["only_b"]
    limit = f"by more than {3 * depths['tolerance']:.4e}, three tolerances"

    def length(label: str, name: str, where: str) -> Row:
        return (label, f"{total[name]:.4e}", f"{total[name] / diagonal:.3e} of the diagonal, {where}")

    return [
        ("depth buffers", f"{len(depths['views'])} x {depths['side']:,}^2", "models drawn from their functions"),
        ("pixels", f"{total['both']:,}", "that both cover"),
        length("depth mean", "mean", "over these"),
        length("depth max", "max", "over these"),
        ("differing", f"{total['differing']:,}", f"{limit}; {total['differing_away']:,} away from discontinuities"),
        ("silhouette", f"{silhouette:,}", f"one alone covers; {total['silhouette_away']:,} away from discontinuities"),
        ("pixels away", f"{total['away']:,}", "more than 2 pixels from a depth discontinuity of both"),
        length("mean away", "away_mean", "over these"),
        length("max away", "away_max", "over these"),
    ]


def _functions(f: dict[str, Any]) -> Row:
    count = FunctionCount(**f["functions"])
    counts = ((count.patches, "curved patches"), (count.mesh_part_faces, "triangles of mesh parts"))
    parts = [f" and {n:,} {what}" for n, what in counts if n]
    return ("functions", str(count), "surface + separators + perturbations" + "".join(parts))


def _copies(f: dict[str, Any]) -> list[Row]:
    """How often the objects that repeat do."""
    repeated = [entry["instances"] for entry in f["objects"] if entry["instances"] > 1]
    times = ", ".join(f"{n:,}" for n in sorted(repeated, reverse=True)[:8])
    return [("repeated", f"{len(repeated):,}", f"objects, in {sum(repeated):,} copies: {times}")] if repeated else []


def _mirrored(f: dict[str, Any]) -> list[Row]:
    count = sum(entry.get("mirrored", False) for entry in f["objects"])
    return [("mirrored", f"{count:,}", "mesh parts, counted and stored as one half")] if count else []


def _quadrics(f: dict[str, Any]) -> list[Row]:
    """Of the set trees, by family: the most frequent first."""
    families: Counter[str] = Counter()
    for entry in f["objects"]:
        families.update(entry.get("families", {}))
    names = ", ".join(f"{name}: {count:,}" for name, count in families.most_common())
    return [("quadrics", f"{families.total():,}", names)] if families else []


def _kinds(f: dict[str, Any]) -> list[Row]:
    """What the functions are, the most frequent kind first; apart, what is no surface."""
    rows = []
    for label, surface in (("kinds", True), ("no surface", False)):
        of_kind = Counter(
            entry["kind"] + (" with perturbations" if entry["perturbations"] else "")
            for entry in f["function_list"]
            if entry["surface"] is surface
        )
        names = ", ".join(f"{kind}: {count:,}" for kind, count in of_kind.most_common())
        rows += [(label, f"{of_kind.total():,}", names)] if of_kind else []
    return rows


def _paint(m: dict[str, Any]) -> Row:
    about = f"in {m['bytes']:,} bytes; {100 * m['right']:.2f} % of the area has the right one"
    stray = f", {100 * m['stray']:.3f} % is farther than the tolerance from it" if m["stray"] else ""
    return ("materials", f"{m['count']:,}", about + stray)


def _materials(f: dict[str, Any]) -> list[Row]:
    names = [name or f"material_{row}" for row, name in enumerate(f["materials"])]
    more = len(names) - _NAMED
    listed = ", ".join(names[:_NAMED]) + (f" and {more:,} more" if more > 0 else "")
    return [("materials", f"{len(names):,}", listed)] if names else []


def _combination(f: dict[str, Any]) -> list[Row]:
    if not f["combination"]:
        return []
    operands = f["combination"]["operands"]
    parts = ", ".join(
        f"{i}: objects {low} to {high - 1}" for i, (low, high) in enumerate(o["objects"] for o in operands)
    )
    return [("operands", f"{len(operands):,}", parts), ("combination", "", f["combination"]["expression"])]


def _promise(f: dict[str, Any]) -> list[Row]:
    proof = "certified" if f["certified"] else "sampled"
    diagonal = f["diagonal"]
    rows = [
        ("tolerance", f["tolerance"], f["metric"]),
        ("max", f["bound_mesh"], proof),
        ("rms", f["rms"], "two-sided, the worse direction"),
    ]
    rows = [row for row in rows if row[1] > 0 or not f.get("combination")]  # of set operations they are not known
    if f["bound_functions"] > 0:
        proof = "certified" if f["functions_certified"] else "sampled"
        rows.append(("max of functions", f["bound_functions"], f"{proof}, whatever mesh is made of them"))
    return [(name, f"{value:.4e}", f"{value / diagonal:.3e} of the diagonal, {note}") for name, value, note in rows]


def _defects(defects: dict[str, int]) -> list[Row]:
    return [(name.replace("_", " "), f"{count:,}", "found") for name, count in defects.items() if count]


def _point(values: list[float]) -> str:
    return f"({', '.join(f'{value:.6g}' for value in values)})"


def _finite(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _finite(entry) for key, entry in value.items()}
    if isinstance(value, (list, tuple)):
        return [_finite(entry) for entry in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
