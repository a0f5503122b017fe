// SPDX-License-Identifier: BSD-3-Clause
// Handles that move and turn the selected object, and the spring with which the mouse pulls a body.
import { BufferGeometry, Float32BufferAttribute, Line, LineBasicMaterial, MathUtils, Object3D, Plane, Vector3 } from "three";
import { TransformControls } from "three/addons/controls/TransformControls.js";

const GRID = 0.1; // m
const ANGLE = 15; // degrees
const PERIOD = 50; // ms between two messages while dragging

export class Gizmo {
  mode = "select"; // or "move", "turn", "pull"
  snapping = localStorage.getItem("snapping") === "yes";
  #app;
  #holder = new Object3D();
  #controls;
  #before = null;
  #dragging = false;
  #sent = 0;

  constructor(app, view) {
    this.#app = app;
    this.#controls = new TransformControls(view.camera, view.renderer.domElement);
    this.#controls.setSize(0.9);
    this.helper = this.#controls.getHelper();
    view.scene3d.add(this.#holder, this.helper);
    this.#controls.addEventListener("dragging-changed", ({ value }) => {
      view.viewpoint.controls.enabled = !value;
      this.#drag(value);
    });
    this.#controls.addEventListener("objectChange", () => this.#moved());
    this.#controls.addEventListener("change", () => view.invalidate());
    app.selection.on("changed", () => this.#attach());
    app.link.on("hello", () => this.#attach());
    app.playback.on("begin", () => this.#attach());
    app.playback.on("end", () => this.#attach());
    this.#watchPull(view);
    this.setSnapping(this.snapping);
  }

  /// Whether the mouse is at the handles.
  get isBusy() {
    return this.#dragging || (this.helper.visible && this.#controls.axis !== null);
  }

  setMode(mode) {
    this.mode = mode;
    if (mode === "move") this.#controls.setMode("translate");
    if (mode === "turn") this.#controls.setMode("rotate");
    this.#attach();
    this.#app.view.emit("options");
  }

  setSnapping(on) {
    this.snapping = on;
    localStorage.setItem("snapping", on ? "yes" : "no");
    this.#controls.setTranslationSnap(on ? GRID : null);
    this.#controls.setRotationSnap(on ? MathUtils.degToRad(ANGLE) : null);
  }

  /// Keeps the handles at the object; before each picture.
  update() {
    const { object } = this.#app.selection;
    if (!this.helper.visible || this.#dragging || !object) return;
    this.#app.view.matrixOf(object).decompose(this.#holder.position, this.#holder.quaternion, this.#holder.scale);
    this.#holder.updateMatrixWorld();
  }

  get #mayEdit() {
    return this.#app.link.mayEdit && !this.#app.playback.run;
  }

  #attach() {
    const { object } = this.#app.selection;
    const movable = object && ["model", "link"].includes(object.kind) && this.#mayEdit;
    if (movable && (this.mode === "move" || this.mode === "turn")) {
      this.#controls.attach(this.#holder);
      this.helper.visible = true;
      this.update();
    } else {
      this.#controls.detach();
      this.helper.visible = false;
    }
    this.#app.view?.invalidate();
  }

  #pose() {
    const { position, quaternion } = this.#holder;
    return [...position.toArray(), ...quaternion.toArray()];
  }

  #drag(begin) {
    const { selection, editing } = this.#app;
    this.#dragging = begin;
    if (begin) {
      this.#before = this.#pose();
    } else if (selection.object) {
      editing.move(selection.object, this.#pose(), this.#before);
    }
  }

  #moved() {
    if (!this.#dragging || performance.now() - this.#sent < PERIOD) return;
    this.#sent = performance.now();
    const { selection, link } = this.#app;
    if (selection.object) link.call("window.set_pose", [selection.object.handle, this.#pose()], "drag").catch(() => {});
  }

  // The spring: in the mode "pull", or with Ctrl

  #watchPull(view) {
    const canvas = view.renderer.domElement;
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new Float32BufferAttribute(new Float32Array(6), 3));
    const line = new Line(geometry, new LineBasicMaterial({ color: 0xffd33d, depthTest: false, transparent: true }));
    line.frustumCulled = false;
    line.visible = false;
    line.renderOrder = 20;
    view.scene3d.add(line);
    let pull = null; // { link, local, plane, target }
    canvas.addEventListener(
      "pointerdown",
      (event) => {
        if (event.button !== 0 || !(this.mode === "pull" || event.ctrlKey) || !this.#mayEdit) return;
        const hit = view.picker.pick(event.clientX, event.clientY);
        if (!hit || hit.link.static) return;
        event.stopImmediatePropagation();
        canvas.setPointerCapture(event.pointerId);
        const normal = view.camera.getWorldDirection(new Vector3());
        pull = {
          link: hit.link,
          local: hit.point.clone().applyMatrix4(view.matrixOf(hit.link).invert()),
          plane: new Plane().setFromNormalAndCoplanarPoint(normal, hit.point),
          target: hit.point.clone(),
        };
        this.#dragging = true;
        // On the line of the pulls: those that come before it are lost.
        this.#app.attempt("window.grip", [hit.link.handle, pull.local.toArray()], "drag");
      },
      { capture: true },
    );
    canvas.addEventListener("pointermove", (event) => {
      if (!pull) return;
      if (!view.picker.rayThrough(event.clientX, event.clientY).intersectPlane(pull.plane, pull.target)) return;
      view.invalidate();
      // Not at once if one was sent just now, but the last one always: the mouse may rest there.
      waiting ??= setTimeout(send, this.#sent + PERIOD - performance.now());
    });
    let waiting = null;
    const send = () => {
      waiting = null;
      if (!pull) return;
      this.#sent = performance.now();
      this.#app.link.call("window.pull", [pull.target.toArray()], "drag").catch(() => {});
    };
    const end = () => {
      if (!pull) return;
      pull = null;
      this.#dragging = false;
      line.visible = false;
      this.#app.attempt("window.let_go", [], "drag");
      view.invalidate();
    };
    canvas.addEventListener("pointerup", end);
    canvas.addEventListener("pointercancel", end);
    view.on("draw", () => {
      line.visible = pull !== null;
      if (!pull) return;
      const at = pull.local.clone().applyMatrix4(view.matrixOf(pull.link));
      geometry.attributes.position.setXYZ(0, ...at.toArray());
      geometry.attributes.position.setXYZ(1, ...pull.target.toArray());
      geometry.attributes.position.needsUpdate = true;
    });
  }
}
