# SPDX-License-Identifier: BSD-3-Clause
"""Named values that scripts share, and tables packed as bytes."""

import struct
from pathlib import Path

import pytest

from bubblesim.scripting.api.sim.sim_module import SimApi
from node_support import in_init, run_script, write

SIM = SimApi.__new__(SimApi)  # packing needs neither a simulation nor a script


def run_in_init(folder: Path, body: str) -> None:
    run = run_script(folder, in_init(body), "--strict", until=0.05)
    assert run.stderr == ""
    assert run.returncode == 0


def test_a_signal_holds_what_was_set_until_it_is_cleared(tmp_path: Path) -> None:
    body = """
for kind, value in (('String', 'text'), ('String', b'\\\\x00\\\\xff'), ('Float', 1.5), ('Int32', -7)):
    get, put, clear = (getattr(sim, f'{verb}{kind}Signal') for verb in ('get', 'set', 'clear'))
    assert get('name') is None
    put('name', value)
    assert get('name') == value
    clear('name')
    assert get('name') is None
    clear('name')
"""
    run_in_init(tmp_path, body.replace("\\\\", "\\"))


def test_a_name_holds_a_value_of_each_kind(tmp_path: Path) -> None:
    body = """
sim.setStringSignal('x', 'text')
sim.setFloatSignal('x', 1.5)
sim.setInt32Signal('x', 2)
assert (sim.getStringSignal('x'), sim.getFloatSignal('x'), sim.getInt32Signal('x')) == ('text', 1.5, 2)
"""
    run_in_init(tmp_path, body)


def test_newer_scripts_find_signals_among_the_properties_of_the_scene(tmp_path: Path) -> None:
    body = """
sim.setIntProperty(sim.handle_scene, 'signal.x', 5)
assert sim.getInt32Signal('x') == sim.getIntProperty(sim.handle_scene, 'signal.x') == 5
sim.setFloatSignal('y', 0.5)
assert sim.getFloatProperty(sim.handle_scene, 'signal.y') == 0.5
sim.setStringProperty(sim.handle_scene, 'signal.z', 'a')
assert sim.getStringSignal('z') == sim.getStringProperty(sim.handle_scene, 'signal.z') == 'a'
try:
    sim.getIntProperty(sim.handle_scene, 'nothing')
except ValueError as error:
    assert "sim.handle_scene and 'signal.NAME'" in str(error)
else:
    raise AssertionError('no error')
"""
    run_in_init(tmp_path, body)


def test_a_vector_is_no_number(tmp_path: Path) -> None:
    body = """
try:
    sim.getIntProperty(sim.handle_scene, 'gravity')
except ValueError as error:
    assert "the property 'gravity' is of type list" in str(error)
else:
    raise AssertionError('no error')
"""
    run_in_init(tmp_path, body)


def test_scripts_share_signals(tmp_path: Path) -> None:
    write(tmp_path / "other.py", "def sysCall_init(): sim.setFloatSignal('from the ramp', 2.5)\n")
    code = """
        def sysCall_init(): pass
        def sysCall_sensing(): print(sim.getFloatSignal('from the ramp'))
    """
    run = run_script(tmp_path, code, "--child-script", f"/Ramp={tmp_path / 'other.py'}", until=0.05)
    assert run.stdout == "2.5\n"


@pytest.mark.parametrize("value", [2**31, -(2**31) - 1])
def test_an_integer_signal_has_32_bits(tmp_path: Path, value: int) -> None:
    run = run_script(tmp_path, f"def sysCall_init(): sim.setInt32Signal('x', {value})\n", "--strict")
    assert f"{value} does not fit into 32 bits" in run.stderr


