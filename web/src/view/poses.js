// SPDX-License-Identifier: BSD-3-Clause
// The poses in the picture: between the last two frames, so that motion is smooth at any rate of steps; those of a recorded
// run while it is played back.
import { poseBetween } from "./pose_between.js";
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

  /// The pose of a link in the picture; null if it was not there in the run that is played. Valid until the next call.
  of(link) {
    return this.#app.playback.run ? this.#app.playback.poseOf(link) : this.#live(link);
  }

  #live(link) {
    const row = this.#app.scene.linkIndex.get(link.handle);
    return (row !== undefined && this.#row(row)) || link.pose;
  }

  /// The matrix of any object: other objects than links move with the link that carries them. `poseOf(link)` returns
  /// where links are, by default in the picture.
  matrix(object, target, poseOf = (link) => this.of(link)) {
    if (object.kind === "link") return poseMatrix(poseOf(object) ?? object.pose, target);
    const carrier = this.#app.scene.objects.get(object.carrier);
    if (!carrier) return poseMatrix(object.pose, target);
    if (!object.inCarrier) {
      object.inCarrier = poseMatrix(carrier.pose).invert().multiply(poseMatrix(object.pose));
    }
    return poseMatrix(poseOf(carrier) ?? carrier.pose, target).multiply(object.inCarrier);
  }

  /// The matrix of an object in the last frame of the simulation, to which the picture moves.
  latest(object, target) {
    const share = this.#share;
    this.#share = 1;
    const found = this.matrix(object, target, (link) => this.#live(link));
    this.#share = share;
    return found;
  }

  #row(row) {
    const last = this.#last?.frame;
    if (!last || last.revision !== this.#app.scene.revision) return null;
    const to = last.poses.subarray(7 * row, 7 * row + 7);
    if (this.#share >= 1) return to;
    const from = this.#before.frame.poses.subarray(7 * row, 7 * row + 7);
    return poseBetween(from, to, this.#share, this.#pose);
  }

  #shareNow() {
    if (!this.smooth || !this.#before || !this.#last || this.#app.playback.run) return 1;
    const a = this.#before.frame;
    const b = this.#last.frame;
    const span = b.written - a.written;
    if (b.state !== "running" || b.revision !== a.revision || b.time <= a.time || span > LONGEST) return 1;
    return Math.min((performance.now() - this.#last.arrived) / 1000 / span, 1);
  }
}
