# SPDX-License-Identifier: GPL-3.0-or-later
"""`.pfg` files to objects and back. A file that is not whole leaves nothing behind."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import bpy
import mathutils
import numpy as np

from ..core import shapes
from ..core.job import Job, Piece
from ..core.native import pfgeom
from ..core.storage import Damaged
from . import read, store, write

#: What Blender's names take, in bytes of UTF-8.
_NAME = 63


@dataclass(frozen=True)
class Loaded:
    content: bytes
    figures: dict[str, Any]
    names: tuple[str, ...]
    matrix: Any  # 4 by 4, or None
    rebuilt: shapes.Rebuilt


@dataclass
class ImportPlan:
    paths: list[Path]
    skipped: list[str]

    def pieces(self) -> list[Piece]:
        return [Piece(path.name, 1.0, _load(path)) for path in self.paths]


def finish_import(done: ImportPlan, job: Job, context: bpy.types.Context) -> list[bpy.types.Object]:
    """Objects for the files that were whole; the others are named."""
    made = []
    for i, path in enumerate(done.paths):
        if i in job.failures:
            done.skipped.append(f"{path.name}: {job.failures[i]}")
        elif job.results[i] is not None:
            made.append(_object_of(path, job.results[i], context))
    return made


def export(obj: bpy.types.Object, path: Path) -> str:
    """Write the object's functions with its name and place. Returns why it could not be done; else nothing."""
    holder = store.holder_of(obj)
    if holder is None:
        return "has no functions: compress it first"
    try:
        model = pfgeom().from_bytes(store.content_of(holder))
        model.placed(read.matrix_of(obj), [obj.name]).save(path)
    except (Damaged, ValueError, OSError) as why:
        return f": {why}"
    return ""


def safe_name(name: str) -> str:
    """A file name for an object's name, on every system."""
    kept = "".join(c if c.isprintable() and c not in '<>:"/\\|?*' else "_" for c in name).strip(". ")
    return kept or "object"


def paths_for(objects: Iterable[bpy.types.Object], path: Path) -> list[tuple[bpy.types.Object, Path]]:
    """The path itself for one object; for several, their names in its folder, none of them twice."""
    objects = list(objects)
    if len(objects) == 1:
        return [(objects[0], path)]
    used: set[str] = set()
    pairs = []
    for obj in objects:
        base = name = safe_name(obj.name)
        number = 1
        while name.lower() in used:
            number += 1
            name = f"{base} {number}"
        used.add(name.lower())
        pairs.append((obj, path.parent / f"{name}.pfg"))
    return pairs


def _load(path: Path):
    def work(progress, cancel):
        try:
            model = pfgeom().load(path)
        except OSError as why:
            raise ValueError(f"cannot be read ({why.strerror or why})") from None
        except pfgeom().FormatError as why:
            raise ValueError(str(why).removeprefix(f"{path}: ")) from None
        rebuilt = shapes.rebuild(model, shapes.Detail(), None, progress, cancel)
        return Loaded(model.to_bytes(), shapes.figures_of(model), model.names, model.world_transform, rebuilt)

    return work


def _object_of(path: Path, loaded: Loaded, context: bpy.types.Context) -> bpy.types.Object:
    name = loaded.names[0] if len(loaded.names) == 1 and loaded.names[0] else path.stem
    name = name.encode()[:_NAME].decode(errors="ignore")
    mesh = bpy.data.meshes.new(name)
    write.add_materials(mesh, loaded.rebuilt.surface.names)
    write.fill(mesh, loaded.rebuilt)
    store.put(mesh, loaded.content, loaded.figures)
    mesh[store.SHOWS] = "REBUILT"
    obj = bpy.data.objects.new(name, mesh)
    if loaded.matrix is not None and np.abs(loaded.matrix).max() < np.finfo(np.float32).max:
        obj.matrix_world = mathutils.Matrix(loaded.matrix.tolist())
    context.collection.objects.link(obj)
    return obj
