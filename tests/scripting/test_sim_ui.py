# SPDX-License-Identifier: BSD-3-Clause
"""User interfaces of scripts, dialogs and consoles: values without a window, and what users do."""

from pathlib import Path
from typing import Any

import pytest

from bubblesim.scene_state.panels import Panels, Widget
from bubblesim.scripting.api.ui.ui_module import SimUi
from bubblesim.scripting.api.ui.xml_widgets import UiXmlError, parse
from node_support import run_script


class ScriptOfTest:
    """A caller that records the calls of its functions."""

    def __init__(self) -> None:
        self.object_path = "/Robot"
        self.shared = self
        self.panels = Panels()
        self.at_end: dict[Any, Any] = {}
        self.calls: list[tuple[Any, ...]] = []

    def callback(self, name: str) -> Any:
        return lambda *arguments: self.calls.append((name, *arguments))


XML = """
<ui title="Robot" closeable="true" onclose="closed" layout="form" position="20,30">
    <label text="&lt;b&gt;Speed&lt;/b&gt;" id="1" />
    <hslider id="2" minimum="-10" maximum="10" value="3" on-change="slide" />
    <group layout="hbox">
        <button text="Go" id="3" on-click="go" />
        <button text="Hold" id="4" checkable="true" on-toggle="hold" />
        <checkbox text="Fast" id="5" on-change="fast" />
        <radiobutton text="A" id="6" checked="true" on-click="radio" />
        <radiobutton text="B" id="7" on-click="radio" />
    </group>
    <tabs id="8">
        <tab title="One"><edit id="9" value="abc" on-editing-finished="written" on-change="edited" /></tab>
        <tab title="Two">
            <combobox id="10" on-change="chosen"><item>x</item><item>y</item></combobox>
            <spinbox id="11" minimum="0" maximum="1" value="0.5" step="0.1" float="true" on-change="spun" />
        </tab>
    </tabs>
    <table id="12" on-cell-activate="cell"><header><item>a</item><item>b</item></header>
        <row><item>1</item><item>2</item></row></table>
    <image id="13" width="2" height="1" /><progressbar id="14" minimum="0" maximum="100" value="20" />
    <plot id="15" /><text-browser id="16" text="hello" /><stretch /><br />
</ui>
"""


@pytest.fixture
def script() -> ScriptOfTest:
    return ScriptOfTest()


def test_values_of_the_xml_and_of_setters(script: ScriptOfTest) -> None:
    ui = SimUi(script)  # type: ignore[arg-type]
    handle = ui.create(XML)
    assert (ui.getTitle(handle), ui.getPosition(handle), ui.isVisible(handle)) == ("Robot", (20, 30), True)
    assert ui.getLabelText(handle, 1) == "<b>Speed</b>"
    assert ui.getSliderValue(handle, 2) == 3
    ui.setSliderValue(handle, 2, 99)
    assert ui.getSliderValue(handle, 2) == 10  # its limit
    assert (ui.getRadiobuttonValue(handle, 6), ui.getRadiobuttonValue(handle, 7)) == (1, 0)
    ui.setRadiobuttonValue(handle, 7, 1)
    assert (ui.getRadiobuttonValue(handle, 6), ui.getRadiobuttonValue(handle, 7)) == (0, 1)
    ui.setCheckboxValue(handle, 5, 2)
    assert ui.getCheckboxValue(handle, 5) == 2
    assert ui.getEditValue(handle, 9) == "abc"
    assert ui.getComboboxItems(handle, 10) == ["x", "y"]
    ui.insertComboboxItem(handle, 10, 0, "w")
    assert (ui.getComboboxSelectedIndex(handle, 10), ui.getComboboxItemText(handle, 10, 1)) == (1, "x")
    assert ui.getSpinboxValue(handle, 11) == 0.5
    assert (ui.getRowCount(handle, 12), ui.getColumnCount(handle, 12), ui.getItem(handle, 12, 0, 1)) == (1, 2, "2")
    ui.setRowCount(handle, 12, 2)
    ui.setItem(handle, 12, 1, 0, "new")
    assert ui.getItem(handle, 12, 1, 0) == "new"
    ui.setProgress(handle, 14, 55)
    assert ui.getProgress(handle, 14) == 55
    ui.addCurve(handle, 15, ui.curve_type_time, "z", [255, 0, 0])
    ui.addCurveTimePoints(handle, 15, "z", [0, 1], [2, 3])
    assert ui.getCurveData(handle, 15, "z") == ([0.0, 1.0], [0.0, 1.0], [2.0, 3.0])
    assert script.calls == []  # setters suppress events


