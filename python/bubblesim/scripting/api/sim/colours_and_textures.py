# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions for the looks of objects: colours of entities, textures, lights, images in files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from bubblesim.scripting.api.differences import differs
from bubblesim.scripting.api.kinds import Bytes, Handle, Integers, Vector3
from bubblesim.scripting.api.sim.distances import DistanceFunctions
from bubblesim.scripting.api.sim.logs import LogFunctions

_TEXTURES_STAY = "textures are objects with numbers; here they are those of the file, and the shape keeps its colour"

_SUFFIXES = {"png", "jpg", "jpeg", "bmp", "tga", "ppm"}
_MOST_PIXELS = 64_000_000
_TYPES = (np.uint8, np.int8, np.uint16, np.int16, np.uint32, np.int32, np.float32, np.float64)


class LookFunctions(DistanceFunctions, LogFunctions):
    """Colours have red, green and blue from 0 to 1. Textures cannot be made by scripts: shapes keep their colour."""

    def changeEntityColor(self, entity: int, colour: Vector3, component: int = 0) -> list[dict[str, Any]]:
        """Set the colour of an object or collection; return what restoreEntityColor needs."""
        links = sorted(self._links_of_entity(entity, self.objectspecialproperty_renderable))
        before = []
        for link in links:
            if (known := self._colour(link, component)) is not None:
                before.append({"handle": link, "component": component, "colour": known})
                self.setShapeColor(link, None, component, colour)
        return before

    def restoreEntityColor(self, before: Any) -> None:
        """Set the colours again that changeEntityColor has returned."""
        for each in before if isinstance(before, list | tuple) else ():
            self.setShapeColor(int(each["handle"]), None, int(each["component"]), list(each["colour"]))

    @differs(_TEXTURES_STAY)
    def createTexture(
        self,
        file: str = "",
        options: int = 0,
        plane: Any = None,
        scaling: Any = None,
        angle_and_position: Any = None,
        fixed: Any = None,
        resolution: Any = None,
    ) -> tuple[int, int, list[int]]:
        """Accept a texture, with a warning; return -1, -1 and its resolution."""
        self._warn_of("createTexture", "textures of scripts are not shown")
        size = [int(number) for number in resolution] if isinstance(resolution, list | tuple) else [0, 0]
        return -1, -1, size

    @differs(_TEXTURES_STAY)
    def setShapeTexture(
        self,
        shape: Handle,
        texture: int,
        mapping: int = 0,
        options: int = 0,
        scaling: Any = None,
        position: Any = None,
        orientation: Any = None,
    ) -> int:
        """Accept the texture of a shape, which keeps its colour, with a warning; return 1."""
        self._tree.kind(self._resolve(shape))  # raises
        self._warn_of("setShapeTexture", "textures of scripts are not shown")
        return 1

    @differs(_TEXTURES_STAY)
    def getShapeTextureId(self, shape: Handle) -> int:
        """Return -1: textures have no numbers."""
        self._tree.kind(self._resolve(shape))  # raises
        return -1

    @differs(_TEXTURES_STAY)
    def getTextureId(self, name: str) -> tuple[int, list[int]]:
        """Return -1 and no resolution: textures have no numbers."""
        return -1, [0, 0]

    @differs(_TEXTURES_STAY)
    def writeTexture(self, texture: int, options: int, data: Bytes, *more: Any) -> int:
        """Accept the image of a texture; return 1."""
        return 1

    @differs("it changes a light; here lights stay as the scene's file has them, with a warning")
    def setLightParameters(
        self, light: Handle, state: int, reserved: Any = None, diffuse: Any = None, specular: Any = None
    ) -> int:
        """Accept the state and the colours of a light, with a warning: lights stay as the scene's file has them."""
        self._tree.kind(self._resolve(light))  # raises
        self._warn_of("setLightParameters", "lights stay as they are")
        return 1

    def getLightParameters(self, light: Handle) -> tuple[int, list[float], list[float], list[float]]:
        """Return 1 and white: lights of files are on."""
        self._tree.kind(self._resolve(light))  # raises
        return 1, [0.0, 0.0, 0.0], [1.0, 1.0, 1.0], [1.0, 1.0, 1.0]

    def saveImage(
        self, image: Bytes, resolution: Integers, options: int, file: str, quality: int = -1, reserved: Any = None
    ) -> Any:
        """Write an image, rows from bottom to top: options 1 for four bytes a pixel. For '.png', '.jpg' or '.bmp' as
        the name, return the file as bytes. A path needs a caller that may use files."""
        width, height = resolution
        channels = 4 if options & 1 else 3
        if len(image) != width * height * channels or width * height > _MOST_PIXELS:
            raise ValueError(f"{width} x {height} pixels need {width * height * channels} bytes, found {len(image)}")
        suffix = file.rpartition(".")[2].lower()
        if suffix not in _SUFFIXES:
            raise ValueError(f"'{file}' is not the name of an image: it ends in .png, .jpg, .bmp, .tga or .ppm")
        from PIL import Image

        pixels = np.frombuffer(image, np.uint8).reshape(height, width, channels)[::-1]
        picture = Image.fromarray(np.ascontiguousarray(pixels), "RGBA" if channels == 4 else "RGB")
        if file.startswith("."):
            import io

            buffer = io.BytesIO()
            picture.save(buffer, {"jpg": "jpeg"}.get(suffix, suffix))
            return buffer.getvalue()
        if not self._caller.may_use_files:
            raise PermissionError("sim.saveImage writes files: a Python script may, and clients of --remote-trusted")
        picture.convert("RGB").save(Path(file))
        return 1

    def loadImage(self, options: int, file: Any) -> tuple[bytes, list[int]]:
        """Return the bytes of an image, rows from bottom to top, and its resolution; options 1: four bytes a pixel. The
        file is a path, for a caller that may use files, or the bytes of a file."""
        import io

        from PIL import Image, UnidentifiedImageError

        if isinstance(file, str) and not self._caller.may_use_files:
            raise PermissionError("sim.loadImage reads files: a Python script may, and clients of --remote-trusted")
        if not isinstance(file, str | bytes | bytearray):
            raise TypeError(f"sim.loadImage: argument 2, file: expected a path or bytes, found {type(file).__name__}")
        source = Path(file) if isinstance(file, str) else io.BytesIO(file)
        try:
            with Image.open(source) as picture:
                if picture.width * picture.height > _MOST_PIXELS:
                    raise ValueError(f"an image has at most {_MOST_PIXELS} pixels")
                pixels = np.asarray(picture.convert("RGBA" if options & 1 else "RGB"))[::-1]
        except UnidentifiedImageError:
            raise ValueError("sim.loadImage: the file is not an image of a known format, such as PNG or JPEG") from None
        except OSError as error:
            raise ValueError(f"sim.loadImage: cannot read {file!r}: {error.strerror or error}") from None
        return pixels.tobytes(), [pixels.shape[1], pixels.shape[0]]

    def transformBuffer(self, data: Bytes, from_type: int, factor: float, offset: float, to_type: int) -> bytes:
        """Return numbers of a type, sim.buffer_uint8 for example, times a factor plus an offset, as another type."""
        if not (0 <= from_type < len(_TYPES) and 0 <= to_type & 15 < len(_TYPES)):
            raise ValueError("sim.transformBuffer takes the types sim.buffer_uint8 to buffer_double")
        numbers = np.frombuffer(data, _TYPES[from_type]).astype(np.float64) * factor + offset
        target: Any = _TYPES[to_type & 15]
        if np.issubdtype(target, np.integer):
            numbers = np.clip(numbers, np.iinfo(target).min, np.iinfo(target).max)
        return numbers.astype(target).tobytes()

    def combineRgbImages(
        self, first: Bytes, first_size: Integers, second: Bytes, second_size: Integers, operation: int
    ) -> bytes:
        """Put one image of three bytes a pixel beside another one of the same height, operation 0, or above it, 1."""
        images = []
        for data, (width, height) in ((first, first_size), (second, second_size)):
            images.append(np.frombuffer(data, np.uint8).reshape(height, width, 3))
        return bytes(np.concatenate(images, axis=0 if operation else 1).tobytes())

    def _warn_of(self, function: str, why: str) -> None:
        self.addLog(self.verbosity_scriptwarnings | self.verbosity_once, f"sim.{function}: {why}")
