# SPDX-License-Identifier: BSD-3-Clause
"""The state of plugins in saved states of a simulation: the values of their attributes, and of objects in these.

Saved are attributes whose values are numbers, strings, arrays or random generators, or containers or objects of this
package that hold such values. Others, such as topics and devices, are not: they have no state, or save it themselves.
"""

from __future__ import annotations

import importlib
from collections import deque
from typing import Any

import numpy as np

_OURS = ("bubblesim.gazebo_plugins.", "bubblesim.controllers.")
_NOT_STATE = ("PluginContext", "Parameters", "Transforms", "StepTime", "UnknownPlugins")
_CONTAINERS: dict[str, Any] = {"tuple": tuple, "list": list, "deque": deque}


class _NotSavedError(Exception):
    pass


def collected(value: Any) -> Any:
    """Return what JSON can hold of the attributes of a plugin, ours or the user's."""
    return _attributes(value, {id(value)})


def _collect(value: Any, seen: set[int]) -> Any:
    if value is None or isinstance(value, bool | int | float | str):
        return value
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, np.ndarray) and value.dtype.kind in "fiub":
        return {"array": value.tolist(), "dtype": value.dtype.str}
    if isinstance(value, np.random.Generator):
        return {"random": value.bit_generator.state}
    for name, kind in _CONTAINERS.items():
        if type(value) is kind:
            return {name: [_collect(item, seen) for item in value]}
    if type(value) is dict:
        return {"dict": [[_collect(key, seen), _collect(item, seen)] for key, item in value.items()]}
    if not _is_ours(value) or id(value) in seen:
        raise _NotSavedError
    seen.add(id(value))
    return _attributes(value, seen)


def _attributes(value: Any, seen: set[int]) -> dict[str, Any]:
    attributes = {}
    for name, item in vars(value).items():
        try:
            attributes[name] = _collect(item, seen)
        except _NotSavedError:
            continue
    return {"object": f"{type(value).__module__}:{type(value).__qualname__}", "attributes": attributes}


def _is_ours(value: Any) -> bool:
    kind = type(value)
    return kind.__module__.startswith(_OURS) and kind.__name__ not in _NOT_STATE and hasattr(value, "__dict__")


def restored(saved: Any, present: Any) -> Any:
    """Return the value that was saved. Changes ``present`` and its parts where they are of the saved kind."""
    if not isinstance(saved, dict):
        return saved
    if "array" in saved:
        return np.array(saved["array"], dtype=saved["dtype"])
    if "random" in saved:
        generator = np.random.default_rng()
        generator.bit_generator.state = saved["random"]
        return generator
    for name, kind in _CONTAINERS.items():
        if name in saved:
            parts = list(present) if isinstance(present, tuple | list | deque) else []
            parts += [None] * (len(saved[name]) - len(parts))
            return kind(restored(item, part) for item, part in zip(saved[name], parts, strict=False))
    if "dict" in saved:
        old = present if isinstance(present, dict) else {}
        keys = [(restored(key, None), item) for key, item in saved["dict"]]
        return {key: restored(item, old.get(key)) for key, item in keys}
    return _restored_object(saved, present)


def _restored_object(saved: dict[str, Any], present: Any) -> Any:
    module, name = saved["object"].split(":")
    if f"{type(present).__module__}:{type(present).__qualname__}" != saved["object"]:
        if not module.startswith(_OURS):
            raise ValueError(f"the saved state has an object of the module {module}, which is not of this package")
        kind: Any = importlib.import_module(module)
        for part in name.split("."):
            kind = getattr(kind, part)
        present = object.__new__(kind)
    for attribute, item in saved["attributes"].items():
        object.__setattr__(present, attribute, restored(item, vars(present).get(attribute)))
    return present
