// SPDX-License-Identifier: BSD-3-Clause
// The frames of models, links and sensors: x red, y green, z blue.
import { markers } from "./markers.js";

const LENGTH = 0.12; // m

export const frames = {
  id: "frames",
  title: "Frames",
  key: "x",
  on: false,
  create: (app) =>
    markers(app, (object) => {
      if (object.static && object.kind === "link") return null;
      const size = object.kind === "model" ? 2 * LENGTH : LENGTH;
      return [
        { color: 0xff4d4d, points: [0, 0, 0, size, 0, 0] },
        { color: 0x4cd964, points: [0, 0, 0, 0, size, 0] },
        { color: 0x4d9bff, points: [0, 0, 0, 0, 0, size] },
      ];
    }),
};
