"""Enable, disable, cancel: what is left."""

from __future__ import annotations

import threading
import time

import bpy
import numpy as np
import scenes
from harness import addon, disable, enable


def _state() -> dict[str, object]:
    """Everything that an add-on can leave behind."""
    handlers = {
        name: [function.__module__ for function in value]
        for name in dir(bpy.app.handlers)
        if isinstance(value := getattr(bpy.app.handlers, name), list)
    }
    menus = [bpy.types.VIEW3D_MT_object, bpy.types.TOPBAR_MT_file_import, bpy.types.TOPBAR_MT_file_export]
    return {
        "classes": sorted(name for name in dir(bpy.types) if "pfgeom" in name.lower()),
        "operators": sorted(
            f"{group}.{name}"
            for group in ("pfgeom", "import_mesh", "export_mesh")
            for name in dir(getattr(bpy.ops, group))
            if "pfgeom" in f"{group}.{name}"
        ),
        "handlers": handlers,
        "menus": [[f.__module__ for f in getattr(menu.draw, "_draw_funcs", ())] for menu in menus],
        "scene": hasattr(bpy.types.Scene, "pfgeom"),
        "datablocks": scenes.datablocks(),
        "threads": threading.active_count(),
    }


def check_twenty_times():
    enabled = _state()
    disable()
    disabled = _state()
    assert "pfgeom" not in str(disabled), disabled
    assert not disabled["scene"]
    for _ in range(20):
        enable()
        assert _state() == enabled
        disable()
        assert _state() == disabled
    enable()


def check_cancel():
    """A running job stops within 0.2 s, from any point of its work, and the scene is as it was."""
    monkey = scenes.suzanne(3)
    scenes.select(monkey)
    compress, job = addon("scene.compress"), addon("core.job")
    before = scenes.datablocks(), scenes.world_mesh(monkey)
    slowest = 0.0
    for wait in (0.05, 0.3, 0.8, 1.5):
        plan = compress.plan([monkey], bpy.context.evaluated_depsgraph_get(), compress.Options(display="REBUILT"))
        running = job.Job(plan.pieces())
        running.start()
        time.sleep(wait)
        assert not running.done, "the work is too short for this check"
        start = time.monotonic()
        running.cancel()
        running.wait(5)
        slowest = max(slowest, time.monotonic() - start)
        assert running.done and running.cancelled
    assert slowest <= 0.2, slowest
    assert scenes.datablocks() == before[0]
    assert all(np.array_equal(a, b) for a, b in zip(before[1], scenes.world_mesh(monkey), strict=True))
