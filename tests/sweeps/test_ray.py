# SPDX-License-Identifier: BSD-3-Clause
"""Sweeps on a Ray cluster of two nodes on this machine, one of which is killed."""

from pathlib import Path

import pytest

from bubblesim.sweeps.local_workers import LocalWorkers
from bubblesim.sweeps.programs import FileProgram
from bubblesim.sweeps.sweep import make_workers, run_sweep
from bubblesim.sweeps.tasks import SweepError, tasks_of
from node_support import write

ray = pytest.importorskip("ray")

PROGRAM = """
import time

def run(run):
    time.sleep(0.3)
    simulation = run.simulation("tricycle")
    simulation.step(20)
    return {"x": simulation.object("/Tricycle").position[0], "hash": str(simulation.state_hash())}
"""
SPEEDS = {"/FrontMotor.target_velocity": [0.5, 1.0]}


@pytest.mark.long
def test_runs_of_a_killed_node_are_repeated(tmp_path: Path) -> None:
    from ray.cluster_utils import Cluster

    program = FileProgram.read(write(tmp_path / "program.py", PROGRAM))
    tasks = tasks_of(range(10), SPEEDS)
    cluster = Cluster(initialize_head=True, head_node_args={"num_cpus": 1})
    second = cluster.add_node(num_cpus=1)
    cluster.wait_for_nodes()
    killed: list[int] = []

    def kill_at_five(done: int, failed: int, total: int) -> None:
        assert (failed, total) == (0, 20)
        if done == 5 and not killed:
            killed.append(done)
            cluster.remove_node(second, allow_graceful=False)

    try:
        workers = make_workers(f"ray://{cluster.address}", program)
        rows = run_sweep(program, tasks, workers, tmp_path / "ray.journal", on_progress=kill_at_five)
    finally:
        ray.shutdown()
        cluster.shutdown()
    assert killed == [5]
    assert rows == run_sweep(program, tasks, LocalWorkers(program, 2), tmp_path / "local.journal")


@pytest.mark.long
def test_a_program_that_cannot_be_loaded_is_reported_by_the_cluster(tmp_path: Path) -> None:
    program = FileProgram.read(write(tmp_path / "program.py", "x = 1\n"))
    try:
        with pytest.raises(SweepError, match="must define a function run"):
            run_sweep(program, tasks_of([0], {}), make_workers("ray", program), tmp_path / "j")
    finally:
        ray.shutdown()
