# SPDX-License-Identifier: BSD-3-Clause
"""Services with nodes that use Cyclone DDS, whose middleware for ROS 2 writes a header before requests and replies.

rmw_cyclonedds is not on PyPI; Cyclone DDS itself is. The header and the names are those of rmw_cyclonedds.
"""

import subprocess
from pathlib import Path

import pytest

from node_support import Node, write
from ros2_peer import PEERS, Domain, peer_environment
from ros_support import start, stop

PROGRAM = """
import sys, time
from dataclasses import dataclass
from cyclonedds.core import Policy, Qos
from cyclonedds.domain import DomainParticipant
from cyclonedds.idl import IdlStruct
from cyclonedds.idl.types import int64, uint64
from cyclonedds.pub import DataWriter
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic
from cyclonedds.util import duration

@dataclass
class Request(IdlStruct, typename='std_srvs::srv::dds_::SetBool_Request_'):
    guid: uint64
    number: int64
    data: bool

@dataclass
class Response(IdlStruct, typename='std_srvs::srv::dds_::SetBool_Response_'):
    guid: uint64
    number: int64
    success: bool
    message: str

qos = Qos(
    Policy.Reliability.Reliable(duration(seconds=1)),
    Policy.History.KeepLast(10),
    Policy.DataRepresentation(use_cdrv0_representation=True, use_xcdrv2_representation=False),
)
participant = DomainParticipant(int(sys.argv[2]))
requests = Topic(participant, 'rq/switchRequest', Request, qos=qos)
replies = Topic(participant, 'rr/switchReply', Response, qos=qos)
if sys.argv[1] == 'client':
    writer, reader = DataWriter(participant, requests, qos=qos), DataReader(participant, replies, qos=qos)
    while not writer.get_matched_subscriptions() or not reader.get_matched_publications():
        time.sleep(0.05)
    for number in (5, 6):
        writer.write(Request(guid=77, number=number, data=number == 5))
        found = []
        while not found:
            found = [each for each in reader.take(10) if isinstance(each, Response) and each.guid == 77]
            time.sleep(0.02)
        print('reply', found[0].number, found[0].success, found[0].message, flush=True)
else:
    reader, writer = DataReader(participant, requests, qos=qos), DataWriter(participant, replies, qos=qos)
    while True:
        for request in (each for each in reader.take(10) if isinstance(each, Request)):
            print('request', request.data, flush=True)
            writer.write(Response(request.guid, request.number, request.data, 'by Cyclone'))
        time.sleep(0.02)
"""
ONLY_LOOPBACK = (
    "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name='lo' multicast='false'/></Interfaces>"
    "<AllowMulticast>false</AllowMulticast></General><Discovery><ParticipantIndex>auto</ParticipantIndex>"
    "<Peers><Peer address='127.0.0.1'/></Peers></Discovery></Domain></CycloneDDS>"
)


def cyclone(domain: Domain, role: str, folder: Path) -> "subprocess.Popen[str]":
    """Start a client or a server of /switch."""
    if not list(PEERS.glob("lib/python*/site-packages/cyclonedds")):
        pytest.skip("cyclonedds is not installed: scripts/setup --with ros2 --with tests")
    program = write(folder / "cyclone.py", PROGRAM)
    env = peer_environment(domain, CYCLONEDDS_URI=ONLY_LOOPBACK)
    with (folder / role).open("w") as output:
        return start([str(PEERS / "bin" / "python"), str(program), role, str(domain.number)], env, stdout=output)


def test_a_client_with_cyclone_calls_a_script(ros2_domain: Domain, tmp_path: Path) -> None:
    script = """
        def sysCall_init():
            simROS2.createService('/switch', 'std_srvs/srv/SetBool', 'switch')

        def switch(request):
            return {'success': request['data'], 'message': 'on' if request['data'] else 'off'}
    """
    file = write(tmp_path / "script.py", script)
    client = cyclone(ros2_domain, "client", tmp_path)
    try:
        with Node(ros2_domain.env(), tmp_path / "log", "ball", "--ros=2", "--child-script", f"/Ball={file}"):
            assert client.wait(timeout=40) == 0
    finally:
        stop(client)
    assert (tmp_path / "client").read_text() == "reply 5 True on\nreply 6 False off\n"


def test_a_script_calls_a_server_with_cyclone(ros2_domain: Domain, tmp_path: Path) -> None:
    script = """
        def sysCall_init():
            self.client = simROS2.createClient('/switch', 'std_srvs/srv/SetBool')
            for data in (True, False):
                print('answered', simROS2.call(self.client, {'data': data}, 30.0), flush=True)
    """
    file = write(tmp_path / "script.py", script)
    server = cyclone(ros2_domain, "server", tmp_path)
    try:
        with Node(ros2_domain.env(), tmp_path / "log", "ball", "--ros=2", "--child-script", f"/Ball={file}") as node:
            node.wait_for_output("answered {'success': True, 'message': 'by Cyclone'}")
            node.wait_for_output("answered {'success': False, 'message': 'by Cyclone'}")
    finally:
        stop(server)
    assert (tmp_path / "server").read_text() == "request True\nrequest False\n"
