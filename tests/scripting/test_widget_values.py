# SPDX-License-Identifier: BSD-3-Clause
"""simUI: what setters set, getters return, for each kind of widget; and the old user interfaces of V-REP."""

from pathlib import Path

from node_support import in_init, run_script

XML = """
<ui title="Panel" size="200,100">
    <button text="Hold" id="1" checkable="true" /><edit id="2" value="a" /><spinbox id="3" minimum="0" maximum="9" />
    <tabs id="4"><tab title="One"><label text="x" id="5" /></tab><tab title="Two"><label text="y" id="6" /></tab></tabs>
    <combobox id="7"><item>x</item><item>y</item></combobox>
    <table id="8"><header><item>a</item><item>b</item></header><row><item>1</item><item>2</item></row></table>
    <image id="9" width="2" height="1" /><plot id="10" /><text-browser id="11" text="hello" />
</ui>
"""
WIDGETS = f"""
ui = simUI.create('''{XML}''')
simUI.setTitle(ui, 'Other')
assert simUI.getTitle(ui) == 'Other'
simUI.setSize(ui, 300, 150)
assert simUI.getSize(ui) == (300, 150) and simUI.adjustSize(ui) is None
simUI.hide(ui)
assert not simUI.isVisible(ui)
simUI.show(ui)
simUI.setWindowEnabled(ui, False)
simUI.setButtonText(ui, 1, 'Stop')
simUI.setButtonPressed(ui, 1, True)
assert simUI.getButtonText(ui, 1) == 'Stop' and simUI.getButtonPressed(ui, 1)
simUI.setEnabled(ui, 1, False)
simUI.setWidgetVisibility(ui, 1, False)
assert not simUI.getEnabled(ui, 1) and not simUI.getWidgetVisibility(ui, 1)
simUI.setStyleSheet(ui, 1, '* {{color: red}}')
simUI.setEditValue(ui, 2, 'written')
assert simUI.getEditValue(ui, 2) == 'written'
simUI.setCurrentEditWidget(ui, 2)
assert simUI.getCurrentEditWidget(ui) == -1
simUI.setSpinboxValue(ui, 3, 4)
assert simUI.getSpinboxValue(ui, 3) == 4
simUI.setCurrentTab(ui, 4, 1)
assert simUI.getCurrentTab(ui, 4) == 1
simUI.setComboboxItems(ui, 7, ['p', 'q', 'r'], 1)
assert simUI.getComboboxItemCount(ui, 7) == 3 and simUI.getComboboxSelectedIndex(ui, 7) == 1
simUI.removeComboboxItem(ui, 7, 0)
assert simUI.getComboboxItems(ui, 7) == ['q', 'r']
simUI.setComboboxSelectedIndex(ui, 7, -1)
assert simUI.getComboboxSelectedIndex(ui, 7) == -1
simUI.setColumnCount(ui, 8, 3)
simUI.setColumnHeaderText(ui, 8, 2, 'c')
simUI.setRowHeaderText(ui, 8, 0, 'first')
simUI.setTableSelection(ui, 8, 0, 1)
simUI.setItemEditable(ui, 8, 0, 0, True)
simUI.setColumnWidth(ui, 8, 0, 10)
simUI.setRowHeight(ui, 8, 0, 10)
assert simUI.getColumnCount(ui, 8) == 3
simUI.clearTable(ui, 8)
assert simUI.getRowCount(ui, 8) == simUI.getColumnCount(ui, 8) == 0
simUI.setImageData(ui, 9, bytes(6), 2, 1)
simUI.setText(ui, 11, 'one')
simUI.appendText(ui, 11, 'two')
assert simUI.getText(ui, 11).split() == ['one', 'two']
simUI.setUrl(ui, 11, 'about:blank')
"""
PLOTS = f"""
ui = simUI.create('''{XML}''')
simUI.addCurve(ui, 10, simUI.curve_type_xy, 'round', [255, 0, 0])
simUI.addCurveXYPoints(ui, 10, 'round', [0, 1, 2], [1, 2, 3], [4, 5, 6])
assert simUI.getCurveData(ui, 10, 'round') == ([0, 1, 2], [1, 2, 3], [4, 5, 6])
simUI.setPlotLabels(ui, 10, 'x', 'y')
simUI.setPlotRanges(ui, 10, 0, 1, 2, 3)
simUI.setPlotXRange(ui, 10, 0, 2)
simUI.setPlotYRange(ui, 10, 0, 4)
simUI.growPlotXRange(ui, 10, 0, 9)
simUI.growPlotYRange(ui, 10, 0, 9)
simUI.setLegendVisibility(ui, 10, True)
simUI.setMouseOptions(ui, 10, True, True, False, False)
simUI.rescaleAxes(ui, 10, 'round')
simUI.rescaleAxesAll(ui, 10)
simUI.replot(ui, 10)
simUI.clearCurve(ui, 10, 'round')
assert simUI.getCurveData(ui, 10, 'round') == ([], [], [])
simUI.removeCurve(ui, 10, 'round')
try:
    simUI.getCurveData(ui, 10, 'round')
except (ValueError, LookupError) as error:
    assert 'round' in str(error)
else:
    raise AssertionError('accepted')
"""
DIALOGS = """
assert simUI.msgBox(simUI.msgbox_type.info, simUI.msgbox_buttons.ok, 'title', 'text') == simUI.msgbox_result.ok
assert simUI.inputDialog('begun', 'label', 'title') == 'begun'
assert simUI.colorDialog([0.1, 0.2, 0.3]) == [0.1, 0.2, 0.3]
assert not simUI.fileDialog(simUI.filedialog_type.load, 'title', '', '', 'txt')
console = sim.auxiliaryConsoleOpen('console', 10, 0)
assert sim.auxiliaryConsoleShow(console, False) == 1
"""
OLD = """
ui = sim.createUI('Old', 0, [4, 2], [10, 10])
button = sim.createUIButton(ui, [1, 1], [1, 1], sim.buttonproperty_button | sim.buttonproperty_enabled)
slider = sim.createUIButton(ui, [2, 1], [1, 1], sim.buttonproperty_slider)
assert sim.getUIHandle('Old') == ui
assert sim.setUIButtonLabel(ui, button, 'up', 'down') == 1 and sim.setUIButtonColor(ui, button, [1, 0, 0]) == 1
assert sim.setUIButtonArrayColor(ui, button, [0, 0], [1, 0, 0]) == 1 and sim.setUIButtonTexture(ui, button) == 1
assert sim.getUIButtonSize(ui, button) == [1, 1]
flags = sim.buttonproperty_button | sim.buttonproperty_isdown
assert sim.setUIButtonProperty(ui, button, flags) == 1 and sim.getUIButtonProperty(ui, button) == flags
assert sim.setUISlider(ui, slider, 250) == 1 and sim.getUISlider(ui, slider) == 250
assert sim.setUIPosition(ui, sim.ui_property_visible, [30, 40]) == 1 and sim.getUIPosition(ui) == [30, 40]
assert sim.setUIProperty(ui, sim.ui_property_visible) == 1 and sim.getUIProperty(ui) & sim.ui_property_visible
assert sim.getUIEventButton(ui)[0] == -1
assert sim.deleteUI(ui) == 1
other = sim.createUI('Other', 0, [4, 2])
assert sim.removeUI(other) == 1
"""


def check(folder: Path, body: str) -> None:
    run = run_script(folder, in_init(body), scene="tricycle", target="/Tricycle", until=0.05)
    assert "failed" not in run.stderr
    assert run.returncode == 0


def test_widgets_keep_what_is_set(tmp_path: Path) -> None:
    check(tmp_path, WIDGETS)


def test_plots_keep_their_curves(tmp_path: Path) -> None:
    check(tmp_path, PLOTS)


def test_dialogs_return_at_once(tmp_path: Path) -> None:
    check(tmp_path, DIALOGS)


def test_user_interfaces_of_v_rep_keep_what_is_set(tmp_path: Path) -> None:
    check(tmp_path, OLD)
