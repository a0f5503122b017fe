# SPDX-License-Identifier: BSD-3-Clause
"""What a failed test leaves, for those who did not see it run."""

from __future__ import annotations

import contextlib
import re
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from bubblesim.running.recording import Pose, Recording, Sample

_SCENE = re.compile(r"[^\w.-]+")


def keep(files: Path, folder: Path, test: str) -> Path:
    """Copy the files of a test to FOLDER/TEST, and plot the path of each bag beside it; return the copy.

    Files of an earlier run of the test are replaced.
    """
    kept = (folder / _SCENE.sub("_", test).strip("_")).absolute()
    shutil.rmtree(kept, ignore_errors=True)
    shutil.copytree(files, kept, ignore_dangling_symlinks=True, symlinks=True)
    for bag in sorted([*kept.glob("*.bag"), *kept.glob("*.mcap")]):
        with contextlib.suppress(Exception):  # a bag may be cut off, its scene edited: the files are what matters
            _plot(bag)
    return kept


def _plot(bag: Path) -> None:
    scene = bag.with_suffix(".scene").read_text()
    recording = _path_in(bag)
    if len(recording.samples) > 1:
        from bubblesim.running.picture import draw  # matplotlib loads slowly

        draw(scene, recording, bag.with_suffix(".png"))


def _path_in(bag: Path) -> Recording:
    """Return the poses of the first frame on /tf, which is the robot's."""
    from bubblesim.geometry.rotations import heading_of

    recording = Recording()
    frames = None
    for at, message in _transforms(bag):
        for transform in message.transforms:
            found = (transform.header.frame_id, transform.child_frame_id)
            frames = frames or found
            if found == frames:
                place, turn = transform.transform.translation, transform.transform.rotation
                pose = Pose(place.x, place.y, place.z, heading_of(turn.x, turn.y, turn.z, turn.w))
                recording.samples.append(Sample(at, at, pose))
    return recording


def _transforms(bag: Path) -> Iterator[tuple[float, Any]]:
    if bag.suffix == ".mcap":
        from bubblesim.testing.mcap_messages import read_messages  # needs numpy: see pytest_configure() of the plugin

        yield from ((at, message) for _, message, at in read_messages(bag, "/tf"))
        return
    import rosbag  # loads slowly

    with rosbag.Bag(str(bag)) as opened:
        yield from ((stamp.to_sec(), message) for _, message, stamp in opened.read_messages(topics=["/tf"]))
