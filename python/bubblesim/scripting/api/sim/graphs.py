# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions that record numbers over time."""

from __future__ import annotations

import math
from array import array
from typing import Any

from bubblesim._core import RunState
from bubblesim.scene_state.graphs import CAPACITY, CUMULATIVE, INVISIBLE, SCATTERED, WITHOUT_LABEL, Curve, Graph, Stream
from bubblesim.scripting.api.kinds import Handle, Integers, Numbers
from bubblesim.scripting.api.sim.context import ApiContext

_RED = [1.0, 0.0, 0.0]
_YELLOW = [1.0, 1.0, 0.0]
_ZEROS = [0.0, 0.0, 0.0]
_STATIC = 2
_NO_LABEL = 4
_LONGEST_NAME = 1000


class GraphFunctions(ApiContext):
    """Any object can have a graph: its handle is that of the object, for example sim.handle_self. In each step, after
    sysCall_sensing, a graph records one value of each stream, at the time of the end of the step. Streams that are
    added while the simulation runs stay until the next start, their values, too."""

    def addGraphStream(
        self,
        graph: Handle,
        name: str,
        unit: str = "",
        options: int = 0,
        colour: Numbers = _RED,
        cyclic_range: float = math.pi,
    ) -> int:
        """Add a stream of numbers, or change the stream of this name; return its id.

        ``options``, added up: 1 invisible, 2 without label, 4 points that are not linked. ``cyclic_range``: values run
        from minus this to this and wrap around, as angles do; 0 for other numbers.
        """
        _require_short(name, unit)
        stream = self._graph(graph, create=True).add_stream(name, unit, options, _colour(colour), abs(cyclic_range))
        stream.temporary = self._runner.state != RunState.STOPPED
        self._caller.shared.graphs.revision += 1
        return stream.id

    def setGraphStreamValue(self, graph: Handle, stream: int, value: float) -> None:
        """Set the value that the stream has in this step; without a call it has none."""
        self._stream(self._graph(graph), stream).next_value = value

    def setGraphStreamTransformation(
        self,
        graph: Handle,
        stream: int,
        transformation: int,
        factor: float = 1.0,
        offset: float = 0.0,
        moving_average: int = 1,
    ) -> None:
        """Show a stream as sim.stream_transf_raw, derivative, integral or cumulative, then times ``factor`` plus
        ``offset``, then as the mean of the last ``moving_average`` values."""
        if not self.stream_transf_raw <= transformation <= CUMULATIVE:
            raise ValueError(f"{transformation} is not a transformation; valid ones: sim.stream_transf_raw, ...")
        if moving_average < 1:
            raise ValueError(f"moving_average is {moving_average}; it must be at least 1")
        found = self._stream(self._graph(graph), stream)
        found.transformation, found.factor, found.offset = transformation, factor, offset
        found.period = moving_average
        self._caller.shared.graphs.revision += 1

    def addGraphCurve(
        self,
        graph: Handle,
        name: str,
        dimension: int,
        streams: Integers,
        defaults: Numbers = _ZEROS,
        unit: str = "",
        options: int = 0,
        colour: Numbers = _YELLOW,
        width: int = 2,
    ) -> int:
        """Add a curve of two streams (x, y) or three (x, y, z) against each other and return its id.

        A stream of -1 is constant, with the value in ``defaults``. ``options`` are those of addGraphStream.
        """
        _require_short(name, unit)
        found = self._graph(graph)
        if dimension not in (2, 3) or len(streams) < dimension or len(defaults) < dimension:
            raise ValueError("sim.addGraphCurve: dimension is 2 or 3, with as many streams and defaults")
        for stream in streams[:dimension]:
            if stream != -1:
                self._stream(found, stream)
        for known in [each.id for each in found.curves.values() if each.name == name and each.points is None]:
            del found.curves[known]
        curve = Curve(
            found.next_id(), name, unit, streams[:dimension], defaults[:dimension], options, _colour(colour), width
        )
        curve.temporary = self._runner.state != RunState.STOPPED
        found.curves[curve.id] = curve
        self._caller.shared.graphs.revision += 1
        return curve.id

    def duplicateGraphCurveToStatic(self, graph: Handle, curve: int, name: str = "") -> int:
        """Keep what a stream or curve shows now as a new curve that does not change, and return its id."""
        _require_short(name)
        found = self._graph(graph)
        self._caller.shared.graphs.revision += 1
        if curve in found.curves:
            model = found.curves[curve]
            copy = Curve(
                found.next_id(), name or f"{model.name} (static)", model.unit, [], [], model.options, model.colour,
                model.width, temporary=False, points=found.points_of_curve(model),
            )  # fmt: skip
            found.curves[copy.id] = copy
            return copy.id
        stream = self._stream(found, curve)
        times, values = found.points_of(stream)
        kept = Stream(
            found.next_id(), name or f"{stream.name} (static)", stream.unit, stream.options, stream.colour, 0.0
        )
        kept.is_static, kept.temporary = True, False
        kept.raw, kept.transformed = array("d", times), array("d", values)
        found.streams[kept.id] = kept
        return kept.id

    def destroyGraphCurve(self, graph: Handle, curve: int) -> None:
        """Remove a stream or curve."""
        found = self._graph(graph)
        if curve not in found.curves:
            del found.streams[self._stream(found, curve).id]
        found.curves.pop(curve, None)
        self._caller.shared.graphs.revision += 1

    def getGraphCurve(self, graph: Handle, graph_type: int, index: int) -> tuple[Any, ...] | None:
        """Return label, style, colour, x data, y data, for 3D curves z data, the limits [min x, max x, min y, ...], id
        and line width of the visible curve number ``index``; None (nil) if there are fewer.

        ``graph_type``: 0 streams over time (x is the time, s), 1 curves of x and y, 2 curves of x, y and z. The style
        is 0 for linked points, 1 for others, plus 2 for static curves and 4 without label.
        """
        found = self._graph(graph)
        shown: list[Stream] | list[Curve]
        if graph_type == 0:
            shown = [each for each in found.streams.values() if not each.options & INVISIBLE]
        else:
            shown = [
                each
                for each in found.curves.values()
                if not each.options & INVISIBLE and len(each.points or each.streams) == graph_type + 1
            ]
        if not 0 <= index < len(shown):
            return None
        curve = shown[index]
        data = list(found.points_of(curve)) if isinstance(curve, Stream) else found.points_of_curve(curve)
        limits = [limit for values in data for limit in ((min(values), max(values)) if values else (0.0, 0.0))]
        style = bool(curve.options & SCATTERED) + _NO_LABEL * bool(curve.options & WITHOUT_LABEL)
        style += _STATIC * (curve.is_static if isinstance(curve, Stream) else curve.points is not None)
        width = 1 if isinstance(curve, Stream) else curve.width
        limits += [0.0] * (6 - len(limits))
        return curve.label, style, list(curve.colour), *data, limits, curve.id, width

    def getGraphInfo(self, graph: Handle) -> tuple[int, list[float], list[float], int]:
        """Return 0, the colours of background and foreground, and the number of values that are kept."""
        self._graph(graph)
        return 0, [0.1, 0.1, 0.1], [0.85, 0.85, 0.85], CAPACITY

    def handleGraph(self, graph: int, time: float) -> None:
        """Record the values now, at a time in s, and not at the end of the step; sim.handle_all for all graphs."""
        for each in self._graphs(graph):
            each.record(time)

    def resetGraph(self, graph: int) -> None:
        """Delete the values of a graph; sim.handle_all for all graphs."""
        for each in self._graphs(graph):
            each.reset()

    def getGraphs(self) -> dict[str, Any]:
        """Return all graphs, for viewers: ``revision`` and for each graph ``handle``, ``object`` (its path) and
        ``streams`` with ``id``, ``label`` and ``colour``."""
        graphs = self._caller.shared.graphs
        return {
            "revision": graphs.revision,
            "graphs": [
                {
                    "handle": handle,
                    "object": self._tree.short_path(handle),
                    "streams": [
                        {"id": each.id, "label": each.label, "colour": list(each.colour)}
                        for each in graph.streams.values()
                        if not (each.options & INVISIBLE or each.is_static)
                    ],
                }
                for handle, graph in graphs.by_handle.items()
            ],
        }

    def getGraphSamples(self, graph: Handle, since: int = 0) -> dict[str, Any]:
        """Return the samples of a graph from number ``since`` on, for viewers.

        The result has ``start`` (the number of the first sample in it), ``end`` (to pass next time), ``resets`` (the
        samples are counted anew after each), ``times``, and ``streams``: 64 bit floats as bytes, by id; NaN stands for
        no value.
        """
        found = self._graph(graph)
        end = found.first + len(found.times)
        start = since if found.first <= since <= end else found.first
        begin = start - found.first
        return {
            "start": start,
            "end": end,
            "resets": found.resets,
            "times": found.times[begin:].tobytes(),
            "streams": {
                str(each.id): array("d", each.shown(begin)).tobytes()
                for each in found.streams.values()
                if not (each.options & INVISIBLE or each.is_static)
            },
        }

    def _graph(self, handle: int, *, create: bool = False) -> Graph:
        handle = self._resolve(handle)
        graphs = self._caller.shared.graphs
        if create:
            return graphs.of(handle)
        if handle not in graphs.by_handle:
            path = self._tree.short_path(handle)
            raise ValueError(f"{path} has no graph: add a stream first, with sim.addGraphStream")
        return graphs.by_handle[handle]

    def _graphs(self, handle: int) -> list[Graph]:
        if handle in (self.handle_all, self.handle_all_except_explicit):
            return list(self._caller.shared.graphs.by_handle.values())
        return [self._graph(handle)]

    def _stream(self, graph: Graph, stream: int) -> Stream:
        if stream not in graph.streams:
            raise ValueError(f"{stream} is not the id of a stream of this graph")
        return graph.streams[stream]


def _require_short(*strings: str) -> None:
    for text in strings:
        if len(text) > _LONGEST_NAME:
            raise ValueError(f"a name or unit of {len(text)} characters: a graph takes at most {_LONGEST_NAME}")


def _colour(values: list[float]) -> tuple[float, float, float]:
    if len(values) != 3:
        raise ValueError(f"a colour has three numbers (red, green, blue from 0 to 1), found {len(values)}")
    return values[0], values[1], values[2]
