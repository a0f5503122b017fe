// SPDX-License-Identifier: BSD-3-Clause
// Where the view is seen from: the mouse, flights to objects and sides, and an object that is followed.
import { PerspectiveCamera, Vector3 } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

import { extentOf } from "./extent.js";

const FLIGHT = 350; // ms

export class Viewpoint {
  camera = new PerspectiveCamera(50, 1, 0.02, 3000);
  following = null; // an object
  #app;
  #view;
  #flight = null; // { begin, from, to }, each with the target and the position of the camera
  #followed = null; // where the object was that is followed

  constructor(app, view) {
    this.#app = app;
    this.#view = view;
    this.camera.position.set(3.2, -4.2, 2.8);
    this.controls = new OrbitControls(this.camera, view.renderer.domElement);
    this.controls.target.set(0, 0, 0.3);
    this.controls.zoomToCursor = true;
    this.controls.maxDistance = 800;
    this.controls.minDistance = 0.05;
    this.controls.addEventListener("change", () => view.invalidate());
    this.controls.addEventListener("start", () => (this.#flight = null));
  }

  /// The distance of the camera from what is looked at, m.
  get distance() {
    return this.camera.position.distanceTo(this.controls.target);
  }

  resize(width, height) {
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
  }

  /// Looks at a box in the world, or at an object.
  look(object) {
    const { centre, radius } = extentOf(this.#app, object);
    const away = this.camera.position.clone().sub(this.controls.target).normalize();
    this.#fly(centre, centre.clone().addScaledVector(away, Math.max(2.6 * radius, 0.3)));
  }

  /// Looks from "top", "front", "right" or "free" at what is looked at now.
  lookFrom(side) {
    const target = this.controls.target.clone();
    const direction = {
      top: new Vector3(0, -1e-4, 1),
      front: new Vector3(1, 0, 0.0001),
      right: new Vector3(0, -1, 0.0001),
      free: new Vector3(0.55, -0.7, 0.5),
    }[side].normalize();
    this.#fly(target, target.clone().addScaledVector(direction, this.distance));
  }

  /// Keeps the camera beside an object; null ends it.
  follow(object) {
    this.following = object;
    this.#followed = null;
    this.#view.emit("options");
    this.#view.invalidate();
  }

  /// Shows the whole scene without its large ground.
  lookAtAll() {
    const { centre, radius } = extentOf(this.#app, null);
    const direction = new Vector3(0.55, -0.7, 0.5).normalize();
    this.#fly(centre, centre.clone().addScaledVector(direction, Math.min(Math.max(2.4 * radius, 1), 60)), true);
  }

  /// Goes on with a flight; returns whether the camera has moved.
  advance() {
    if (!this.#flight) return false;
    const t = Math.min((performance.now() - this.#flight.begin) / FLIGHT, 1);
    const eased = t * t * (3 - 2 * t);
    const { from, to } = this.#flight;
    this.controls.target.lerpVectors(from[0], to[0], eased);
    this.camera.position.lerpVectors(from[1], to[1], eased);
    if (t === 1) this.#flight = null;
    return true;
  }

  /// Call it before each picture: moves with the object that is followed.
  update() {
    if (this.following && this.#app.scene.objects.has(this.following.handle)) {
      const place = new Vector3().setFromMatrixPosition(this.#view.matrixOf(this.following));
      if (this.#followed) {
        const moved = place.clone().sub(this.#followed);
        this.controls.target.add(moved);
        this.camera.position.add(moved);
      }
      this.#followed = place;
    }
    this.controls.update();
  }

  #fly(target, position, atOnce = false) {
    if (atOnce) {
      this.controls.target.copy(target);
      this.camera.position.copy(position);
      this.#flight = null;
      this.#view.invalidate();
      return;
    }
    this.#flight = {
      begin: performance.now(),
      from: [this.controls.target.clone(), this.camera.position.clone()],
      to: [target, position],
    };
  }
}
