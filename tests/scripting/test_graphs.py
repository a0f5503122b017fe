# SPDX-License-Identifier: BSD-3-Clause
"""Graph streams of scripts: what they record in each step, against closed formulas."""

from pathlib import Path

from node_support import run_script

HEADER = """
import math
import numpy as np
near = lambda a, b, tol=1e-9: np.testing.assert_allclose(a, b, atol=tol)
"""


def check(folder: Path, code: str, until: float = 0.5) -> None:
    run = run_script(folder, HEADER + code, "--strict", until=until)
    assert (run.stderr, run.returncode) == ("", 0)


def test_a_stream_records_the_value_of_each_step_at_its_end(tmp_path: Path) -> None:
    check(
        tmp_path,
        """
def sysCall_init():
    self.stream = sim.addGraphStream(sim.handle_self, 'height', 'm', 0, [0, 1, 0])
def sysCall_sensing():
    t = sim.getSimulationTime()
    if t > 0.4:
        label, style, colour, x, y, limits, number, width = sim.getGraphCurve(sim.handle_self, 0, 0)
        assert (label, style, colour, number, width) == ('height (m)', 0, [0, 1, 0], self.stream, 1)
        near(x, [0.05 * n for n in range(1, len(x) + 1) if n != 3] + [0.05 * (len(x) + 1)])
        near(y, [10 * (each - 0.05) for each in x])
        near(limits, [x[0], x[-1], y[0], y[-1], 0, 0])
        assert sim.getGraphCurve(sim.handle_self, 0, 1) is None
    if round(t / 0.05) != 2:  # a step without a value
        sim.setGraphStreamValue(sim.handle_self, self.stream, 10 * t)
""",
    )


def test_transformations(tmp_path: Path) -> None:
    check(
        tmp_path,
        """
def sysCall_init():
    self.graph = sim.getObject('.')
    names = ('raw', 'derivative', 'integral', 'cumulative')
    self.streams = [sim.addGraphStream(self.graph, name) for name in names]
    for kind, stream in enumerate(self.streams):
        sim.setGraphStreamTransformation(self.graph, stream, kind, 2.0, 1.0)
    self.angle = sim.addGraphStream(self.graph, 'angle', 'rad')
    sim.setGraphStreamTransformation(self.graph, self.angle, sim.stream_transf_derivative)
    self.mean = sim.addGraphStream(self.graph, 'mean')
    sim.setGraphStreamTransformation(self.graph, self.mean, sim.stream_transf_raw, 1, 0, 3)
    self.set = []
def sysCall_sensing():
    t = sim.getSimulationTime() + sim.getSimulationTimeStep()
    if len(self.set) == 8:
        near(self.y(0), [2 * v + 1 for v in self.set])
        near(self.y(1), [2 * (b - a) / 0.05 + 1 for a, b in zip(self.set, self.set[1:])])
        areas = np.cumsum([0.5 * (a + b) * 0.05 for a, b in zip(self.set, self.set[1:])])
        near(self.y(2), [1, *(2 * areas + 1)])
        near(self.y(3), 2 * np.cumsum(self.set) + 1)
        near(self.y(4), [20.0] * 7, 1e-6)  # rad/s, across -pi to pi
        near(self.y(5), [sum(self.set[n:n + 3]) / 3 for n in range(6)])
        self.set.append(0)
    elif len(self.set) < 8:
        self.set.append(t ** 2)
        for stream in [*self.streams, self.mean]:
            sim.setGraphStreamValue(self.graph, stream, t ** 2)
        sim.setGraphStreamValue(self.graph, self.angle, math.remainder(20 * t, 2 * math.pi))
def sysCall_actuation():
    self.y = lambda index: sim.getGraphCurve(self.graph, 0, index)[4]
""",
    )


