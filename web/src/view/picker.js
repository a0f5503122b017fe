// SPDX-License-Identifier: BSD-3-Clause
// What is under a point of the screen, and the selection by mouse.
import { Plane, Raycaster, Vector2, Vector3 } from "three";

export class Picker {
  #app;
  #view;
  #pressed = null; // where a button went down

  constructor(app, view) {
    this.#app = app;
    this.#view = view;
    this.#watchPointer();
  }

  /// What is under a point of the screen: { link, point, distance } or null.
  pick(clientX, clientY) {
    const ray = this.#raycaster(clientX, clientY);
    const [hit] = ray.intersectObjects(this.#view.bodies.group.children, false);
    if (!hit) return null;
    const part = hit.object.userData.parts[hit.instanceId];
    return { link: part.link, point: hit.point, distance: hit.distance };
  }

  /// A ray in the world through a point of the screen.
  rayThrough(clientX, clientY) {
    return this.#raycaster(clientX, clientY).ray;
  }

  /// The place on a shape, or else on the ground z = 0, under a point of the screen.
  ground(clientX, clientY) {
    const hit = this.pick(clientX, clientY);
    if (hit) return hit.point.toArray();
    const place = this.rayThrough(clientX, clientY).intersectPlane(new Plane(new Vector3(0, 0, 1)), new Vector3());
    return place ? place.toArray() : this.#view.viewpoint.controls.target.toArray();
  }

  #raycaster(clientX, clientY) {
    const box = this.#view.renderer.domElement.getBoundingClientRect();
    const place = new Vector2(((clientX - box.left) / box.width) * 2 - 1, 1 - ((clientY - box.top) / box.height) * 2);
    const ray = new Raycaster();
    ray.setFromCamera(place, this.#view.camera);
    return ray;
  }

  #watchPointer() {
    const canvas = this.#view.renderer.domElement;
    canvas.addEventListener("pointerdown", (event) => {
      this.#pressed = [event.clientX, event.clientY];
    });
    canvas.addEventListener("pointerup", (event) => {
      const pressed = this.#pressed;
      this.#pressed = null;
      if (!pressed || event.button !== 0 || this.#view.gizmo.isBusy) return;
      if (Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) > 4) return; // it turned the view
      this.#select(this.pick(event.clientX, event.clientY), event.altKey);
    });
    canvas.addEventListener("dblclick", (event) => {
      const hit = this.pick(event.clientX, event.clientY);
      if (!hit) return;
      const model = this.#app.scene.outermost(hit.link);
      this.#view.viewpoint.look(model.static ? hit.link : model);
    });
  }

  #select(hit, linkFirst) {
    const { scene, selection } = this.#app;
    if (!hit) {
      selection.select(null);
      return;
    }
    // The model first; a second click, or Alt, its link.
    const model = scene.outermost(hit.link);
    const inside = selection.object && scene.outermost(selection.object) === model;
    selection.select(linkFirst || inside ? hit.link : model);
  }
}
