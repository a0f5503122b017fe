// SPDX-License-Identifier: BSD-3-Clause
// A grid on the ground: squares of 1 m, and the axes of the world (x red, y green).
import { BufferGeometry, Float32BufferAttribute, Group, LineBasicMaterial, LineSegments } from "three";

const HALF = 20; // m
const PART = 1; // m; some drivers drop a whole line that leads behind the camera, so lines are made of short ones
const LIFT = 0.002; // m above the ground

export const grid = {
  id: "grid",
  title: "Grid",
  key: "g",
  on: true,
  create() {
    const group = new Group();
    const fine = [];
    for (let i = -HALF; i <= HALF; ++i) {
      if (i === 0) continue;
      fine.push(i, -HALF, LIFT, i, HALF, LIFT, -HALF, i, LIFT, HALF, i, LIFT);
    }
    group.add(lines(fine, 0x8090a0, 0.28));
    group.add(lines([-HALF, 0, LIFT, 0, 0, LIFT, 0, -HALF, LIFT, 0, 0, LIFT], 0x8090a0, 0.45));
    group.add(lines([0, 0, LIFT, HALF, 0, LIFT], 0xe5534b, 0.9));
    group.add(lines([0, 0, LIFT, 0, HALF, LIFT], 0x57ab5a, 0.9));
    return { object3d: group };
  },
};

function lines(positions, color, opacity) {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute(inParts(positions), 3));
  return new LineSegments(geometry, new LineBasicMaterial({ color, transparent: true, opacity, depthWrite: false }));
}

/// Splits lines, six numbers each, into parts.
function inParts(positions) {
  const parts = [];
  for (let at = 0; at < positions.length; at += 6) {
    const from = positions.slice(at, at + 3);
    const to = positions.slice(at + 3, at + 6);
    const count = Math.ceil(Math.hypot(...from.map((each, axis) => to[axis] - each)) / PART);
    const point = (number) => from.map((each, axis) => each + ((to[axis] - each) * number) / count);
    for (let part = 0; part < count; ++part) parts.push(...point(part), ...point(part + 1));
  }
  return parts;
}
