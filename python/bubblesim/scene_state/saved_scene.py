# SPDX-License-Identifier: BSD-3-Clause
"""The present scene as an SDFormat file: the text of its own file with what was changed."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any
from xml.dom import expatbuilder
from xml.dom.minidom import Document, Element

from bubblesim._core import Scene, SceneView, Simulation
from bubblesim.geometry import rotations
from bubblesim.scene_state.scene_edits import SceneEdits

_READABLE = (".sdf", ".world")
_PLACES_OF_A_FILE = 100_000  # the numbers of places in the tree that a model has are below
# Of a model without a world, and of the empty scene: see the loader.
_WORLD = """\
<?xml version="1.0"?>
<sdf version="1.9" xmlns:bubblesim="https://bubblesim">
  <world name="{name}">
    <physics name="default" type="ode"><max_step_size>0.005</max_step_size></physics>
    <gravity>0 0 -9.81</gravity>
    <model name="ground_plane">
      <static>true</static>
      <link name="link"><collision name="collision"><geometry><plane/></geometry></collision></link>
    </model>
  </world>
</sdf>
"""


def scene_text(simulation: Any, edits: SceneEdits, folder: Path) -> str:
    """Return the scene of a stopped simulation as the text of a file in this folder.

    Models that were removed are left out, those that were added are put in. Poses that differ from those of the file
    are in a <state> element. Colours, masses and friction coefficients that were set are in the links; models of an
    <include> keep the colours of their file. Relative paths in the text become absolute if the scene's file is in
    another folder.

    :raises ValueError: for changes that SDFormat cannot express, and for scenes that are not SDFormat.
    """
    _check(simulation, edits)
    document = _text_of(simulation, folder)
    root: Any = document.documentElement
    world = _children(root, "world")[0]
    beginning = Simulation(simulation.scene)
    start = beginning.world
    here = simulation.world
    own = set(_outermost(start))
    now = set(_outermost(here))
    elements = {str(start.name(model)): _element_of(world, beginning, model) for model in own}
    added = [_added(document, simulation, edits, model, elements) for model in sorted(now - own)]
    for model in own - now:
        _leave_out(elements[str(start.name(model))], str(start.name(model)))
    for number, element in enumerate(added, start=1):
        _renumber_places(element, number * _PLACES_OF_A_FILE)
        world.appendChild(element)
    _write_colours(document, world, here, edits)
    _write_numbers(document, world, here, edits)
    _write_objects(document, world, here, beginning)
    _write_state(document, world, here, [model for model in _outermost(here) if not here.is_static(model)], start, own)
    return document.toxml()


def _check(simulation: Any, edits: SceneEdits) -> None:
    path = simulation.world.path
    left = [f"the name '{name}' of {path(handle)}" for handle, name in edits.names.items()]
    left += [f"the parent of {path(handle)}" for handle in edits.parents]
    left += [f"{path(handle)}, which was added from a file of CoppeliaSim" for handle in edits.foreign]
    left += [f"the static flag of {path(handle)}" for handle in edits.static if handle not in edits.shapes]
    if left:
        raise ValueError(f"the scene cannot be saved: a file has no place for {', '.join(left)}; take it back first")
    scene = Path(simulation.scene_file)
    if scene.name and scene.suffix not in _READABLE:
        raise ValueError(f"the scene of {scene} cannot be saved: its file is not SDFormat (.sdf, .world)")


def _folder(simulation: Any) -> Path:
    return Path(simulation.scene_file).absolute().parent if simulation.scene_file.name else Path.cwd()


def _parsed(text: str) -> Document:
    # Without namespaces: files use prefixes that they do not declare.
    return expatbuilder.parseString(text.encode(), namespaces=False)


def _text_of(simulation: Any, folder: Path) -> Document:
    """Return the scene's file, with a world, as a file in this folder."""
    scene = Path(simulation.scene_file)
    if not scene.name:
        return _parsed(_WORLD.format(name=simulation.world_name))
    document = _parsed(scene.read_text(encoding="utf-8"))
    if folder.absolute() != _folder(simulation):
        root: Any = document.documentElement
        _make_absolute(root, _folder(simulation))
    if simulation.is_model_file:
        outer = _parsed(_WORLD.format(name=simulation.world_name))
        world = _children(outer.documentElement, "world")[0]
        for part in ("model", "light"):
            for element in _children(document.documentElement, part):
                world.appendChild(outer.importNode(element, True))
        return outer
    return document


