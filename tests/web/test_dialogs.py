# SPDX-License-Identifier: BSD-3-Clause
"""The panel with dialogs and user interfaces of scripts, in a real browser."""

from collections.abc import Iterator

import pytest

pytest.importorskip("playwright")

from node_support import write
from tools_page import ToolsPage

SCRIPT = """
function sysCall_init()
    motor = sim.getObject('/FrontMotor')
    ui = simUI.create([[<ui title="Drive" closeable="true" on-close="closed">
        <label text="&lt;b&gt;Speed&lt;/b&gt;" id="1"/>
        <hslider id="2" minimum="0" maximum="10" value="3" on-change="moved"/>
        <button text="Stop" id="3" on-click="clicked"/>
        <checkbox text="Fast" id="4" on-change="checked"/>
        <edit value="abc" id="5" on-change="written"/>
        <combobox id="6" on-change="chosen"><item>first</item><item>second</item></combobox>
        <tabs id="7"><tab title="One"><label text="in one"/></tab><tab title="Two"><label text="in two"/></tab></tabs>
        <table><header><item>A</item></header><row><item>cell</item></row></table>
        <progressbar id="8" minimum="0" maximum="10" value="5"/>
    </ui>]])
    busy = simUI.create([[<ui title="Busy">
        <label text="0" id="1"/>
        <edit value="" id="2"/>
        <spinbox minimum="0" maximum="1000" value="0" id="3" on-change="counted"/>
        <button text="Press" id="4" on-click="pressed"/>
        <hslider id="5" minimum="0" maximum="100" value="0"/>
    </ui>]])
    dialog = sim.displayDialog('Question', 'Go on?', sim.dlgstyle_yes_no, false)
    console = sim.auxiliaryConsoleOpen('Log', 10, 0)
    sim.auxiliaryConsolePrint(console, 'first line')
end
function moved(ui, id, value) print('moved', id, value) simUI.setLabelText(ui, 1, 'Speed ' .. value) end
function clicked(ui, id) print('clicked', id) end
function checked(ui, id, value) print('checked', id, value) end
function written(ui, id, value) print('written', id, value) end
function chosen(ui, id, value) print('chosen', id, value) end
function closed(ui) print('closed') end
function counted(ui, id, value) print('counted', value) end
function pressed(ui, id) print('pressed') end
function sysCall_sensing()
    simUI.setLabelText(busy, 1, tostring(sim.getSimulationTime()))
    if sim.getDialogResult(dialog) == sim.dlgret_yes and not answered then
        answered = true
        print('yes')
    end
end
"""


@pytest.fixture(scope="module")
def window(tmp_path_factory: pytest.TempPathFactory) -> Iterator[ToolsPage]:
    folder = tmp_path_factory.mktemp("window")
    script = write(folder / "drive.lua", SCRIPT)
    with ToolsPage(folder, "tricycle", "--child-script", f"/Tricycle={script}") as window:
        window.show("dialogs")
        window.wait_for("document.querySelectorAll('.dialog').length === 4")
        yield window
        assert window.errors == []


def dialog(title: str) -> str:
    return (
        f"[...document.querySelectorAll('.dialog')].find((each) => each.querySelector('b').textContent === '{title}')"
    )


def in_log(window: ToolsPage, line: str) -> bool:
    return line in window.node.output


def wait_for_line(window: ToolsPage, line: str) -> None:
    from ros_support import wait_until

    wait_until(lambda: in_log(window, line), line, timeout=30)


def test_widgets_call_the_functions_of_the_script(window: ToolsPage) -> None:
    page = window.page
    drive = page.locator(".dialog", has_text="Drive")
    assert drive.locator(".label").first.text_content() == "Speed"  # without the tags of the rich text
    drive.locator("input[type=range]").fill("7")
    wait_for_line(window, "moved\t2\t7")
    window.wait_for(f"{dialog('Drive')}.querySelector('.label').textContent === 'Speed 7'")
    drive.locator("button", has_text="Stop").click()
    wait_for_line(window, "clicked\t3")
    drive.locator("input[type=checkbox]").check()
    wait_for_line(window, "checked\t4\t2")
    drive.locator("input[type=text]").fill("new")
    wait_for_line(window, "written\t5\tnew")
    drive.locator("select").select_option("second")
    wait_for_line(window, "chosen\t6\t1")
    assert drive.locator("td").text_content() == "cell"
    drive.locator("button.tab", has_text="Two").click()
    window.wait_for(f"{dialog('Drive')}.textContent.includes('in two')")


def later_label(window: ToolsPage) -> None:
    """Wait until the page shows another time than now in the dialog Busy, whose script changes it in each step."""
    label = f"{dialog('Busy')}.querySelector('.label').textContent"
    before = window.page.evaluate(label)
    window.wait_for(f"{label} !== '{before}'")


def test_text_is_written_while_the_script_changes_other_widgets(window: ToolsPage) -> None:
    text = window.page.locator(".dialog", has_text="Busy").locator("input[type=text]")
    text.click()
    for character in "two words":
        window.page.keyboard.type(character)
        later_label(window)
    assert text.input_value() == "two words"


def test_a_number_is_sent_when_it_is_complete(window: ToolsPage) -> None:
    number = window.page.locator(".dialog", has_text="Busy").locator("input[type=number]")
    number.fill("")
    for digit in "123":
        window.page.keyboard.type(digit)
        later_label(window)
    window.page.keyboard.press("Enter")
    wait_for_line(window, "counted\t123")
    assert "counted\t12\n" not in window.node.output


def test_a_long_press_is_a_click(window: ToolsPage) -> None:
    window.page.locator(".dialog", has_text="Busy").locator("button", has_text="Press").hover()
    window.page.mouse.down()
    later_label(window)
    window.page.mouse.up()
    wait_for_line(window, "pressed")


def test_a_slider_is_dragged_while_the_script_changes_other_widgets(window: ToolsPage) -> None:
    slider = window.page.locator(".dialog", has_text="Busy").locator("input[type=range]")
    box = slider.bounding_box()
    assert box is not None
    window.page.mouse.move(box["x"] + 8, box["y"] + box["height"] / 2)
    window.page.mouse.down()
    later_label(window)
    window.page.mouse.move(box["x"] + box["width"] - 1, box["y"] + box["height"] / 2)
    later_label(window)
    window.page.mouse.up()
    assert slider.input_value() == "100"


def test_a_dialog_is_answered_and_a_console_shows_its_lines(window: ToolsPage) -> None:
    assert window.page.locator(".dialog", has_text="Log").locator("pre").text_content() == "first line"
    window.page.locator(".dialog", has_text="Question").locator("button", has_text="Yes").click()
    wait_for_line(window, "yes")
    window.wait_for(f"{dialog('Question')}.hidden")


def test_a_closed_interface_is_hidden(window: ToolsPage) -> None:
    window.page.locator(".dialog", has_text="Drive").locator("button.close").click()
    wait_for_line(window, "closed")
    window.wait_for(f"{dialog('Drive')}.hidden")
