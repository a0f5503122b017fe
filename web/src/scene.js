// SPDX-License-Identifier: BSD-3-Clause
// The objects of the scene, as the simulator has described them.
import { Emitter } from "./emitter.js";

/// Emits "changed" ({ added, removed } lists of objects) after each change of the objects, "colours" (a list of
/// links) when they have other colours, and "cleared" before the objects of another scene come.
export class Scene extends Emitter {
  objects = new Map(); // by handle
  models = []; // handles of the outermost models
  environment = null;
  info = null; // what window.share returns
  linkIndex = new Map(); // handle of a link: its row in the poses of frames
  colours = new Map(); // that were set, by handle of the link: red, green, blue from 0 to 1
  axisIndex = new Map(); // handle of a joint: the place of its first axis in the joint positions of frames
  revision = -1;
  #link;
  #busy = false;
  #again = false;
  #newer = null; // colours that were set while the objects are fetched

  constructor(link) {
    super();
    this.#link = link;
    link.on("scene", (info) => {
      this.#clear();
      this.info = info;
      this.#fetch();
    });
    link.on("models", () => this.#fetch());
    link.on("colours", (changes) => {
      this.#newer?.push(...changes);
      this.#recolour(changes);
    });
    link.on("connection", (connected) => {
      if (!connected) this.#again = false;
    });
  }

  /// The objects below one in the tree, or those at its top.
  children(handle = -1) {
    if (handle === -1) return [...this.objects.values()].filter((each) => each.parent === -1 && !each.hidden);
    return this.objects.get(handle)?.children ?? [];
  }

  /// The object of this path, or undefined.
  byPath(path) {
    for (const object of this.objects.values()) if (object.path === path) return object;
    return undefined;
  }

  /// The outermost model of an object.
  outermost(object) {
    return this.objects.get(object?.model);
  }

  /// The pose of a link in the last frame, or its pose at the start: x, y, z and a quaternion x, y, z, w.
  pose(object) {
    const row = this.linkIndex.get(object.handle);
    const frame = this.#link.frame;
    if (row === undefined || !frame || frame.revision !== this.revision) return object.pose;
    return frame.poses.subarray(7 * row, 7 * row + 7);
  }

  #clear() {
    const removed = [...this.objects.values()];
    this.objects.clear();
    this.models = [];
    this.linkIndex.clear();
    this.axisIndex.clear();
    this.colours.clear();
    this.revision = -1;
    this.emit("cleared", removed);
    if (removed.length) this.emit("changed", { added: [], removed });
  }

  /// Finds the link that carries an object.
  #attach(object) {
    if (object.kind === "joint") {
      object.carrier = object.child_link;
    } else if (object.kind === "sensor") {
      const above = this.objects.get(object.carrier);
      if (above?.kind === "joint") object.carrier = above.child_link;
    } else if (object.kind === "model") {
      object.carrier = object.canonical_link;
    }
  }

  async #fetch() {
    if (this.#busy) {
      this.#again = true;
      return;
    }
    this.#busy = true;
    const info = this.info;
    this.#newer = [];
    try {
      const changes = await this.#link.call("window.models", [this.models]);
      if (this.info === info) this.#take(changes);
    } catch (error) {
      if (this.#link.connected) console.warn(`the objects of the scene: ${error.message}`);
    } finally {
      this.#busy = false;
      this.#newer = null;
      if (this.#again) {
        this.#again = false;
        this.#fetch();
      }
    }
  }

  #recolour(changes) {
    const links = [];
    for (const [handle, colour] of changes) {
      if (String(this.colours.get(handle)) === String(colour)) continue;
      this.colours.set(handle, colour);
      if (this.objects.has(handle)) links.push(this.objects.get(handle));
    }
    if (links.length) this.emit("colours", links);
  }

  #take(changes) {
    this.#recolour([...changes.colours, ...this.#newer]);
    const models = new Set(changes.models);
    const frames = new Set(changes.frames.map((each) => each.handle));
    const removed = [...this.objects.values()].filter(
      (object) => !frames.has(object.handle) && !models.has(this.outermost(object)?.handle),
    );
    for (const object of removed) this.objects.delete(object.handle);
    for (const object of changes.objects) this.objects.set(object.handle, object);
    for (const frame of changes.frames) {  // those that were there stay the same objects
      this.objects.set(frame.handle, Object.assign(this.objects.get(frame.handle) ?? {}, frame));
    }
    for (const [handle, parent, path, name] of changes.places) {
      const object = this.objects.get(handle);
      if (object) Object.assign(object, { parent, path, name });
    }
    for (const object of this.objects.values()) object.children = [];
    for (const object of this.objects.values()) if (!object.hidden) this.objects.get(object.parent)?.children.push(object);
    for (const object of changes.objects) this.#attach(object);
    this.models = changes.models;
    this.environment = changes.environment;
    this.revision = changes.revision;
    this.linkIndex = new Map(changes.links.map((handle, row) => [handle, row]));
    this.axisIndex = new Map();
    changes.axes.forEach(([joint, axis], place) => {
      if (axis === 0) this.axisIndex.set(joint, place);
    });
    this.emit("changed", { added: changes.objects, removed });
  }
}
