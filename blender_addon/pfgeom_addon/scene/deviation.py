# SPDX-License-Identifier: GPL-3.0-or-later
"""How far the active object is from its original or its functions, as attributes of the mesh that it shows."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import bpy

from ..core import deviation
from ..core.job import Job, Piece
from ..core.native import pfgeom
from ..core.storage import Damaged
from ..core.tolerance import stretch
from . import read, store

DISTANCE = "pfgeom_deviation"  # float attribute of the points, in the scene's units
HEAT = "pfgeom_heat"  # colour attribute of the points
RANGE = "pfgeom_heat_top"  # on the mesh: the length that has the last colour
MEASURED = "pfgeom_measured"  # on the mesh: max, rms and mean normal angle as measured


@dataclass
class Target:
    name: str
    matrix: Any  # 4 by 4, to the world
    top: float  # the tolerance there
    shown: tuple[Any, Any]  # (vertices, faces)
    other: Any  # (vertices, faces), or the bytes of functions


@dataclass
class Plan:
    targets: list[Target]
    skipped: list[str]

    def pieces(self) -> list[Piece]:
        return [Piece(target.name, len(target.shown[1]), _work(target)) for target in self.targets]


def plan(objects: Iterable[bpy.types.Object], depsgraph: bpy.types.Depsgraph) -> Plan:
    targets: dict[str, Target] = {}
    skipped = []
    for obj in objects:
        holder = store.holder_of(obj)
        reason = why_not(obj, holder, depsgraph)
        if not reason and obj.data.name not in targets:
            try:
                targets[obj.data.name] = _target(obj, holder, depsgraph)
            except Damaged as damage:
                reason = f": {damage}"
        if reason:
            skipped.append(f"{obj.name} {reason}")
    return Plan(list(targets.values()), skipped)


def why_not(obj: bpy.types.Object, holder: bpy.types.Mesh | None, depsgraph: bpy.types.Depsgraph) -> str:
    if holder is None:
        return "has no functions"
    if obj.library is not None or obj.data.library is not None:
        return "is linked from a library"
    if len(obj.data.polygons) == 0:
        return "shows nothing"
    if len(obj.evaluated_get(depsgraph).data.vertices) != len(obj.data.vertices):
        return "has modifiers that make new vertices: show its rebuilt mesh first"
    if store.shows(obj) != "ORIGINAL" and store.original_of(obj) is None:
        return "has lost its original, so there is nothing to compare with"
    return ""


def finish(done: Plan, job: Job) -> list[str]:
    measured = []
    for i, target in enumerate(done.targets):
        obj = bpy.data.objects.get(target.name)
        result = job.results[i]
        if result is None or obj is None or len(obj.data.vertices) != len(target.shown[0]):
            done.skipped.append(f"{target.name}: {job.failures.get(i, 'has changed meanwhile')}")
            continue
        _write(obj.data, result, target.top)
        measured.append(obj.name)
    return measured


def figures_of(mesh: bpy.types.Mesh) -> tuple[float, float, float] | None:
    """max, rms (lengths in the world) and the mean angle of the normals, if they were measured."""
    values = mesh.get(MEASURED)
    return tuple(values) if values is not None and len(values) == 3 else None


def _target(obj: bpy.types.Object, holder: bpy.types.Mesh, depsgraph: bpy.types.Depsgraph) -> Target:
    matrix = read.matrix_of(obj)
    shown = read.surface_of(obj, depsgraph)
    if store.shows(obj) == "ORIGINAL":
        other = store.content_of(holder)
    else:
        original = read.surface_of_hidden(store.original_of(obj))
        other = (original.vertices, original.faces)
    top = store.figures_of(holder).get("tolerance", 0.0) * stretch(matrix)
    return Target(obj.name, matrix, top, (shown.vertices, shown.faces), other)


def _work(target: Target):
    def work(progress, cancel):
        other = target.other
        if isinstance(other, bytes):
            other = pfgeom().from_bytes(other).to_mesh(cancel=cancel)
        in_world = [(deviation.to_world(vertices, target.matrix), faces) for vertices, faces in (target.shown, other)]
        return deviation.measure(*in_world, progress, cancel)

    return work


def _write(mesh: bpy.types.Mesh, result: deviation.Deviations, top: float) -> None:
    top = top or float(result.distances.max())
    _attribute(mesh, DISTANCE, "FLOAT").foreach_set("value", result.distances)
    _attribute(mesh, HEAT, "FLOAT_COLOR").foreach_set("color", deviation.colours(result.distances, top).reshape(-1))
    mesh.color_attributes.active_color = mesh.color_attributes[HEAT]
    mesh[RANGE] = top
    mesh[MEASURED] = [result.figures[name] for name in ("max", "rms", "normal_deg_mean")]
    mesh.update()


def _attribute(mesh: bpy.types.Mesh, name: str, kind: str):
    layer = mesh.attributes.get(name)
    if layer is not None and (layer.data_type, layer.domain) != (kind, "POINT"):
        mesh.attributes.remove(layer)
        layer = None
    if layer is None:
        layer = mesh.attributes.new(name, kind, "POINT")
    return layer.data
