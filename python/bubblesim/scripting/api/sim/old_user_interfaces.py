# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions for the user interfaces of V-REP's scenes, which are drawn in the 3D view there."""

from __future__ import annotations

from typing import Any

from bubblesim.scene_state.panels import Panel, Widget
from bubblesim.scripting.api.kinds import Integers, StringOrNothing
from bubblesim.scripting.api.sim.dialogs import DialogFunctions

_MOST_POSITION = 1000  # of a slider


class OldUserInterfaceFunctions(DialogFunctions):
    """The files of these interfaces are not read: an interface has any name, and the buttons, labels and sliders that
    scripts use. The window shows them in its panel Dialogs."""

    def getUIHandle(self, name: str) -> int:
        """Return the handle of the user interface with this name."""
        panels = self._caller.shared.panels
        for panel in panels.by_handle.values():
            if panel.kind == "old ui" and panel.root.values["title"] == name:
                return panel.handle
        return self._open_panel("old ui", name, []).handle

    def createUI(self, title: str, menu: int, size: Integers, cell: Any = None, buttons: Any = None) -> int:
        """Open a user interface without buttons and return its handle."""
        return self._open_panel("old ui", title, []).handle

    def deleteUI(self, ui: int) -> int:
        """Close a user interface; return 1."""
        self._old_ui(ui)
        self._close_panel(ui)
        return 1

    def getUIButtonLabel(self, ui: int, button: int) -> str:
        """Return the label of a button."""
        return str(self._button(ui, button).values["text"])

    def setUIButtonLabel(self, ui: int, button: int, up: StringOrNothing = None, down: StringOrNothing = None) -> int:
        """Set the label of a button; return 1."""
        if up is not None:
            self._button(ui, button).values["text"] = up
            self._caller.shared.panels.changed()
        return 1

    def getUIButtonProperty(self, ui: int, button: int) -> int:
        """Return the flags of a button, sim.buttonproperty_isdown for example."""
        return int(self._button(ui, button).values["property"])

    def setUIButtonProperty(self, ui: int, button: int, value: int) -> int:
        """Set the flags of a button; return 1. Its kind, enabled and isdown show in the window."""
        widget = self._button(ui, button)
        kinds = {self.buttonproperty_label: "label", self.buttonproperty_slider: "hslider"}
        widget.kind = kinds.get(value & 3, "edit" if value & 3 == self.buttonproperty_editbox else "button")
        widget.values["property"] = value
        widget.values["enabled"] = bool(value & self.buttonproperty_enabled)
        widget.values["checked"] = bool(value & self.buttonproperty_isdown)
        self._caller.shared.panels.changed()
        return 1

    def setUIButtonColor(self, ui: int, button: int, up: Any = None, down: Any = None, label: Any = None) -> int:
        """Set the colour of a button that is up, three numbers from 0 to 1; return 1."""
        if isinstance(up, list | tuple) and len(up) == 3:
            red, green, blue = (round(255 * min(max(float(part), 0.0), 1.0)) for part in up)
            self._button(ui, button).values["style"] = f"* {{background-color: rgb({red}, {green}, {blue})}}"
            self._caller.shared.panels.changed()
        return 1

    def setUIButtonArrayColor(self, ui: int, button: int, position: Integers, colour: Any) -> int:
        """Accept the colour of a part of a button; return 1."""
        self._button(ui, button)
        return 1

    def setUIButtonTexture(self, ui: int, button: int, size: Any = None, texture: Any = None) -> int:
        """Accept a picture on a button; return 1."""
        self._button(ui, button)
        return 1

    def getUIButtonSize(self, ui: int, button: int) -> list[int]:
        """Return the size of a button in cells: 1, 1."""
        self._button(ui, button)
        return [1, 1]

    def createUIButton(self, ui: int, position: Integers, size: Integers, value: int) -> int:
        """Add a button with these flags and return its handle."""
        numbers = [part.number for part in self._old_ui(ui).root.parts]
        number = max(numbers, default=0) + 1
        self._button(ui, number)
        self.setUIButtonProperty(ui, number, value)
        return number

    def getUIEventButton(self, ui: int) -> tuple[int, list[int]]:
        """Return the handle of the button that a user has operated since the last call, -1 if there is none, and two
        numbers of the event."""
        panel = self._old_ui(ui)
        event, panel.result = panel.result, None
        return event if event is not None else (-1, [0, 0])

    def getUISlider(self, ui: int, slider: int) -> int:
        """Return the position of a slider, 0 to 1000."""
        return int(self._slider(ui, slider).values["value"])

    def setUISlider(self, ui: int, slider: int, position: float) -> int:
        """Set the position of a slider, 0 to 1000; return 1."""
        self._slider(ui, slider).values["value"] = min(max(0, round(position)), _MOST_POSITION)
        self._caller.shared.panels.changed()
        return 1

    def getUIPosition(self, ui: int, which: int = 0) -> list[int]:
        """Return x and y in pixels, as they were set."""
        return list(self._old_ui(ui).root.values["position"])

    def setUIPosition(self, ui: int, which: int, position: Integers) -> int:
        """Set x and y in pixels; return 1. The window shows all in its panel Dialogs."""
        self._old_ui(ui).root.values["position"] = position[:2]
        return 1

    def getUIProperty(self, ui: int) -> int:
        """Return flags, sim.ui_property_visible for example."""
        return self.ui_property_visible if self._old_ui(ui).root.values["visible"] else 0

    def setUIProperty(self, ui: int, value: int) -> int:
        """Set flags; return 1. sim.ui_property_visible shows it, or hides it."""
        self._old_ui(ui).root.values["visible"] = bool(value & self.ui_property_visible)
        self._caller.shared.panels.changed()
        return 1

    def _old_ui(self, handle: int) -> Panel:
        return self._caller.shared.panels.panel(handle, "old ui")

    def _slider(self, ui: int, number: int) -> Widget:
        widget = self._button(ui, number)
        if widget.kind != "hslider":
            widget.kind = "hslider"
            widget.values["property"] = self.buttonproperty_slider | self.buttonproperty_enabled
        return widget

    def _button(self, ui: int, number: int) -> Widget:
        """Return a button, label or slider; it is added if there is none with this number."""
        panel = self._old_ui(ui)
        for part in panel.root.parts:
            if part.number == number:
                return part
        widget = Widget(number, "button")
        widget.values = {
            "text": str(number),
            "property": self.buttonproperty_enabled,
            "enabled": True,
            "checked": False,
        }
        widget.values |= {"minimum": 0, "maximum": _MOST_POSITION, "value": 0}
        widget.on_event = lambda event, value: self._operated(panel, widget, event, value)
        panel.root.parts.append(widget)
        self._caller.shared.panels.changed()
        return widget

    def _operated(self, panel: Panel, widget: Widget, event: str, value: Any) -> None:
        values = widget.values
        first = 0
        if widget.kind == "hslider":
            first = values["value"] = int(value)
        elif widget.kind == "edit":
            values["value"] = str(value)
        elif values["property"] & self.buttonproperty_staydown:
            values["property"] ^= self.buttonproperty_isdown
            first = int(bool(values["property"] & self.buttonproperty_isdown))
            values["checked"] = bool(first)
        panel.result = (widget.number, [first, 0])
