# SPDX-License-Identifier: BSD-3-Clause
"""Messages of scripts: levels, the terminal, and what readers get."""

from pathlib import Path

from node_support import run_script


def test_levels_choose_the_stream_and_the_verbosity(tmp_path: Path) -> None:
    code = """
        def sysCall_init():
            sim.addLog(sim.verbosity_errors, 'one')
            sim.addLog(sim.verbosity_scriptwarnings, 'two')
            sim.addLog(sim.verbosity_scriptinfos, 'three')
            sim.addLog(sim.verbosity_debug, 'hidden')
            sim.setStringParam(sim.stringparam_verbosity, 'debug')
            assert sim.getStringParam(sim.stringparam_verbosity) == 'debug'
            sim.addLog(sim.verbosity_debug, 'four')
            sim.setStringParam(sim.stringparam_verbosity, 'warnings')
            sim.addLog(sim.verbosity_infos, 'hidden')
            sim.addLog(sim.verbosity_warnings | sim.verbosity_undecorated, 'five')
            sim.addLog(sim.verbosity_warnings | sim.verbosity_once, 'six')
            sim.addLog(sim.verbosity_warnings | sim.verbosity_once, 'six')
            try:
                sim.setStringParam(sim.stringparam_verbosity, 'loud')
            except ValueError as error:
                assert 'valid ones: none, errors' in str(error)
            sim.addLog('no level', object)
    """
    run = run_script(tmp_path, code, "--strict")
    assert run.returncode == 0, run.stderr
    assert run.stdout.splitlines() == ["info: /Ball: three", "info: /Ball: four"]
    assert run.stderr.splitlines() == ["error: /Ball: one", "warning: /Ball: two", "five", "warning: /Ball: six"]


def test_readers_get_all_messages_with_object_level_and_time(tmp_path: Path) -> None:
    code = """
        import sys
        def sysCall_init(): self.seen = 0
        def sysCall_sensing():
            if sim.getSimulationTime() == 0:
                print('a', 'b', sep='')
                print('to', end='')
                print('gether')
                print('trouble', file=sys.stderr)
                sim.addLog(sim.verbosity_trace, 'detail')
                sim.addLog(sim.verbosity_infos | sim.verbosity_onlyterminal, 'not kept')
                self.seen = 1
            elif self.seen:
                found = sim.getLog(0)
                assert [(e['number'], e['object'], e['level'], e['text']) for e in found['entries']] == [
                    (1, '/Ball', 450, 'ab'), (2, '/Ball', 450, 'together'),
                    (3, '/Ball', 430, 'trouble'), (4, '/Ball', 700, 'detail')], found
                assert {e['time'] for e in found['entries']} == {0.0}
                assert sim.getLog(found['last'])['entries'] == []
                assert [e['text'] for e in sim.getLog(1, 2)['entries']] == ['trouble', 'detail']
                self.seen = 0
                for n in range(6000): sim.addLog(sim.verbosity_debug, n)
                assert len(sim.getLog(0, 10 ** 6)['entries']) == 5000
                print('checked')
    """
    run = run_script(tmp_path, code, "--strict")
    assert run.returncode == 0, run.stderr
    assert "checked" in run.stdout


def test_what_a_script_in_lua_prints_is_kept_too(tmp_path: Path) -> None:
    code = """
        function sysCall_init()
            print('one', 2)
            sim.addLog(sim.verbosity_scripterrors, 'three')
            local entries = sim.getLog().entries
            assert(#entries == 2 and entries[1].text == 'one, 2' or entries[1].text == 'one\\t2', entries[1].text)
            assert(entries[2].level == sim.verbosity_scripterrors and entries[2].object == '/Ball')
            print('checked')
        end
    """
    run = run_script(tmp_path, code, "--strict", name="script.lua")
    assert run.returncode == 0, run.stderr
    assert "checked" in run.stdout
