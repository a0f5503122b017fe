# SPDX-License-Identifier: BSD-3-Clause
"""The panels of the window for scripts, output, plots, cameras, driving and recording, in a real browser."""

import csv
import io
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("playwright")

from playwright.sync_api import Dialog

from node_support import write
from ros_support import wait_until
from tools_page import ToolsPage

SCRIPT = """\
import math

def sysCall_init():
    self.car = sim.getObject('.')
    sim.setJointTargetVelocity(sim.getObject('/FrontMotor'), 1.0)
    self.trail = sim.addDrawingObject(sim.drawing_linestrip, 2, 0, -1, 5000, [1, 0.5, 0])
    self.ball = sim.addDrawingObject(sim.drawing_spherepts, 0.1, 0, self.car, 5)
    sim.addDrawingObjectItem(self.ball, sim.getObjectPosition(self.car))
    self.wave = sim.addGraphStream(self.car, 'wave', 'm')
    print('ready')
    sim.addLog(sim.verbosity_warnings, 'battery is low')
    sim.addLog(sim.verbosity_debug, 'detail')

def sysCall_sensing():
    t = sim.getSimulationTime()
    sim.addDrawingObjectItem(self.trail, sim.getObjectPosition(self.car))
    sim.setGraphStreamValue(self.car, self.wave, math.sin(t))
    sim.setFloatSignal('half', t / 2)
"""


# Resolves when all that had to be drawn, also after a change of size, is on the screen.
DRAWN = "new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 300))))"


@pytest.fixture(scope="module")
def window(tmp_path_factory: pytest.TempPathFactory) -> Iterator[ToolsPage]:
    folder = tmp_path_factory.mktemp("window")
    script = write(folder / "car.py", SCRIPT)
    with ToolsPage(folder, "tricycle", "--child-script", f"/Tricycle={script}") as window:
        window.script = script  # type: ignore[attr-defined]
        yield window
        assert window.errors == []


def visible_lines(window: ToolsPage) -> list[str]:
    return window.page.eval_on_selector_all(".entryrow:not([hidden]) .what", "rows => rows.map(r => r.textContent)")


def test_the_console_shows_and_filters_the_output_of_scripts(window: ToolsPage) -> None:
    window.show("console")
    window.page.wait_for_selector(".entryrow:has-text('detail')", state="attached")  # the last of them
    assert visible_lines(window)[:2] == ["ready", "battery is low"]
    window.page.select_option(".console select >> nth=1", label="All")
    assert "detail" in visible_lines(window)
    window.page.select_option(".console select >> nth=1", label="Errors, warnings")
    assert visible_lines(window) == ["battery is low"]
    window.page.select_option(".console select >> nth=1", label="All but debug")
    window.page.select_option(".console .of", "/Tricycle")
    window.page.fill(".console .search", "READY")
    assert visible_lines(window) == ["ready"]
    window.page.fill(".console .search", "")
    window.page.select_option(".console .of", "")


def test_the_prompt_calls_functions_of_sim(window: ToolsPage) -> None:
    window.show("console")
    window.page.fill(".prompt", "sim.getObjectAlias(sim.getObject('/FrontMotor'))")
    window.page.press(".prompt", "Enter")
    window.page.wait_for_selector(".entryrow .what:text-is(\"'FrontMotor'\")")
    window.page.fill(".prompt", "__import__('os')")
    window.page.press(".prompt", "Enter")
    window.page.wait_for_selector(".entryrow[data-kind=error]:has-text('only functions of sim')")
    window.page.press(".prompt", "ArrowUp")
    assert window.page.input_value(".prompt") == "__import__('os')"
    window.page.fill(".prompt", "sim.getSimulationTimeS")
    window.page.press(".prompt", "Tab")
    window.wait_for("document.querySelector('.prompt').value === 'sim.getSimulationTimeStep('")
    window.page.fill(".prompt", "")


def test_a_script_is_edited_checked_saved_and_restarted(window: ToolsPage) -> None:
    script: Path = window.script  # type: ignore[attr-defined]
    window.show("scripts")
    window.page.wait_for_selector(".cm-content:has-text('sysCall_init')")
    window.page.click(".cm-content")
    window.page.keyboard.press("Control+End")
    window.page.keyboard.type("\ndef broken(:\n")
    window.page.wait_for_selector(".cm-lint-marker-error")
    changed = window.page.locator(".scripts button:has-text('Revert')")  # it can be pressed while there are changes
    for _ in range(40):  # what was typed in one go is one step: on a busy machine that may be a single letter
        if changed.is_disabled():
            break
        window.page.keyboard.press("Control+z")
    assert "broken" not in window.page.inner_text(".cm-content")
    window.page.keyboard.press("Control+Home")
    window.page.keyboard.type("print('edited')\nsim.getObjectPosi")
    window.page.wait_for_selector(".cm-tooltip-autocomplete li[aria-selected]:has-text('getObjectPosition')")
    window.page.wait_for_timeout(200)  # the editor ignores an Enter just after the list has opened
    window.page.keyboard.press("Enter")
    assert "sim.getObjectPosition(" in window.page.inner_text(".cm-content")
    window.page.wait_for_selector(".signature:has-text('sim.getObjectPosition(')")
    window.page.keyboard.type("sim.getObject('.'))\n")
    window.page.keyboard.press("Control+s")
    wait_until(lambda: "edited\n" in window.node.output, "the script to start again")
    assert script.read_text().startswith("print('edited')\nsim.getObjectPosition(sim.getObject('.'))\nimport math\n")
    window.page.wait_for_selector(".scripts .state[data-state=running]")


