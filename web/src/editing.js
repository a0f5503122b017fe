// SPDX-License-Identifier: BSD-3-Clause
// Changes of the scene by hand, and their undoing. A change is { title, redo(), undo() }; both return promises.
import { Emitter } from "./emitter.js";

const MOST = 200; // changes that can be undone

/// Emits "changed" when there is something else to undo or redo.
export class Editing extends Emitter {
  done = [];
  undone = [];
  #app;
  #busy = Promise.resolve();

  constructor(app) {
    super();
    this.#app = app;
    app.link.on("scene", () => {
      this.done = [];
      this.undone = [];
      this.emit("changed");
    });
    window.addEventListener("keydown", (event) => this.#key(event));
  }

  /// Moves a model or link to a pose in the world; `before` is its pose before.
  move(object, pose, before = null) {
    const target = { handle: object.handle };
    const from = before ?? [...this.#app.view.poseOf(object)];
    // On the line of the poses that the handles send while they are dragged: none of those may come after this one.
    const set = (to) => this.#app.link.call("window.set_pose", [this.#now(target), to], "drag");
    return this.carry({ title: `move ${object.name}`, redo: () => set(pose), undo: () => set(from) });
  }

  /// Gives all visuals of a link one colour: red, green, blue from 0 to 1. Undone, it has that of its first visual.
  colour(object, colour) {
    const target = { handle: object.handle };
    const before = this.#app.scene.colours.get(object.handle) ?? object.visuals[0].material.diffuse;
    const set = (to) => this.#app.link.call("window.set_color", [this.#now(target), to]);
    return this.carry({ title: `colour ${object.name}`, redo: () => set(colour), undo: () => set(before) });
  }

  /// Sets a number that window.get_state returns, such as the mass.
  number(object, name, value, before) {
    const target = { handle: object.handle };
    const set = (to) => this.#app.link.call("window.set_number", [this.#now(target), name, to]);
    const title = `${name.replace("_", " ")} ${object.name}`;
    return this.carry({ title, redo: () => set(value), undo: () => set(before) });
  }

  /// Gives a link colour and friction of a material; undone, it has the colour of its first visual and its friction.
  async material(object, name, { colour, friction }) {
    const { link, scene } = this.#app;
    const target = { handle: object.handle };
    const before = {
      colour: scene.colours.get(object.handle) ?? object.visuals[0].material.diffuse,
      friction: (await link.call("window.get_state", [object.handle], "properties")).numbers.friction,
    };
    const set = async (to) => {
      await link.call("window.set_color", [this.#now(target), to.colour]);
      if (before.friction !== undefined) await link.call("window.set_number", [this.#now(target), "friction", to.friction]);
    };
    return this.carry({ title: `${name} ${object.name}`, redo: () => set({ colour, friction }), undo: () => set(before) });
  }

  remove(object) {
    const target = { handle: object.handle };
    let number;
    return this.carry({
      title: `delete ${object.name}`,
      redo: async () => (number = await this.#app.link.call("window.remove", [this.#now(target)])),
      undo: async () => this.#replace(target, await this.#app.link.call("window.restore", [number])),
    });
  }

  duplicate(object) {
    const pose = [...this.#app.view.poseOf(object)];
    const { radius } = this.#app.view.extent(object);
    pose[0] += Math.min(2 * radius, 1) + 0.1;
    return this.#create(`copy ${object.name}`, () => ["window.duplicate", [object.handle, pose]]);
  }

  /// Adds a model of the model folders, moved by `position`.
  addModel(name, position) {
    return this.#create(`add ${name}`, () => ["window.add_model", [name, position]]);
  }

  /// Adds a part of the palette, see window.build.
  build(kind, position, options) {
    return this.#create(`add ${kind.replace("_", " ")}`, () => ["window.build", [kind, position, options]]);
  }

  carry(change) {
    if (this.#app.playback.run) {
      this.#app.notify("This is a playback: go back to live to change the scene.", "warning");
      return Promise.resolve();
    }
    return this.#next(async () => {
      await change.redo();
      this.done.push(change);
      if (this.done.length > MOST) this.done.shift();
      this.undone = [];
    });
  }

  undo() {
    if (this.#app.playback.run) return Promise.resolve();
    return this.#next(async () => {
      const change = this.done.pop();
      if (!change) return;
      await change.undo();
      this.undone.push(change);
    });
  }

  redo() {
    if (this.#app.playback.run) return Promise.resolve();
    return this.#next(async () => {
      const change = this.undone.pop();
      if (!change) return;
      await change.redo();
      this.done.push(change);
    });
  }

  #create(title, call) {
    const target = { handle: -1 };
    let number = null;
    return this.carry({
      title,
      redo: async () => {
        const handle = number === null ? await this.#app.link.call(...call()) : await this.#app.link.call("window.restore", [number]);
        if (number !== null) this.#replace(target, handle);
        target.handle = handle;
        this.#selectSoon(handle);
      },
      undo: async () => (number = await this.#app.link.call("window.remove", [this.#now(target)])),
    });
  }

  // Models that were brought back have other handles.
  #handles = new Map();

  #replace(target, handle) {
    this.#handles.set(this.#now(target), handle);
  }

  #now(target) {
    let { handle } = target;
    while (this.#handles.has(handle)) handle = this.#handles.get(handle);
    return handle;
  }

  #selectSoon(handle) {
    const { scene, selection } = this.#app;
    const end = scene.on("changed", () => {
      if (!scene.objects.has(handle)) return;
      end();
      selection.select(scene.objects.get(handle));
    });
  }

  #next(work) {
    this.#busy = this.#busy.then(async () => {
      try {
        await work();
      } catch (error) {
        this.#app.notify(error.message, "error");
      }
      this.emit("changed");
    });
    return this.#busy;
  }

  #key(event) {
    if (event.target.closest("input, textarea, select, [contenteditable], .cm-editor")) return;
    const { selection, link } = this.#app;
    if (!link.mayEdit) return;
    const object = selection.object?.kind === "model" && selection.object.parent === -1 ? selection.object : null;
    const control = event.ctrlKey || event.metaKey;
    if (control && event.key === "z") this.undo();
    else if (control && (event.key === "y" || (event.shiftKey && event.key === "Z"))) this.redo();
    else if (control && event.key === "d" && object) this.duplicate(object);
    else if (event.key === "Delete" && object) this.remove(object);
    else return;
    event.preventDefault();
  }
}
