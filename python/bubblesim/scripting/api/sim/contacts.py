# SPDX-License-Identifier: BSD-3-Clause
"""The `sim` function for the contact points of all objects."""

from __future__ import annotations

from bubblesim.scripting.api.sim.distances import DistanceFunctions


class ContactFunctions(DistanceFunctions):
    """Contacts that need no contact sensor."""

    def getContactInfo(
        self, dynamic_pass: int, entity: int, index: int
    ) -> tuple[list[int], list[float], list[float], list[float]] | None:
        """Return the two objects of a contact point, its position (m), the force on the first object (N) and the
        direction in which the second one pushes it, in world axes; None (nil) behind the last point.

        ``entity``: the first object, a collection, or sim.handle_all. ``index`` counts its points from 0. They are
        those of the last physics step: ``dynamic_pass`` has no effect.
        """
        if index < 0:
            raise ValueError(f"the index of a contact point must be at least 0, found {index}")
        links: set[int] = set()  # none: all
        if entity != self.handle_all:
            links = {link for each in self._objects_of_entity(entity) for link in self._links(each)}
            if not links:
                return None
        found = self._world.contact_point(index, sorted(links))
        if found is None:
            return None
        first, second, position, force, normal = found
        return [self._shape_of(first), self._shape_of(second)], position, force, normal