def test_the_editor_explains_functions_old_names_and_callbacks_under_the_mouse(window: ToolsPage) -> None:
    window.show("scripts")
    window.page.wait_for_selector(".cm-content:has-text('sysCall_init')")
    window.page.click(".cm-content")
    window.page.keyboard.press("Control+Home")
    lines = ("simUI.setTitle", "simGetObjectPosition", "sim.setObjectParent", "simVision.binaryWo")
    for comment in lines[:3]:
        window.page.keyboard.type(f"# {comment}")
        window.page.wait_for_timeout(500)  # a list of completions, of which there is none in comments, would take Enter
        window.page.keyboard.press("Enter")
    assert [f"# {line}" for line in lines[:3]] == window.page.inner_text(".cm-content").splitlines()[:3]
    window.page.keyboard.type(lines[3])
    window.page.wait_for_selector(".cm-tooltip-autocomplete li[aria-selected]:has-text('binaryWorkImg')")
    window.page.keyboard.press("Escape")
    for word, explanation in (
        ("simUI.setTitle", "Set the title of a user interface"),
        ("simGetObjectPosition", "simGetObjectPosition is an old name."),
        ("sim.setObjectParent", "In CoppeliaSim, it changes any object"),
        ("sysCall_sensing", "Called in each step, after the physics and the sensors."),
    ):
        line = window.page.locator(f".cm-line:has-text('{word}')").first
        line.hover(position={"x": 60, "y": 8})
        window.page.wait_for_selector(f".cm-tooltip-hover:has-text('{explanation}')")
        window.page.mouse.move(5, 5)
        window.page.wait_for_selector(".cm-tooltip-hover", state="detached")
    revert = window.page.locator(".scripts button:has-text('Revert')")
    for _ in range(40):
        if revert.is_disabled():
            break
        window.page.keyboard.press("Control+z")


def test_a_file_that_another_program_has_changed_is_overwritten_only_after_a_question(window: ToolsPage) -> None:
    script: Path = window.script  # type: ignore[attr-defined]
    window.show("scripts")
    window.page.wait_for_selector(".cm-content:has-text('sysCall_init')")
    window.page.click(".cm-content")
    window.page.keyboard.press("Control+Home")
    window.page.keyboard.type("print('mine')\n")
    theirs = SCRIPT + "print('theirs')\n"
    write(script, theirs)
    questions: list[str] = []

    def refuse(dialog: Dialog) -> None:
        questions.append(dialog.message)
        dialog.dismiss()

    window.page.once("dialog", refuse)
    window.page.keyboard.press("Control+s")
    wait_until(lambda: window.page.wait_for_timeout(20) or bool(questions), "the question")
    assert "was changed by another program" in questions[0]
    assert script.read_text() == theirs
    write(script, SCRIPT)
    window.page.click(".scripts button:has-text('Revert')")
    window.page.wait_for_selector(".cm-content:not(:has-text('mine'))")


def test_errors_of_scripts_lead_to_their_line(window: ToolsPage) -> None:
    script: Path = window.script  # type: ignore[attr-defined]
    write(script, SCRIPT + "\ndef sysCall_actuation():\n    missing_name()\n")
    handle = window.call("sim.getObject", "/Tricycle")
    assert window.call("sim.initScript", handle)
    window.page.wait_for_selector('.tab[data-panel="problems"].bad')
    window.show("problems")
    window.page.click(".problem:has-text('missing_name')")
    window.page.wait_for_selector(".cm-content:has-text('missing_name()')")
    window.page.wait_for_selector(".cm-activeLine:has-text('missing_name()')")
    window.page.wait_for_selector(".cm-lint-marker-error")
    assert window.page.evaluate("bubblesim.selection.object.path") == "/Tricycle"
    write(script, SCRIPT)
    assert window.call("sim.initScript", handle)
    window.wait_for("!document.querySelector('.tab[data-panel=problems]').classList.contains('bad')")


def test_drawings_are_in_the_picture(window: ToolsPage) -> None:
    window.wait_for("[...bubblesim.drawings.values()].some(d => d.changes.kind === 'linestrip' && d.count > 5)")
    count = "[...bubblesim.drawings.values()].find(d => d.changes.kind === 'linestrip').count"
    first = window.page.evaluate(count)
    window.wait_for(f"{count} > {first}")
    ball = "[...bubblesim.drawings.values()].find(d => d.changes.kind === 'sphere')"
    window.call("window.pause")  # the car moves
    window.wait_for("bubblesim.link.frame.state === 'paused'")
    window.page.evaluate("bubblesim.view.settled()")
    position = window.page.evaluate(f"{ball}.group.matrix.elements.slice(12, 15)")
    car = window.call("sim.getObjectPosition", window.call("sim.getObject", "/Tricycle"))
    window.call("window.start")
    assert np.linalg.norm(np.subtract(position, car)) < 0.5


