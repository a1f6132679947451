"""The main door: a mesh into functions."""

from __future__ import annotations

import logging
from typing import Any, Literal

from . import _core
from .meshes import as_mesh
from .model import Model
from .options import EFFORTS, check_options
from .tasks import CancelToken, Progress, check_task

_log = logging.getLogger("pfgeom")


def compress(
    vertices: Any,
    faces: Any = None,
    *,
    materials: Any = None,
    material_names: Any = None,
    tolerance: float = 1e-3,
    relative: bool = True,
    metric: Literal["max", "rms"] = "max",
    effort: Literal["fast", "normal", "best"] = "normal",
    threads: int = 0,
    progress: Progress | None = None,
    cancel: CancelToken | None = None,
) -> Model:
    """Turn a mesh into the smallest set of functions found that stays within a tolerance.

    The result is encoded, decoded, turned into a mesh and measured against the input before it is returned, so
    the tolerance is a promise about ``model.to_mesh()``. Nothing is refused for its shape: open, non-manifold,
    self-intersecting and degenerate meshes all have a result.

    Parameters
    ----------
    vertices
        (n, 3) real numbers; or, without ``faces``, one object: a pair (vertices, faces), or anything with
        ``.vertices`` and ``.faces`` (trimesh), ``.points`` and ``.cells_dict`` (meshio), or ``.points`` and
        ``.regular_faces`` (pyvista).
    faces
        (m, 3) triangles, (m, k) polygons, or a list of polygons of mixed lengths; any integer type.
    materials
        (m,) integers, the material of each face, or None: those of a `Mesh`, else none. They are kept as regions of the
        functions' surface, whose borders are within the tolerance.
    material_names
        As many names as there are materials; or nothing.
    tolerance
        Allowed deviation between the input's surface and the default mesh, both ways.
    relative
        Whether ``tolerance`` is a share of the diagonal of the bounding box of the vertices in use, or else a
        length in the mesh's units.
    metric
        What the tolerance limits: the ``"max"`` or the ``"rms"`` deviation.
    effort
        How long to look for fewer bytes: ``"fast"``, ``"normal"`` or ``"best"``. What it changes is the number of
        settings tried for set trees, and the points that these are fitted to; the promise is the same.
    threads
        0: all of the machine's. The result does not depend on it, to the last bit.
    progress
        Called as ``progress(fraction, stage)`` from this thread, at most 20 times a second; what it raises
        stops the call.
    cancel
        Token that stops the call within 100 ms, from any thread.

    Returns
    -------
    Model
        With `Model.report` filled.

    Raises
    ------
    ValueError
        An option or the mesh is not valid; the sentence names the row.
    TypeError
        Not numbers, or an object of no known kind.
    LimitError
        The mesh exceeds a cap.
    Cancelled
        The token was set.

    Notes
    -----
    After S. I. Vyatkin, B. S. Dolgovesov, "Compression of Geometric Data with the Use of Perturbation
    Functions", Optoelectronics, Instrumentation and Data Processing 54(4), 2018, 334-339.

    Examples
    --------
    >>> model = pfgeom.compress(vertices, faces, tolerance=1e-3)
    >>> model.save("shape.pfg")
    """
    check_options(tolerance, metric, effort)
    check_task(threads, progress, cancel)
    mesh = as_mesh(vertices, faces, materials, material_names)
    core, report = _core.compress(
        *mesh,
        mesh.materials,
        mesh.material_names,
        tolerance,
        relative,
        metric == "rms",
        EFFORTS.index(effort),
        threads,
        progress,
        cancel,
    )
    model = Model(core, report)
    _log_outcome(model, report)
    return model


def _log_outcome(model: Model, report: dict[str, Any]) -> None:
    found = {name: count for name, count in report["defects"].items() if count}
    if found:
        _log.info("the mesh has %s", ", ".join(f"{name.replace('_', ' ')}: {n}" for name, n in found.items()))
    _log.info("%d triangles, %d bytes to %r", report["faces"], report["raw_bytes"], model)