def _children(element: Any, name: str) -> list[Element]:
    return [child for child in element.childNodes if child.nodeType == child.ELEMENT_NODE and child.tagName == name]


def _make_absolute(element: Element, folder: Path) -> None:
    """Let relative paths of meshes, pictures, included models and scripts lead to the same files from anywhere."""
    for name in ("uri", "bubblesim:child_script", "albedo_map", "diffuse"):
        for each in element.getElementsByTagName(name):
            text: Any = each.firstChild
            path = text.data.strip() if text is not None and text.nodeType == text.TEXT_NODE else ""
            if path and "://" not in path and (folder / path).exists():
                text.data = str(folder / path)


def _outermost(world: Any) -> list[int]:
    return [int(model) for model in world.models]


def _leave_out(element: Any, name: str) -> None:
    if element is None:
        raise ValueError(f"the scene cannot be saved without /{name}: give its <include> a <name>")
    element.parentNode.removeChild(element)


def _element_of(world: Element, beginning: Any, model: int) -> Element | None:
    """Return the <model> or <include> of a model of the file; an <include> without a <name> by its file."""
    name = str(beginning.world.name(model))
    folder = Path(SceneView().model(beginning, model)[0]["file"]).parent.name
    nameless = []
    for element in _children(world, "model") + _children(world, "include"):
        names = [element.getAttribute("name")] if element.tagName == "model" else _texts(element, "name")
        if names == [name]:
            return element
        if not names and [uri.rpartition("/")[2] for uri in _texts(element, "uri")] == [folder]:
            nameless.append(element)
    return nameless[0] if len(nameless) == 1 else None


def _texts(element: Element, name: str) -> list[str]:
    first: list[Any] = [child.firstChild for child in _children(element, name)]
    return [text.data.strip() for text in first if text is not None]


def _added(
    document: Document, simulation: Any, edits: SceneEdits, model: int, elements: Mapping[str, Element | None]
) -> Element:
    """Return the element of an added model; ``elements`` are those of the file's models by their names."""
    name = str(simulation.world.name(model))
    colour = [float(part) for part in simulation.color(model)]
    text = edits.sources.get(model)
    root: Any = document.documentElement
    if text is not None and "<uri>file://" in text and model in edits.shapes:
        raise ValueError(
            f"the scene cannot be saved: the triangles of /{name} were made by a program and have no file: remove it"
        )
    if text is not None:
        found = next(iter(_children(_parsed(text).documentElement, "model")), None)
    else:
        found = elements.get(edits.originals.get(model, ""))
    if found is None:
        raise ValueError(f"the scene cannot be saved: /{name} was added by another program, or is not SDFormat")
    element: Element = document.importNode(found, True)
    if element.tagName == "model":
        element.setAttribute("name", name)
    else:
        _replace(document, element, "name", name)
    _make_absolute(element, _folder(simulation))
    if simulation.world.is_static(model):  # it has no place in <state>
        for pose in _children(element, "pose"):
            element.removeChild(pose)
        element.appendChild(_pose_of(document, simulation.world, model, quaternions=_has_quaternions(root)))
    shape = edits.shapes.get(model)
    if shape is not None and shape.static:
        _append(document, element, "static", "true")
    for visual in element.getElementsByTagName("visual") if shape is not None else ():
        _set_colour(document, visual, colour)
    return element


