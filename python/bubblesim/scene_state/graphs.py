# SPDX-License-Identifier: BSD-3-Clause
"""Graphs: named numbers that scripts record in each step, and curves of two or three of them.

A graph belongs to an object. In each step it records the time and one value of each stream, or NaN where none was set.
"""

from __future__ import annotations

import math
from array import array
from collections.abc import Callable
from dataclasses import dataclass, field

Colour = tuple[float, float, float]

CAPACITY = 10_000
"""Samples of a graph; the oldest ones are replaced."""
INVISIBLE, WITHOUT_LABEL, SCATTERED = 1, 2, 4  # options of streams and curves
RAW, DERIVATIVE, INTEGRAL, CUMULATIVE = range(4)
_MOST_STREAMS = 1000  # and curves, of a scene


@dataclass
class Stream:
    """A number over time."""

    id: int
    name: str
    unit: str
    options: int
    colour: Colour
    cyclic_range: float
    """Values run from minus this to this, as pi for an angle, and wrap around; 0 for other numbers."""
    temporary: bool = True
    """It ends when the next run starts."""
    transformation: int = RAW
    factor: float = 1.0
    offset: float = 0.0
    period: int = 1
    """Number of samples in the moving average."""
    next_value: float = math.nan
    is_static: bool = False
    raw: array[float] = field(default_factory=lambda: array("d"))
    transformed: array[float] = field(default_factory=lambda: array("d"))
    """Parallel to the times of the graph."""

    @property
    def label(self) -> str:
        """Return the name with the unit."""
        return f"{self.name} ({self.unit})" if self.unit else self.name

    def record(self, dt: float) -> None:
        """Append the next value.

        :param dt: s since the previous sample; NaN for the first one.
        """
        value, self.next_value = self.next_value, math.nan
        before = self.raw[-1] if self.raw else math.nan
        sum_before = self.transformed[-1] if self.transformed else math.nan
        self.raw.append(value)
        self.transformed.append(self._transform(value, before, sum_before, dt))

    def _transform(self, value: float, before: float, total: float, dt: float) -> float:
        if self.transformation == DERIVATIVE:
            return self._difference(value, before) / dt if dt > 0.0 else math.nan
        if self.transformation == INTEGRAL and not math.isnan(value):
            if math.isnan(before) or math.isnan(dt):
                return 0.0
            area = (before + 0.5 * self._difference(value, before)) * dt
            return area if math.isnan(total) else total + area
        if self.transformation == CUMULATIVE and not math.isnan(total):
            return total + value
        return value

    def _difference(self, value: float, before: float) -> float:
        change = value - before
        return (
            change if math.isnan(change) or not self.cyclic_range else math.remainder(change, 2.0 * self.cyclic_range)
        )

    def shown(self, start: int = 0) -> list[float]:
        """Return the values from an index on with factor, offset and moving average, NaN where there is none."""
        begin = max(0, start - self.period + 1)
        scaled = [value * self.factor + self.offset for value in self.transformed[begin:]]
        if self.period <= 1:
            return scaled
        ends = range(start - begin + 1, len(scaled) + 1)
        return [_mean(scaled[end - self.period : end]) if end >= self.period else math.nan for end in ends]


def _mean(values: list[float]) -> float:
    valid = [value for value in values if not math.isnan(value)]
    return math.nan if math.isnan(values[-1]) else sum(valid) / len(valid)


@dataclass
class Curve:
    """Two or three streams against each other."""

    id: int
    name: str
    unit: str
    streams: list[int]
    """Ids of streams; -1 for a constant."""
    defaults: list[float]
    options: int
    colour: Colour
    width: int
    temporary: bool = True
    points: list[list[float]] | None = None
    """The lists of x, y and z of a static curve."""

    @property
    def label(self) -> str:
        """Return the name with the unit."""
        return f"{self.name} ({self.unit})" if self.unit else self.name


