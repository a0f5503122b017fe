// SPDX-License-Identifier: BSD-3-Clause
// The shapes that collide, as wire frames.
import { MeshBasicMaterial } from "three";

import { Bodies } from "../bodies.js";

const PLAIN = { diffuse: [1, 1, 1], emissive: [0, 0, 0] };

export const collisions = {
  id: "collisions",
  title: "Collision shapes",
  key: "c",
  on: false,
  create(app) {
    const wires = () => new MeshBasicMaterial({ color: 0xff7ac6, wireframe: true, transparent: true, opacity: 0.5 });
    const bodies = new Bodies(app, {
      shapes: (link) => link.collisions.filter(({ shape }) => shape.type !== "plane"),
      material: () => PLAIN,
      makeMaterial: wires,
    });
    const there = new Set();
    let on = false;
    const sync = () => {
      if (!on) return;
      const { objects } = app.scene;
      bodies.remove([...there].filter((object) => objects.get(object.handle) !== object));
      for (const object of [...there]) if (objects.get(object.handle) !== object) there.delete(object);
      const added = [...objects.values()].filter((object) => !there.has(object));
      for (const object of added) there.add(object);
      bodies.add(added).then(() => app.view.invalidate());
    };
    app.scene.on("changed", sync);
    return {
      object3d: bodies.group,
      update: () => bodies.update((link) => app.view.poses.of(link)),
      toggle(now) {
        on = now;
        sync();
      },
    };
  },
};
