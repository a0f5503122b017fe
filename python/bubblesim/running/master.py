# SPDX-License-Identifier: BSD-3-Clause
"""The ROS master of a run."""

from __future__ import annotations

import contextlib
import sys
import urllib.parse
from collections.abc import Iterator

import rosgraph
import rosgraph.network

from bubblesim.program.ros_calls import RosCallError, call
from bubblesim.running.processes import Programs, RunError
from bubblesim.running.stop import Stop, wait_for

_CALLER = "/bubblesim_run"
_SIMULATOR_NODE = "/sim_ros_interface"


def simulator_runs() -> bool:
    """Return whether the simulator's node is alive, or stopped; the master may list nodes that were killed."""
    try:
        call(call(rosgraph.get_master_uri(), _CALLER, "lookupNode", _SIMULATOR_NODE), _CALLER, "getPid")
    except RosCallError as error:
        return isinstance(error.__cause__, TimeoutError)
    return True


def require_master() -> None:
    """Raise RunError if no master responds at ROS_MASTER_URI."""
    if not rosgraph.is_master_online():
        uri = rosgraph.get_master_uri()
        raise RunError(f"no ROS master at {uri}: start `roscore` in another terminal, or add --roscore")


def provide_master(programs: Programs, stop: Stop) -> bool:
    """Start a roscore unless one runs at ROS_MASTER_URI; return whether it was started."""
    if rosgraph.is_master_online():
        if simulator_runs():
            raise RunError(f"a simulator is already running on {rosgraph.get_master_uri()}: stop it first")
        return False
    uri = urllib.parse.urlparse(rosgraph.get_master_uri())
    if not rosgraph.network.is_local_address(uri.hostname or ""):
        raise RunError(f"no ROS master at {uri.geturl()}: start it there, or unset ROS_MASTER_URI")
    print(f"no ROS master at {uri.geturl()}: starting a roscore", file=sys.stderr, flush=True)
    programs.start("roscore", "roscore", "-p", str(uri.port or 11311), serves_others=True)
    wait_for(rosgraph.is_master_online, f"the master at {uri.geturl()}", programs, stop)
    return True


@contextlib.contextmanager
def simulated_time() -> Iterator[None]:
    """Set /use_sim_time for all nodes, and restore it at the end."""
    master = rosgraph.Master(_CALLER)
    before = master.getParam("/use_sim_time") if master.hasParam("/use_sim_time") else None
    master.setParam("/use_sim_time", True)
    try:
        yield
    finally:
        with contextlib.suppress(OSError, rosgraph.MasterError):
            if before is None:
                master.deleteParam("/use_sim_time")
            else:
                master.setParam("/use_sim_time", before)
