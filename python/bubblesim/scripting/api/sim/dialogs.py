# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions for dialogs and consoles."""

from __future__ import annotations

from typing import Any

from bubblesim.scene_state.panels import Panel, Widget
from bubblesim.scripting.api.differences import differs
from bubblesim.scripting.api.kinds import StringOrNothing
from bubblesim.scripting.api.sim.context import ApiContext

_MODAL = "a modal dialog waits for the user; here the call returns at once"

_MOST_LINES = 10_000
_NO_PLACE: list[int] = []


class DialogFunctions(ApiContext):
    """The window shows dialogs and consoles in its panel Dialogs. Nothing waits for a user: a modal dialog is open,
    too, when the function returns. They end with their script."""

    @differs(_MODAL)
    def displayDialog(
        self,
        title: str,
        text: str,
        style: int,
        modal: bool = False,
        initial: StringOrNothing = None,
        title_colours: object = None,
        colours: object = None,
    ) -> int:
        """Open a dialog and return its handle; ``style`` is sim.dlgstyle_message, input, ok, ok_cancel or yes_no."""
        buttons = {
            self.dlgstyle_ok: [("OK", self.dlgret_ok)],
            self.dlgstyle_input: [("OK", self.dlgret_ok)],
            self.dlgstyle_ok_cancel: [("OK", self.dlgret_ok), ("Cancel", self.dlgret_cancel)],
            self.dlgstyle_yes_no: [("Yes", self.dlgret_yes), ("No", self.dlgret_no)],
        }.get(style & ~self.dlgstyle_dont_center, [])
        parts = [Widget(0, "label", {"text": text.replace("&&n", "\n"), "enabled": True})]
        if style & ~self.dlgstyle_dont_center == self.dlgstyle_input:
            parts.append(Widget(1, "edit", {"value": initial or "", "enabled": True}))
        parts += [Widget(0, "button", {"text": label, "enabled": True}) for label, _ in buttons]
        panel = self._open_panel("dialog", title, parts)
        panel.result = self.dlgret_still_open
        for part, (_, result) in zip(parts[len(parts) - len(buttons) :], buttons, strict=True):
            part.on_event = self._finishing(panel, result)
        if len(parts) > 1 and parts[1].kind == "edit":
            parts[1].on_event = lambda event, value: parts[1].values.update(value=str(value))
        return panel.handle

    def getDialogResult(self, dialog: int) -> int:
        """Return sim.dlgret_still_open, dlgret_ok, cancel, yes or no."""
        return int(self._dialog(dialog).result)

    def getDialogInput(self, dialog: int) -> str:
        """Return what was written in a dialog with the style sim.dlgstyle_input."""
        return str(self._dialog(dialog).widget(1).values["value"])

    def endDialog(self, dialog: int) -> int:
        """Close a dialog; return 1."""
        self._dialog(dialog)
        self._close_panel(dialog)
        return 1

    @differs(_MODAL)
    def msgBox(self, kind: int, buttons: int, title: str, message: str) -> int:
        """Open a dialog with a message; return sim.msgbox_return_ok or msgbox_return_yes at once."""
        self.displayDialog(title, message, self.dlgstyle_ok)
        with_yes = (self.msgbox_buttons_yesno, self.msgbox_buttons_yesnocancel)
        return self.msgbox_return_yes if buttons in with_yes else self.msgbox_return_ok

    @differs(_MODAL)
    def fileDialog(
        self, mode: int, title: str, path: str, name: str, extension_name: str, extension: str
    ) -> str | None:
        """Return None (nil), as if a user had cancelled."""
        return None

    def auxiliaryConsoleOpen(
        self,
        title: str,
        lines: int,
        mode: int,
        position: Any = None,
        size: Any = None,
        colour: object = None,
        background: object = None,
    ) -> int:
        """Open a console, which keeps the last ``lines`` lines, and return its handle."""
        values = {"value": "", "lines": min(max(1, lines), _MOST_LINES), "enabled": True}
        return self._open_panel("console", title, [Widget(1, "textbrowser", values)]).handle

    def auxiliaryConsolePrint(self, console: int, text: StringOrNothing = None) -> int:
        """Add a string to a console, or with None (nil) clear it; return 1."""
        panels = self._caller.shared.panels
        values = panels.panel(console, "console").widget(1).values
        lines = [] if text is None else (values["value"] + text).split("\n")
        values["value"] = "\n".join(lines[-values["lines"] - 1 :])
        panels.changed()
        return 1

    def auxiliaryConsoleClose(self, console: int) -> int:
        """Close a console; return 1, or 0 if it is not open."""
        panel = self._caller.shared.panels.by_handle.get(console)
        if panel is None or panel.kind != "console":
            return 0
        self._close_panel(console)
        return 1

    def auxiliaryConsoleShow(self, console: int, visible: bool = True) -> int:
        """Show a console, or hide it; return 1."""
        panels = self._caller.shared.panels
        panels.panel(console, "console").root.values["visible"] = visible
        panels.changed()
        return 1

    def textEditorOpen(self, text: str, xml: str = "") -> int:
        """Show a string in a console; return its handle."""
        console = self.auxiliaryConsoleOpen("Text editor", _MOST_LINES, 0)
        self.auxiliaryConsolePrint(console, text)
        return console

    def _dialog(self, handle: int) -> Panel:
        return self._caller.shared.panels.panel(handle, "dialog")

    def _finishing(self, panel: Panel, result: int) -> Any:
        def on_event(event: str, value: object) -> None:
            panel.result = result
            panel.root.values["visible"] = False

        return on_event

    def _open_panel(self, kind: str, title: str, parts: list[Widget]) -> Panel:
        panels = self._caller.shared.panels
        values = {"title": title, "visible": True, "layout": "vbox", "enabled": True, "position": [0, 0]}
        panel = panels.open(kind, self._caller.object_path, Widget(0, "ui", {**values, "size": [0, 0]}, parts))
        self._caller.at_end["panel", panel.handle] = lambda: panels.close(panel.handle)
        return panel

    def _close_panel(self, handle: int) -> None:
        self._caller.shared.panels.close(handle)
        self._caller.at_end.pop(("panel", handle), None)
