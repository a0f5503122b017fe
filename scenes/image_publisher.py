#python
# SPDX-License-Identifier: BSD-3-Clause
# Publishes the images of a rotating camera on /image, and shows the received images on a panel. The panel is a camera
# whose images are set by this script.


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
