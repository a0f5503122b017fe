// SPDX-License-Identifier: BSD-3-Clause
// The points where bodies touch.
import { BufferAttribute, BufferGeometry, Points, PointsMaterial } from "three";

import { Poll } from "../../poll.js";

const PERIOD = 60; // ms between two questions

export const contacts = {
  id: "contacts",
  title: "Contact points",
  key: "k",
  live: true,
  on: false,
  create(app) {
    const material = new PointsMaterial({ color: 0xff2e88, size: 7, sizeAttenuation: false, depthTest: false });
    const dots = new Points(new BufferGeometry(), material);
    dots.frustumCulled = false;
    dots.renderOrder = 6;
    let last = -1;
    const poll = new Poll(app, PERIOD, async () => {
      const count = app.link.frame?.count;
      if (count === last) return;
      last = count;
      const points = await app.link.call("window.get_contacts", [], "overlays");
      const positions = new Float32Array(points.flatMap(([x, y, z]) => [x, y, z]));
      dots.geometry.dispose();
      dots.geometry = new BufferGeometry();
      dots.geometry.setAttribute("position", new BufferAttribute(positions, 3));
      app.view.invalidate();
    });
    return {
      object3d: dots,
      toggle(on) {
        last = -1;
        if (on) poll.start();
        else poll.stop();
      },
    };
  },
};
