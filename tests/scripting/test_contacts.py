# SPDX-License-Identifier: BSD-3-Clause
"""sim.getContactInfo: the contact points of all objects, as CoppeliaSim's display of contacts asks for them."""

from pathlib import Path

from node_support import run_script

CODE = """
    function sysCall_init() ball, floor = sim.getObject('/Ball'), sim.getObject('/Floor') end
    local function report(name, entity)
        local index = 0
        while true do
            local objects, position, force, normal = sim.getContactInfo(sim.handle_all, entity, index)
            if not objects then return print(name, index) end
            if index == 0 then
                local first, second = sim.getObjectAlias(objects[1]), sim.getObjectAlias(objects[2])
                print(name, first, second, {force[3] > 0, normal[3] > 0}, #position)
            end
            index = index + 1
        end
    end
    function sysCall_sensing()
        if reported or not sim.getContactInfo(0, floor, 0) then return end
        reported = true
        report('ball', ball)
        report('floor', floor)
        report('all', sim.handle_all)
    end
"""


def test_points_are_listed_with_the_object_that_was_asked_for_first(tmp_path: Path) -> None:
    run = run_script(tmp_path, CODE, "--strict", name="script.lua", until=4.0)
    assert run.stderr == ""
    reported = run.stdout.splitlines()
    assert reported[0] == "ball\tBall\tFloor\t{true, true}\t3"
    assert reported[2] == "floor\tFloor\tBall\t{false, false}\t3"
    assert [reported[1], reported[3], reported[5]] == ["ball\t1", "floor\t1", "all\t1"]


def test_a_sphere_in_the_middle_of_a_cylinder_comes_out(tmp_path: Path) -> None:
    code = """
        function sysCall_init()
            shapes = {}
            for kind = 1, 2 do
                shapes[kind] = sim.createPureShape(kind, 8, {0.1, 0.1, 0.1}, 1)
                sim.setObjectPosition(shapes[kind], -1, {1, 1, 0.05})
            end
        end
        function sysCall_cleanup()
            for _, shape in ipairs(shapes) do
                local place = sim.getObjectPosition(shape, -1)
                print(math.abs(place[1] - 1) < 0.01 and place[3] > 0.04 and place[3] < 0.2)
            end
        end
    """
    run = run_script(tmp_path, code, "--strict", name="script.lua", scene="p3dx_floor", target="/Floor", until=0.5)
    assert (run.stderr, run.stdout) == ("", "true\ntrue\n")
