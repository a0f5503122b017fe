# SPDX-License-Identifier: BSD-3-Clause
"""The ROS master that a run uses."""

from __future__ import annotations

import contextlib
import sys
import urllib.parse
import xmlrpc.client
from collections.abc import Iterator

import rosgraph
import rosgraph.network

from bubblesim.running.processes import Programs, RunError
from bubblesim.running.stop import Stop, wait_for

_CALLER = "/bubblesim_run"
_SIMULATOR_NODE = "/sim_ros_interface"


def simulator_runs() -> bool:
    """Whether the simulator's node is alive; a master also knows nodes that were killed."""
    try:
        uri = rosgraph.Master(_CALLER).lookupNode(_SIMULATOR_NODE)
        xmlrpc.client.ServerProxy(uri).getPid(_CALLER)
    except (OSError, rosgraph.MasterError):
        return False
    return True


def require_master() -> None:
    """RunError when no master answers at ROS_MASTER_URI."""
    if not rosgraph.is_master_online():
        uri = rosgraph.get_master_uri()
        raise RunError(f"no ROS master answers at {uri}: start `roscore` in another terminal, or add --roscore")


def provide_master(programs: Programs, stop: Stop) -> bool:
    """Starts a roscore unless one answers at ROS_MASTER_URI; whether it did."""
    if rosgraph.is_master_online():
        if simulator_runs():
            raise RunError(f"a simulator runs already on {rosgraph.get_master_uri()}: end it first")
        return False
    uri = urllib.parse.urlparse(rosgraph.get_master_uri())
    if not rosgraph.network.is_local_address(uri.hostname or ""):
        raise RunError(f"no master answers at {uri.geturl()}: start it there, or unset ROS_MASTER_URI")
    print(f"starting a roscore, as none answers at {uri.geturl()}", file=sys.stderr, flush=True)
    programs.start("roscore", "roscore", "-p", str(uri.port or 11311), serves_others=True)
    wait_for(rosgraph.is_master_online, f"the master at {uri.geturl()}", programs, stop)
    return True


@contextlib.contextmanager
def simulated_time() -> Iterator[None]:
    """Tells all nodes to take their time from /clock, and takes that back at the end."""
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
