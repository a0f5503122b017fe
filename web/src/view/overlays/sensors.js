// SPDX-License-Identifier: BSD-3-Clause
// What sensors can see: volumes of proximity sensors, fans of lidars, the pyramids of cameras.
import { markers } from "./markers.js";

const SEGMENTS = 32;
const FAR = 3; // m, at most drawn of a camera's or lidar's range

export const sensors = {
  id: "sensors",
  title: "Sensor volumes",
  key: "v",
  on: false,
  create: (app) =>
    markers(app, (object) => {
      if (object.kind !== "sensor") return null;
      const points = { proximity, lidar, camera, depth_camera: camera }[object.parameters.kind]?.(object.parameters);
      return points ? [{ color: 0x2dd4bf, points }] : null;
    }),
};

function proximity({ volume, min_range: near, max_range: far, half_angle: half }) {
  if (volume === "ray") return [near, 0, 0, far, 0, 0];
  const lines = [];
  const tilt = Math.tan(half);
  if (volume === "disc") return fan(near, far, -half, half);
  if (volume === "pyramid") {
    const [a, b] = [near * tilt, far * tilt];
    for (const [y, z, y2, z2] of [[1, 1, 1, -1], [1, -1, -1, -1], [-1, -1, -1, 1], [-1, 1, 1, 1]]) {
      lines.push(near, a * y, a * z, far, b * y, b * z, far, b * y, b * z, far, b * y2, b * z2);
    }
    return lines;
  }
  const begin = volume === "cylinder" ? far * tilt : near * tilt;
  const circle = (x, radius) => {
    for (let i = 0; i < SEGMENTS; ++i) {
      const [a, b] = [i, i + 1].map((each) => (2 * Math.PI * each) / SEGMENTS);
      lines.push(x, radius * Math.cos(a), radius * Math.sin(a), x, radius * Math.cos(b), radius * Math.sin(b));
    }
  };
  const reach = volume === "cone" ? far * Math.cos(half) : far;
  circle(near, begin);
  circle(reach, volume === "cone" ? far * Math.sin(half) : far * tilt);
  for (let i = 0; i < 8; ++i) {
    const angle = (2 * Math.PI * i) / 8;
    const end = volume === "cone" ? far * Math.sin(half) : far * tilt;
    lines.push(near, begin * Math.cos(angle), begin * Math.sin(angle), reach, end * Math.cos(angle), end * Math.sin(angle));
  }
  return lines;
}

function fan(near, far, from, to) {
  const lines = [];
  const at = (radius, angle) => [radius * Math.cos(angle), radius * Math.sin(angle), 0];
  const steps = Math.max(2, Math.ceil(((to - from) / (2 * Math.PI)) * 2 * SEGMENTS));
  for (let i = 0; i < steps; ++i) {
    const [a, b] = [i, i + 1].map((each) => from + ((to - from) * each) / steps);
    lines.push(...at(far, a), ...at(far, b), ...at(near, a), ...at(near, b));
  }
  lines.push(...at(near, from), ...at(far, from), ...at(near, to), ...at(far, to));
  return lines;
}

function lidar({ min_range: near, max_range: far, min_angle: from, max_angle: to }) {
  return fan(near, Math.min(far, FAR), from, to);
}

function camera({ width, height, horizontal_fov: fov, near, far }) {
  const end = Math.min(far, FAR / 3);
  const lines = [];
  const y = Math.tan(fov / 2);
  const z = (y * height) / width;
  const corners = [[1, 1], [1, -1], [-1, -1], [-1, 1]];
  corners.forEach(([a, b], place) => {
    const [c, d] = corners[(place + 1) % 4];
    for (const x of [near, end]) lines.push(x, x * a * y, x * b * z, x, x * c * y, x * d * z);
    lines.push(near, near * a * y, near * b * z, end, end * a * y, end * b * z);
  });
  return lines;
}
