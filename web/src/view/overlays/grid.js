// SPDX-License-Identifier: BSD-3-Clause
// A grid on the ground: squares of 1 m, and the axes of the world (x red, y green).
import { BufferGeometry, Float32BufferAttribute, Group, LineBasicMaterial, LineSegments } from "three";

const HALF = 20; // m
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
  geometry.setAttribute("position", new Float32BufferAttribute(positions, 3));
  return new LineSegments(geometry, new LineBasicMaterial({ color, transparent: true, opacity, depthWrite: false }));
}
