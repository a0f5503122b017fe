// SPDX-License-Identifier: BSD-3-Clause
// Pictures of models that are not in the scene.
import {
  AmbientLight,
  Box3,
  Color,
  DirectionalLight,
  LinearSRGBColorSpace,
  PerspectiveCamera,
  Scene as Scene3d,
  Vector3,
  WebGLRenderer,
} from "three";

import { Bodies } from "./bodies.js";

const SIZE = 144; // pixels

export class Thumbnails {
  #app;
  #made = new Map(); // name: promise of a URL
  #busy = Promise.resolve();

  constructor(app) {
    this.#app = app;
  }

  of(name) {
    if (!this.#made.has(name)) {
      const picture = this.#busy.then(() => this.#draw(name));
      this.#made.set(name, picture);
      this.#busy = picture.catch(() => {}); // one after the other
    }
    return this.#made.get(name);
  }

  async #draw(name) {
    const { link } = this.#app;
    const objects = await link.call("server.preview", [name], "previews");
    const ask = (call, [number]) => link.call(`server.preview_${call.split(".")[1]}`, [name, number], "previews");
    const byHandle = new Map(objects.map((object) => [object.handle, object]));
    const scene = { on() {}, objects: byHandle, linkIndex: new Map(), colours: new Map() };
    const bodies = new Bodies(
      { link: { call: ask, connected: true }, scene, view: { invalidate() {} } },
      { shapes: (each) => each.visuals, material: (visual) => visual.material },
    );
    await bodies.add(objects);
    await bodies.settled();
    bodies.update((each) => each.pose);
    const picture = new Scene3d();
    picture.background = new Color(0.86, 0.88, 0.9);
    const sun = new DirectionalLight(new Color(1, 1, 1), 0.75 * Math.PI);
    sun.position.set(0.6, -0.8, 1.4);
    picture.add(bodies.group, sun, new AmbientLight(new Color(0.45, 0.45, 0.45), Math.PI));
    const box = new Box3();
    for (const mesh of bodies.group.children) {
      mesh.computeBoundingBox();
      if (mesh.boundingBox.getSize(new Vector3()).length() < 100) box.union(mesh.boundingBox);
    }
    if (box.isEmpty()) box.set(new Vector3(-1, -1, -1), new Vector3(1, 1, 1));
    const centre = box.getCenter(new Vector3());
    const radius = box.getSize(new Vector3()).length() / 2;
    const camera = new PerspectiveCamera(30, 1, radius / 50, 100 * radius);
    camera.position.copy(centre).addScaledVector(new Vector3(0.6, -0.75, 0.5).normalize(), 3.9 * radius);
    camera.lookAt(centre);
    const renderer = new WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
    renderer.outputColorSpace = LinearSRGBColorSpace;
    renderer.setSize(SIZE, SIZE);
    renderer.render(picture, camera);
    const blob = await new Promise((resolve) => renderer.domElement.toBlob(resolve, "image/png"));
    renderer.dispose();
    renderer.forceContextLoss(); // browsers have few
    return URL.createObjectURL(blob);
  }
}
