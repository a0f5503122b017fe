// SPDX-License-Identifier: BSD-3-Clause
// Edges of the selected object.
import { EdgesGeometry, Group, LineBasicMaterial, LineSegments, Matrix4 } from "three";

export const outline = {
  id: "outline",
  title: "Outline of the selection",
  on: true,
  create(app) {
    const group = new Group();
    const material = new LineBasicMaterial({ color: 0xffa116, transparent: true, opacity: 0.9 });
    const edges = new Map(); // by geometry
    let shown = []; // { lines, link, local }
    const rebuild = () => {
      group.clear();
      shown = [];
      const { object } = app.selection;
      if (!object) return;
      for (const link of linksBelow(app.scene, object)) {
        for (const { local, batch, visual } of app.view.bodies.partsOf(link.handle)) {
          if (visual.shape.type === "plane") continue;
          if (!edges.has(batch.geometry)) edges.set(batch.geometry, new EdgesGeometry(batch.geometry, 30));
          const lines = new LineSegments(edges.get(batch.geometry), material);
          lines.matrixAutoUpdate = false;
          lines.renderOrder = 10;
          group.add(lines);
          shown.push({ lines, link, local });
        }
        if (shown.length > 400) break;
      }
    };
    app.selection.on("changed", rebuild);
    const matrix = new Matrix4();
    return {
      object3d: group,
      update() {
        for (const { lines, link, local } of shown) {
          lines.matrix.multiplyMatrices(app.view.matrixOf(link, matrix), local);
          lines.matrixWorldNeedsUpdate = true;
        }
      },
    };
  },
};

function* linksBelow(scene, object) {
  if (object.kind === "link") yield object;
  if (object.kind === "model") for (const child of scene.children(object.handle)) yield* linksBelow(scene, child);
}
