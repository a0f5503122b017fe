#python
# SPDX-License-Identifier: BSD-3-Clause
# A camera on /image, and a panel that shows what comes on that topic: a camera that is given its pictures and measures
# none. The camera turns, so that there is something to see.


def sysCall_init():
    self.camera = sim.getObject('./Camera')
    self.panel = sim.getObject('/Panel')
    sim.setJointTargetVelocity(sim.getObject('./Turn'), 0.3)
    if simROS:
        self.image_topic = simROS.imageTransportAdvertise('/image')
        simROS.imageTransportSubscribe('/image', on_image)


def on_image(data, width, height):
    if [width, height] == sim.getVisionSensorRes(self.panel):
        sim.setVisionSensorImg(self.panel, data)


def sysCall_sensing():
    if simROS and simROS.wantsMessages(self.image_topic):
        data, (width, height) = sim.getVisionSensorImg(self.camera)
        simROS.imageTransportPublish(self.image_topic, data, width, height, 'Camera_optical')
