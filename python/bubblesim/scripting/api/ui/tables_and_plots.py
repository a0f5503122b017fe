# SPDX-License-Identifier: BSD-3-Clause
"""`simUI` functions for tables and plots."""

from __future__ import annotations

from typing import Any

from bubblesim.scripting.api.kinds import Integers, Numbers
from bubblesim.scripting.api.ui.context import UiContext

_MOST_POINTS = 10_000  # of a curve
_MOST_CELLS = 100_000


class TableAndPlotFunctions(UiContext):
    """Rows and columns of tables count from 0. A plot has curves by name, each with its last 10000 points."""

    def getRowCount(self, ui: int, widget: int) -> int:
        """Return the number of rows of a table."""
        return len(self._rows(ui, widget))

    def setRowCount(self, ui: int, widget: int, count: int, suppress: object = None) -> None:
        """Set the number of rows of a table."""
        rows, columns = self._rows(ui, widget), self.getColumnCount(ui, widget)
        if not 0 <= count * max(1, columns) <= _MOST_CELLS:
            raise ValueError(f"a table has at most {_MOST_CELLS} cells")
        rows[count:] = []
        rows += [[""] * columns for _ in range(count - len(rows))]
        self._panels.changed()

    def getColumnCount(self, ui: int, widget: int) -> int:
        """Return the number of columns of a table."""
        return len(self._widget(ui, widget, "table").values["headers"])

    def setColumnCount(self, ui: int, widget: int, count: int, suppress: object = None) -> None:
        """Set the number of columns of a table."""
        rows = self._rows(ui, widget)
        if not 0 <= count * max(1, len(rows)) <= _MOST_CELLS:
            raise ValueError(f"a table has at most {_MOST_CELLS} cells")
        for cells in (*rows, self._widget(ui, widget, "table").values["headers"]):
            cells[count:] = []
            cells += [""] * (count - len(cells))
        self._panels.changed()

    def getItem(self, ui: int, widget: int, row: int, column: int) -> str:
        """Return the string in a cell."""
        return self._row(ui, widget, row, column)[column]

    def setItem(self, ui: int, widget: int, row: int, column: int, text: str, suppress: object = None) -> None:
        """Set the string in a cell."""
        self._row(ui, widget, row, column)[column] = text
        self._panels.changed()

    def setItemEditable(self, ui: int, widget: int, row: int, column: int, editable: bool) -> None:
        """Accept whether a user can write in a cell; here none can."""
        self._row(ui, widget, row, column)

    def setColumnHeaderText(self, ui: int, widget: int, column: int, text: str) -> None:
        """Set the string above a column."""
        if not 0 <= column < self.getColumnCount(ui, widget):
            raise ValueError(f"the widget {widget} has no column {column}")
        self._widget(ui, widget, "table").values["headers"][column] = text
        self._panels.changed()

    def setRowHeaderText(self, ui: int, widget: int, row: int, text: str) -> None:
        """Accept the string before a row; it is not shown."""
        self._rows(ui, widget)

    def setColumnWidth(self, ui: int, widget: int, column: int, least: int, most: int | None = None) -> None:
        """Accept the width of a column; columns have the width of what is in them."""
        self._rows(ui, widget)

    def setRowHeight(self, ui: int, widget: int, row: int, least: int, most: int | None = None) -> None:
        """Accept the height of a row."""
        self._rows(ui, widget)

    def setTableSelection(self, ui: int, widget: int, row: int, column: int, suppress: object = None) -> None:
        """Select a cell, or with -1 none."""
        self._set(self._widget(ui, widget, "table"), "selected", [row, column])

    def clearTable(self, ui: int, widget: int, suppress: object = None) -> None:
        """Remove all rows and columns of a table."""
        table = self._widget(ui, widget, "table")
        table.values.update(rows=[], headers=[])
        self._panels.changed()

    def addCurve(
        self,
        ui: int,
        widget: int,
        kind: int,
        name: str,
        colour: Integers,
        style: int = 0,
        options: Any = None,
    ) -> None:
        """Add a curve to a plot: red, green, blue from 0 to 255; kind and style are those of simUI.curve_type and
        curve_style."""
        curves = self._widget(ui, widget, "plot").values["curves"]
        curves[name] = {"kind": kind, "colour": colour[:3], "x": [], "y": []}
        self._panels.changed()

    def removeCurve(self, ui: int, widget: int, name: str) -> None:
        """Remove a curve of a plot."""
        self._curve(ui, widget, name)
        del self._widget(ui, widget, "plot").values["curves"][name]
        self._panels.changed()

    def clearCurve(self, ui: int, widget: int, name: str) -> None:
        """Remove the points of a curve."""
        self._curve(ui, widget, name).update(x=[], y=[])
        self._panels.changed()

    def addCurveTimePoints(self, ui: int, widget: int, name: str, times: Numbers, values: Numbers) -> None:
        """Add points to a curve over time: times in s, and values."""
        self._add_points(ui, widget, name, times, values)

    def addCurveXYPoints(self, ui: int, widget: int, name: str, sequence: Numbers, xs: Numbers, ys: Numbers) -> None:
        """Add points to a curve in a plane: numbers that order them, x and y."""
        self._add_points(ui, widget, name, xs, ys)

    def getCurveData(self, ui: int, widget: int, name: str) -> tuple[list[float], list[float], list[float]]:
        """Return numbers that order the points of a curve, and x and y (time and value)."""
        curve = self._curve(ui, widget, name)
        return [float(number) for number in range(len(curve["x"]))], list(curve["x"]), list(curve["y"])

    def setPlotRanges(self, ui: int, widget: int, x_least: float, x_most: float, y_least: float, y_most: float) -> None:
        """Set the ranges that a plot shows."""
        self._range(ui, widget, "x", x_least, x_most)
        self._range(ui, widget, "y", y_least, y_most)

    def setPlotXRange(self, ui: int, widget: int, least: float, most: float) -> None:
        """Set the range of x that a plot shows."""
        self._range(ui, widget, "x", least, most)

    def setPlotYRange(self, ui: int, widget: int, least: float, most: float) -> None:
        """Set the range of y that a plot shows."""
        self._range(ui, widget, "y", least, most)

    def growPlotXRange(self, ui: int, widget: int, least: float, most: float) -> None:
        """Accept by how much the range of x grows; plots show all points unless a range is set."""
        self._widget(ui, widget, "plot")

    def growPlotYRange(self, ui: int, widget: int, least: float, most: float) -> None:
        """Accept by how much the range of y grows; plots show all points unless a range is set."""
        self._widget(ui, widget, "plot")

    def rescaleAxes(self, ui: int, widget: int, name: str, grow_x: bool = False, grow_y: bool = False) -> None:
        """Show all points of a plot."""
        self._widget(ui, widget, "plot").values.pop("ranges", None)
        self._panels.changed()

    def rescaleAxesAll(self, ui: int, widget: int, grow_x: bool = False, grow_y: bool = False) -> None:
        """Show all points of a plot."""
        self.rescaleAxes(ui, widget, "")

    def setPlotLabels(self, ui: int, widget: int, x: str, y: str) -> None:
        """Set the strings at the axes of a plot."""
        self._set(self._widget(ui, widget, "plot"), "labels", [x, y])

    def setLegendVisibility(self, ui: int, widget: int, visible: bool) -> None:
        """Show the names of the curves, or hide them."""
        self._set(self._widget(ui, widget, "plot"), "legend", visible)

    def setMouseOptions(self, ui: int, widget: int, pan_x: bool, pan_y: bool, zoom_x: bool, zoom_y: bool) -> None:
        """Accept what the mouse does in a plot; it has no effect."""
        self._widget(ui, widget, "plot")

    def replot(self, ui: int, widget: int) -> None:
        """Draw a plot; it is drawn in any case."""
        self._widget(ui, widget, "plot")

    def _rows(self, ui: int, widget: int) -> list[list[str]]:
        rows: list[list[str]] = self._widget(ui, widget, "table").values["rows"]
        return rows

    def _row(self, ui: int, widget: int, row: int, column: int) -> list[str]:
        rows = self._rows(ui, widget)
        if not (0 <= row < len(rows) and 0 <= column < len(rows[row])):
            raise ValueError(f"the widget {widget} has no cell {row}, {column}")
        return rows[row]

    def _curve(self, ui: int, widget: int, name: str) -> dict[str, Any]:
        curves: dict[str, dict[str, Any]] = self._widget(ui, widget, "plot").values["curves"]
        if name not in curves:
            raise LookupError(f"the widget {widget} has no curve '{name}'")
        return curves[name]

    def _add_points(self, ui: int, widget: int, name: str, xs: list[float], ys: list[float]) -> None:
        if len(xs) != len(ys):
            raise ValueError(f"{len(xs)} numbers for x and {len(ys)} for y")
        curve = self._curve(ui, widget, name)
        for axis, added in (("x", xs), ("y", ys)):
            curve[axis] = [*curve[axis], *added][-_MOST_POINTS:]
        self._panels.changed()

    def _range(self, ui: int, widget: int, axis: str, least: float, most: float) -> None:
        values = self._widget(ui, widget, "plot").values
        values["ranges"] = {**values.get("ranges", {}), axis: [least, most]}
        self._panels.changed()
