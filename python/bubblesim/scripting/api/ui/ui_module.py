# SPDX-License-Identifier: BSD-3-Clause
"""The module `simUI` of one child script."""

from __future__ import annotations

import sys
from typing import Any

from bubblesim.program.output import write_line
from bubblesim.scene_state.panels import Panel, Widget
from bubblesim.scripting.api.differences import differs
from bubblesim.scripting.api.functions import script_module
from bubblesim.scripting.api.named_constants import Names
from bubblesim.scripting.api.ui.tables_and_plots import TableAndPlotFunctions
from bubblesim.scripting.api.ui.widgets import WidgetFunctions, switch_others_off
from bubblesim.scripting.api.ui.xml_widgets import parse

_MODAL = "a modal dialog waits for the user; here the call returns at once"


@script_module("simUI")
class SimUi(WidgetFunctions, TableAndPlotFunctions):
    """User interfaces of widgets. The window shows them in its panel Dialogs; without a window they keep their values.
    They end with their script."""

    curve_type = Names(time=0, xy=1)
    curve_style = Names(line=0, line_and_scatter=1, scatter=2, step_left=3, step_right=4, step_center=5, impulse=6)
    scatter_shape = Names(none=0, dot=1, cross=2, plus=3, circle=4, disc=5, square=6, diamond=7, star=8, triangle=9)
    line_style = Names(solid=0, dot=1, dash=2, dash_dot=3, dash_dot_dot=4)
    line_size = Names(thin=0, normal=1, thick=2)
    msgbox_type = Names(info=0, question=1, warning=2, critical=3)
    msgbox_buttons = Names(ok=0, yesno=1, yesnocancel=2, okcancel=3)
    msgbox_result = Names(cancel=0, no=1, yes=2, ok=3, error=4)
    filedialog_type = Names(load=0, save=1, load_multiple=2, folder=3)
    mouse_event = Names(press=0, release=1, move=2)
    curve_type_time = 0
    curve_type_xy = 1
    curve_style_line = 0
    curve_style_line_and_scatter = 1
    curve_style_scatter = 2
    msgbox_type_info = 0
    msgbox_type_question = 1
    msgbox_type_warning = 2
    msgbox_type_critical = 3
    msgbox_buttons_ok = 0
    msgbox_buttons_yesno = 1
    msgbox_buttons_yesnocancel = 2
    msgbox_buttons_okcancel = 3
    msgbox_result_cancel = 0
    msgbox_result_no = 1
    msgbox_result_yes = 2
    msgbox_result_ok = 3
    msgbox_result_error = 4

    def create(self, xml: str) -> int:
        """Open a user interface and return its handle; ``xml`` describes its widgets, as in the manual.

        A function that the XML names is called with the handle, the id of the widget and the new value.
        """
        functions: dict[int, dict[str, str]] = {}
        root = parse(xml, lambda widget, names: functions.update({id(widget): names}))
        root.values.setdefault("title", "")
        root.values["visible"] = root.values.get("visible", True)
        root.values["position"] = _pair(root.values.pop("pos", root.values.get("position", "")), [50, 50])
        root.values["size"] = _pair(root.values.get("size", ""), [0, 0])
        panel = self._panels.open("ui", self._caller.object_path, root)
        for widget in root.all():
            self._connect(panel, widget, functions[id(widget)])
        handle = panel.handle
        self._caller.at_end["ui", handle] = lambda: self._panels.close(handle)
        return handle

    def destroy(self, ui: int) -> None:
        """Close a user interface."""
        self._panel(ui)
        self._panels.close(ui)
        self._caller.at_end.pop(("ui", ui), None)

    def show(self, ui: int) -> None:
        """Show a user interface."""
        self._set(self._panel(ui).root, "visible", True)

    def hide(self, ui: int) -> None:
        """Hide a user interface."""
        self._set(self._panel(ui).root, "visible", False)

    def isVisible(self, ui: int) -> bool:
        """Return whether a user interface is shown."""
        return bool(self._panel(ui).root.values["visible"])

    def getTitle(self, ui: int) -> str:
        """Return the title of a user interface."""
        return str(self._panel(ui).root.values["title"])

    def setTitle(self, ui: int, title: str, suppress: object = None) -> None:
        """Set the title of a user interface."""
        self._set(self._panel(ui).root, "title", title)

    def getPosition(self, ui: int) -> tuple[int, int]:
        """Return x and y of a user interface in pixels, as they were set."""
        x, y = self._panel(ui).root.values["position"]
        return x, y

    def setPosition(self, ui: int, x: int, y: int, visible: object = None) -> None:
        """Set x and y of a user interface in pixels; the window shows all in its panel Dialogs."""
        self._set(self._panel(ui).root, "position", [x, y])

    def getSize(self, ui: int) -> tuple[int, int]:
        """Return width and height of a user interface in pixels, as they were set."""
        width, height = self._panel(ui).root.values["size"]
        return width, height

    def setSize(self, ui: int, width: int, height: int) -> None:
        """Set width and height of a user interface in pixels."""
        self._set(self._panel(ui).root, "size", [width, height])

    def adjustSize(self, ui: int) -> None:
        """Give a user interface the size of its widgets."""
        self._set(self._panel(ui).root, "size", [0, 0])

    def setWindowEnabled(self, ui: int, enabled: bool) -> None:
        """Let a user operate a user interface, or not."""
        self._set(self._panel(ui).root, "enabled", enabled)

    @differs(_MODAL)
    def msgBox(self, kind: int, buttons: int, title: str, message: str) -> int:
        """Write a message to the terminal; return simUI.msgbox_result_ok or msgbox_result_yes, because nobody can be
        waited for."""
        write_line(sys.stderr, f"info: {self._caller.object_path}: {title}: {message}")
        with_yes = (self.msgbox_buttons_yesno, self.msgbox_buttons_yesnocancel)
        return self.msgbox_result_yes if buttons in with_yes else self.msgbox_result_ok

    @differs(_MODAL)
    def fileDialog(
        self, kind: int, title: str, path: str, name: str, extension: str, filter_name: str = "", native: bool = False
    ) -> list[str]:
        """Return no file, as if a user had cancelled: nobody can be waited for."""
        return []

    def inputDialog(self, initial: str, label: str = "", title: str = "") -> str:
        """Return the initial value: nobody can be waited for."""
        return initial

    def colorDialog(self, initial: Any, title: str = "", alpha: bool = False, native: bool = False) -> Any:
        """Return the initial colour: nobody can be waited for."""
        return initial

    def _connect(self, panel: Panel, widget: Widget, functions: dict[str, str]) -> None:
        """Let a widget take what users do, and call the script's functions."""

        def on_event(event: str, value: Any) -> None:
            event = _take(panel, widget, event, value)
            events = (event, "toggle") if widget.values.get("checkable") and event == "click" else (event,)
            for each in events:
                if name := functions.get(each, ""):
                    self._call(name, *_arguments(panel, widget, each, value))

        widget.on_event = on_event

    def _call(self, name: str, *arguments: Any) -> None:
        try:
            self._caller.callback(name)(*arguments)
        except (ValueError, TypeError) as error:  # no such function
            write_line(sys.stderr, f"warning: simUI of {self._caller.object_path}: {error}")


