# SPDX-License-Identifier: BSD-3-Clause
"""Widgets from the XML string of simUI.create."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ElementTree
from collections.abc import Callable
from typing import Any

from bubblesim.scene_state.panels import Widget

_MOST_CHARACTERS = 1_000_000
_TRUE = ("true", "1", "yes", "on")
_LAYOUTS = ("vbox", "hbox", "grid", "form", "none")
# Elements, with the kinds of their attributes; names are without hyphens and underscores. Others are kept as strings.
_CONTAINERS = {"group", "tabs", "tab", "scrollarea"}
_KINDS: dict[str, dict[str, str]] = {
    "ui": {"closeable": "flag", "resizable": "flag", "modal": "flag", "visible": "flag"},
    "group": {"flat": "flag", "visible": "flag"},
    "scrollarea": {},
    "tabs": {"currenttab": "integer"},
    "tab": {},
    "label": {"wordwrap": "flag"},
    "button": {"checkable": "flag", "checked": "flag", "autoexclusive": "flag", "default": "flag"},
    "checkbox": {"checked": "flag"},
    "radiobutton": {"checked": "flag", "autoexclusive": "flag"},
    "edit": {},
    "spinbox": {"minimum": "number", "maximum": "number", "value": "number", "step": "number", "decimals": "integer",
                "float": "flag"},
    "hslider": {"minimum": "integer", "maximum": "integer", "value": "integer", "inverted": "flag"},
    "vslider": {"minimum": "integer", "maximum": "integer", "value": "integer", "inverted": "flag"},
    "dial": {"minimum": "integer", "maximum": "integer", "value": "integer", "wrapping": "flag"},
    "progressbar": {"minimum": "integer", "maximum": "integer", "value": "integer"},
    "combobox": {"editable": "flag"},
    "table": {"editable": "flag", "showgrid": "flag", "showhorizontalheader": "flag", "showverticalheader": "flag"},
    "tree": {},
    "image": {"width": "integer", "height": "integer", "scaled": "flag", "keepaspectratio": "flag"},
    "plot": {},
    "textbrowser": {"readonly": "flag", "ishtml": "flag"},
    "svg": {},
    "datetime": {},
    "properties": {},
    "scene3d": {},
    "separator": {},
    "stretch": {"factor": "integer"},
    "br": {},
}  # fmt: skip
_ALIASES = {"spin": "spinbox", "slider": "hslider", "combo": "combobox", "radio": "radiobutton", "text": "textbrowser"}
_UNESCAPED = re.compile(r"&(?!#?\w+;)")


class UiXmlError(ValueError):
    """The XML string is not a user interface."""


def parse(xml: str, connect: Callable[[Widget, dict[str, str]], None]) -> Widget:
    """Return the widgets of a string.

    :param connect: called for each widget, with the names of the script's functions by event, "change" for example.
    :raises UiXmlError: if the string is not well-formed or has unknown elements.
    """
    if len(xml) > _MOST_CHARACTERS:
        raise UiXmlError(f"an XML string of {len(xml)} characters: at most {_MOST_CHARACTERS} are accepted")
    if "<!DOCTYPE" in xml or "<!ENTITY" in xml:
        raise UiXmlError("a user interface has no document type")
    try:
        root = ElementTree.fromstring(_UNESCAPED.sub("&amp;", xml.strip()))
    except ElementTree.ParseError as error:
        raise UiXmlError(f"the XML string is not well-formed: {error}") from None
    if root.tag != "ui":
        raise UiXmlError(f"the first element is <{root.tag}>, not <ui>")
    numbers: set[int] = set()
    return _widget(root, connect, numbers)


def _widget(
    element: ElementTree.Element, connect: Callable[[Widget, dict[str, str]], None], numbers: set[int]
) -> Widget:
    tag = element.tag.replace("-", "").lower()
    tag = _ALIASES.get(tag, tag)
    if tag not in _KINDS:
        known = ", ".join(sorted(_KINDS.keys() - {"ui"}))
        raise UiXmlError(f"<{element.tag}> is not a widget; known ones: {known}")
    attributes = {name.replace("-", "").replace("_", "").lower(): value for name, value in element.attrib.items()}
    number = _number(element.tag, "id", attributes.pop("id", "0"))
    if number and number in numbers:
        raise UiXmlError(f"two widgets have the id {number}")
    numbers.add(number)
    functions = {name.removeprefix("on"): attributes.pop(name) for name in list(attributes) if name.startswith("on")}
    kinds = _KINDS[tag]
    values = {name: _value(element.tag, name, kinds.get(name, "string"), text) for name, text in attributes.items()}
    values["enabled"] = attributes.get("enabled", "true").lower() in _TRUE
    if tag == "ui" or tag in _CONTAINERS:
        layout = attributes.get("layout", "none" if tag == "scrollarea" else "vbox")
        values["layout"] = layout if layout in _LAYOUTS else "vbox"
    widget = Widget(number, tag, values)
    _fill(widget, element)
    if tag == "ui" or tag in _CONTAINERS:
        widget.parts = [_widget(child, connect, numbers) for child in element]
    connect(widget, functions)
    return widget


def _fill(widget: Widget, element: ElementTree.Element) -> None:
    """Add the values that a widget has without attributes for them."""
    values = widget.values
    if widget.kind in ("hslider", "vslider", "dial", "progressbar", "spinbox"):
        values.setdefault("minimum", 0)
        values.setdefault("maximum", 99 if widget.kind == "spinbox" else 100)
        values.setdefault("value", values["minimum"])
        values["value"] = min(max(values["value"], values["minimum"]), values["maximum"])
    elif widget.kind in ("label", "button", "checkbox", "radiobutton"):
        values.setdefault("text", (element.text or "").strip())
    elif widget.kind in ("edit", "textbrowser"):
        values["value"] = values.get("value", values.pop("text", (element.text or "").strip()))
    elif widget.kind == "combobox":
        values["items"] = [_string(item) for item in element.iter("item")]
        values["value"] = 0 if values["items"] else -1
    elif widget.kind == "table":
        headers = [_string(item) for header in element.iter("header") for item in header]
        rows = [[_string(item) for item in row] for row in element.iter("row")]
        columns = max([len(headers), *(len(row) for row in rows)])
        values["headers"] = headers + [""] * (columns - len(headers))
        values["rows"] = [row + [""] * (columns - len(row)) for row in rows]
    elif widget.kind == "plot":
        values["curves"] = {}
    if widget.kind in ("checkbox", "radiobutton", "button"):
        values.setdefault("checked", False)


def _string(element: ElementTree.Element) -> str:
    return (element.text or element.get("text") or "").strip()


def _value(tag: str, name: str, kind: str, text: str) -> Any:
    if kind == "flag":
        return text.lower() in _TRUE
    if kind in ("integer", "number"):
        return _number(tag, name, text) if kind == "integer" else _float(tag, name, text)
    return text


def _number(tag: str, name: str, text: str) -> int:
    return int(_float(tag, name, text))


def _float(tag: str, name: str, text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise UiXmlError(f"<{tag} {name}='{text}'>: expected a number") from None
