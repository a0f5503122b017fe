# SPDX-License-Identifier: BSD-3-Clause
"""Handles of simROS and simROS2 after their object was shut down: a second shutdown, and any other use."""

from collections.abc import Callable

from node_support import Node

Script = Callable[[str], Node]


def test_stale_handles_are_reported_by_kind(script: Script) -> None:
    node = script("""\
        A, B = simROS, simROS2
        def quiet(*arguments):
            pass
        def end(*ends):
            return [lambda handle, end=each: end(handle) for each in ends]
        def sysCall_init():
            pictures = (bytes(3), 1, 1, '')
            cases = [
                (A.advertise('/a', 'std_msgs/Empty'), A.shutdownPublisher, lambda h: A.publish(h, {})),
                (B.createPublisher('/a', 'std_msgs/Empty'), B.shutdownPublisher, lambda h: B.publish(h, {})),
                (A.subscribe('/a', 'std_msgs/Empty', quiet), A.shutdownSubscriber, A.shutdownSubscriber),
                (B.createSubscription('/a', 'std_msgs/Empty', quiet), B.shutdownSubscription, B.shutdownSubscription),
                (A.serviceClient('/s', 'std_srvs/Empty'), A.shutdownServiceClient, lambda h: A.call(h, {})),
                (B.createClient('/s', 'std_srvs/Empty'), B.shutdownClient, lambda h: B.waitForService(h, 0)),
                (A.advertiseService('/t', 'std_srvs/Empty', quiet), A.shutdownServiceServer, A.shutdownServiceServer),
                (B.createService('/u', 'std_srvs/Empty', quiet), B.shutdownService, B.shutdownService),
                (A.imageTransportAdvertise('/i'), A.imageTransportShutdownPublisher,
                 lambda h: A.imageTransportPublish(h, *pictures)),
                (A.imageTransportSubscribe('/i', quiet), A.imageTransportShutdownSubscriber, A.shutdownSubscriber),
                (B.createActionClient('/x', 'actionlib/Test', quiet, quiet, quiet), B.shutdownActionClient,
                 lambda h: B.sendGoal(h, {})),
                (B.createActionServer('/y', 'actionlib/Test', quiet, quiet, quiet), B.shutdownActionServer,
                 lambda h: B.actionServerActionIsActive(h, 'id')),
            ]
            for number, (handle, shut_down, use) in enumerate(cases):
                shut_down(handle)
                for again in (shut_down, use):
                    try:
                        again(handle)
                        print('accepted:', number)
                    except ValueError as error:
                        text = str(error)
                        known = text.startswith(f'invalid object handle {handle}: no such ')
                        print('clear:' if known and text.endswith(', or it was shut down') else 'not clear:', error)
            print('done')
        """)
    node.wait_for_output("done")
    assert "accepted" not in node.output
    assert "not clear" not in node.output
    assert node.output.count("clear: ") == 24