def _renumber_places(model: Element, offset: int) -> None:
    """Make the places of an added model in the tree distinct from those of other models of the file."""
    for place in model.getElementsByTagName("bubblesim:place"):
        for number in _children(place, "id") + _children(place, "parent"):
            text: Any = number.firstChild
            if int(text.data) >= 0:
                text.data = str(int(text.data) + offset)


def _replace(document: Document, parent: Element, name: str, text: str) -> Element:
    for old in _children(parent, name):
        parent.removeChild(old)
    return _append(document, parent, name, text)


def _set_colour(document: Document, visual: Element, colour: Sequence[float]) -> None:
    material = _replace(document, visual, "material", "")
    _append(document, material, "diffuse", " ".join(map(repr, [*colour, 1.0])))


def _write_colours(document: Document, world: Element, here: Any, edits: SceneEdits) -> None:
    """Give visuals the colours that were set for their links, where the file has them."""
    for link, colour in edits.colours.links.items():
        for element in _elements_of_link(world, here, link):
            for visual in _children(element, "visual"):
                _set_colour(document, visual, colour)


def _write_numbers(document: Document, world: Element, here: Any, edits: SceneEdits) -> None:
    """Give links the masses and friction coefficients that were set."""
    for link, numbers in edits.numbers.links.items():
        elements = _elements_of_link(world, here, link)
        if not elements:
            what = " and ".join(numbers)
            raise ValueError(
                f"the scene cannot be saved: an <include> has no place for the {what} of {here.path(link)}; put them "
                "into the file of the model"
            )
        for element in elements:
            if "mass" in numbers:
                _set_mass(document, element, numbers["mass"])
            for collision in _children(element, "collision") if "friction" in numbers else ():
                ode = collision
                for name in ("surface", "friction", "ode"):
                    ode = next(iter(_children(ode, name)), None) or _append(document, ode, name, "")
                for name in ("mu", "mu2"):
                    _replace(document, ode, name, repr(numbers["friction"]))


def _set_mass(document: Document, link: Element, mass: float) -> None:
    """Set the mass of a link, and scale its inertia."""
    inertial = next(iter(_children(link, "inertial")), None) or _append(document, link, "inertial", "")
    factor = mass / float(next(iter(_texts(inertial, "mass")), "1"))
    inertia = next(iter(_children(inertial, "inertia")), None) or _append(document, inertial, "inertia", "")
    for name, default in (("ixx", "1"), ("iyy", "1"), ("izz", "1"), ("ixy", "0"), ("ixz", "0"), ("iyz", "0")):
        before = float(next(iter(_texts(inertia, name)), default))
        _replace(document, inertia, name, repr(factor * before))
    _replace(document, inertial, "mass", repr(mass))


def _elements_of_link(world: Element, here: Any, link: int) -> list[Element]:
    """Return the <link> of a link; none if it is that of an <include>."""
    places = [world]
    for name in _names(here, link):
        parts = [part for place in places for part in _children(place, "model") + _children(place, "link")]
        places = [part for part in parts if part.getAttribute("name") == name]
    return places


def _names(world: Any, handle: int) -> list[str]:
    """Return the names from the outermost model to an object."""
    above = int(world.part_of(handle))
    return [*(_names(world, above) if above >= 0 else []), str(world.name(handle))]


def _append(document: Document, parent: Element, name: str, text: str) -> Element:
    element: Element = parent.appendChild(document.createElement(name))
    element.appendChild(document.createTextNode(text))
    return element


def _write_state(
    document: Document, world: Element, here: Any, models: Sequence[int], start: Any, own: set[int]
) -> None:
    """Write the poses that differ from those at the start of the file."""

    def moved(handle: int) -> bool:
        return list(here.pose(handle)) != list(start.pose(handle))

    changed = [model for model in models if model not in own or any(map(moved, here.parts(model, "link")))]
    if not changed:
        return
    states = _children(world, "state")
    state = states[0] if states else world.appendChild(document.createElement("state"))
    state.setAttribute("world_name", world.getAttribute("name"))
    root: Any = document.documentElement
    for model in changed:
        for old in _children(state, "model"):
            if old.getAttribute("name") == here.name(model):
                state.removeChild(old)
        state.appendChild(_state_of(document, here, model, quaternions=_has_quaternions(root)))


