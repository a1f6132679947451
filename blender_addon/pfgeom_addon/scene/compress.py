# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects to functions in the .blend: what is to be done, and what to do with what came out."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

import bpy
import numpy as np

from ..core import shapes, tolerance
from ..core.job import Job, Piece
from . import read, store, write


@dataclass(frozen=True)
class Options:
    """What a person chooses."""

    share: float | None = 1e-3  # of the size; or else
    length: float = 0.0  # in the world's units
    metric: str = "max"
    effort: str = "normal"
    display: str = "ORIGINAL"  # or REBUILT, PREVIEW, NONE
    keep_original: bool = False


@dataclass
class Group:
    """Objects whose evaluated meshes are one."""

    mesh: str  # names, not references: these outlive an undo
    surface: shapes.Surface
    objects: list[str] = field(default_factory=list)
    matrices: list[np.ndarray] = field(default_factory=list)


@dataclass
class Plan:
    options: Options
    groups: list[Group]
    skipped: list[str]  # a sentence each

    def pieces(self) -> list[Piece]:
        return [Piece(group.objects[0], len(group.surface.faces), _work(group, self.options)) for group in self.groups]


def why_not(obj: bpy.types.Object) -> str:
    """Why an object cannot be compressed; empty if it can."""
    if obj.type != "MESH":
        return f"is no mesh ({obj.type.lower()})"
    if obj.library is not None or obj.data.library is not None:
        return "is linked from a library"
    if store.shows(obj) in ("PREVIEW", "NONE"):
        return "shows a preview of its functions or nothing: rebuild it first"
    return ""


def plan(objects: Iterable[bpy.types.Object], depsgraph: bpy.types.Depsgraph, options: Options) -> Plan:
    groups: dict[tuple[str, str], Group] = {}
    skipped = []
    for obj in objects:
        reason = why_not(obj)
        if not reason and not shows_something(obj, depsgraph):
            reason = "is empty"
        if reason:
            skipped.append(f"{obj.name} {reason}")
            continue
        surface = read.surface_of(obj, depsgraph)
        key = (obj.data.name, read.fingerprint(surface))
        group = groups.setdefault(key, Group(obj.data.name, surface))
        group.objects.append(obj.name)
        group.matrices.append(read.matrix_of(obj))
    return Plan(options, list(groups.values()), skipped)


def shows_something(obj: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> bool:
    return len(obj.evaluated_get(depsgraph).data.polygons) > 0


def finish(done: Plan, job: Job) -> list[str]:
    """Write what came out into the scene. Returns the names of the objects that have functions now."""
    compressed = []
    for i, group in enumerate(done.groups):
        result = job.results[i]
        if result is None:
            reason = job.failures.get(i, "was not reached")
            done.skipped.extend(f"{name}: {reason}" for name in group.objects)
            continue
        there = [obj for name in group.objects if (obj := _still_there(name, group)) is not None]
        if there:
            _write(there, result, done.options)
            compressed += [obj.name for obj in there]
    return compressed


def _work(group: Group, options: Options):
    settings = shapes.Settings(_tolerance(group, options), options.metric, options.effort)
    detail = {"REBUILT": shapes.Detail(), "PREVIEW": shapes.PREVIEW}.get(options.display)
    return lambda progress, cancel: shapes.compress(group.surface, settings, detail, progress, cancel)


def _tolerance(group: Group, options: Options) -> tolerance.Tolerance:
    if options.share is None:
        return tolerance.from_length(options.length, group.matrices)
    used = group.surface.vertices[group.surface.faces.reshape(-1)]
    extent = (used.max(axis=0) - used.min(axis=0)).astype(np.float64)
    return tolerance.from_share(options.share, extent, group.matrices)


def _still_there(name: str, group: Group) -> bpy.types.Object | None:
    """The object, if nobody gave it another mesh meanwhile."""
    obj = bpy.data.objects.get(name)
    return obj if obj is not None and obj.type == "MESH" and obj.data.name == group.mesh else None


def _write(objects: list[bpy.types.Object], result: shapes.Compressed, options: Options) -> None:
    source = objects[0].data
    if options.display == "ORIGINAL":
        holder = bpy.data.meshes.new(f"{source.name} functions")
        store.put(holder, result.content, result.figures)
        for obj in objects:
            store.point_to(obj, holder)
        return
    mesh = write.new_mesh_like(source, source.name)
    write.fill(mesh, result.rebuilt)
    store.put(mesh, result.content, result.figures)
    mesh[store.SHOWS] = options.display
    for obj in objects:
        write.show(obj, mesh, options.keep_original)
