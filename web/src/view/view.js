// SPDX-License-Identifier: BSD-3-Clause
// The 3D view: draws the scene when something has changed, and knows what is under the mouse.
import {
  Color,
  ColorManagement,
  Fog,
  Group,
  LinearSRGBColorSpace,
  MathUtils,
  Matrix4,
  Object3D,
  PCFShadowMap,
  PerspectiveCamera,
  Plane,
  Quaternion,
  Raycaster,
  Scene as Scene3d,
  Vector2,
  Vector3,
  WebGLRenderer,
  WebGLRenderTarget,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

import { h } from "../dom.js";
import { Emitter } from "../emitter.js";
import { Bodies } from "./bodies.js";
import { Gizmo } from "./gizmo.js";
import { Lights } from "./lights.js";
import { overlays } from "./overlays/index.js";
import { Pace } from "./pace.js";
import { Poses } from "./poses.js";

// Colours are those of the simulator's cameras, which do not convert them.
ColorManagement.enabled = false;
Object3D.DEFAULT_UP.set(0, 0, 1);

/// Emits "draw" before and "drawn" after each picture, "options" when an overlay is switched, and "pick" ({ object, point, event }) when
/// something is clicked.
export class View extends Emitter {
  element = h("div.view");
  overlays = []; // { id, title, key, on, layer }
  following = null; // an object
  shadows = localStorage.getItem("shadows") !== "no";
  #app;
  #dirty = true;
  #pace;
  #pressed = null;
  #ready = false;

  constructor(app) {
    super();
    this.#app = app;
    this.renderer = new WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
    this.renderer.outputColorSpace = LinearSRGBColorSpace;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.renderer.shadowMap.autoUpdate = false;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.element.append(this.renderer.domElement);
    this.#pace = new Pace(this.renderer.getContext());
    this.scene3d = new Scene3d();
    this.camera = new PerspectiveCamera(50, 1, 0.02, 3000);
    this.camera.position.set(3.2, -4.2, 2.8);
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.target.set(0, 0, 0.3);
    this.controls.zoomToCursor = true;
    this.controls.maxDistance = 800;
    this.controls.minDistance = 0.05;
    this.controls.addEventListener("change", () => this.invalidate());
    this.controls.addEventListener("start", () => (this.#flight = null));

    app.view = this; // for its parts
    this.poses = new Poses(app);
    this.bodies = new Bodies(app, { shapes: (link) => link.visuals, material: (visual) => visual.material });
    this.lights = new Lights();
    this.world = new Group();
    this.world.add(this.bodies.group);
    this.scene3d.add(this.lights.group, this.world);
    for (const overlay of overlays) this.#addOverlay(overlay);
    this.gizmo = new Gizmo(app, this);

    app.scene.on("changed", (change) => this.#change(change));
    app.scene.on("colours", (links) => (this.#changing = this.#changing.then(() => this.bodies.recolour(links))));
    app.link.on("frame", () => this.invalidate());
    app.selection.on("changed", () => this.invalidate());
    new ResizeObserver(() => this.#resize()).observe(this.element);
    this.#watchPointer();
    this.renderer.setAnimationLoop(() => this.#frame());
  }

  /// Draws again soon.
  invalidate() {
    this.#dirty = true;
  }

  /// The matrix of a link, model or another object in the picture.
  matrixOf(object, target = new Matrix4()) {
    return this.poses.matrix(object, target);
  }

  /// The pose of an object in the picture: x, y, z and the quaternion x, y, z, w.
  poseOf(object) {
    const place = new Vector3();
    const turn = new Quaternion();
    this.matrixOf(object).decompose(place, turn, new Vector3());
    return [...place.toArray(), ...turn.toArray()];
  }

  /// Switches an overlay on or off.
  setOverlay(id, on) {
    const overlay = this.overlays.find((each) => each.id === id);
    overlay.on = on;
    overlay.layer.object3d.visible = on;
    localStorage.setItem(`overlay-${id}`, on ? "yes" : "no");
    overlay.layer.toggle?.(on);
    this.emit("options");
    this.invalidate();
  }

  setShadows(on) {
    this.shadows = on;
    localStorage.setItem("shadows", on ? "yes" : "no");
    this.#light();
    this.emit("options");
  }

  /// Looks at a box in the world, or at an object.
  look(object) {
    const { centre, radius } = this.extent(object);
    const away = this.camera.position.clone().sub(this.controls.target).normalize();
    this.#fly(centre, centre.clone().addScaledVector(away, Math.max(2.6 * radius, 0.3)));
  }

  /// Looks from "top", "front", "right" or "free" at what is looked at now.
  lookFrom(side) {
    const target = this.controls.target.clone();
    const distance = this.camera.position.distanceTo(target);
    const direction = {
      top: new Vector3(0, -1e-4, 1),
      front: new Vector3(1, 0, 0.0001),
      right: new Vector3(0, -1, 0.0001),
      free: new Vector3(0.55, -0.7, 0.5),
    }[side].normalize();
    this.#fly(target, target.clone().addScaledVector(direction, distance));
  }

  /// Keeps the camera beside an object; null ends it.
  follow(object) {
    this.following = object;
    this.#followed = null;
    this.emit("options");
    this.invalidate();
  }

  /// Shows the whole scene without its large ground.
  lookAtAll() {
    const { centre, radius } = this.extent(null);
    const direction = new Vector3(0.55, -0.7, 0.5).normalize();
    this.#fly(centre, centre.clone().addScaledVector(direction, Math.min(Math.max(2.4 * radius, 1), 60)), true);
  }

  /// { centre, radius } of an object's shapes in the world; of all moving objects and small static ones for null.
  extent(object) {
    const low = new Vector3(Infinity, Infinity, Infinity);
    const high = new Vector3(-Infinity, -Infinity, -Infinity);
    const corner = new Vector3();
    const inside = (link) => {
      for (let each = link; each; each = this.#app.scene.objects.get(each.parent)) if (each === object) return true;
      return false;
    };
    for (const link of this.#app.scene.objects.values()) {
      if (link.kind !== "link" || (object && !inside(link))) continue;
      const matrix = this.matrixOf(link);
      for (const { visual, local, batch } of this.bodies.partsOf(link.handle)) {
        if (visual.shape.type === "plane") continue;
        if (!batch.geometry.boundingBox) batch.geometry.computeBoundingBox();
        const box = batch.geometry.boundingBox;
        const world = new Matrix4().multiplyMatrices(matrix, local);
        const size = box.getSize(new Vector3()).applyMatrix4(new Matrix4().extractRotation(world));
        if (!object && link.static && size.length() > 60) continue;
        for (let i = 0; i < 8; ++i) {
          corner
            .set(i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z)
            .applyMatrix4(world);
          low.min(corner);
          high.max(corner);
        }
      }
    }
    if (!Number.isFinite(low.x)) {
      const centre = object ? new Vector3().setFromMatrixPosition(this.matrixOf(object)) : new Vector3();
      return { centre, radius: object ? 0.3 : 2 };
    }
    return { centre: low.clone().add(high).multiplyScalar(0.5), radius: Math.max(high.distanceTo(low) / 2, 0.05) };
  }

  /// What is under a point of the screen: { link, point, distance } or null.
  pick(clientX, clientY) {
    const box = this.renderer.domElement.getBoundingClientRect();
    const place = new Vector2(((clientX - box.left) / box.width) * 2 - 1, 1 - ((clientY - box.top) / box.height) * 2);
    const ray = new Raycaster();
    ray.setFromCamera(place, this.camera);
    const [hit] = ray.intersectObjects(this.bodies.group.children, false);
    if (!hit) return null;
    const part = hit.object.userData.parts[hit.instanceId];
    return { link: part.link, point: hit.point, distance: hit.distance };
  }

  /// A ray in the world through a point of the screen.
  rayThrough(clientX, clientY) {
    const box = this.renderer.domElement.getBoundingClientRect();
    const ray = new Raycaster();
    ray.setFromCamera(
      new Vector2(((clientX - box.left) / box.width) * 2 - 1, 1 - ((clientY - box.top) / box.height) * 2),
      this.camera,
    );
    return ray.ray;
  }

  /// The place on a shape, or else on the ground z = 0, under a point of the screen.
  ground(clientX, clientY) {
    const hit = this.pick(clientX, clientY);
    if (hit) return hit.point.toArray();
    const place = this.rayThrough(clientX, clientY).intersectPlane(new Plane(new Vector3(0, 0, 1)), new Vector3());
    return place ? place.toArray() : this.controls.target.toArray();
  }

  /// The picture as a PNG.
  screenshot() {
    this.#draw();
    return new Promise((resolve) => this.renderer.domElement.toBlob(resolve, "image/png"));
  }

  /// The scene as a camera sensor would see it, without overlays: { width, height, rgba }, from the top.
  pictureFrom(sensor) {
    const { width, height, horizontal_fov: fov, near, far } = sensor.parameters;
    const camera = new PerspectiveCamera(1, width / height, near, far);
    camera.fov = MathUtils.radToDeg(2 * Math.atan((Math.tan(fov / 2) * height) / width));
    camera.updateProjectionMatrix();
    const axes = new Matrix4().makeBasis(new Vector3(0, -1, 0), new Vector3(0, 0, 1), new Vector3(-1, 0, 0));
    this.matrixOf(sensor).multiply(axes).decompose(camera.position, camera.quaternion, camera.scale);
    const target = new WebGLRenderTarget(width, height);
    const shown = this.scene3d.children.map((each) => each.visible);
    for (const each of this.scene3d.children) each.visible = each === this.world || each === this.lights.group;
    this.bodies.update((link) => this.poses.of(link));
    this.lights.follow(camera.position, 10);
    this.renderer.shadowMap.needsUpdate = true;
    this.renderer.setRenderTarget(target);
    this.renderer.render(this.scene3d, camera);
    const pixels = new Uint8Array(4 * width * height);
    this.renderer.readRenderTargetPixels(target, 0, 0, width, height, pixels);
    this.renderer.setRenderTarget(null);
    target.dispose();
    this.scene3d.children.forEach((each, place) => (each.visible = shown[place]));
    this.invalidate();
    const rgba = new Uint8ClampedArray(pixels.length);
    for (let row = 0; row < height; ++row) rgba.set(pixels.subarray(4 * width * row, 4 * width * (row + 1)), 4 * width * (height - 1 - row));
    return { width, height, rgba };
  }

  /// Resolves when the scene is drawn completely.
  async settled() {
    await this.#changing;
    await this.bodies.settled();
    this.poses.advance(); // the last frame may be newer than the last picture
    this.#draw();
  }

  #changing = Promise.resolve();
  #flight = null;
  #followed = null;

  #change({ added, removed }) {
    this.#changing = this.#changing.then(async () => {
      this.bodies.remove(removed);
      await this.bodies.add(added);
      this.#light();
      if (!this.#app.scene.models.length) this.#ready = false;
      else if (!this.#ready) {
        this.#ready = true;
        this.lookAtAll();
      }
    });
  }

  #light() {
    const { environment } = this.#app.scene;
    if (!environment) return;
    this.lights.set(environment, this.shadows);
    const background = environment.sky ? new Color(0.68, 0.82, 0.97) : new Color(...environment.background);
    this.scene3d.background = background;
    this.scene3d.fog = environment.sky ? new Fog(background, 60, 600) : null;
    this.invalidate();
  }

  #addOverlay({ id, title, key, on, create }) {
    const layer = create(this.#app);
    const kept = localStorage.getItem(`overlay-${id}`);
    const overlay = { id, title, key, on: kept ? kept === "yes" : on, layer };
    layer.object3d.visible = overlay.on;
    this.overlays.push(overlay);
    this.scene3d.add(layer.object3d);
    if (overlay.on) layer.toggle?.(true);
  }

  #resize() {
    const { clientWidth: width, clientHeight: height } = this.element;
    if (!width || !height) return;
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.invalidate();
  }

  #fly(target, position, atOnce = false) {
    if (atOnce) {
      this.controls.target.copy(target);
      this.camera.position.copy(position);
      this.#flight = null;
      this.invalidate();
      return;
    }
    this.#flight = {
      begin: performance.now(),
      from: [this.controls.target.clone(), this.camera.position.clone()],
      to: [target, position],
    };
  }

  #frame() {
    if (this.#flight) {
      const t = Math.min((performance.now() - this.#flight.begin) / 350, 1);
      const eased = t * t * (3 - 2 * t);
      const { from, to } = this.#flight;
      this.controls.target.lerpVectors(from[0], to[0], eased);
      this.camera.position.lerpVectors(from[1], to[1], eased);
      if (t === 1) this.#flight = null;
      this.#dirty = true;
    }
    if (this.poses.advance()) this.#dirty = true;
    if (!this.#dirty || document.hidden || !this.#pace.mayDraw) return;
    this.#draw();
  }

  #draw() {
    this.#dirty = false;
    if (this.following && this.#app.scene.objects.has(this.following.handle)) {
      const place = new Vector3().setFromMatrixPosition(this.matrixOf(this.following));
      if (this.#followed) {
        const moved = place.clone().sub(this.#followed);
        this.controls.target.add(moved);
        this.camera.position.add(moved);
      }
      this.#followed = place;
    }
    this.controls.update();
    this.bodies.update((link) => this.poses.of(link));
    for (const { on, layer } of this.overlays) if (on) layer.update?.();
    this.gizmo.update();
    this.emit("draw");
    this.lights.follow(this.controls.target, this.camera.position.distanceTo(this.controls.target));
    this.renderer.shadowMap.needsUpdate = true;
    this.renderer.render(this.scene3d, this.camera);
    this.#pace.drawn();
    this.emit("drawn");
  }

  #watchPointer() {
    const canvas = this.renderer.domElement;
    canvas.addEventListener("pointerdown", (event) => {
      this.#pressed = [event.clientX, event.clientY];
    });
    canvas.addEventListener("pointerup", (event) => {
      const pressed = this.#pressed;
      this.#pressed = null;
      if (!pressed || event.button !== 0 || this.gizmo.isBusy) return;
      if (Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) > 4) return; // it turned the view
      const hit = this.pick(event.clientX, event.clientY);
      this.emit("pick", { hit, event });
    });
    canvas.addEventListener("dblclick", (event) => {
      const hit = this.pick(event.clientX, event.clientY);
      if (hit) this.look(this.#app.scene.outermost(hit.link).static ? hit.link : this.#app.scene.outermost(hit.link));
    });
    this.on("pick", ({ hit, event }) => {
      if (!hit) {
        this.#app.selection.select(null);
        return;
      }
      // The model first; a second click, or Alt, its link.
      const model = this.#app.scene.outermost(hit.link);
      const inside = this.#app.selection.object && this.#app.scene.outermost(this.#app.selection.object) === model;
      this.#app.selection.select(event.altKey || inside ? hit.link : model);
    });
  }
}
