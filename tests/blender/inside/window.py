"""In a real window, with simulated mouse and keyboard: what an artist does, from the first click to a reloaded file.

Writes screenshots 01-panel.png ... into the folder, and figures.json. A step that does not come in time is a failure.
"""

import json
import sys
import time
import traceback
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

import bpy
import harness
import scenes

#: Seconds that a step may take, on a loaded machine.
PATIENCE = 60
#: Pixels from the top of the sidebar, at a scale of 1.
TAB, BUTTON = 190, 168

figures: dict[str, float] = {}


def window() -> bpy.types.Window:
    return bpy.context.window_manager.windows[0]


def area() -> bpy.types.Area:
    return next(a for a in window().screen.areas if a.type == "VIEW_3D")


def region(kind: str) -> bpy.types.Region:
    return next(r for r in area().regions if r.type == kind)


def in_view(**more):
    return bpy.context.temp_override(window=window(), area=area(), region=region("WINDOW"), **more)


def click(x: int, y: int):
    window().event_simulate(type="MOUSEMOVE", value="NOTHING", x=x, y=y)
    yield 0.2
    window().event_simulate(type="LEFTMOUSE", value="PRESS", x=x, y=y)
    window().event_simulate(type="LEFTMOUSE", value="RELEASE", x=x, y=y)
    yield 0.3


def click_sidebar(from_right: int, from_top: int):
    ui = region("UI")
    yield from click(ui.x + ui.width - from_right, ui.y + ui.height - from_top)


def press(key: str, **modifiers: bool):
    middle = region("WINDOW")
    x, y = middle.x + middle.width // 3, middle.y + middle.height // 2
    window().event_simulate(type="MOUSEMOVE", value="NOTHING", x=x, y=y)
    yield 0.2
    window().event_simulate(type=key, value="PRESS", x=x, y=y, **modifiers)
    window().event_simulate(type=key, value="RELEASE", x=x, y=y, **modifiers)
    yield 0.3


def until(condition, what: str):
    start = time.monotonic()
    while not condition():
        assert time.monotonic() - start < PATIENCE, f"waited in vain for: {what}"
        yield 0.05


def shoot(name: str):
    for shown in window().screen.areas:
        shown.tag_redraw()
    yield 0.4
    with in_view():
        bpy.ops.screen.screenshot(filepath=str(harness.folder() / f"{name}.png"))
    print(f"shot {name}", flush=True)


def status():
    return harness.addon("ui.running").status()


def scenario():
    yield from prepare()
    yield from stop_it()
    yield from run_it()
    yield from look_and_undo()
    yield from files()


def prepare():
    """Suzanne with modifiers, nicely in view; the tab by a click."""
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    area().spaces[0].show_region_ui = True
    monkey = scenes.suzanne(4)
    scenes.select(monkey)
    with in_view():
        bpy.ops.view3d.view_axis(type="FRONT")
        bpy.ops.view3d.view_orbit(angle=0.5, type="ORBITLEFT")
        bpy.ops.view3d.view_selected()
    yield 1.0
    yield from click_sidebar(12, TAB)
    yield from shoot("01-panel")


def stop_it():
    """The button, the bar, Esc: nothing has changed."""
    before = scenes.datablocks()
    monkey = bpy.data.objects["Suzanne"]
    yield from click_sidebar(110, BUTTON)
    yield from until(lambda: status() is not None and status().fraction > 0, "work that runs")
    yield 1.0
    yield from shoot("02-running")
    assert status() is not None, "the work is too short for this step"
    start = time.monotonic()
    window().event_simulate(type="ESC", value="PRESS", x=600, y=400)
    window().event_simulate(type="ESC", value="RELEASE", x=600, y=400)
    while status() is not None:
        assert time.monotonic() - start < PATIENCE
        yield 0.01
    figures["cancel_seconds"] = time.monotonic() - start
    assert scenes.datablocks() == before
    assert "pfgeom_holder" not in monkey
    yield from shoot("03-stopped")


def run_it():
    """Again, coarser, to be replaced: the dialog says what is lost; then the rebuilt mesh."""
    monkey = bpy.data.objects["Suzanne"]
    monkey.modifiers[0].levels = 2
    chosen = bpy.context.scene.pfgeom
    chosen.share, chosen.effort, chosen.display = 0.5, "fast", "REBUILT"
    with in_view():
        bpy.ops.ed.undo_push(message="Prepared")  # a script's changes are no steps of their own
    region("UI").tag_redraw()
    yield 0.5
    yield from click_sidebar(110, BUTTON + 23)  # one line more: `Keep original`
    yield from shoot("04-dialog")
    yield from press("RET")
    yield from until(lambda: "pfgeom_functions" in monkey.data, "functions")
    assert harness.addon("scene.store").original_of(monkey) is not None
    yield from shoot("05-rebuilt")


def look_and_undo():
    """The heat map; Ctrl-Z takes it away, another one the whole run."""
    monkey = bpy.data.objects["Suzanne"]
    with in_view():
        bpy.ops.pfgeom.deviation("INVOKE_DEFAULT")
    yield from until(lambda: "pfgeom_heat" in monkey.data.attributes, "the heat map")
    yield from shoot("06-deviation")
    yield from press("Z", ctrl=True)
    yield from until(lambda: "pfgeom_heat" not in bpy.data.objects["Suzanne"].data.attributes, "undo of the heat map")
    yield from press("Z", ctrl=True)
    yield from until(lambda: "pfgeom_functions" not in bpy.data.objects["Suzanne"].data, "undo of the run")
    assert len(bpy.data.objects["Suzanne"].modifiers) == 1
    yield from press("Z", ctrl=True, shift=True)
    yield from until(lambda: "pfgeom_functions" in bpy.data.objects["Suzanne"].data, "redo of the run")
    yield from shoot("07-redone")


def files():
    """Export, import, save, reload, rebuild."""
    exported, blend = harness.folder() / "window.pfg", harness.folder() / "window.blend"
    with in_view():
        bpy.ops.export_mesh.pfgeom(filepath=str(exported))
        bpy.ops.import_mesh.pfgeom("INVOKE_DEFAULT", directory=str(exported.parent), files=[{"name": exported.name}])
    yield from until(lambda: "Suzanne.001" in bpy.data.objects, "the imported object")
    bpy.data.objects["Suzanne.001"].location.x += 2.5
    with in_view():
        bpy.ops.view3d.view_all()
    yield from shoot("08-imported")
    with in_view():
        bpy.ops.wm.save_as_mainfile(filepath=str(blend))
        bpy.ops.wm.open_mainfile(filepath=str(blend))
    yield 1.0
    back = bpy.data.objects["Suzanne.001"]
    scenes.select(back)
    count = len(back.data.polygons)
    for detail, expected in (("NONE", 0), ("DEFAULT", count)):
        with in_view():
            bpy.ops.pfgeom.rebuild("INVOKE_DEFAULT", detail=detail)
        yield from until(lambda n=expected: len(back.data.polygons) == n, "the rebuilt mesh")
    yield from shoot("09-reloaded")


def end(code: int) -> None:
    (harness.folder() / "figures.json").write_text(json.dumps(figures))
    harness.leave(code)


def step():
    try:
        return next(_steps)
    except StopIteration:
        end(0)
    except BaseException:
        traceback.print_exc()
        end(1)


harness.install(harness.arguments()[0])
bpy.context.preferences.view.show_splash = False
_steps = scenario()
bpy.app.timers.register(step, first_interval=1.0, persistent=True)
