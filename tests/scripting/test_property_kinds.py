# SPDX-License-Identifier: BSD-3-Clause
"""Properties of each kind: what is set is read, by the function of its kind and by getProperty."""

from pathlib import Path

import pytest

from node_support import in_init, run_script

VALUES = {
    "Long": "2**40",
    "Vector2": "[1.5, 2.5]",
    "Vector3": "[1.0, 2.0, 3.0]",
    "Quaternion": "[0.0, 0.0, 0.6, 0.8]",
    "Pose": "[1.0, 2.0, 3.0, 0.0, 0.0, 0.6, 0.8]",
    "FloatArray": "[0.5, 1.5, 2.5, 3.5]",
    "IntArray": "[1, 2, 3, 4]",
    "IntArray2": "[3, 4]",
    "StringArray": "['a', 'b']",
    "Table": "{'a': 1, 'b': [2, 3]}",
}


@pytest.mark.parametrize("kind", VALUES)
def test_what_is_set_is_read(tmp_path: Path, kind: str) -> None:
    body = f"""
value = {VALUES[kind]}
for target, name in ((sim.handle_scene, 'signal.own'), (sim.getObject('.'), 'customData.own')):
    sim.set{kind}Property(target, name, value)
    assert sim.get{kind}Property(target, name) == value, sim.get{kind}Property(target, name)
    assert sim.getProperty(target, name) == value
"""
    run = run_script(tmp_path, in_init(body), "--strict", scene="tricycle", target="/Tricycle", until=0.05)
    assert (run.stderr, run.returncode) == ("", 0)


def test_the_parent_of_an_object_is_a_handle(tmp_path: Path) -> None:
    body = """
first, second = sim.createDummy(0.01), sim.createDummy(0.01)
sim.setHandleProperty(first, 'parent', second)
assert sim.getObjectParent(first) == sim.getHandleProperty(first, 'parent') == second
"""
    run = run_script(tmp_path, in_init(body), "--strict", scene="tricycle", target="/Tricycle", until=0.05)
    assert (run.stderr, run.returncode) == ("", 0)
