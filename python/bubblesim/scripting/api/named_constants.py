# SPDX-License-Identifier: BSD-3-Clause
"""Constants by name in a table of a module, simUI.curve_type.time for example."""

from __future__ import annotations

from typing import Any

from bubblesim.messages.names import unknown_attribute


class Names(dict[str, Any]):
    """Constants by name, as attributes in Python."""

    def __getattr__(self, name: str) -> Any:
        """Return a constant."""
        if name in self:
            return self[name]
        raise unknown_attribute(f"there is no {name}; there are {', '.join(self)}")
