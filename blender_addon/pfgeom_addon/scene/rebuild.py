# SPDX-License-Identifier: GPL-3.0-or-later
"""Functions in the .blend to meshes: what is to be made, and where it goes."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

import bpy

from ..core import shapes
from ..core.job import Job, Piece
from ..core.native import pfgeom
from ..core.storage import Damaged
from . import read, store, write


@dataclass(frozen=True)
class Options:
    """What a person chooses."""

    show: str = "REBUILT"  # or PREVIEW, NONE
    cells: int | None = None  # along the longest side; or else
    tolerance: float | None = None  # extra, as a share of the size; or else the default mesh
    keep_original: bool = True

    @property
    def detail(self) -> shapes.Detail:
        return shapes.PREVIEW if self.show == "PREVIEW" else shapes.Detail(self.cells, self.tolerance)


@dataclass
class Target:
    """Objects that have one copy of functions and show one mesh."""

    holder: str
    mesh: str
    content: bytes
    labels: shapes.Surface
    objects: list[str] = field(default_factory=list)


@dataclass
class Plan:
    options: Options
    targets: list[Target]
    skipped: list[str]

    def pieces(self) -> list[Piece]:
        return [Piece(target.objects[0], len(target.content), _work(target, self.options)) for target in self.targets]


def plan(objects: Iterable[bpy.types.Object], depsgraph: bpy.types.Depsgraph, options: Options) -> Plan:
    targets: dict[tuple[str, str], Target] = {}
    skipped = []
    for obj in objects:
        holder = store.holder_of(obj)
        try:
            reason = why_not(obj, holder)
            if not reason and (key := (holder.name, obj.data.name)) not in targets:
                labels = _labels_of(obj, depsgraph)
                targets[key] = Target(holder.name, obj.data.name, store.content_of(holder), labels)
        except Damaged as damage:
            reason = f": {damage}"
        if reason:
            skipped.append(f"{obj.name} {reason}")
        else:
            targets[key].objects.append(obj.name)
    return Plan(options, list(targets.values()), skipped)


def why_not(obj: bpy.types.Object, holder: bpy.types.Mesh | None) -> str:
    if holder is None:
        return "has no functions"
    if obj.library is not None or obj.data.library is not None:
        return "is linked from a library"
    if store.shows(obj) != "ORIGINAL" and obj.data.shape_keys:
        return "has shape keys on its rebuilt mesh"
    return ""


def finish(done: Plan, job: Job) -> list[str]:
    """Write what came out. Returns the names of the objects that show it."""
    rebuilt = []
    for i, target in enumerate(done.targets):
        objects = [obj for name in target.objects if (obj := _still_there(name, target)) is not None]
        if i in job.failures or not objects or (job.results[i] is None and done.options.show != "NONE"):
            reason = job.failures.get(i, "is not there any more")
            done.skipped.extend(f"{name}: {reason}" for name in target.objects)
            continue
        _write(objects, target, job.results[i], done.options)
        rebuilt += [obj.name for obj in objects]
    return rebuilt


def _work(target: Target, options: Options):
    def work(progress, cancel):
        if options.show == "NONE":
            return None
        model = pfgeom().from_bytes(target.content)
        return shapes.rebuild(model, options.detail, target.labels, progress, cancel)

    return work


def _labels_of(obj: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> shapes.Surface:
    """Whose faces say shading and material: the original while it is there, else what is shown."""
    original = store.original_of(obj)
    if original is None or store.shows(obj) == "ORIGINAL":
        return read.surface_of(obj, depsgraph)
    return read.surface_of_hidden(original)


def _still_there(name: str, target: Target) -> bpy.types.Object | None:
    obj = bpy.data.objects.get(name)
    return obj if obj is not None and obj.type == "MESH" and obj.data.name == target.mesh else None


def _write(objects: list[bpy.types.Object], target: Target, result: shapes.Rebuilt | None, options: Options) -> None:
    mesh = objects[0].data
    if store.FUNCTIONS not in mesh:  # the original: it is left as it is
        holder = bpy.data.meshes[target.holder]
        mesh = write.new_mesh_like(mesh, mesh.name)
        store.put(mesh, target.content, store.figures_of(holder))
        for obj in objects:
            write.show(obj, mesh, options.keep_original)
    write.fill(mesh, result)
    mesh[store.SHOWS] = options.show
