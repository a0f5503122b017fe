// SPDX-License-Identifier: BSD-3-Clause
// The 3D view: draws the scene and its overlays when something has changed.
import {
  Color,
  ColorManagement,
  Fog,
  Group,
  LinearSRGBColorSpace,
  Matrix4,
  Object3D,
  PCFShadowMap,
  Quaternion,
  Scene as Scene3d,
  Vector3,
  WebGLRenderer,
} from "three";

import { h } from "../dom.js";
import { Emitter } from "../emitter.js";
import { Bodies } from "./bodies.js";
import { extentOf } from "./extent.js";
import { Gizmo } from "./gizmo.js";
import { Lights } from "./lights.js";
import { overlays } from "./overlays/index.js";
import { Pace } from "./pace.js";
import { Picker } from "./picker.js";
import { Poses } from "./poses.js";
import { SeeThrough } from "./see_through.js";
import { pictureFrom } from "./sensor_picture.js";
import { Viewpoint } from "./viewpoint.js";

// Colours are those of the simulator's cameras, which do not convert them.
ColorManagement.enabled = false;
Object3D.DEFAULT_UP.set(0, 0, 1);

/// Emits "draw" before and "drawn" after each picture, and "options" when an overlay is switched or an object is followed.
export class View extends Emitter {
  element = h("div.view");
  overlays = []; // { id, title, key, on, live, layer }
  shadows = localStorage.getItem("shadows") !== "no";
  #app;
  #dirty = true;
  #hidden = false; // nothing of it is drawn
  #pace;
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
    this.viewpoint = new Viewpoint(app, this);

    app.view = this; // for its parts
    this.poses = new Poses(app);
    this.bodies = new Bodies(app, { shapes: (link) => link.visuals, material: (visual) => visual.material });
    this.lights = new Lights();
    this.seeThrough = new SeeThrough(app);
    this.world = new Group();
    this.world.add(this.bodies.group);
    this.scene3d.add(this.lights.group, this.world);
    for (const overlay of overlays) this.#addOverlay(overlay);
    this.gizmo = new Gizmo(app, this);
    this.picker = new Picker(app, this); // after the gizmo, which takes clicks first

    app.scene.on("changed", (change) => this.#change(change));
    app.scene.on("colours", (links) => (this.#changing = this.#changing.then(() => this.bodies.recolour(links))));
    app.link.on("frame", () => this.invalidate());
    app.playback.on("changed", () => this.invalidate());
    app.playback.on("begin", () => this.#showPlayback(true));
    app.playback.on("end", () => this.#showPlayback(false));
    app.selection.on("changed", () => this.invalidate());
    new ResizeObserver(() => this.#resize()).observe(this.element);
    this.renderer.setAnimationLoop(() => this.#frame());
  }

  get camera() {
    return this.viewpoint.camera;
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
    overlay.layer.object3d.visible = this.#shows(overlay);
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

  setSeeThrough(on) {
    this.seeThrough.set(on);
    this.emit("options");
    this.invalidate();
  }

  /// { centre, radius } of an object's shapes in the world, of the whole scene for null.
  extent(object) {
    return extentOf(this.#app, object);
  }

  /// Draws at this size in pixels, whatever the size of the element is; null ends it.
  setSize(size) {
    this.#fixed = size;
    this.renderer.setPixelRatio(size ? 1 : Math.min(window.devicePixelRatio, 2));
    this.#resize();
  }

  #fixed = null;

  /// Draws at once, and returns the canvas.
  draw() {
    this.#draw();
    return this.renderer.domElement;
  }

  /// The picture as a PNG.
  screenshot() {
    this.#draw();
    return new Promise((resolve) => this.renderer.domElement.toBlob(resolve, "image/png"));
  }

  /// The scene as a camera sensor would see it: { width, height, rgba }.
  pictureFrom(sensor) {
    return pictureFrom(this, sensor);
  }

  /// Resolves when the scene is drawn completely.
  async settled() {
    await this.#changing;
    await this.bodies.settled();
    this.poses.advance(); // the last frame may be newer than the last picture
    this.#draw();
  }

  #changing = Promise.resolve();

  #change({ added, removed }) {
    this.#changing = this.#changing.then(async () => {
      this.bodies.remove(removed);
      await this.bodies.add(added);
      this.#light();
      if (!this.#app.scene.models.length) this.#ready = false;
      else if (!this.#ready) {
        this.#ready = true;
        this.viewpoint.lookAtAll();
      }
    });
  }

  #light() {
    const { environment, objects } = this.#app.scene;
    if (!environment) return;
    this.lights.set(environment, [...objects.values()].filter((object) => object.lights?.length), this.shadows);
    const background = environment.sky ? new Color(0.68, 0.82, 0.97) : new Color(...environment.background);
    this.scene3d.background = background;
    this.scene3d.fog = environment.sky ? new Fog(background, 60, 600) : null;
    this.invalidate();
  }

  /// A recorded run has links that the scene no longer has, and nothing of what overlays ask the simulator for.
  #showPlayback(on) {
    const { recorder } = this.#app;
    if (on) this.#past = [...recorder.removed.values()];
    const past = this.#past;
    this.#changing = this.#changing.then(() => (on ? this.bodies.add(past) : this.bodies.remove(past)));
    for (const overlay of this.overlays) overlay.layer.object3d.visible = this.#shows(overlay);
    this.invalidate();
  }

  #past = [];

  #shows({ on, live }) {
    return on && !(live && this.#app.playback.run);
  }

  #addOverlay({ id, title, key, on, live, create }) {
    const layer = create(this.#app);
    const kept = localStorage.getItem(`overlay-${id}`);
    const overlay = { id, title, key, on: kept ? kept === "yes" : on, live, layer };
    layer.object3d.visible = this.#shows(overlay);
    this.overlays.push(overlay);
    this.scene3d.add(layer.object3d);
    if (overlay.on) layer.toggle?.(true);
  }

  #resize() {
    const [width, height] = this.#fixed ?? [this.element.clientWidth, this.element.clientHeight];
    this.#hidden = !width || !height;
    if (this.#hidden) return;
    this.renderer.setSize(width, height, false); // the canvas fills the element
    this.viewpoint.resize(width, height);
    if (this.#ready) this.#draw(); // at once: the canvas is empty after a change of size
  }

  #frame() {
    if (this.viewpoint.advance()) this.#dirty = true;
    if (this.poses.advance()) this.#dirty = true;
    if (!this.#dirty || this.#hidden || document.hidden || !this.#pace.mayDraw) return;
    this.#draw();
  }

  #draw() {
    this.#dirty = false;
    this.viewpoint.update();
    this.bodies.update((link) => this.poses.of(link), Boolean(this.#app.playback.run));
    for (const overlay of this.overlays) if (this.#shows(overlay)) overlay.layer.update?.();
    this.gizmo.update();
    this.emit("draw");
    this.lights.place((link) => this.matrixOf(link));
    this.lights.follow(this.viewpoint.controls.target, this.viewpoint.distance);
    this.seeThrough.update();
    this.renderer.shadowMap.needsUpdate = true;
    this.renderer.render(this.scene3d, this.camera);
    this.#pace.drawn();
    this.emit("drawn");
  }
}
