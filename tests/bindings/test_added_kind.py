# SPDX-License-Identifier: BSD-3-Clause
"""A kind of sensor that a library adds to a running Python (tests/sim/sensors/rate_of_turn.cpp)."""

import os
import subprocess
import sys
from pathlib import Path

from ros_support import REPOSITORY

SCENE = """
<sdf version='1.9' xmlns:bubblesim='https://bubblesim'><world name='w'><gravity>0 0 0</gravity>
<model name='Top'><link name='link'>
  <inertial><mass>1</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz></inertia></inertial>
  <sensor name='Turn' type='rate_of_turn'/>
</link></model></world></sdf>
"""

# Another process, because kinds are never removed. The core loads the library bubblesim first.
PROGRAM = """
import ctypes
import sys

import numpy as np

import bubblesim
from bubblesim import _core
from bubblesim.scene_files.sensor_kinds import page
from message_support import codec

library, scene = sys.argv[1:]
ctypes.CDLL(library).add_rate_of_turn()


def message(reading):
    return {"vector": {"z": reading.rate}}


simulation = bubblesim.Simulation(scene)
simulation.object("/Top").angular_velocity = [0, 0, 2]
simulation.step()
reading = simulation.object("/Turn").reading
assert type(reading) is bubblesim.RateOfTurnReading is _core.RateOfTurnReading
assert (abs(reading.rate - 2) < 1e-9, reading.cut_off, reading.time) == (True, False, simulation.time)
np.testing.assert_allclose(reading.axis, [0, 0, 1], atol=1e-12)
assert (reading.rates.dtype, reading.rates.shape, reading.rates.flags.writeable) == (np.float32, (3,), False)
assert reading._fields == ("rate", "cut_off", "axis", "rates")
assert bubblesim.RateOfTurnReading.rate.__doc__ == "About the sensor's z axis, rad/s."
kept = reading.rates
simulation.object("/Top").angular_velocity = [0, 0, 3]
simulation.step()
assert abs(simulation.object("/Turn").reading.rates[2] - 3) < 1e-6
assert abs(kept[2] - 2) < 1e-6, "a reading that is held does not change"

state = simulation.save()
simulation.step(5)
simulation.restore(state)
assert simulation.save() == state

batch = bubblesim.Batch(scene, 3, observations=["/Turn.rate_of_turn", "/Turn.turn_axis"])
assert batch.step().shape == (3, 4)

sent = codec.encode("geometry_msgs/Vector3Stamped", message(reading))
assert codec.decode("geometry_msgs/Vector3Stamped", sent)["vector"]["z"] == reading.rate

assert "| `rate` | number | rad/s | about the sensor's z axis |" in page()
try:
    _core.read_imu(simulation, simulation.object("/Turn").handle)
except bubblesim.WrongObject as error:
    assert str(error) == "/Turn is a rate-of-turn sensor, not an IMU", error
else:
    raise AssertionError("it is not an IMU")
print("done")
"""


def test_an_added_kind_is_known_everywhere(tmp_path: Path) -> None:
    folder = Path(os.environ.get("BUBBLESIM_BUILD_DIR", REPOSITORY / ".ws" / "devel" / "lib" / "bubblesim"))
    (library,) = folder.rglob("librate_of_turn.so")
    scene = tmp_path / "turn.sdf"
    scene.write_text(SCENE)
    program = tmp_path / "program.py"
    program.write_text(PROGRAM)
    run = subprocess.run(
        [sys.executable, program, library, scene],
        capture_output=True,
        text=True,
        check=False,
        timeout=90,
        env={**os.environ, "PYTHONPATH": f"{REPOSITORY / 'tests' / 'support'}:{os.environ.get('PYTHONPATH', '')}"},
    )
    assert run.stdout == "done\n", run.stderr
