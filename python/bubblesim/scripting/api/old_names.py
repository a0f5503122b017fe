# SPDX-License-Identifier: BSD-3-Clause
"""Names of functions and constants in older versions of CoppeliaSim and in V-REP, and the names that they have here.

One table: the modules answer to the old names, the reference page lists them. Names that functions here still have are
not in it.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from types import MappingProxyType

from bubblesim.program.output import write_line
from bubblesim.scene_state import log
from bubblesim.scripting.caller import Caller

# By module: the old name and the present one.
RENAMED: dict[str, Mapping[str, str]] = {
    "sim": {
        "setIntegerSignal": "setInt32Signal",
        "getIntegerSignal": "getInt32Signal",
        "clearIntegerSignal": "clearInt32Signal",
        "setDoubleSignal": "setFloatSignal",
        "getDoubleSignal": "getFloatSignal",
        "clearDoubleSignal": "clearFloatSignal",
        "getInt32Parameter": "getInt32Param",
        "setInt32Parameter": "setInt32Param",
        "getIntegerParameter": "getInt32Param",
        "setIntegerParameter": "setInt32Param",
        "getFloatParameter": "getFloatParam",
        "setFloatParameter": "setFloatParam",
        "getFloatingParameter": "getFloatParam",
        "setFloatingParameter": "setFloatParam",
        "getBoolParameter": "getBoolParam",
        "setBoolParameter": "setBoolParam",
        "getBooleanParameter": "getBoolParam",
        "setBooleanParameter": "setBoolParam",
        "getStringParameter": "getStringParam",
        "setStringParameter": "setStringParam",
        "getArrayParameter": "getArrayParam",
        "setArrayParameter": "setArrayParam",
        "setObjectInt32Parameter": "setObjectInt32Param",
        "getObjectIntParameter": "getObjectInt32Parameter",
        "setObjectIntParameter": "setObjectInt32Param",
        "setObjectFloatParameter": "setObjectFloatParam",
        "setObjectStringParameter": "setObjectStringParam",
        "getObjectBoolParameter": "getObjectBoolParam",
        "setObjectBoolParameter": "setObjectBoolParam",
        "getEngineInt32Parameter": "getEngineInt32Param",
        "setEngineInt32Parameter": "setEngineInt32Param",
        "getEngineFloatParameter": "getEngineFloatParam",
        "setEngineFloatParameter": "setEngineFloatParam",
        "getEngineBoolParameter": "getEngineBoolParam",
        "setEngineBoolParameter": "setEngineBoolParam",
        "getVelocity": "getObjectVelocity",
        "getInvertedMatrix": "getMatrixInverse",
        "isHandleValid": "isHandle",
        "lockResources": "acquireLock",
        "unlockResources": "releaseLock",
        "boolAnd16": "boolAnd32",
        "boolOr16": "boolOr32",
        "boolXor16": "boolXor32",
        "packInts": "packInt32Table",
        "packFloats": "packFloatTable",
        "packBytes": "packUInt8Table",
        "unpackInts": "unpackInt32Table",
        "unpackFloats": "unpackFloatTable",
        "unpackBytes": "unpackUInt8Table",
        "createMeshShape": "createShape",
        "switchThreads": "switchThread",
    },
    "simIK": {
        "createIkGroup": "createGroup",
        "eraseIkGroup": "eraseGroup",
        "getIkGroupHandle": "getGroupHandle",
        "doesIkGroupExist": "doesGroupExist",
        "getIkGroupFlags": "getGroupFlags",
        "setIkGroupFlags": "setGroupFlags",
        "getIkGroupCalculation": "getGroupCalculation",
        "setIkGroupCalculation": "setGroupCalculation",
        "handleIkGroup": "handleGroup",
        "addIkElement": "addElement",
        "addIkElementFromScene": "addElementFromScene",
        "applyIkEnvironmentToScene": "applyEnvironmentToScene",
        "getIkElementFlags": "getElementFlags",
        "setIkElementFlags": "setElementFlags",
        "getIkElementBase": "getElementBase",
        "setIkElementBase": "setElementBase",
        "getIkElementConstraints": "getElementConstraints",
        "setIkElementConstraints": "setElementConstraints",
        "getIkElementPrecision": "getElementPrecision",
        "setIkElementPrecision": "setElementPrecision",
        "getIkElementWeights": "getElementWeights",
        "setIkElementWeights": "setElementWeights",
        "setLinkedDummy": "setTargetDummy",
        "getLinkedDummy": "getTargetDummy",
        "generateIkPath": "generatePath",
    },
}

# Functions of V-REP 3 with names of their own, without `sim`.
OF_V_REP = {
    "GetInvertedMatrix": "getMatrixInverse",
    "GetObjectLastUniqueIdentifier": "getObjectUid",
    "JointGetForce": "getJointForce",
    "ExtLaunchExecutable": "launchExecutable",
    "GetSystemTimeInMilliseconds": "getSystemTimeInMs",
}
# Beginnings of the functions of V-REP's plugins, which were functions of the global namespace.
OF_PLUGINS = {
    "simExtRosInterface_": "simROS",
    "simExtROS_": "simROS",
    "simExtCustomUI_": "simUI",
    "simExtVision_": "simVision",
    "simExtOMPL_": "simOMPL",
    "simExtRemoteApi": "simRemoteApi",
    "simExtRemoteApi_": "simRemoteApi",
}
_V_REP_NAME = re.compile(r"sim(?:_\w+|[A-Z]\w*|rml_\w+)\Z", re.ASCII)

Exists = Callable[[str, str], bool]
"""Whether a module, by name, has a function or constant."""


def present_name(module: str, name: str) -> str | None:
    """Return the present name of a function of a module; None if it is not an old name."""
    return RENAMED.get(module, {}).get(name)


def of_v_rep(name: str, exists: Exists) -> tuple[str, str] | None:
    """Return module and name of what a script of V-REP 3 knows as a global, ``simGetObjectHandle`` for example.

    :return: None if ``name`` is no such name, or nothing here has it.
    """
    if not _V_REP_NAME.match(name):
        return None
    for module, present in _candidates(name):
        present = present_name(module, present) or present
        if exists(module, present):
            return module, present
    return None


def _candidates(name: str) -> Iterator[tuple[str, str]]:
    for beginning, module in OF_PLUGINS.items():
        if name.startswith(beginning):
            rest = name.removeprefix(beginning)
            yield module, rest[:1].lower() + rest[1:]
    rest = name.removeprefix("sim")
    if rest.startswith("_"):  # a constant
        yield "sim", rest[1:]
    elif rest.startswith("rml_"):
        yield "sim", rest
    elif rest in OF_V_REP:
        yield "sim", OF_V_REP[rest]
    elif rest.startswith("RML"):
        yield "sim", "rml" + rest[3:]
    else:
        yield "sim", rest[0].lower() + rest[1:]


def names_to(module: str, exists: Exists) -> Mapping[str, str]:
    """Return the old names of a module's functions that are there, with the present ones."""
    known = RENAMED.get(module, {})
    return MappingProxyType({old: new for old, new in known.items() if exists(module, new)})


