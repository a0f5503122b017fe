// SPDX-License-Identifier: BSD-3-Clause
// Shows a recorded run in place of the simulation, which goes on meanwhile.
import { Emitter } from "../emitter.js";

/// Emits "begin" and "end", and "changed" when time, speed or motion are others.
export class Playback extends Emitter {
  run = null; // null: the simulation is shown
  time = 0; // s
  plays = false;
  speed = 1; // seconds of the run per second
  #drawn = 0; // ms

  /// Begins at the end of a run, or at a time.
  begin(run, time = run.end) {
    if (this.run) this.end();
    this.run = run;
    this.plays = false;
    this.emit("begin");
    this.seek(time);
  }

  /// Shows the simulation again.
  end() {
    if (!this.run) return;
    this.run = null;
    this.plays = false;
    this.emit("end");
    this.emit("changed");
  }

  seek(time) {
    if (!this.run) return;
    this.time = Math.min(Math.max(time, this.run.begin), this.run.end);
    this.emit("changed");
  }

  /// Goes some frames on or back, to the time of one.
  step(frames) {
    if (!this.run) return;
    this.pause();
    const place = this.run.place(this.time) + frames;
    this.seek(this.run.frames[Math.min(Math.max(place, 0), this.run.frames.length - 1)].time);
  }

  /// Plays on; from the begin at the end.
  play() {
    if (!this.run || this.plays) return;
    if (this.time >= this.run.end) this.time = this.run.begin;
    this.plays = true;
    this.#drawn = performance.now();
    this.emit("changed");
    requestAnimationFrame(() => this.#advance());
  }

  pause() {
    if (!this.plays) return;
    this.plays = false;
    this.emit("changed");
  }

  setSpeed(speed) {
    this.speed = speed;
    this.emit("changed");
  }

  /// The pose of a link; null if it was not there. Valid until the next call.
  poseOf(link) {
    return this.run.pose(link, this.time);
  }

  #advance() {
    if (!this.plays) return;
    const now = performance.now();
    const time = this.time + (this.speed * (now - this.#drawn)) / 1000;
    this.#drawn = now;
    if (time >= this.run.end) this.plays = false;
    else requestAnimationFrame(() => this.#advance());
    this.seek(time);
  }
}
