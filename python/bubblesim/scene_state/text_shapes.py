# SPDX-License-Identifier: BSD-3-Clause
"""The models of words that scripts and programs create: letters of small boxes, without collisions."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

_MOST = 200  # letters
_DEPTH = 0.1  # of the letters, as a part of their height


def text_sdf(text: str, colour: Sequence[float], height: float, *, centred: bool) -> str:
    """Return a static model of a line of words as SDFormat, along x, with its letters up along y.

    :param height: of a capital letter, m.
    :param centred: about the origin; otherwise it begins there.
    """
    from PIL import Image, ImageDraw, ImageFont  # late, because few scripts make words

    if not 0 < len(text) <= _MOST or not text.isprintable():
        raise ValueError(f"a line has 1 to {_MOST} letters, which can be printed, found {text[:20]!r}")
    if not 0 < height < 1e3:
        raise ValueError(f"the height of a line must be from 0 to 1000 m, found {height:g}")
    font = ImageFont.load_default()

    def drawn(words: str) -> np.ndarray[tuple[int, ...], np.dtype[np.bool_]]:
        _, _, right, bottom = font.getbbox(words)
        image = Image.new("1", (max(1, round(right)), max(1, round(bottom))))
        ImageDraw.Draw(image).text((0, 0), words, fill=1, font=font)
        return np.array(image)

    pixels = drawn(text)
    capital = np.flatnonzero(drawn("H").any(axis=1))  # rows of a capital letter, of which the height is meant
    side = height / len(capital)
    middle, base = (pixels.shape[1] / 2 if centred else 0.0), (capital[0] + capital[-1] + 1) / 2
    parts: list[str] = []
    for row, begin, end in _runs(pixels):
        x, y = ((begin + end) / 2 - middle) * side, float(base - row - 0.5) * side
        size = f"{(end - begin) * side!r} {side!r} {_DEPTH * height!r}"
        parts.append(
            f'<visual name="part_{len(parts)}"><pose>{x!r} {y!r} 0 0 0 0</pose><geometry><box><size>{size}</size></box>'
            f"</geometry><material><diffuse>{' '.join(repr(float(c)) for c in colour)} 1</diffuse></material></visual>"
        )
    return (
        f'<sdf version="1.9"><model name="Text"><static>true</static><link name="link">{"".join(parts)}</link></model>'
        "</sdf>"
    )


def _runs(pixels: np.ndarray[tuple[int, ...], np.dtype[np.bool_]]) -> list[tuple[int, int, int]]:
    """Return row, begin and end of the lines of set pixels."""
    runs = []
    for row, line in enumerate(pixels):
        changes = np.flatnonzero(np.diff(np.concatenate([[False], line, [False]]).astype(int)))
        runs += [(row, int(begin), int(end)) for begin, end in zip(changes[::2], changes[1::2], strict=True)]
    return runs
