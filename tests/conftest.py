# SPDX-License-Identifier: BSD-3-Clause
"""Common to all tests: the --long option and the roscore fixture."""

import os
import shutil
import signal
import tempfile

import pytest
from hypothesis import HealthCheck, settings

# A shell starts background jobs with SIGINT ignored, and their children inherit that: Ctrl-C would have no effect.
signal.signal(signal.SIGINT, signal.default_int_handler)
signal.signal(signal.SIGHUP, signal.SIG_DFL)  # likewise for nohup

# On a busy machine an example may take any time.
_at_leisure = settings(deadline=None, suppress_health_check=[HealthCheck.too_slow])
# A commit passes or fails as the one before it; --hypothesis-profile=explore draws new examples each time.
settings.register_profile("suite", _at_leisure, derandomize=True)
settings.register_profile("explore", _at_leisure)
settings.load_profile("suite")

pytest_plugins = ["ros_support", "web_support"]


_left = tempfile.mkdtemp(prefix="bubblesim_tests_")  # what programs leave: roscore its PID, a divergence its states
os.environ["TMPDIR"] = os.environ["ROS_HOME"] = _left


def pytest_unconfigure() -> None:
    shutil.rmtree(_left, ignore_errors=True)


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--long", action="store_true", help="run the tests marked long, too")
    parser.addoption("--renew-pictures", action="store_true", help="write the pictures that pages are compared with")


# The tests start with these, in this order: files that take minutes, so that no process waits for another one at the
# end, then pages that are drawn without a GPU, then long files that would be the last ones by their names.
START_WITH = [
    "tests/test_workspaces.py",
    "meta/test_workspace.py",
    "test_benchmarks.py",
    "test_docs.py",
    "services/test_stuck_scripts.py",
    "services/test_standard_services.py",
    "tests/web/",
    "slam/test_pioneer_slam.py",
    "testing/test_plugin.py",
]


def _turn(item: pytest.Item) -> int:
    return next((i for i, part in enumerate(START_WITH) if part in str(item.path)), len(START_WITH))


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    items.sort(key=_turn)
    if config.getoption("--long"):
        return
    for item in items:
        if item.get_closest_marker("long"):
            item.add_marker(pytest.mark.skip(reason="long: runs with --long"))
