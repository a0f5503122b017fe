# SPDX-License-Identifier: BSD-3-Clause
"""The services that save and restore a state, called by another node."""

from pathlib import Path

from node_support import NAME, Node, findings_of
from ros_support import RosCore, wait_until

PROBE = """
import json, random, rospy
from bubblesim_msgs.srv import RestoreState, SaveState, Step

rospy.init_node('probe')
save = rospy.ServiceProxy('NODE/save_state', SaveState)
restore = rospy.ServiceProxy('NODE/restore_state', RestoreState)
step = rospy.ServiceProxy('NODE/step', Step)
step(5)
first = save().state
step(5)
second = save().state
numbers = random.Random(3)
states = [first[:size] for size in range(0, len(first), 97)]
for _ in range(50):
    changed = bytearray(first)
    changed[numbers.randrange(len(first))] ^= 1 << numbers.randrange(8)
    states.append(bytes(changed))
answers = [restore(state) for state in states]
unchanged = save().state == second
restored = restore(first).success and save().state == first
refused = sum(bool(not answer.success and answer.status_message) for answer in answers)
print(json.dumps({'states': len(states), 'refused': refused, 'unchanged': unchanged, 'restored': restored}))
""".replace("NODE", NAME)


def test_a_damaged_state_is_refused_and_changes_nothing(roscore: RosCore, tmp_path: Path) -> None:
    with Node(roscore.env, tmp_path / "log", "tricycle", "--paused"):
        wait_until(lambda: f"{NAME}/step" in roscore.state()["services"], "the services")
        found = findings_of(PROBE, roscore.env, tmp_path)
    assert found == {"states": found["states"], "refused": found["states"], "unchanged": True, "restored": True}
