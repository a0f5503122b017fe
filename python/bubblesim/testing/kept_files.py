# SPDX-License-Identifier: BSD-3-Clause
"""What a failed test leaves, for those who did not see it run."""

from __future__ import annotations

import contextlib
import re
import shutil
from pathlib import Path

from bubblesim.running.recording import Pose, Recording, Sample

_SCENE = re.compile(r"[^\w.-]+")


def keep(files: Path, folder: Path, test: str) -> Path:
    """Copy the files of a test to FOLDER/TEST, and plot the path of each bag beside it; return the copy.

    Files of an earlier run of the test are replaced.
    """
    kept = (folder / _SCENE.sub("_", test).strip("_")).absolute()
    shutil.rmtree(kept, ignore_errors=True)
    shutil.copytree(files, kept, ignore_dangling_symlinks=True, symlinks=True)
    for bag in sorted(kept.glob("*.bag")):
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
    import rosbag

    from bubblesim.geometry.rotations import heading_of

    recording = Recording()
    frames = None
    with rosbag.Bag(str(bag)) as messages:
        for _, message, stamp in messages.read_messages(topics=["/tf"]):
            for transform in message.transforms:
                found = (transform.header.frame_id, transform.child_frame_id)
                frames = frames or found
                if found == frames:
                    place, turn = transform.transform.translation, transform.transform.rotation
                    pose = Pose(place.x, place.y, place.z, heading_of(turn.x, turn.y, turn.z, turn.w))
                    recording.samples.append(Sample(stamp.to_sec(), stamp.to_sec(), pose))
    return recording
