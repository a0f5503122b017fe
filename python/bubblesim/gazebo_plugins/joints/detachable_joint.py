# SPDX-License-Identifier: BSD-3-Clause
"""gz-sim's DetachableJoint: a link of another model that is attached, and detached by a message."""

from __future__ import annotations

import sys

from bubblesim.gazebo_plugins.plugin import Message, Plugin, PluginContext
from bubblesim.messages.names import did_you_mean, nearest_names
from bubblesim.program.output import write_line

_OWN = "__model__"


class DetachableJoint(Plugin):
    """Messages are std_msgs/Empty; the state, "attached" or "detached", is published when it changes, and kept for
    those who come later.

    The child is held where it is when it is attached. It is looked for until it is there: its model may be added later.
    """

    acts_without_ros = True

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        p = self.parameters
        self._parent = self.part_named(self._required("parent_link"), "parent_link", "link")
        self._child_model = self._required("child_model")
        self._child_link = self._required("child_link")
        self._attaches_at_start = p.flag("initial_attach", default=True)
        self._warns = not p.flag("suppress_child_warning", default=False)
        below = f"/model/{self.world.name(context.model)}/detachable_joint"
        detach_topic = p.text("detach_topic", p.text("topic", f"{below}/detach"))
        attach_topic = p.text("attach_topic", f"{below}/attach")
        child = self.world.name(context.model) if self._child_model == _OWN else self._child_model
        state_topic = p.text("output_topic", f"/model/{child}/detachable_joint/state")
        p.check()
        self._attachment = 0  # of the world; 0: none
        self._wanted = self._attaches_at_start
        self._published = ""  # the state that was published
        self._publisher = -1
        if self.bridge is not None:
            self._publisher = self.advertise(state_topic, "std_msgs/String", 10, latch=True)
        self.subscribe(detach_topic, "std_msgs/Empty", self._detach)
        self.subscribe(attach_topic, "std_msgs/Empty", self._attach)

    def _required(self, name: str) -> str:
        given = self.parameters.given(name)
        if not given:
            raise self.parameters.fail(name, "is missing")
        return given

    def _attach(self, _: Message) -> None:
        self._wanted = True

    def _detach(self, _: Message) -> None:
        self._wanted = False

    def reset(self) -> None:
        """Begin as at first: the reset of the world has ended the attachment."""
        self._attachment = 0
        self._wanted = self._attaches_at_start
        self._published = ""

    def actuate(self) -> None:
        """Attach or detach the child as the last message asks for."""
        if self._attachment and self._attachment not in self.world.attachments:
            self._attachment = 0  # one of the models was removed
            self._wanted = False
        if self._wanted and not self._attachment:
            child = self._find_child()
            if child >= 0:
                self._attachment = self.world.attach(self._parent, child)
        elif self._attachment and not self._wanted:
            self.world.detach(self._attachment)
            self._attachment = 0

    def publish(self) -> None:
        """Publish a new state."""
        state = "attached" if self._attachment else "detached"
        if self._publisher < 0 or state == self._published or (not self._published and state == "detached"):
            return
        self._published = state
        self.bridge.publish(self._publisher, {"data": state})

    def _find_child(self) -> int:
        """Return the handle of the child's link, -1 if it is not there."""
        models = {self.world.name(model): model for model in self.world.models}
        of = self.context.model if self._child_model == _OWN else models.get(self._child_model.rpartition("::")[2], -1)
        links = {} if of < 0 else {self.world.name(link): link for link in self.world.parts(of, "link")}
        if self._child_link in links:
            return int(links[self._child_link])
        if self._warns:
            self._warns = False
            missing, known = (self._child_model, models) if of < 0 else (self._child_link, links)
            kind = "model" if of < 0 else f"link of {self._child_model}"
            hint = did_you_mean(nearest_names(missing, sorted(known)))
            text = f"there is no {kind} '{missing}'{hint}; it is attached when it is added"
            write_line(sys.stderr, f"warning: {self.parameters.title}: {text}")
        return -1