def _has_quaternions(root: Any) -> bool:
    """Return whether poses of this version of SDFormat can have quaternions."""
    return tuple(map(int, root.getAttribute("version").split(".")[:2])) >= (1, 9)


def _state_of(document: Document, world: Any, handle: int, *, quaternions: bool) -> Element:
    element: Element = document.createElement(str(world.kind(handle)))
    element.setAttribute("name", str(world.name(handle)))
    element.appendChild(_pose_of(document, world, handle, quaternions=quaternions))
    if world.kind(handle) == "model":
        for part in [*world.parts(handle, "model"), *world.parts(handle, "link")]:
            if world.part_of(part) == handle:
                element.appendChild(_state_of(document, world, int(part), quaternions=quaternions))
    return element


def _write_objects(document: Document, world: Element, here: Any, beginning: Any) -> None:
    """Write the poses of the file's <bubblesim:object>s that were moved."""
    root: Any = document.documentElement
    for handle in [int(each.handle) for each in beginning.objects if each.kind == "frame"]:
        if not here.contains(handle) or _in_carrier(here, handle) == _in_carrier(beginning.world, handle):
            continue
        *model, name = _names(beginning.world, handle)
        owners = [each for each in _children(world, "model") if model == [each.getAttribute("name")]]
        objects = [each for owner in owners or [world] for each in _children(owner, "bubblesim:object")]
        for element in [each for each in objects if each.getAttribute("name") == name]:
            for old in _children(element, "pose"):
                element.removeChild(old)
            element.appendChild(_pose_element(document, _in_carrier(here, handle), quaternions=_has_quaternions(root)))


def _in_carrier(world: Any, frame: int) -> list[float]:
    """Return the pose of a frame in the frame of the link that carries it, or in the world."""
    link = int(world.frame_link(frame))
    return list(world.pose(frame) if link < 0 else world.pose_in(frame, link))


def _pose_of(document: Document, world: Any, handle: int, *, quaternions: bool) -> Element:
    return _pose_element(document, world.pose(handle), quaternions=quaternions)


def _pose_element(document: Document, values: Sequence[float], *, quaternions: bool) -> Element:
    pose: Element = document.createElement("pose")
    numbers = [float(number) for number in values]
    if quaternions:
        pose.setAttribute("rotation_format", "quat_xyzw")
    else:
        x, y, z, w = numbers[3:]
        # R = Rz(yaw) Ry(pitch) Rx(roll): the Euler angles of its inverse are -roll, -pitch and -yaw.
        numbers[3:] = [-angle for angle in rotations.euler_angles([-x, -y, -z, w])]
    pose.appendChild(document.createTextNode(" ".join(map(repr, numbers))))
    return pose


def write_scene(text: str, file: Path, *, overwrite: bool) -> None:
    """Write the text of a scene at once, after a check that it can be loaded.

    :raises FileExistsError: if there is such a file and ``overwrite`` is not set.
    """
    descriptor, name = tempfile.mkstemp(suffix=".sdf", prefix=f".{file.stem}-", dir=file.parent)
    try:
        with os.fdopen(descriptor, "w", encoding="utf-8") as output:
            output.write(text + "\n")
        Path(name).chmod(0o644)
        Scene(name)  # raises
        put: Callable[[str, Path], None] = os.replace if overwrite else os.link
        put(name, file)
    except FileExistsError:
        raise FileExistsError(f"{file} exists: it is overwritten only with the flag for it") from None
    finally:
        Path(name).unlink(missing_ok=True)
