# SPDX-License-Identifier: BSD-3-Clause
"""The models of CoppeliaSim's model browser that programs name, and ours that take their places."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from bubblesim._core import scene_folders
from bubblesim.messages.names import did_you_mean, nearest_names

PAGE = "docs/models_of_the_browser.md"

_ABOVE = 0.002  # m: what cameras see of a floor is above the floor of the scene


@dataclass(frozen=True)
class BrowserModel:
    """One of our models. It is found by the names of the files that several versions of CoppeliaSim have."""

    object: str  # the name of its base in scripts
    files: tuple[str, ...]  # without .ttm, some with their folder; capitals, spaces and signs do not count
    model: str  # the folder in scenes/models
    script: str = ""  # a file of the folder, of models that an <include> adds without a script

    def text(self) -> str:
        """Return the text of its file, with its script, and with paths that hold for any folder."""
        folder = Path(scene_folders()[-1]).absolute() / "models" / self.model
        text = (folder / "model.sdf").read_text(encoding="utf-8")
        if self.script and "</bubblesim:place>" in text:  # the first object is the base
            text = text.replace("</bubblesim:place>", f"<script>{self.script}</script></bubblesim:place>", 1)
        elif self.script:
            child_script = f"<bubblesim:child_script>{folder / self.script}</bubblesim:child_script>"
            text = re.sub(r"<model [^>]*>", lambda found: found[0] + child_script, text, count=1)
        return re.sub("<script>(.+?)</script>", lambda found: f"<script>{folder / found[1]}</script>", text)


@dataclass(frozen=True)
class BrowserBox:
    """A wall or a floor. It is static."""

    object: str
    files: tuple[str, ...]
    size: tuple[float, float, float]  # m; it extends along x
    centre: float  # m, its height
    colour: str

    def text(self) -> str:
        """Return the text of a file that has the model."""
        box = f"<geometry><box><size>{' '.join(map(repr, self.size))}</size></box></geometry>"
        return (
            f'<sdf version="1.11"><model name="{self.object}"><static>true</static><pose>0 0 {self.centre} 0 0 0</pose>'
            f'<link name="link"><collision name="box">{box}</collision>'
            f'<visual name="box"><pose>0 0 {_ABOVE} 0 0 0</pose>{box}'
            f"<material><diffuse>{self.colour} 1</diffuse></material></visual></link></model></sdf>"
        )


def _walls() -> Iterator[BrowserBox]:
    for height, thickness in ((80, 0.1), (240, 0.15)):
        for length in (25, 50, 100, 150, 200, 400):
            name, section = f"{height}cmHighWall{length}cm", f"wall section {length}cm"
            files = (f"{height}cm high walls/{section}", name, *([section] if height == 80 else []))
            size = (length / 100, thickness, height / 100)
            yield BrowserBox(name, files, size, height / 200, "0.8 0.78 0.74")


def _floors() -> Iterator[BrowserBox]:
    for side in (3, 5, 10, 15):
        names = (f"{side}m x {side}m wooden floor", f"{side}m x {side}m floor")
        yield BrowserBox("Floor", names, (float(side), float(side), 0.1), -0.05, "0.66 0.5 0.34")
    resizable = ("resizable floor 5-25 meters", "resizable floor 5-25 metres", "ResizableFloor_5_25")
    yield BrowserBox("Floor", resizable, (5.0, 5.0, 0.1), -0.05, "0.72 0.72 0.7")


BROWSER_MODELS: tuple[BrowserModel | BrowserBox, ...] = (
    BrowserModel("PioneerP3DX", ("pioneer p3dx",), "PioneerP3DX", script="avoid_obstacles.py"),
    BrowserModel("ePuck", ("e-puck",), "ePuck"),
    BrowserModel("LineTracer", ("line tracer",), "LineTracer"),
    BrowserModel("bubbleRob", ("bubbleRob",), "TutorialBubbleRob"),
    BrowserModel("Quadcopter", ("Quadcopter", "Quadricopter"), "TargetQuadcopter"),
    BrowserModel("UR3", ("UR3",), "UR3"),
    BrowserModel("UR5", ("UR5",), "UR5"),
    BrowserModel("UR10", ("UR10",), "UR10"),
    BrowserModel("Franka", ("FrankaEmikaPanda", "Franka"), "FrankaEmikaPanda"),
    BrowserModel("RG2", ("RG2",), "RG2"),
    BrowserModel("youBot", ("KUKA YouBot",), "KukaYouBot"),
    BrowserModel("dr12", ("dr12",), "Dr12"),
    BrowserModel("dr20", ("dr20",), "Dr20"),
    BrowserModel("Kilobot", ("Kilobot",), "Kilobot"),
    BrowserModel("BarrettHand", ("BarrettHand",), "BarrettHand"),
    BrowserModel("conveyor", ("conveyor", "conveyor belt", "generic conveyor (belt)"), "Conveyor"),
    BrowserModel("Bill", ("Walking Bill", "path planning Bill"), "Bill", script="walk.py"),
    BrowserModel("Bill", ("Standing Bill", "Bill"), "Bill"),
    BrowserModel("diningChair", ("dining chair",), "chair"),
    BrowserModel("customizableTable", ("customizable table",), "table"),
    BrowserModel("indoorPlant", ("indoorPlant",), "plant"),
    BrowserModel("sofa", ("sofa",), "sofa"),
    *_walls(),
    *_floors(),
)


def browser_model(file: str) -> BrowserModel | BrowserBox | None:
    """Return the model for a path of any system that ends with the name of a file of the browser."""
    folders = [_plain(part) for part in re.split(r"[/\\]", re.sub(r"\.ttm$", "", file, flags=re.IGNORECASE))]
    return _BY_NAME.get("/".join(folders[-2:])) or _BY_NAME.get(folders[-1])


def suggestion(file: str) -> str:
    """Return the end of an error about an unknown name: the nearest one, and where all of them are."""
    names = {_plain(name): name for model in BROWSER_MODELS for name in model.files if "/" not in name}
    nearest = [f"'{names[name]}'" for name in nearest_names(_plain(file), sorted(names))]
    return f"{did_you_mean(nearest)}; {PAGE} lists those of CoppeliaSim's model browser that are known"


def _plain(name: str) -> str:
    return re.sub(r"[^\w/]|_", "", name).casefold()


_BY_NAME = {_plain(name): model for model in BROWSER_MODELS for name in model.files}
