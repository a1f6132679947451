# SPDX-License-Identifier: GPL-3.0-or-later
"""Long work as operators: blocking from a script or in the background, else beside the window, to be stopped by Esc."""

from __future__ import annotations

from typing import ClassVar

import bpy
from bpy.app.handlers import persistent

from ..core import native, texts
from ..core.job import Job

#: Seconds between two looks at the work; Esc is an event of its own and needs none.
_INTERVAL = 0.1
#: Seconds that a stopped job gets to end before it is left alone; native work ends within 0.1.
_PATIENCE = 0.15
#: Besides Esc these reach the window while work runs: it can be looked at, not changed.
_LOOKING = {
    "MOUSEMOVE", "INBETWEEN_MOUSEMOVE", "MIDDLEMOUSE", "WHEELUPMOUSE", "WHEELDOWNMOUSE", "TRACKPADPAN", "TRACKPADZOOM",
    "NDOF_MOTION", "WINDOW_DEACTIVATE", "TIMER", "TIMER_REPORT", "TIMER_REGION",
}  # fmt: skip

_running: LongWork | None = None


def status():
    """Of the work that runs now, or None."""
    return _running.job.status() if _running is not None else None


class LongWork:
    """An operator whose work runs in a thread. Blender's data is touched in the main thread alone.

    Subclasses give `plan(context)`, which reads, and `finish(context, plan, job)`, which writes and returns names.
    """

    verb: ClassVar[str]  # for the report: `Compressed`

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if native.why_missing():
            cls.poll_message_set("The native module is not loaded; the panel says why")
            return False
        if _running is not None:
            cls.poll_message_set("Work is running; Esc stops it")
            return False
        if context.mode != "OBJECT":
            cls.poll_message_set("Only in object mode")
            return False
        return True

    def execute(self, context: bpy.types.Context) -> set[str]:
        plan = self.plan(context)
        return self._end(context, plan, Job(plan.pieces()).run())

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        return self.start(context)

    def start(self, context: bpy.types.Context) -> set[str]:
        global _running
        if bpy.app.background:
            return self.execute(context)
        self._plan = self.plan(context)
        if not self._plan.pieces():
            return self._end(context, self._plan, Job([]))
        self.job = Job(self._plan.pieces())
        self._timer = context.window_manager.event_timer_add(_INTERVAL, window=context.window)
        self._workspace = context.workspace.name
        context.window_manager.modal_handler_add(self)
        self.job.start()
        _running = self
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if _running is not self:  # stopped by a file that was loaded, or by the add-on's end
            return {"CANCELLED"}
        if event.type == "ESC" and event.value == "PRESS":
            self.stop()
            _redraw()
            self.report({"INFO"}, "Stopped; nothing was changed")
            return {"CANCELLED"}
        if event.type == "TIMER":
            if self.job.done:
                self._clear()
                result = self._end(context, self._plan, self.job)
                _redraw()
                return result
            self._show()
        return {"PASS_THROUGH"} if event.type in _LOOKING else {"RUNNING_MODAL"}

    def cancel(self, context: bpy.types.Context) -> None:
        if _running is self:
            self.stop()

    def stop(self) -> None:
        self.job.cancel()
        self.job.wait(_PATIENCE)
        self._clear()

    def _show(self) -> None:
        now = self.job.status()
        name = f"{now.name}: {now.stage}, " if now.name else ""
        text = f"PF Geometry: {name}{texts.progress(now.fraction, now.seconds_left)}   |   Esc: stop"
        workspace = bpy.data.workspaces.get(self._workspace)
        if workspace is not None:
            workspace.status_text_set(text)
        _redraw()

    def _clear(self) -> None:
        """Nothing of the run is left, whichever way it ended."""
        global _running
        _running = None
        bpy.context.window_manager.event_timer_remove(self._timer)
        workspace = bpy.data.workspaces.get(self._workspace)
        if workspace is not None:
            workspace.status_text_set(None)

    def _end(self, context: bpy.types.Context, plan, job: Job) -> set[str]:
        if job.cancelled:
            return {"CANCELLED"}
        names = self.finish(context, plan, job)
        for sentence in plan.skipped:
            self.report({"WARNING"}, sentence)
        if not names:
            self.report({"WARNING"} if plan.skipped else {"INFO"}, f"{self.verb} nothing")
            return {"CANCELLED"}
        self.report({"INFO"}, f"{self.verb} {texts.listing(names)}")
        return {"FINISHED"}


def _redraw() -> None:
    """The sidebars alone: to draw a large scene ten times a second would take more time than the work."""
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                for region in area.regions:
                    if region.type == "UI":
                        region.tag_redraw()


def _stop_running() -> None:
    if _running is not None:
        _running.stop()


@persistent
def _before_load(*_: object) -> None:
    _stop_running()


classes = ()


def register() -> None:
    bpy.app.handlers.load_pre.append(_before_load)


def unregister() -> None:
    _stop_running()
    bpy.app.handlers.load_pre.remove(_before_load)