def test_what_users_do_calls_the_functions_with_handle_id_and_value(script: ScriptOfTest) -> None:
    ui = SimUi(script)  # type: ignore[arg-type]
    handle = ui.create(XML)
    root = script.panels.by_handle[handle].root
    paths = {each.number: path for each, path in with_paths(root) if each.number}
    for number, event, value in [
        (2, "change", -4),
        (3, "click", None),
        (4, "click", None),
        (5, "change", True),
        (7, "click", True),
        (9, "change", "abcd"),
        (9, "editingfinished", "abcd"),
        (10, "change", 1),
        (11, "change", 0.75),
        (12, "cellactivate", [0, 1, "2"]),
    ]:
        script.panels.send(handle, paths[number], event, value)
    script.panels.send(handle, [], "close", None)
    assert script.calls == [
        ("slide", handle, 2, -4),
        ("go", handle, 3),
        ("hold", handle, 4, True),
        ("fast", handle, 5, 2),
        ("radio", handle, 7),
        ("edited", handle, 9, "abcd"),
        ("written", handle, 9, "abcd"),
        ("chosen", handle, 10, 1),
        ("spun", handle, 11, 0.75),
        ("cell", handle, 12, 0, 1, "2"),
        ("closed", handle),
    ]
    assert ui.getRadiobuttonValue(handle, 6) == 0
    assert not ui.isVisible(handle)


def with_paths(widget: Widget, path: tuple[int, ...] = ()) -> list[tuple[Widget, list[int]]]:
    found = [(widget, list(path))]
    for index, part in enumerate(widget.parts):
        found += with_paths(part, (*path, index))
    return found


@pytest.mark.parametrize(
    ("xml", "why"),
    [
        ("<ui", "not well-formed"),
        ("<window/>", "the first element is <window>, not <ui>"),
        ("<ui><slidr id='1'/></ui>", "<slidr> is not a widget; known ones: "),
        ("<ui><label id='1'/><label id='1'/></ui>", "two widgets have the id 1"),
        ("<ui><hslider minimum='low'/></ui>", "<hslider minimum='low'>: expected a number"),
        ("<!DOCTYPE x [<!ENTITY a 'b'>]><ui/>", "no document type"),
    ],
)
def test_a_wrong_description_is_an_error(xml: str, why: str) -> None:
    with pytest.raises(UiXmlError, match=why):
        parse(xml, lambda widget, functions: None)


def test_wrong_ids_and_kinds_are_errors(script: ScriptOfTest) -> None:
    ui = SimUi(script)  # type: ignore[arg-type]
    handle = ui.create(XML)
    with pytest.raises(LookupError, match="has no widget 99"):
        ui.getSliderValue(handle, 99)
    with pytest.raises(ValueError, match="the widget 1 is a label, not a hslider or vslider or dial"):
        ui.getSliderValue(handle, 1)
    ui.destroy(handle)
    with pytest.raises(LookupError, match=f"no ui has the handle {handle}"):
        ui.getTitle(handle)


def test_dialogs_consoles_and_old_interfaces_keep_their_values(tmp_path: Path) -> None:
    code = """
        function sysCall_init()
            local d = sim.displayDialog('Title', 'Name?', sim.dlgstyle_input, false, 'Bill')
            print(sim.getDialogResult(d) == sim.dlgret_still_open, sim.getDialogInput(d), sim.endDialog(d))
            print(pcall(sim.getDialogResult, d))
            local c = sim.auxiliaryConsoleOpen('Log', 2, 0)
            print(sim.auxiliaryConsolePrint(c, 'a'), sim.auxiliaryConsolePrint(c, nil), sim.auxiliaryConsoleClose(c))
            local ui = simGetUIHandle('Panel')
            simSetUIButtonLabel(ui, 3, 'Go')
            simSetUISlider(ui, 4, 250)
            print(simGetUIHandle('Panel') == ui, simGetUISlider(ui, 4), sim.getUIButtonLabel(ui, 3))
            print(simGetUIEventButton(ui))
        end
    """
    run = run_script(tmp_path, code, "--strict", name="script.lua")
    printed = run.stdout.splitlines()
    assert [printed[0], *printed[2:]] == ["true\tBill\t1", "1\t1\t1", "true\t250\tGo", "-1\t{0, 0}"]
    assert printed[1].startswith("false\t")
    assert "no dialog has the handle" in printed[1]


def test_constants_are_in_tables_too() -> None:
    assert SimUi.curve_type.time == SimUi.curve_type_time
    assert SimUi.curve_style.scatter == SimUi.curve_style_scatter
    assert SimUi.msgbox_result.yes == SimUi.msgbox_result_yes
    with pytest.raises(AttributeError, match="there is no none; there are time, xy"):
        _ = SimUi.curve_type.none