def test_curves_show_streams_against_each_other(tmp_path: Path) -> None:
    check(
        tmp_path,
        """
def sysCall_init():
    g = self.graph = sim.handle_self
    self.x, self.y = sim.addGraphStream(g, 'x', 'm', 1), sim.addGraphStream(g, 'y', 'm', 1)
    self.xy = sim.addGraphCurve(g, 'path', 2, [self.x, self.y], [0, 0], 'm by m')
    self.xyz = sim.addGraphCurve(g, 'path 3d', 3, [self.x, self.y, -1], [0, 0, 7], 'm', 4, [0, 0, 1], 5)
def sysCall_sensing():
    t, g = sim.getSimulationTime(), self.graph
    if t > 0.2:
        assert sim.getGraphCurve(g, 0, 0) is None  # both are invisible
        label, style, colour, x, y, limits, number, width = sim.getGraphCurve(g, 1, 0)
        near(y, [each ** 2 for each in x])
        assert (label, style, number, width) == ('path (m by m)', 0, self.xy, 2)
        label, style, colour, x, y, z, limits, number, width = sim.getGraphCurve(g, 2, 0)
        assert style == 1 and width == 5 and set(z) == {7}
        near(limits, [x[0], x[-1], y[0], y[-1], 7, 7])
        kept = sim.duplicateGraphCurveToStatic(g, self.xy, 'before')
        sim.resetGraph(g)
        assert sim.getGraphCurve(g, 1, 0)[3] == []
        assert sim.getGraphCurve(g, 1, 1)[:2] == ('before (m by m)', 2) and sim.getGraphCurve(g, 1, 1)[3] == x
        sim.destroyGraphCurve(g, kept)
        assert sim.getGraphCurve(g, 1, 1) is None
    sim.setGraphStreamValue(g, self.x, t)
    sim.setGraphStreamValue(g, self.y, t ** 2)
""",
    )


def test_viewers_get_new_samples_as_bytes(tmp_path: Path) -> None:
    check(
        tmp_path,
        """
def sysCall_init():
    self.stream = sim.addGraphStream(sim.handle_self, 'height', 'm', 0, [0, 1, 0])
    self.seen, self.values = 0, []
def sysCall_sensing():
    found = sim.getGraphs()['graphs']
    assert [each['object'] for each in found] == ['/Ball']
    assert found[0]['streams'] == [{'id': self.stream, 'label': 'height (m)', 'colour': [0, 1, 0]}]
    new = sim.getGraphSamples(found[0]['handle'], self.seen)
    assert new['start'] == self.seen
    self.seen = new['end']
    self.values += np.frombuffer(new['streams'][str(self.stream)]).tolist()
    assert len(new['times']) == 8 * (new['end'] - new['start'])
    near(self.values, [0.05 * n for n in range(len(self.values))])
    assert len(self.values) == round(sim.getSimulationTime() / 0.05)
    sim.setGraphStreamValue(sim.handle_self, self.stream, sim.getSimulationTime())
""",
    )


def test_errors_name_what_is_missing(tmp_path: Path) -> None:
    check(
        tmp_path,
        """
def refused(call, *arguments):
    try:
        call(*arguments)
    except ValueError as error:
        return str(error)
    raise AssertionError('accepted')
def sysCall_init():
    assert '/Ball has no graph' in refused(sim.setGraphStreamValue, sim.handle_self, 0, 1.0)
    sim.addGraphStream(sim.handle_self, 'a')
    assert '7 is not the id of a stream' in refused(sim.setGraphStreamValue, sim.handle_self, 7, 1.0)
    assert 'not a transformation' in refused(sim.setGraphStreamTransformation, sim.handle_self, 0, 9)
    assert 'dimension is 2 or 3' in refused(sim.addGraphCurve, sim.handle_self, 'c', 4, [0, 0])
    assert sim.addGraphStream(sim.handle_self, 'a', 'kg') == 0
""",
    )


def test_a_script_in_lua_records(tmp_path: Path) -> None:
    code = """
function sysCall_init()
    graph = sim.getObject('.')
    stream = sim.addGraphStream(graph, 'height', 'm', 0, {1, 0, 0})
end
function sysCall_sensing()
    if sim.getSimulationTime() > 0.12 then
        local label, style, colour, x, y = sim.getGraphCurve(graph, 0, 0)
        assert(label == 'height (m)' and #x == 3 and math.abs(y[3] - 0.1) < 1e-9)
        assert(sim.getGraphCurve(graph, 0, 1) == nil)
        print('seen')
    end
    sim.setGraphStreamValue(graph, stream, sim.getSimulationTime())
end
"""
    run = run_script(tmp_path, code, "--strict", name="script.lua")
    assert (run.stderr, run.returncode) == ("", 0)
    assert "seen" in run.stdout


def test_a_graph_records_when_it_is_handled(tmp_path: Path) -> None:
    check(
        tmp_path,
        """
def sysCall_init():
    stream = sim.addGraphStream(sim.handle_self, 'height', 'm')
    for time in (1.0, 2.0):
        sim.setGraphStreamValue(sim.handle_self, stream, 10 * time)
        sim.handleGraph(sim.handle_self, time)
    _, _, _, x, y, _, _, _ = sim.getGraphCurve(sim.handle_self, 0, 0)
    near(x, [1, 2])
    near(y, [10, 20])
    assert sim.getGraphInfo(sim.handle_self)[0] == 0
""",
    )
