// SPDX-License-Identifier: BSD-3-Clause
// Records the last runs of the scene, as this page receives them, in its memory.
import { Emitter } from "../emitter.js";
import { Run } from "./run.js";

const MOST_RUNS = 5;
const MOST_BYTES = 256 * 2 ** 20; // of all runs

/// Emits "changed" when there is another run.
export class Recorder extends Emitter {
  runs = []; // the last one is recorded now
  removed = new Map(); // links that were in the scene and are no longer, by handle
  #scene;
  #layouts = new Map();
  #session = "";
  #numbers = 0;

  constructor(link, scene) {
    super();
    this.#scene = scene;
    link.on("scene", ({ process, frames }) => this.#begin(`${process} ${frames}`));
    link.on("frame", (frame) => this.#add(frame));
    scene.on("changed", ({ added, removed }) => this.#note(added, removed));
  }

  /// Those with some motion, the last one first.
  get usable() {
    return this.runs.filter(({ frames }) => frames.length > 1).reverse();
  }

  /// After a loss of the connection the scene may still be the same.
  #begin(session) {
    if (session === this.#session) return;
    this.#session = session;
    this.runs = [];
    this.removed.clear();
    this.#layouts = new Map();
    this.#numbers = 0;
    this.emit("changed");
  }

  #note(added, removed) {
    const { revision, objects, linkIndex: rows, axisIndex: axes } = this.#scene;
    if (revision === -1) return; // another scene comes, or the same one again
    for (const object of removed) if (object.kind === "link") this.removed.set(object.handle, object);
    for (const { handle } of added) this.removed.delete(handle);
    const links = [...objects.values()].filter(({ kind }) => kind === "link");
    this.#layouts.set(revision, { rows, axes, there: new Set(links.map(({ handle }) => handle)) });
  }

  #add(frame) {
    let run = this.runs.at(-1);
    if (!run || frame.time < run.frames.at(-1).time) {
      if (run?.frames.length === 1) this.runs.pop();
      run = new Run(`Run ${++this.#numbers}`);
      run.layouts = this.#layouts;
      this.runs.push(run);
      if (this.runs.length > MOST_RUNS) this.runs.shift();
      run.add(frame);
      this.emit("changed");
      return;
    }
    run.add(frame);
    if (run.frames.length === 2) this.emit("changed");
    if (this.runs.reduce((sum, { bytes }) => sum + bytes, 0) <= MOST_BYTES) return;
    if (this.runs.length > 1) this.runs.shift();
    else run.shorten();
  }
}
