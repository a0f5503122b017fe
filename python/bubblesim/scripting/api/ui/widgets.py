# SPDX-License-Identifier: BSD-3-Clause
"""`simUI` functions for single widgets."""

from __future__ import annotations

from bubblesim.scene_state.panels import Widget
from bubblesim.scripting.api.differences import differs
from bubblesim.scripting.api.kinds import Bytes
from bubblesim.scripting.api.ui.context import UiContext

_SLIDERS = ("hslider", "vslider", "dial")
_MOST_PIXELS = 4_000_000


class WidgetFunctions(UiContext):
    """The arguments are the handle of the user interface and the id of the widget. Setters call the function of
    ``on-change`` only if ``suppress`` is false."""

    def getSliderValue(self, ui: int, widget: int) -> int:
        """Return the value of a slider or dial."""
        return int(self._widget(ui, widget, *_SLIDERS).values["value"])

    def setSliderValue(self, ui: int, widget: int, value: float, suppress: bool = True) -> None:
        """Set the value of a slider or dial; it is kept within its limits."""
        slider = self._widget(ui, widget, *_SLIDERS)
        self._set(slider, "value", int(_limited(slider, value)), quietly=suppress)

    def getSpinboxValue(self, ui: int, widget: int) -> float:
        """Return the value of a spin box."""
        value: float = self._widget(ui, widget, "spinbox").values["value"]
        return value

    def setSpinboxValue(self, ui: int, widget: int, value: float, suppress: bool = True) -> None:
        """Set the value of a spin box; it is kept within its limits."""
        box = self._widget(ui, widget, "spinbox")
        limited = _limited(box, value)
        self._set(box, "value", limited if value % 1 else int(limited), quietly=suppress)

    def getEditValue(self, ui: int, widget: int) -> str:
        """Return the string in an edit field."""
        return str(self._widget(ui, widget, "edit").values["value"])

    def setEditValue(self, ui: int, widget: int, value: str, suppress: bool = True) -> None:
        """Set the string in an edit field."""
        self._set(self._widget(ui, widget, "edit"), "value", value, quietly=suppress)

    def getCheckboxValue(self, ui: int, widget: int) -> int:
        """Return 2 if a check box is checked, else 0."""
        return 2 if self._widget(ui, widget, "checkbox").values["checked"] else 0

    def setCheckboxValue(self, ui: int, widget: int, value: int, suppress: bool = True) -> None:
        """Check a check box (any value but 0), or uncheck it."""
        box = self._widget(ui, widget, "checkbox")
        box.values["checked"] = value != 0
        self._set(box, "checked", value != 0)
        if not suppress and box.on_event is not None:
            box.on_event("change", value != 0)

    def getRadiobuttonValue(self, ui: int, widget: int) -> int:
        """Return 1 if a radio button is on, else 0."""
        return int(self._widget(ui, widget, "radiobutton").values["checked"])

    def setRadiobuttonValue(self, ui: int, widget: int, value: int, suppress: bool = True) -> None:
        """Switch a radio button on (any value but 0), which switches the others of its layout off, or off."""
        button = self._widget(ui, widget, "radiobutton")
        if value:
            switch_others_off(self._panel(ui).root, button)
        self._set(button, "checked", value != 0)
        if not suppress and value and button.on_event is not None:
            button.on_event("click", None)

    def getButtonText(self, ui: int, widget: int) -> str:
        """Return the string on a button."""
        return str(self._widget(ui, widget, "button").values["text"])

    def setButtonText(self, ui: int, widget: int, text: str) -> None:
        """Set the string on a button."""
        self._set(self._widget(ui, widget, "button"), "text", text)

    def getButtonPressed(self, ui: int, widget: int) -> bool:
        """Return whether a checkable button is down."""
        return bool(self._widget(ui, widget, "button").values["checked"])

    def setButtonPressed(self, ui: int, widget: int, pressed: bool) -> None:
        """Press a checkable button, or release it."""
        self._set(self._widget(ui, widget, "button"), "checked", pressed)

    def getLabelText(self, ui: int, widget: int) -> str:
        """Return the string of a label."""
        return str(self._widget(ui, widget, "label").values["text"])

    def setLabelText(self, ui: int, widget: int, text: str, suppress: object = None) -> None:
        """Set the string of a label."""
        self._set(self._widget(ui, widget, "label"), "text", text)

    def getText(self, ui: int, widget: int) -> str:
        """Return the string of the text browser."""
        return str(self._widget(ui, widget, "textbrowser").values["value"])

    def setText(self, ui: int, widget: int, text: str, suppress: object = None) -> None:
        """Set the string of the text browser."""
        self._set(self._widget(ui, widget, "textbrowser"), "value", text)

    def appendText(self, ui: int, widget: int, text: str) -> None:
        """Add a line to the text browser."""
        browser = self._widget(ui, widget, "textbrowser")
        self._set(browser, "value", f"{browser.values['value']}\n{text}".strip("\n"))

    def getProgress(self, ui: int, widget: int) -> int:
        """Return the value of a progress bar."""
        return int(self._widget(ui, widget, "progressbar").values["value"])

    def setProgress(self, ui: int, widget: int, value: float) -> None:
        """Set the value of a progress bar."""
        bar = self._widget(ui, widget, "progressbar")
        self._set(bar, "value", _limited(bar, value))

    def setImageData(self, ui: int, widget: int, data: Bytes, width: int, height: int) -> None:
        """Set an image: three bytes for each pixel, rows from the top."""
        image = self._widget(ui, widget, "image")
        if not 0 < width * height <= _MOST_PIXELS or len(data) not in (3 * width * height, 4 * width * height):
            raise ValueError(f"{width} x {height} pixels need {3 * width * height} bytes, found {len(data)}")
        image.values.update(data=data, columns=width, rows=height)
        self._panels.changed()

    def getCurrentTab(self, ui: int, widget: int) -> int:
        """Return the index of the tab that is in front."""
        return int(self._widget(ui, widget, "tabs").values.get("currenttab", 0))

    def setCurrentTab(self, ui: int, widget: int, index: int, suppress: bool = True) -> None:
        """Bring a tab to the front, by its index."""
        tabs = self._widget(ui, widget, "tabs")
        if not 0 <= index < len(tabs.parts):
            raise ValueError(f"the widget {widget} has no tab {index}")
        self._set(tabs, "currenttab", index, quietly=suppress)

    def getEnabled(self, ui: int, widget: int) -> bool:
        """Return whether a user can operate a widget."""
        return bool(self._widget(ui, widget).values["enabled"])

    def setEnabled(self, ui: int, widget: int, enabled: bool, suppress: object = None) -> None:
        """Let a user operate a widget, or not."""
        self._set(self._widget(ui, widget), "enabled", enabled)

    def getWidgetVisibility(self, ui: int, widget: int) -> bool:
        """Return whether a widget is shown."""
        return bool(self._widget(ui, widget).values.get("visible", True))

    def setWidgetVisibility(self, ui: int, widget: int, visible: bool) -> None:
        """Show a widget, or hide it."""
        self._set(self._widget(ui, widget), "visible", visible)

    def setStyleSheet(self, ui: int, widget: int, style: str) -> None:
        """Set the style of a widget in Qt's style sheets; color, background-color, font-size and font-weight show."""
        self._set(self._widget(ui, widget), "style", style)

    def setUrl(self, ui: int, widget: int, url: str) -> None:
        """Accept the address of the text browser; it has no effect."""
        self._widget(ui, widget)

    @differs("it returns the field in which the user writes; here pages know alone")
    def getCurrentEditWidget(self, ui: int) -> int:
        """Return -1: pages know alone in which field a user writes."""
        self._panel(ui)
        return -1

    def setCurrentEditWidget(self, ui: int, widget: int) -> None:
        """Accept the field in which a user is to write; it has no effect."""
        self._panel(ui)

    def getComboboxItems(self, ui: int, widget: int) -> list[str]:
        """Return the items of a combo box."""
        return list(self._widget(ui, widget, "combobox").values["items"])

    def getComboboxItemCount(self, ui: int, widget: int) -> int:
        """Return the number of items of a combo box."""
        return len(self.getComboboxItems(ui, widget))

    def getComboboxItemText(self, ui: int, widget: int, index: int) -> str:
        """Return an item of a combo box, by its index from 0."""
        items = self.getComboboxItems(ui, widget)
        if not 0 <= index < len(items):
            raise ValueError(f"the widget {widget} has no item {index}")
        return items[index]

    def getComboboxSelectedIndex(self, ui: int, widget: int) -> int:
        """Return the index of the selected item, -1 if none is."""
        return int(self._widget(ui, widget, "combobox").values["value"])

    def setComboboxSelectedIndex(self, ui: int, widget: int, index: int, suppress: bool = True) -> None:
        """Select an item, -1 none."""
        box = self._widget(ui, widget, "combobox")
        if not -1 <= index < len(box.values["items"]):
            raise ValueError(f"the widget {widget} has no item {index}")
        self._set(box, "value", index, quietly=suppress)

    def setComboboxItems(self, ui: int, widget: int, items: list[str], index: int = 0, suppress: bool = True) -> None:
        """Set the items of a combo box, and the selected one."""
        box = self._widget(ui, widget, "combobox")
        box.values["items"] = [str(item) for item in items]
        self.setComboboxSelectedIndex(ui, widget, min(index, len(box.values["items"]) - 1), suppress)

    def insertComboboxItem(self, ui: int, widget: int, index: int, text: str, suppress: bool = True) -> None:
        """Insert an item before the one with this index."""
        box = self._widget(ui, widget, "combobox")
        box.values["items"].insert(index, text)
        selected = box.values["value"]
        self._set(box, "value", selected + (0 <= index <= selected) if selected >= 0 else 0, quietly=suppress)

    def removeComboboxItem(self, ui: int, widget: int, index: int, suppress: bool = True) -> None:
        """Remove an item."""
        self.getComboboxItemText(ui, widget, index)  # raises
        box = self._widget(ui, widget, "combobox")
        del box.values["items"][index]
        selected = box.values["value"]
        self._set(box, "value", selected - (selected >= index and selected > 0), quietly=suppress)
        if not box.values["items"]:
            box.values["value"] = -1


def switch_others_off(root: Widget, button: Widget) -> None:
    """Switch off the radio buttons in the layout of one."""
    for layout in root.all():
        if button in layout.parts:
            for part in layout.parts:
                if part.kind == button.kind:
                    part.values["checked"] = False


def _limited(widget: Widget, value: float) -> float:
    return float(min(max(value, widget.values["minimum"]), widget.values["maximum"]))
