// SPDX-License-Identifier: BSD-3-Clause
// The paths that models have driven, since the start of the run or since the page was opened.
import { BufferAttribute, BufferGeometry, DynamicDrawUsage, Group, Line, LineBasicMaterial, Matrix4 } from "three";

const LEAST = 0.01; // m between two points
const MOST = 20000; // points of a model
const MODELS = 50;
const COLOURS = [0x2f81f7, 0xff7b25, 0x3fb950, 0xd2569c, 0xa371f7, 0xd4a72c];

export const paths = {
  id: "paths",
  title: "Path driven",
  key: "t",
  live: true,
  on: true,
  create(app) {
    const group = new Group();
    const lines = new Map(); // handle of a model: { line, count, last }
    let time = 0;
    const clear = () => {
      for (const { line } of lines.values()) line.geometry.dispose();
      lines.clear();
      group.clear();
    };
    const matrix = new Matrix4();
    app.scene.on("changed", ({ removed }) => {
      if (removed.length) clear();
    });
    app.link.on("frame", (frame) => {
      if (frame.time < time) clear();
      const moved = frame.time > time; // by the simulation, not by hand
      time = frame.time;
      if (!moved || frame.revision !== app.scene.revision) return;
      let followed = 0;
      for (const model of app.scene.children()) {
        if (model.static || !app.scene.linkIndex.has(model.canonical_link)) continue;
        if (++followed > MODELS) break;
        const { elements } = app.view.poses.latest(model, matrix);
        append(model.handle, elements[12], elements[13], elements[14] + 0.01);
      }
    });
    const append = (handle, x, y, z) => {
      let path = lines.get(handle);
      if (!path) {
        const geometry = new BufferGeometry();
        geometry.setAttribute("position", new BufferAttribute(new Float32Array(3 * MOST), 3).setUsage(DynamicDrawUsage));
        const line = new Line(geometry, new LineBasicMaterial({ color: COLOURS[lines.size % COLOURS.length] }));
        line.frustumCulled = false;
        path = { line, count: 0, last: [Infinity, 0, 0] };
        lines.set(handle, path);
        group.add(line);
      }
      const { last, line } = path;
      if (Math.hypot(x - last[0], y - last[1], z - last[2]) < LEAST || path.count >= MOST) return;
      path.last = [x, y, z];
      const attribute = line.geometry.attributes.position;
      attribute.setXYZ(path.count++, x, y, z);
      attribute.addUpdateRange(3 * (path.count - 1), 3);
      attribute.needsUpdate = true;
      line.geometry.setDrawRange(0, path.count);
    };
    return { object3d: group };
  },
};
