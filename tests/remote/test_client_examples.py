# SPDX-License-Identifier: BSD-3-Clause
"""The examples that come with the sources of CoppeliaSim's client, unchanged, in the folder BUBBLESIM_CLIENT_EXAMPLES.

They are those of `pip download --no-deps --no-binary :all: coppeliasim-zmqremoteapi-client`, unpacked.
"""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from remote_support import RemoteNode
from ros_support import DEADLINE

FOLDER = Path(os.environ.get("BUBBLESIM_CLIENT_EXAMPLES", ""))
# Those that need neither Tk nor files beside them. test1 and test2 are the maintainers' own tests.
EXAMPLES = {
    "simpleTest": [],
    "simpleTest-nonBlocking": [],
    "pController": [],
    "simpleMovement": [],
    "synchronousImageTransmission": [],
    "opencv": ["cv2"],  # shows a picture, here without a screen
}
# An example connects to port 23000, where another program may listen.
RUN = """
import runpy, sys
import coppeliasim_zmqremoteapi_client as blocking
import coppeliasim_zmqremoteapi_client.asyncio as others

def connect_to(port, client):
    begin = client.__init__
    client.__init__ = lambda self, *arguments, **named: begin(self, *arguments, **({'port': port} | named))

for module in (blocking, others):
    connect_to(int(sys.argv[1]), module.RemoteAPIClient)
runpy.run_path(sys.argv[2], run_name='__main__')
"""


@pytest.mark.skipif("BUBBLESIM_CLIENT_EXAMPLES" not in os.environ, reason="BUBBLESIM_CLIENT_EXAMPLES names no folder")
@pytest.mark.parametrize("name", EXAMPLES)
def test_an_example_runs_to_its_end(tmp_path: Path, name: str) -> None:
    for module in EXAMPLES[name]:
        pytest.importorskip(module)
    with RemoteNode(tmp_path, scene="p3dx_floor") as node:
        command = [sys.executable, "-c", RUN, str(node.port), str(FOLDER / f"{name}.py")]
        environment = os.environ | {"QT_QPA_PLATFORM": "offscreen"}
        run = subprocess.run(
            command, env=environment, capture_output=True, text=True, timeout=10 * DEADLINE, check=False
        )
        assert run.returncode == 0, run.stderr
        assert run.stdout.splitlines()[-1] == "Program ended"