def of_functions(present: Mapping[str, Sequence[str]]) -> dict[str, str]:
    """Return the old names of functions, with their module where they have one, and the present ones.

    :param present: the names of functions by module.
    """
    of_v_rep_3 = {f"sim{name[0].upper()}{name[1:]}": f"sim.{name}" for name in present.get("sim", ())}
    of_plugins = {
        f"{beginning}{name}": f"{module}.{name}"
        for beginning, module in OF_PLUGINS.items()
        for name in present.get(module, ())
    }
    renamed = {
        f"{module}.{old}": f"{module}.{new}"
        for module, names in RENAMED.items()
        for old, new in names.items()
        if new in present.get(module, ())
    }
    globals_of_renamed = {
        f"sim{old[4].upper()}{old[5:]}": new for old, new in renamed.items() if old.startswith("sim.")
    }
    others = {f"sim{old}": f"sim.{new}" for old, new in OF_V_REP.items() if new in present.get("sim", ())}
    return {**of_v_rep_3, **globals_of_renamed, **of_plugins, **renamed, **others}


def note_old_name(caller: Caller, old: str, new: str) -> None:
    """Log the first old name that a caller uses, with the present one."""
    if caller.uses_old_names:
        return
    caller.uses_old_names = True
    line = (
        f"{caller.object_path} uses names of older versions: {old} is now {new}; all: docs/child_scripts/old_names.md"
    )
    write_line(sys.stderr, f"info: {line}")
    caller.shared.log.add(log.INFO, caller.object_path, line)