def test_values_of_all_kinds_are_plotted_and_exported(window: ToolsPage) -> None:
    window.show("plots")
    joint = next(
        path
        for path in window.page.evaluate("[...bubblesim.scene.objects.values()].map(o => o.path)")
        if path.endswith("/FrontMotor")
    )
    for kind, chosen in (
        ("joint", [joint]),
        ("pose", ["/Tricycle", "0"]),
        ("signal", ["half"]),
        ("graph", ["/Tricycle", "wave (m)"]),
    ):
        window.page.evaluate("([kind, chosen]) => bubblesim.plot(kind, chosen).then(() => 0)", [kind, chosen])
    window.wait_for("bubblesim.plots.plots.every(p => p.series.every(({series}) => series.times.length > 20))")
    table = list(csv.reader(io.StringIO(window.page.evaluate("bubblesim.plots.csv()"))))
    assert table[0] == ["time (s)", f"{joint} position", "/Tricycle x (m)", "signal half", "/Tricycle wave (m)"]
    rows = table[1:]
    times = [float(row[0]) for row in rows]
    assert times == sorted(times)
    waves = [(float(row[0]), float(row[4])) for row in rows if row[4]]
    # The graph stamps the end of the step in which the script has computed sin(t).
    assert max(abs(np.sin(t - 0.05) - wave) for t, wave in waves) < 1e-9
    window.page.wait_for_selector(".plot .uplot canvas")
    window.page.click(".plots button:has-text('Pause')")
    shown = "document.querySelector('.plot .uplot canvas').toDataURL()"
    window.page.evaluate(DRAWN)
    before = window.page.evaluate(shown)
    window.page.wait_for_timeout(500)
    assert window.page.evaluate(shown) == before
    window.page.click(".plots button:has-text('Continue')")
    window.wait_for(f"{shown} !== {before!r}")
    with window.page.expect_download() as download:
        window.page.click(".plots button:has-text('CSV')")
    assert download.value.suggested_filename.endswith(".csv")


def test_a_drag_zooms_and_a_double_click_follows_again(window: ToolsPage) -> None:
    window.show("plots")
    if not window.page.evaluate("bubblesim.plots.plots.length"):
        window.page.evaluate("bubblesim.plot('signal', ['half']).then(() => 0)")
    window.wait_for("bubblesim.plots.plots[0].series[0].series.times.length > 20")
    window.page.wait_for_selector(".plot .u-over")
    shown = "document.querySelector('.plot .uplot canvas').toDataURL()"
    over = window.page.locator(".plot .u-over").first
    box = over.bounding_box()
    assert box
    y = box["y"] + box["height"] / 2
    window.page.mouse.move(box["x"] + 0.3 * box["width"], y)
    window.page.mouse.down()
    window.page.mouse.move(box["x"] + 0.6 * box["width"], y, steps=5)
    window.page.mouse.up()
    window.page.evaluate(DRAWN)
    before = window.page.evaluate(shown)
    window.page.wait_for_timeout(600)
    assert window.page.evaluate(shown) == before
    over.dblclick()
    window.wait_for(f"{shown} !== {before!r}")


def test_the_form_of_a_plot_offers_what_the_scene_has(window: ToolsPage) -> None:
    window.show("plots")
    plots = window.page.evaluate("bubblesim.plots.plots.length")
    window.page.click(".plots button:has-text('Add plot')")
    window.page.select_option(".addform select[name=kind]", "graph")
    window.page.wait_for_selector(".addform option:text-is('wave (m)')", state="attached")
    window.page.click(".addform button[type=submit]:enabled")
    window.wait_for(f"bubblesim.plots.plots.length === {plots + 1}")


def test_a_screenshot_is_a_picture_of_the_view(window: ToolsPage) -> None:
    window.show("record")
    with window.page.expect_download() as download:
        window.page.click("button:has-text('Take a screenshot')")
    assert Path(download.value.path()).read_bytes().startswith(b"\x89PNG")


def test_without_ros_there_are_no_tools_for_it(window: ToolsPage) -> None:
    assert window.page.is_hidden('.tab[data-panel="driving"]')
    window.show("record")
    assert window.page.is_hidden(".record select")


def test_a_tab_that_a_scene_cannot_use_gives_way_to_another(window: ToolsPage) -> None:
    window.page.evaluate("bubblesim.layout.showFor({ ros: true })")
    window.show("driving")
    window.page.evaluate("bubblesim.layout.showFor({ ros: false })")
    assert window.page.is_hidden(".driving")
    assert window.page.is_visible('.tab.on[data-panel="properties"]')
