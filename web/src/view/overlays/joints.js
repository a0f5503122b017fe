// SPDX-License-Identifier: BSD-3-Clause
// The axes of joints: a line along each axis, with a ring for those that turn and an arrow for those that slide.
import { Quaternion, Vector3 } from "three";

import { markers } from "./markers.js";

const LENGTH = 0.16; // m
const RADIUS = 0.05;
const SEGMENTS = 24;

export const joints = {
  id: "joints",
  title: "Joint axes",
  key: "j",
  on: false,
  create: (app) =>
    markers(app, (object) => {
      if (object.kind !== "joint") return null;
      return object.axes.map((axis) => ({ color: 0xffb02e, points: axisLines(object.type, axis) }));
    }),
};

function axisLines(type, { direction }) {
  const along = new Vector3(...direction).normalize();
  const end = along.clone().multiplyScalar(LENGTH);
  const lines = [-end.x, -end.y, -end.z, end.x, end.y, end.z];
  const turn = new Quaternion().setFromUnitVectors(new Vector3(0, 0, 1), along);
  const point = (x, y, z) => new Vector3(x, y, z).applyQuaternion(turn).toArray();
  if (type === "prismatic") {
    for (const side of [1, -1]) lines.push(...point(0, 0, LENGTH), ...point(0.03 * side, 0, LENGTH - 0.05));
  } else {
    for (let i = 0; i < SEGMENTS; ++i) {
      const [a, b] = [i, i + 1].map((each) => (2 * Math.PI * each) / SEGMENTS);
      lines.push(...point(RADIUS * Math.cos(a), RADIUS * Math.sin(a), 0), ...point(RADIUS * Math.cos(b), RADIUS * Math.sin(b), 0));
    }
  }
  return lines;
}
