#python
# SPDX-License-Identifier: BSD-3-Clause
# Publishes the simulation time, subscribes to its own topic, and sends the ball's transform.


def sysCall_init():
    self.ball = sim.getObject('.')
    if simROS:
        self.time_topic = simROS.advertise('/simulationTime', 'std_msgs/Float32')
        simROS.subscribe('/simulationTime', 'std_msgs/Float32', 'on_time')


def on_time(message):
    sim.addLog(sim.verbosity_debug, f"received the time {message['data']:.2f}")


def sysCall_actuation():
    if not simROS:
        return
    simROS.publish(self.time_topic, {'data': sim.getSimulationTime()})
    simROS.sendTransform(transform_of(self.ball, 'Ball', 'world'))


def transform_of(handle, child_frame, parent_frame):
    x, y, z = sim.getObjectPosition(handle)
    qx, qy, qz, qw = sim.getObjectQuaternion(handle)
    return {
        'header': {'stamp': simROS.getTime(), 'frame_id': parent_frame},
        'child_frame_id': child_frame,
        'transform': {'translation': {'x': x, 'y': y, 'z': z}, 'rotation': {'x': qx, 'y': qy, 'z': qz, 'w': qw}},
    }
