// SPDX-License-Identifier: BSD-3-Clause
// A recorded run: its frames in the order of their times, and which object each of their rows is.
import { poseBetween } from "../view/pose_between.js";

export class Run {
  frames = []; // { time, revision, poses, joints }, see link.js
  layouts = new Map(); // by revision of the scene: { rows, axes, there }, the place of each link and joint in frames by
  // handle, and the handles of all links; those without a place stand still
  bytes = 0;
  #pose = new Float32Array(7);

  constructor(name) {
    this.name = name;
  }

  get begin() {
    return this.frames[0].time;
  }

  get end() {
    return this.frames.at(-1).time;
  }

  /// Adds a frame. One with the time of the last frame takes its place.
  add({ time, revision, poses, joints }) {
    if (this.frames.at(-1)?.time === time) this.bytes -= sizeOf(this.frames.pop());
    const frame = { time, revision, poses, joints };
    this.frames.push(frame);
    this.bytes += sizeOf(frame);
  }

  /// Drops the oldest tenth.
  shorten() {
    for (const frame of this.frames.splice(0, Math.ceil(this.frames.length / 10))) this.bytes -= sizeOf(frame);
  }

  /// The number of the last frame that is not after a time; of the first one for earlier times.
  place(time) {
    let low = 0;
    let high = this.frames.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.frames[middle].time <= time) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  /// The pose of a link at a time, between two frames; null if the link was not there. Valid until the next call.
  pose(link, time) {
    const place = this.place(time);
    const frame = this.frames[place];
    const next = this.frames[place + 1];
    const from = this.#poseIn(frame, link);
    if (!from || !next || next.revision !== frame.revision || time <= frame.time) return from;
    return poseBetween(from, this.#poseIn(next, link), (time - frame.time) / (next.time - frame.time), this.#pose);
  }

  /// The position of a joint in a frame; undefined if it was not there.
  joint(handle, frame) {
    const place = this.layouts.get(frame.revision)?.axes.get(handle);
    return place === undefined ? undefined : frame.joints[place];
  }

  #poseIn(frame, link) {
    const layout = this.layouts.get(frame.revision);
    if (!layout?.there.has(link.handle)) return null;
    const row = layout.rows.get(link.handle);
    return row === undefined ? link.pose : frame.poses.subarray(7 * row, 7 * row + 7);
  }
}

function sizeOf({ poses, joints }) {
  return poses.byteLength + joints.byteLength;
}