def _take(panel: Panel, widget: Widget, event: str, value: Any) -> str:
    """Change the values of a widget by what a user has done; return the event whose function is to be called."""
    values = widget.values
    if event == "close":
        values["visible"] = False
    elif widget.kind == "button":
        if values.get("checkable"):
            values["checked"] = not values["checked"]
    elif widget.kind == "checkbox":
        values["checked"] = bool(value)
    elif widget.kind == "radiobutton":
        switch_others_off(panel.root, widget)
        values["checked"] = True
        return "click"
    elif widget.kind == "tabs":
        values["currenttab"] = int(value)
    elif widget.kind in ("hslider", "vslider", "dial", "combobox"):
        values["value"] = int(value)
    elif widget.kind == "spinbox":
        whole = not values.get("float") and float(values["value"]).is_integer() and not values.get("decimals")
        values["value"] = int(value) if whole else float(value)
    elif widget.kind in ("edit", "textbrowser"):
        values["value"] = str(value)
    return event


def _arguments(panel: Panel, widget: Widget, event: str, value: Any) -> list[Any]:
    """Return what the script's function gets."""
    if widget is panel.root:
        return [panel.handle]
    begin: list[Any] = [panel.handle, widget.number]
    if event == "click" and widget.kind != "plot":
        return begin
    if widget.kind == "checkbox":
        return [*begin, 2 if widget.values["checked"] else 0]
    if widget.kind == "button":
        return [*begin, widget.values["checked"]]
    if isinstance(value, list):
        return [*begin, *value]
    return [*begin, widget.values.get("value", value) if widget.kind != "tabs" else widget.values["currenttab"]]


def _pair(text: Any, default: list[int]) -> list[int]:
    """Return two numbers from a string such as '20,30'."""
    numbers = [part.strip() for part in str(text).split(",")]
    if len(numbers) != 2 or not all(number.lstrip("-").isdigit() for number in numbers):
        return default
    return [int(number) for number in numbers]
