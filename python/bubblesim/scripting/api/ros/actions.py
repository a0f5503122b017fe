# SPDX-License-Identifier: BSD-3-Clause
"""`simROS2` functions for actions: those of ROS 2, or with actionlib's protocol on ROS 1."""

from __future__ import annotations

from typing import Any

from bubblesim.scripting.api.ros.action_client import ActionClient, ResultCode
from bubblesim.scripting.api.ros.action_server import ACCEPT, DEFER, REJECT, ActionServer
from bubblesim.scripting.api.ros.action_topics import ActionTopics, GoalStatus
from bubblesim.scripting.api.ros.context import RosContext
from bubblesim.scripting.api.ros.kinds import CallbackOrName, RosHandle
from bubblesim.scripting.api.ros.ros2_action_client import Ros2ActionClient
from bubblesim.scripting.api.ros.ros2_action_parts import Ros2ActionParts
from bubblesim.scripting.api.ros.ros2_action_server import Ros2ActionServer
from bubblesim.scripting.api.ros.stamps import Message
from bubblesim.scripting.caller import Caller


class RosActions(RosContext):
    """Action clients and servers of one script; they are shut down when the script ends.

    An action type is `actionlib/Test` or `actionlib/action/Test`. On ROS 1, the messages TestActionGoal,
    TestActionFeedback and TestActionResult must exist; on ROS 2, the file Test.action or these messages.
    """

    action_result_code_succeeded = int(ResultCode.SUCCEEDED)
    action_result_code_aborted = int(ResultCode.ABORTED)
    action_result_code_canceled = int(ResultCode.CANCELED)
    action_result_code_unknown = int(ResultCode.UNKNOWN)
    goal_response_reject = REJECT
    goal_response_accept_and_execute = ACCEPT
    goal_response_accept_and_defer = DEFER
    cancel_response_reject = REJECT
    cancel_response_accept = ACCEPT

    def __init__(self, bridge: Any, simulation: Any, caller: Caller) -> None:
        """Bind the functions to one script."""
        super().__init__(bridge, simulation, caller)
        self._action_clients: dict[int, ActionClient | Ros2ActionClient] = {}
        self._action_servers: dict[int, ActionServer | Ros2ActionServer] = {}

    def createActionClient(
        self,
        name: str,
        action_type: str,
        goal_response_callback: CallbackOrName,
        feedback_callback: CallbackOrName,
        result_callback: CallbackOrName,
    ) -> int:
        """Create an action client and return its handle.

        ``goal_response_callback(goal_id, accepted)`` is called once per goal. For an accepted goal,
        ``feedback_callback(goal_id, feedback)`` is called with each feedback, and ``result_callback(goal_id, code,
        result)`` once. The code is one of simROS2.action_result_code_succeeded (4), _canceled (5), _aborted (6), with
        the values of ROS 2, and _unknown (0) for a goal that the server does not know any more.
        """
        callbacks = map(self._caller.callback, (goal_response_callback, feedback_callback, result_callback))
        made = self._make(ActionClient, Ros2ActionClient, name, action_type, *callbacks)
        client: ActionClient | Ros2ActionClient = made
        self._action_clients[client.handle] = client
        self._caller.in_each_step["action client", client.handle] = client.send_outgoing
        self._caller.at_end["action client", client.handle] = lambda: self.shutdownActionClient(client.handle)
        return client.handle

    def sendGoal(self, client: RosHandle, goal: Message) -> str:
        """Send a goal and return its id. Without a server, it is sent when one connects; the call does not wait."""
        return self._action_client(client).send_goal(goal)

    def cancelLastGoal(self, client: RosHandle) -> bool:
        """Request the server to cancel the last goal; return False if there is none or it has ended."""
        return self._action_client(client).cancel_last_goal()

    def shutdownActionClient(self, client: RosHandle) -> None:
        """Shut down a client; its goals continue, and its handle becomes invalid."""
        self._action_client(client).close()
        del self._action_clients[client]
        self._forget("action client", client)

    def createActionServer(
        self,
        name: str,
        action_type: str,
        handle_goal_callback: CallbackOrName,
        handle_cancel_callback: CallbackOrName,
        handle_accepted_callback: CallbackOrName,
    ) -> int:
        """Create an action server and return its handle.

        ``handle_goal_callback(goal_id, goal)`` returns whether to accept a goal: False, True, or one of
        simROS2.goal_response_reject, _accept_and_execute, _accept_and_defer (then the goal is pending until
        actionServerActionExecute). ``handle_cancel_callback(goal_id, goal)`` returns whether to accept a cancel
        request, which actionServerActionCanceled then completes. ``handle_accepted_callback(goal_id, goal)`` starts the
        goal's execution.
        """
        handle_goal = self._caller.answering_callback(handle_goal_callback, _check_goal_response)
        handle_cancel = self._caller.answering_callback(handle_cancel_callback, _check_cancel_response)
        handle_accepted = self._caller.callback(handle_accepted_callback)
        callbacks = handle_goal, handle_cancel, handle_accepted
        made = self._make(ActionServer, Ros2ActionServer, name, action_type, *callbacks)
        server: ActionServer | Ros2ActionServer = made
        self._action_servers[server.handle] = server
        self._caller.in_each_step["action server", server.handle] = server.publish_status_when_due
        self._caller.at_end["action server", server.handle] = lambda: self.shutdownActionServer(server.handle)
        return server.handle

    def shutdownActionServer(self, server: RosHandle) -> None:
        """Shut down an action server; its handle becomes invalid."""
        self._action_server(server).close()
        del self._action_servers[server]
        self._forget("action server", server)

    def actionServerPublishFeedback(self, server: RosHandle, goal_id: str, feedback: Message) -> None:
        """Publish feedback on a goal to its client."""
        self._action_server(server).publish_feedback(goal_id, feedback)

    def actionServerActionExecute(self, server: RosHandle, goal_id: str) -> None:
        """Start a goal that was accepted with simROS2.goal_response_accept_and_defer."""
        self._action_server(server).execute(goal_id)

    def actionServerActionSucceed(self, server: RosHandle, goal_id: str, result: Message) -> None:
        """End an executing goal: it succeeded."""
        self._action_server(server).finish(goal_id, "succeed", result)

    def actionServerActionAbort(self, server: RosHandle, goal_id: str, result: Message) -> None:
        """End an executing goal: it was aborted."""
        self._action_server(server).finish(goal_id, "abort", result)

    def actionServerActionCanceled(self, server: RosHandle, goal_id: str, result: Message) -> None:
        """End a pending or executing goal: it was cancelled."""
        self._action_server(server).finish(goal_id, "be canceled", result)

    def actionServerActionIsCanceling(self, server: RosHandle, goal_id: str) -> bool:
        """Return whether a cancel request was accepted and the goal has not ended."""
        return self._action_server(server).is_in(goal_id, GoalStatus.RECALLING, GoalStatus.PREEMPTING)

    def actionServerActionIsActive(self, server: RosHandle, goal_id: str) -> bool:
        """Return whether the goal is pending, executing or cancelling; False if it has ended or is unknown."""
        active = (GoalStatus.PENDING, GoalStatus.ACTIVE, GoalStatus.RECALLING, GoalStatus.PREEMPTING)
        return self._action_server(server).is_in(goal_id, *active)

    def actionServerActionIsExecuting(self, server: RosHandle, goal_id: str) -> bool:
        """Return whether the goal is executing and not cancelling."""
        return self._action_server(server).is_in(goal_id, GoalStatus.ACTIVE)

    def actionClientTreatUInt8ArrayAsString(self, client: RosHandle) -> None:
        """Let uint8[] of feedback and results be strings in Lua, not tables; in Python they are always bytes."""
        self._byte_arrays.deliver_strings(client)

    def actionServerTreatUInt8ArrayAsString(self, server: RosHandle) -> None:
        """Let uint8[] of goals be strings in Lua, not tables; in Python they are always bytes."""
        self._byte_arrays.deliver_strings(server)

    def _make(self, of_ros1: Any, of_ros2: Any, name: str, action_type: str, *callbacks: Any) -> Any:
        kind: Any = Ros2ActionParts if self._is_ros2 else ActionTopics
        endpoints = kind(self._bridge, name, action_type, self._warn_of_truncation)

        def delivering(callback: Any) -> Any:
            return lambda *arguments: callback(*(self._byte_arrays.received(made.handle, each) for each in arguments))

        with endpoints.closed_on_error():
            made = (of_ros2 if self._is_ros2 else of_ros1)(endpoints, *map(delivering, callbacks))
        return made

    def _action_client(self, handle: int) -> ActionClient | Ros2ActionClient:
        if handle not in self._action_clients:
            raise ValueError(f"invalid object handle {handle}: no such action client, or it was shut down")
        return self._action_clients[handle]

    def _action_server(self, handle: int) -> ActionServer | Ros2ActionServer:
        if handle not in self._action_servers:
            raise ValueError(f"invalid object handle {handle}: no such action server, or it was shut down")
        return self._action_servers[handle]

    def _forget(self, what: str, handle: int) -> None:
        self._byte_arrays.forget(handle)
        self._caller.in_each_step.pop((what, handle), None)
        self._caller.at_end.pop((what, handle), None)


def _check_goal_response(response: object) -> None:
    if response not in (REJECT, ACCEPT, DEFER):
        raise ValueError(
            "the goal callback must return True, False or one of simROS2.goal_response_reject, "
            f"goal_response_accept_and_execute, goal_response_accept_and_defer; it returned {response!r}"
        )


def _check_cancel_response(response: object) -> None:
    if response not in (REJECT, ACCEPT):
        raise ValueError(
            "the cancel callback must return True, False or one of simROS2.cancel_response_reject, "
            f"cancel_response_accept; it returned {response!r}"
        )
