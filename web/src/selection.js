// SPDX-License-Identifier: BSD-3-Clause
import { Emitter } from "./emitter.js";

/// The selected object; emits "changed" with it, or with null.
export class Selection extends Emitter {
  object = null;

  constructor(scene) {
    super();
    scene.on("changed", ({ removed }) => {
      if (this.object && removed.includes(this.object)) this.select(null);
    });
  }

  select(object) {
    if (object === this.object) return;
    this.object = object;
    this.emit("changed", object);
  }
}
