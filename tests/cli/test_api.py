# SPDX-License-Identifier: BSD-3-Clause
"""bubblesim api."""

import re

import pytest

from bubblesim.scripting.api.functions import MODULES, functions
from bubblesim.scripting.api.ik import ik_module  # noqa: F401  # registers modules
from bubblesim.scripting.api.image import image_module  # noqa: F401  # registers modules
from bubblesim.scripting.api.ompl import ompl_module  # noqa: F401  # registers modules
from bubblesim.scripting.api.ros import ros_modules  # noqa: F401  # registers modules
from bubblesim.scripting.api.sim import remote_api_module, sim_module  # noqa: F401  # registers modules
from bubblesim.scripting.api.ui import ui_module  # noqa: F401  # registers modules
from bubblesim.scripting.api.vision import vision_module  # noqa: F401  # registers modules
from cli_support import bubblesim
from ros_support import REPOSITORY


def test_all_functions_are_listed() -> None:
    run = bubblesim("api")
    known = [f"{module}.{function.name}" for module in MODULES for function in functions(MODULES[module])]
    assert [line.partition("(")[0] for line in sorted(run.stdout.splitlines())] == sorted(known)


def test_a_module_lists_its_own() -> None:
    lines = bubblesim("api", "simROS").stdout.splitlines()
    assert lines
    assert all(line.startswith("simROS.") for line in lines)


@pytest.mark.parametrize("name", ["sim.setObjectPosition", "setObjectPosition"])
def test_a_function_documents_its_arguments_and_what_it_does(name: str) -> None:
    text = bubblesim("api", name).stdout
    assert text.startswith("sim.setObjectPosition(handle, position, relative_to=-1)\n")
    assert "position     3 numbers\n" in text
    assert "relative_to  the handle of an object, an integer, optional\n" in text
    assert "Set the position of a model, link, hinge or dummy" in text


@pytest.mark.parametrize(
    ("old", "present"),
    [
        ("simGetObjectHandle", "sim.getObjectHandle"),
        ("sim.getIntegerSignal", "sim.getInt32Signal"),
        ("simExtRosInterface_publish", "simROS.publish"),
        ("simIK.createIkGroup", "simIK.createGroup"),
    ],
)
def test_an_old_name_leads_to_the_present_one(old: str, present: str) -> None:
    lines = bubblesim("api", old).stdout.splitlines()
    assert lines[0] == f"{old} is an old name of {present}"
    assert lines[1].startswith(f"{present}(")


def test_a_part_of_a_name_finds_all_that_have_it() -> None:
    text = bubblesim("api", "stringsignal").stdout
    assert {"sim.setStringSignal", "sim.getStringSignal", "sim.clearStringSignal"} <= set(
        text.replace("(", " ").split()
    )


def test_an_unknown_name_brings_similar_ones() -> None:
    run = bubblesim("api", "getObjekt")
    assert (run.returncode, run.stdout) == (2, "")
    assert "there is no script function 'getObjekt'; did you mean getObject" in run.stderr


def test_how_a_function_differs_from_coppeliasims_is_stated() -> None:
    refusing = bubblesim("api", "sim.setObjectParent").stdout
    assert "In CoppeliaSim, it changes any object; here an object held by physics or the file stays" in refusing
    assert "In CoppeliaSim, the result is -1 before the first step" in bubblesim("api", "readProximitySensor").stdout
    assert "In CoppeliaSim, it has an effect; here the call is accepted" in bubblesim("api", "sim.addBanner").stdout
    assert "In CoppeliaSim" not in bubblesim("api", "sim.getObjectPosition").stdout


def test_each_difference_is_a_clause() -> None:
    for module, api in MODULES.items():
        for function in functions(api):
            if function.differs:
                assert "; here" in function.differs, f"{module}.{function.name}"
                assert not function.differs.endswith(".")


def test_functions_that_the_page_names_as_different_state_how() -> None:
    page = (REPOSITORY / "docs/coming_from_coppeliasim.md").read_text()
    table = page.partition("## What differs")[2].partition("\n## ")[0]
    known = {f"{module}.{function.name}": function for module in MODULES for function in functions(MODULES[module])}
    left = [row.split("|")[1] for row in table.splitlines() if row.startswith("|")]
    names = [name for cell in left for name in re.findall(r"`((?:sim\w*\.)?[a-z]\w+)`", cell)]
    named = [name if "." in name else f"sim.{name}" for name in names]
    found = [name for name in named if name in known]
    assert len(found) > 5
    assert [name for name in found if not known[name].differs] == []
