# SPDX-License-Identifier: BSD-3-Clause
"""A rospy service /paint, std_srvs/SetBool: echoes true, rejects false by raising."""

import rospy
from std_srvs.srv import SetBool, SetBoolRequest, SetBoolResponse


def paint(request: SetBoolRequest) -> SetBoolResponse:
    if not request.data:
        raise rospy.ServiceException("no brush")
    return SetBoolResponse(True, "painted")


rospy.init_node("painter")
server = rospy.Service("/paint", SetBool, paint)
rospy.spin()
