// SPDX-License-Identifier: BSD-3-Clause
// Lines that are attached to objects.
import { BufferGeometry, Float32BufferAttribute, Group, LineBasicMaterial, LineSegments } from "three";

const materials = new Map();

function material(color) {
  if (!materials.has(color)) materials.set(color, new LineBasicMaterial({ color, depthTest: false, transparent: true }));
  return materials.get(color);
}

/// Lines in world or object axes: points are x, y, z of both ends of each.
export function segments(points, color) {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute(points, 3));
  const lines = new LineSegments(geometry, material(color));
  lines.renderOrder = 5;
  return lines;
}

/// An overlay's layer: `linesOf(object)` returns a list of { color, points } in the object's frame, or null.
export function markers(app, linesOf) {
  const group = new Group();
  let shown = []; // { holder, object }
  let stale = true;
  app.scene.on("changed", () => {
    stale = true;
    app.view?.invalidate();
  });
  const rebuild = () => {
    stale = false;
    for (const { holder } of shown) for (const lines of holder.children) lines.geometry.dispose();
    group.clear();
    shown = [];
    for (const object of app.scene.objects.values()) {
      const found = linesOf(object);
      if (!found?.length) continue;
      const holder = new Group();
      holder.matrixAutoUpdate = false;
      for (const { color, points } of found) holder.add(segments(points, color));
      group.add(holder);
      shown.push({ holder, object });
      if (shown.length > 3000) break;
    }
  };
  return {
    object3d: group,
    update() {
      if (stale) rebuild();
      for (const { holder, object } of shown) {
        app.view.matrixOf(object, holder.matrix);
        holder.matrixWorldNeedsUpdate = true;
      }
    },
  };
}