class Graph:
    """Streams and curves of one object."""

    def __init__(self, require_room: Callable[[], None]) -> None:
        """Create it without streams.

        :param require_room: called before a stream or curve is added; raises ValueError if there are too many.
        """
        self._require_room = require_room
        self.times = array("d")
        """s of simulated time."""
        self.first = 0
        """Number of the oldest sample that is kept."""
        self.resets = 0
        self.streams: dict[int, Stream] = {}
        self.curves: dict[int, Curve] = {}
        self._created = 0

    def next_id(self) -> int:
        """Return the id of the next stream or curve; raise ValueError if the scene has too many."""
        self._require_room()
        self._created += 1
        return self._created - 1

    def add_stream(self, name: str, unit: str, options: int, colour: Colour, cyclic_range: float) -> Stream:
        """Add a stream, or change the stream of this name."""
        for known in self.streams.values():
            if known.name == name and not known.is_static:
                known.unit, known.options, known.colour, known.cyclic_range = unit, options, colour, cyclic_range
                return known
        stream = Stream(self.next_id(), name, unit, options, colour, cyclic_range)
        stream.raw.extend([math.nan] * len(self.times))
        stream.transformed.extend([math.nan] * len(self.times))
        self.streams[stream.id] = stream
        return stream

    def record(self, time: float) -> None:
        """Append a sample of all streams, at a simulated time in s."""
        live = [stream for stream in self.streams.values() if not stream.is_static]
        dt = time - self.times[-1] if self.times else math.nan
        self.times.append(time)
        for stream in live:
            stream.record(dt)
        if len(self.times) >= 2 * CAPACITY:  # rarely, because it moves everything
            self.first += CAPACITY
            for values in (self.times, *(each for stream in live for each in (stream.raw, stream.transformed))):
                del values[:CAPACITY]

    def reset(self) -> None:
        """Delete all samples."""
        self.resets += 1
        self.first = 0
        del self.times[:]
        for stream in self.streams.values():
            stream.next_value = math.nan
            if not stream.is_static:
                del stream.raw[:], stream.transformed[:]

    def points_of(self, stream: Stream) -> tuple[list[float], list[float]]:
        """Return times and values of a stream, without gaps."""
        if stream.is_static:
            return list(stream.raw), list(stream.transformed)
        found = [(t, v) for t, v in zip(self.times, stream.shown(), strict=True) if not math.isnan(v)]
        return [t for t, _ in found], [v for _, v in found]

    def points_of_curve(self, curve: Curve) -> list[list[float]]:
        """Return the lists of x, y and z (3D) of a curve, without gaps."""
        if curve.points is not None:
            return curve.points
        columns = [
            self.streams[each].shown() if each in self.streams else [default] * len(self.times)
            for each, default in zip(curve.streams, curve.defaults, strict=True)
        ]
        rows = [row for row in zip(*columns, strict=True) if not any(map(math.isnan, row))]
        return [list(column) for column in zip(*rows, strict=True)] if rows else [[] for _ in columns]


class Graphs:
    """The graphs of a simulation by the handles of their objects."""

    def __init__(self) -> None:
        """Create it without graphs."""
        self.by_handle: dict[int, Graph] = {}
        self.revision = 0
        """Rises when a stream or curve is added, changed or removed, not with each sample."""

    def of(self, handle: int) -> Graph:
        """Return the graph of an object, which is made if there is none."""
        return self.by_handle.setdefault(handle, Graph(self._require_room))

    def _require_room(self) -> None:
        if sum(len(each.streams) + len(each.curves) for each in self.by_handle.values()) >= _MOST_STREAMS:
            raise ValueError(f"the graphs of a scene have at most {_MOST_STREAMS} streams and curves")

    def record(self, time: float) -> None:
        """Append a sample to all graphs that have streams."""
        for graph in self.by_handle.values():
            if graph.streams and not (graph.times and graph.times[-1] == time):
                graph.record(time)

    def begin_run(self) -> None:
        """Remove what scripts have added in the run before, which stays until now for readers, and all samples."""
        self.revision += 1
        for graph in self.by_handle.values():
            graph.streams = {key: each for key, each in graph.streams.items() if not each.temporary}
            graph.curves = {key: each for key, each in graph.curves.items() if not each.temporary}
            graph.reset()

    def remove(self, handles: set[int]) -> None:
        """Remove the graphs of objects that are about to be removed."""
        for handle in handles & self.by_handle.keys():
            del self.by_handle[handle]
            self.revision += 1
