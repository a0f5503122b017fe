# SPDX-License-Identifier: BSD-3-Clause
"""Functions for what is not here: they return what the manual states, and the scripts that call them go on."""

from pathlib import Path

import pytest

from node_support import REFUSED, in_init, run_script

MAIN_SCRIPTS = {  # what each returns when a main script calls it: objects that were handled, or 1
    "handleSimulationStart": None,
    "handleSensingStart": None,
    "handleJointMotion": None,
    "handleExtCalls": None,
    "handleDynamics": 1,
    "handleMechanism": 1,
    "handleModule": 1,
    "handlePath": 1,
    "handleMill": 0,
    "handleMainScript": 0,
    "handleGeneralCallbackScript": 0,
    "handleChildScript": 0,
    "launchThreadedChildScripts": 0,
    "delegateChildScriptExecution": 0,
    "resumeThreads": 0,
    "openModule": 1,
    "closeModule": 1,
    "resetCollision": 1,
    "resetDistance": 1,
    "resetMilling": 1,
    "resetProximitySensor": 1,
    "resetVisionSensor": 1,
    "handleCollision": 0,
    "handleDistance": (0, 0.0),
    "handleIkGroup": 0,  # sim.ikresult_not_performed
    "advanceSimulationByOneStep": 1,
    "getRealTimeSimulation": 0,
    "isRealTimeSimulationStepNeeded": 0,
    "getSimulationPassesPerRenderingPass": 1,
}
SCRIPTS_OF_SCRIPTS = (
    "handleChildScripts handleCustomizationScripts handleAddOnScripts handleSandboxScript handleEmbeddedScripts "
    "handleSimulationScripts"
)
WINDOW = """
assert sim.addBanner('text', 0.1, 0, [0] * 6, sim.handle_self, [1] * 12) == 1 and sim.removeBanner(1) == 1
assert sim.addGhost(0, sim.handle_self, 0, 0, 0) == 1 and sim.modifyGhost(0, 1, 0, 0) == 1
assert sim.adjustView(0, sim.handle_self, 0) == 1 and sim.cameraFitToView(0) == 1
view = sim.floatingViewAdd(0.2, 0.8, 0.4, 0.4, 0)
assert view >= 0 and sim.floatingViewRemove(view) == 1
assert sim.refreshDialogs() == 1 and sim.announceSceneContentChange() == 1
assert (sim.getPage(), sim.setPage(1), sim.getNavigationMode(), sim.setNavigationMode(0)) == (0, 1, 0, 1)
assert isinstance(sim.moduleEntry(-1, 'entry'), int)
assert sim.enableEventCallback(True, 'plugin') == 1 and sim.getGenesisEvents() == []
for name in ('setEventFilters', 'pushUserEvent', 'setDebugWatchList', 'setPluginInfo', 'setModuleInfo', 'setStepper'):
    assert getattr(sim, name)('name', 0) is None
assert sim.setSimulationPassesPerRenderingPass(2) == 1 and sim.adjustRealTimeTimer(0, 0.1) == 1
assert sim.getSimulatorMessage()[0] == -1
assert sim.getUserVariables() == [] and sim.getStackTraceback() == ''
assert sim.saveUI(0, 'file') == 0 and sim.loadUI('file', 0) == 0
assert sim.fileDialog(0, 'title', '', '', 'any', '*') is None
assert sim.msgBox(sim.msgbox_type_info, sim.msgbox_buttons_ok, 'title', 'text') == sim.msgbox_return_ok
assert sim.msgBox(sim.msgbox_type_info, sim.msgbox_buttons_yesno, 'title', 'text') == sim.msgbox_return_yes
assert isinstance(sim.textEditorOpen('text'), int)
"""
OLD_CALCULATIONS = """
joint = sim.getObject('/FrontMotor')
for name in ('getIkGroupHandle', 'getMechanismHandle', 'getPathPlanningHandle', 'getMotionPlanningHandle'):
    assert getattr(sim, name)('name') == 0
assert sim.checkIkGroup(0, [joint]) == (sim.ikresult_not_performed, [sim.getJointPosition(joint)])
assert sim.createIkElement(0, 0, [0, 0, 0, 0]) == 1 and sim.removeIkGroup(0) == 1
assert sim.setIkGroupProperties(0, 0, 3, 0.1) == 1 and sim.setIkElementProperties(0, joint, 7) == 1
assert sim.computeJacobian(0) == -1 and sim.getIkGroupMatrix(0) == ([], [0, 0]) and sim.exportIk('file') == 0
for name in ('generateIkPath', 'getConfigForTipPose'):
    assert getattr(sim, name)(0, [joint], 10) is None
for name in ('findIkPath', 'findMpPath', 'getMpConfigForTipPose'):
    assert getattr(sim, name)(0) is None
assert (sim.searchPath(0), sim.initializePathSearch(0), sim.performPathSearchStep(0)) == (0, -1, 0)
assert 'sim.moveToConfig' in refused(sim.generateTimeOptimalTrajectory)
assert sim.readCollision(0) == 0
"""
MODULES = """
plugins = sim.getLoadedPlugins()
assert plugins and sim.getPluginName(0)[0] == plugins[0]
assert sim.getPluginName(len(plugins)) is None
assert sim.getPluginInfo('simIK', 0) in ('', 0) and sim.getModuleInfo('simIK', 0) in ('', 0)
assert (sim.loadModule('file', 'simIK'), sim.loadModule('file', 'simNothing')) == (1, -3)
assert sim.unloadModule(0) == 1 and sim.unloadPlugin('simIK') is None and sim.sendModuleMessage(0, 0) == 0
assert sim.registerScriptFunction('f@x') == 1 and sim.registerScriptVariable('v') == 1
assert sim.registerScriptFuncHook('sysCall_init', 'f') == -1 and sim.isDeprecated('sim.wait') == -1
assert sim.setNameSuffix(2) == 1 and sim.setAutoYieldDelay(0.002) is None
"""
DEVICES = """
car = sim.getObject('.')
assert (sim.serialOpen('/dev/null'), sim.serialCheck(0), sim.serialSend(0, 'x'), sim.serialClose(0)) == (-1, 0, 0, 0)
assert sim.serialRead(0) is None
sensor = sim.getObject('/FrontSonar')
assert sim.setExplicitHandling(sensor, 1) == 1 and sim.getExplicitHandling(sensor) == 0
assert sim.getMaterialId('rough') == -1 and sim.setShapeMaterial(car, 1) == 1
assert sim.getShapeTextureId(car) == -1 and sim.getTextureId('wood')[0] == -1
assert sim.createTexture('', 0, None, None, None, 0, [8, 4]) == (-1, -1, [8, 4])
assert sim.setShapeTexture(car, 1) == 1 and sim.writeTexture(1, 0, b'') == 1 and not sim.readTexture(1)
assert sim.getLightParameters(car)[0] == 1 and isinstance(sim.setLightParameters(car, 0), int)
assert sim.getExtensionString(car) == ''
assert sim.relocateShapeFrame(car) == 0 and sim.alignShapeBB(car) == 0 and sim.reorientShapeBoundingBox(car) == 0
assert sim.setScriptVariable('v', car, 1) == -1 and sim.getCustomizationScriptAssociatedWithObject(car) == -1
assert sim.setObjectHierarchyOrder(car, 1) is None
assert sim.getScriptInt32Param(car, sim.scriptattribute_enabled) == 1
assert sim.getScriptAttribute(car, sim.scriptattribute_enabled) == 1
sim.setScriptInt32Param(car, sim.scriptattribute_enabled, 1)
sim.setScriptAttribute(car, sim.scriptattribute_enabled, 1)
sim.setScriptStringParam(car, sim.scriptstringparam_text, '')
assert 'sysCall_init' in sim.getScriptStringParam(car, sim.scriptstringparam_text)
assert sim.systemSemaphore('name', True) is True
assert sim.getLastInfo() == '' and sim.getLastError() is None and sim.setLastError('f', 'text') == 1
"""


