# SPDX-License-Identifier: BSD-3-Clause
"""Tubes between scripts: packets in their order, as many as the reader keeps."""

from pathlib import Path

from node_support import run_script


def test_packets_go_both_ways_in_their_order(tmp_path: Path) -> None:
    code = """
        function sysCall_init()
          local a, b = sim.tubeOpen(0, 'pipe', 2), nil
          assert(sim.tubeStatus(a) == 0 and sim.tubeWrite(a, 'lost') == 0)
          b = sim.tubeOpen(0, 'pipe', 2)
          assert(sim.tubeStatus(a) == 1 and sim.tubeRead(b) == nil)
          assert(sim.tubeWrite(a, 'one') == 1 and sim.tubeWrite(a, 'two') == 1)
          local connected, here, there = sim.tubeStatus(b)
          assert(connected == 1 and here == 2 and there == 0)
          assert(sim.tubeRead(b) == 'one' and sim.tubeRead(b) == 'two' and sim.tubeRead(b) == nil)
          assert(sim.tubeWrite(b, sim.packTable({1, 2})) == 1 and sim.unpackTable(sim.tubeRead(a))[2] == 2)
          assert(sim.tubeClose(b) == 1 and sim.tubeStatus(a) == 0)
          print('done')
        end
    """
    run = run_script(tmp_path, code, "--strict", name="script.lua")
    assert (run.stdout, run.stderr, run.returncode) == ("done\n", "", 0)