@pytest.mark.parametrize(
    ("kind", "letter", "numbers"),
    [
        ("UInt8", "B", [0, 1, 255]),
        ("Int32", "i", [-(2**31), 0, 2**31 - 1]),
        ("Float", "f", [0.5, -1.25, 2.0**127]),
        ("Double", "d", [0.1, -1e300, 5e-324]),
    ],
)
def test_numbers_pack_as_little_endian(kind: str, letter: str, numbers: list[float]) -> None:
    pack, unpack = getattr(SIM, f"pack{kind}Table"), getattr(SIM, f"unpack{kind}Table")
    data = pack(numbers)
    assert data == struct.pack(f"<{len(numbers)}{letter}", *numbers)
    assert unpack(data) == numbers
    assert pack(numbers, 1, 2) == data[struct.calcsize(letter) :]
    assert unpack(data, 1) == numbers[1:]
    assert unpack(b"xyz" + data, 0, 2, 3) == numbers[:2]


@pytest.mark.parametrize(
    "call", ["packInt32Table([1, 2], 1, 2)", "packInt32Table([1], -1)", "unpackInt32Table(b'', 0, 1)"]
)
def test_picking_more_than_there_is_is_refused(call: str) -> None:
    with pytest.raises(ValueError, match="exceed"):
        eval(f"sim.{call}", {"sim": SIM})


def test_numbers_that_do_not_fit_are_refused() -> None:
    with pytest.raises(ValueError, match=r"sim\.packUInt8Table: number out of range"):
        SIM.packUInt8Table([256])
    with pytest.raises(ValueError, match=r"sim\.packFloatTable: number out of range"):
        SIM.packFloatTable([1e39])


def test_tables_of_any_nesting_come_back() -> None:
    table = {"name": "Grüezi", "data": b"\x00\xff", "list": [1, -2.5, None, True, {"deep": []}]}
    assert SIM.unpackTable(SIM.packTable(table)) == table


def test_other_bytes_are_no_packed_table() -> None:
    with pytest.raises(ValueError, match=r"sim\.unpackTable: the bytes are not a packed table"):
        SIM.unpackTable(b"\x5a\xff")


def test_what_no_table_may_hold_is_refused() -> None:
    with pytest.raises(TypeError, match=r"sim\.packTable: "):
        SIM.packTable({"x": object()})


def test_small_and_unsigned_integers_are_packed() -> None:
    assert SIM.packUInt16Table([1, 65535]) == struct.pack("<2H", 1, 65535)
    assert SIM.unpackUInt16Table(struct.pack("<2H", 7, 8), 1) == [8]
    assert SIM.unpackUInt32Table(SIM.packUInt32Table([2**32 - 1])) == [2**32 - 1]


def test_strings_are_added_to_a_signal_and_bytes_are_one(tmp_path: Path) -> None:
    body = """
sim.appendStringSignal('log', 'a')
sim.appendStringSignal('log', 'b')
assert sim.getStringSignal('log') == 'ab'
sim.appendStringSignal('log', b'c')
assert sim.getBufferSignal('log') == b'abc'
sim.setBufferSignal('log', b'd')
assert sim.getStringSignal('log') == b'd'
sim.clearBufferSignal('log')
assert sim.getStringSignal('log') is None
"""
    run_in_init(tmp_path, body)


def test_rotations_of_newer_versions_are_those_of_the_older_names() -> None:
    assert SIM.yprToAbg(0.1, 0.2, 0.3) == SIM.yawPitchRollToAlphaBetaGamma(0.1, 0.2, 0.3)
    assert SIM.abgToYpr(0.1, 0.2, 0.3) == SIM.alphaBetaGammaToYawPitchRoll(0.1, 0.2, 0.3)
    assert SIM.buildMatrixQ([1, 2, 3], [0, 0, 0, 1]) == [1, 0, 0, 1, 0, 1, 0, 2, 0, 0, 1, 3]
    assert SIM.getQuaternionInverse([0.5, 0.5, 0.5, 0.5]) == [-0.5, -0.5, -0.5, 0.5]
    assert SIM.getConfigDistance([0, 3.1], [0, -3.1], None, [0, 2]) == pytest.approx(2 * 3.14159265 - 6.2, abs=1e-6)
    assert SIM.getConfigDistance([0, 0], [3, 2], [1, 2]) == 5.0