def check(folder: Path, body: str) -> None:
    code = REFUSED + in_init(body) + "def sysCall_cleanup():\n    print('to the end')\n"
    run = run_script(folder, code, scene="tricycle", target="/Tricycle", until=0.1)
    assert "failed" not in run.stderr
    assert (run.stdout.splitlines()[-1], run.returncode) == ("to the end", 0)


def test_functions_of_main_scripts_return_what_a_main_script_takes(tmp_path: Path) -> None:
    body = f"""
for name, result in {MAIN_SCRIPTS}.items():
    assert getattr(sim, name)() == result, name
for name in '{SCRIPTS_OF_SCRIPTS}'.split():
    assert getattr(sim, name)(sim.syscb_actuation) == 0, name
"""
    check(tmp_path, body)


@pytest.mark.parametrize(
    "body", [WINDOW, OLD_CALCULATIONS, MODULES, DEVICES], ids=["window", "old", "modules", "devices"]
)
def test_calls_without_effect_return_as_the_manual_states(tmp_path: Path, body: str) -> None:
    check(tmp_path, body)


def test_the_legacy_remote_api_is_not_started(tmp_path: Path) -> None:
    body = """
assert simRemoteApi.start(19997) == simRemoteApi.stop(19997) == simRemoteApi.reset(19997) == -1
assert simRemoteApi.status(19997)[0] == -1
"""
    check(tmp_path, body)
