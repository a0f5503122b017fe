// SPDX-License-Identifier: BSD-3-Clause
// The poses in the picture: between the last two frames, so that motion is smooth at any rate of steps.
import { poseMatrix } from "./pose_matrix.js";

const LONGEST = 0.25; // s between frames that are joined

export class Poses {
  smooth = true;
  #app;
  #last = null; // { frame, arrived }
  #before = null;
  #share = 1; // of the way from the frame before to the last one
  #pose = new Float32Array(7);

  constructor(app) {
    this.#app = app;
    app.link.on("frame", (frame) => {
      this.#before = this.#last;
      this.#last = { frame, arrived: performance.now() };
    });
    app.scene.on("cleared", () => (this.#last = this.#before = null));
  }

  /// Goes on in time; returns whether poses have changed since the last call.
  advance() {
    const before = this.#share;
    this.#share = this.#shareNow();
    return this.#share !== before || this.#share < 1;
  }

  /// The pose of a link in the picture. Valid until the next call.
  of(link) {
    const row = this.#app.scene.linkIndex.get(link.handle);
    return (row !== undefined && this.#row(row)) || link.pose;
  }

  /// The matrix of any object: other objects than links move with the link that carries them.
  matrix(object, target) {
    if (object.kind === "link") return poseMatrix(this.of(object), target);
    const carrier = this.#app.scene.objects.get(object.carrier);
    if (!carrier) return poseMatrix(object.pose, target);
    if (!object.inCarrier) {
      object.inCarrier = poseMatrix(carrier.pose).invert().multiply(poseMatrix(object.pose));
    }
    return poseMatrix(this.of(carrier), target).multiply(object.inCarrier);
  }

  /// The matrix of an object in the last frame, to which the picture moves.
  latest(object, target) {
    const share = this.#share;
    this.#share = 1;
    const found = this.matrix(object, target);
    this.#share = share;
    return found;
  }

  #row(row) {
    const last = this.#last?.frame;
    if (!last || last.revision !== this.#app.scene.revision) return null;
    const to = last.poses.subarray(7 * row, 7 * row + 7);
    if (this.#share >= 1) return to;
    const from = this.#before.frame.poses.subarray(7 * row, 7 * row + 7);
    const pose = this.#pose;
    // The shorter way between the quaternions.
    const sign = from[3] * to[3] + from[4] * to[4] + from[5] * to[5] + from[6] * to[6] < 0 ? -1 : 1;
    let norm = 0;
    for (let i = 0; i < 7; ++i) {
      pose[i] = from[i] + this.#share * ((i > 2 ? sign : 1) * to[i] - from[i]);
      if (i > 2) pose[i] = i > 2 && sign < 0 ? from[i] + this.#share * (-to[i] - from[i]) : pose[i];
      if (i > 2) norm += pose[i] * pose[i];
    }
    norm = 1 / Math.sqrt(norm);
    for (let i = 3; i < 7; ++i) pose[i] *= norm;
    return pose;
  }

  #shareNow() {
    if (!this.smooth || !this.#before || !this.#last) return 1;
    const a = this.#before.frame;
    const b = this.#last.frame;
    const span = b.written - a.written;
    if (b.state !== "running" || b.revision !== a.revision || b.time <= a.time || span > LONGEST) return 1;
    return Math.min((performance.now() - this.#last.arrived) / 1000 / span, 1);
  }
}
