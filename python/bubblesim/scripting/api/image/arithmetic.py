# SPDX-License-Identifier: BSD-3-Clause
"""Functions of `simIM` that compute with the numbers of images."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from bubblesim.scripting.api.image.drawing import Array, DrawingFunctions
from bubblesim.scripting.api.kinds import Numbers


class ArithmeticFunctions(DrawingFunctions):
    """Results are rounded to integers and limited to their range in formats that have one. ``K`` in a name stands for a
    constant."""

    def abs(self, image: int, in_place: bool = False) -> int:
        """Return the absolute value of each number."""
        return self._result(image, np.abs(self._at(image)), in_place)

    def absdiff(self, image: int, other: int, in_place: bool = False) -> int:
        """Return the absolute difference of two images."""
        return self._combined(image, self._at(other), lambda a, b: np.abs(a - b), in_place)

    def absdiffK(self, image: int, numbers: Numbers, in_place: bool = False) -> int:
        """Return the absolute difference of an image and numbers, one of each channel."""
        return self._combined(image, self._constant(image, numbers), lambda a, b: np.abs(a - b), in_place)

    def add(self, image: int, other: int, in_place: bool = False) -> int:
        """Return the sum of two images."""
        return self._combined(image, self._at(other), np.add, in_place)

    def addK(self, image: int, numbers: Numbers, in_place: bool = False) -> int:
        """Return the sum of an image and numbers, one of each channel."""
        return self._combined(image, self._constant(image, numbers), np.add, in_place)

    def subtract(self, image: int, other: int, in_place: bool = False) -> int:
        """Return the difference of two images."""
        return self._combined(image, self._at(other), np.subtract, in_place)

    def subtractK(self, image: int, numbers: Numbers, in_place: bool = False) -> int:
        """Return the difference of an image and numbers, one of each channel."""
        return self._combined(image, self._constant(image, numbers), np.subtract, in_place)

    def multiply(self, image: int, other: int, in_place: bool = False) -> int:
        """Return the product of two images."""
        return self._combined(image, self._at(other), np.multiply, in_place)

    def divide(self, image: int, other: int, in_place: bool = False) -> int:
        """Return the quotient of two images; 0 where the second one is 0."""
        return self._combined(image, self._at(other), _quotient, in_place)

    def divideK(self, image: int, numbers: Numbers, in_place: bool = False) -> int:
        """Return the quotient of an image and numbers, one of each channel; 0 for those that are 0."""
        return self._combined(image, self._constant(image, numbers), _quotient, in_place)

    def addWeighted(
        self, image: int, other: int, alpha: float, beta: float, gamma: float, in_place: bool = False
    ) -> int:
        """Return alpha times an image, plus beta times another one, plus gamma."""
        return self._combined(image, self._at(other), lambda a, b: alpha * a + beta * b + gamma, in_place)

    def scaleAdd(self, image: int, alpha: float, other: int, in_place: bool = False) -> int:
        """Return alpha times an image, plus another one."""
        return self._combined(image, self._at(other), lambda a, b: alpha * a + b, in_place)

    def pow(self, image: int, power: float, in_place: bool = False) -> int:
        """Return each number to a power; of its absolute value if the power is no integer."""
        base = self._numbers(image)
        return self._result(
            image, self._as(self._at(image), (base if power == int(power) else abs(base)) ** power), in_place
        )

    def sqrt(self, image: int, in_place: bool = False) -> int:
        """Return the square root of each number."""
        return self._result(image, self._as(self._at(image), np.sqrt(self._numbers(image))), in_place)

    def exp(self, image: int, in_place: bool = False) -> int:
        """Return e to the power of each number."""
        with np.errstate(over="ignore"):
            return self._result(image, self._as(self._at(image), np.exp(self._numbers(image))), in_place)

    def log(self, image: int, in_place: bool = False) -> int:
        """Return the natural logarithm of each number's absolute value; 0 for 0, where there is none."""
        numbers = np.abs(self._numbers(image))
        found = np.log(numbers, out=np.zeros_like(numbers), where=numbers > 0)
        return self._result(image, self._as(self._at(image), found), in_place)

    def bitwiseAnd(self, image: int, other: int, in_place: bool = False) -> int:
        """Return the bits that both images have set."""
        return self._with_bits(image, self._at(other), np.bitwise_and, in_place)

    def bitwiseAndK(self, image: int, numbers: Numbers, in_place: bool = False) -> int:
        """Return the bits that an image and numbers, one of each channel, have set."""
        return self._with_bits(image, self._constant(image, numbers), np.bitwise_and, in_place)

    def bitwiseOr(self, image: int, other: int, in_place: bool = False) -> int:
        """Return the bits that one of two images has set."""
        return self._with_bits(image, self._at(other), np.bitwise_or, in_place)

    def bitwiseOrK(self, image: int, numbers: Numbers, in_place: bool = False) -> int:
        """Return the bits that an image or numbers, one of each channel, have set."""
        return self._with_bits(image, self._constant(image, numbers), np.bitwise_or, in_place)

    def bitwiseXor(self, image: int, other: int, in_place: bool = False) -> int:
        """Return the bits in which two images differ."""
        return self._with_bits(image, self._at(other), np.bitwise_xor, in_place)

    def bitwiseXorK(self, image: int, numbers: Numbers, in_place: bool = False) -> int:
        """Return the bits in which an image differs from numbers, one of each channel."""
        return self._with_bits(image, self._constant(image, numbers), np.bitwise_xor, in_place)

    def bitwiseNot(self, image: int, in_place: bool = False) -> int:
        """Return the bits that an image has not set."""
        return self._with_bits(image, self._at(image), lambda a, _b: np.bitwise_not(a), in_place)

    def mean(self, image: int) -> list[float]:
        """Return the mean of each channel."""
        return [float(number) for number in self._at(image).mean(axis=(0, 1))]

    def min(self, image: int, other: int, in_place: bool = False) -> int:
        """Return the smaller numbers of two images."""
        return self._combined(image, self._at(other), np.minimum, in_place)

    def max(self, image: int, other: int, in_place: bool = False) -> int:
        """Return the larger numbers of two images."""
        return self._combined(image, self._at(other), np.maximum, in_place)

    def greaterThanK(self, image: int, numbers: Numbers, in_place: bool = False) -> int:
        """Return 255 where an image is above numbers, one of each channel, else 0."""
        return self._combined(image, self._constant(image, numbers), lambda a, b: 255.0 * (a > b), in_place)

    def lessThanK(self, image: int, numbers: Numbers, in_place: bool = False) -> int:
        """Return 255 where an image is below numbers, one of each channel, else 0."""
        return self._combined(image, self._constant(image, numbers), lambda a, b: 255.0 * (a < b), in_place)

    def _numbers(self, image: int) -> Array:
        return self._at(image).astype(np.float64)

    def _with_bits(self, image: int, other: Array, action: Callable[[Array, Array], Array], in_place: bool) -> int:
        pixels = self._at(image)
        if not np.issubdtype(pixels.dtype, np.integer):
            raise ValueError(
                "bits are those of formats with integers; simIM.convert makes one, simIM.fmt_8UC3 for example"
            )
        if other.shape not in (pixels.shape, pixels.shape[2:]):
            raise ValueError("the images have different sizes or channels")
        return self._result(image, action(pixels, other.astype(pixels.dtype)), in_place)


def _quotient(numbers: Array, divisors: Array) -> Array:
    return np.divide(numbers, divisors, out=np.zeros_like(numbers), where=divisors != 0)
