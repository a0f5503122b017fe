# SPDX-License-Identifier: BSD-3-Clause
"""The types of gazebo_msgs equal those of Gazebo 9 and 11 on the wire."""

import pytest

from bubblesim import _core

# Values from the code of other generators for gazebo_msgs 2.9: rosserial, rosnodejs, roslisp.
MESSAGES = {
    "ContactState": "48c0ffb054b8c444f870cecea1ee50d9",
    "ContactsState": "acbcb1601a8e525bf72509f18e6f668d",
    "LinkState": "0818ebbf28ce3a08d48ab1eaa7309ebe",
    "LinkStates": "48c080191eb15c41858319b4d8a609c2",
    "ModelState": "9330fd35f2fcd82d457e54bd54e10593",
    "ModelStates": "48c080191eb15c41858319b4d8a609c2",
    "ODEPhysics": "667d56ddbd547918c32d1934503dc335",
}
SERVICES = {
    "ApplyBodyWrench": "585b9f9618aa0581b207e2f2d90866bc",
    "ApplyJointEffort": "c0039811b8cc919490b3cff748cdf46b",
    "BodyRequest": "5eade9afe7f232d78005bd0cafeab755",
    "DeleteModel": "9ce56b4e9e54616de25d796dc972a262",
    "GetLinkState": "09d6c98cce97b35f7ab9bd70300657ab",
    "GetModelState": "4c515e936d3319c9610c559c60bfc3d4",
    "GetPhysicsProperties": "575a5e74786981b7df2e3afc567693a6",
    "GetWorldProperties": "36bb0f2eccf4d8be971410c22818ba3f",
    "JointRequest": "0be1351618e1dc030eb7959d9a4902de",
    "SetLinkState": "8a5146eb66ae4d26b0860b08f3f271be",
    "SetModelState": "5b3ab0281d4f5445def017e3a2e4a07b",
    "SpawnModel": "9ed9c82c96abe1a00c3e8cdaeee24413",
}


@pytest.mark.parametrize("name", MESSAGES)
def test_messages_have_gazebos_md5(name: str) -> None:
    assert _core.messages.type_hash(f"gazebo_msgs/{name}") == MESSAGES[name]


@pytest.mark.parametrize("name", SERVICES)
def test_services_have_gazebos_md5(name: str) -> None:
    assert _core.messages.service_type_hash(f"gazebo_msgs/{name}") == SERVICES[name]
