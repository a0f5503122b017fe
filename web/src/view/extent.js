// SPDX-License-Identifier: BSD-3-Clause
// How large the shapes of objects are.
import { Matrix4, Vector3 } from "three";

/// { centre, radius } of an object's shapes in the world; of all moving objects and small static ones for null.
export function extentOf(app, object) {
  const { scene, view } = app;
  const low = new Vector3(Infinity, Infinity, Infinity);
  const high = new Vector3(-Infinity, -Infinity, -Infinity);
  const corner = new Vector3();
  const inside = (link) => {
    for (let each = link; each; each = scene.objects.get(each.parent)) if (each === object) return true;
    return object.handle === link.model;
  };
  for (const link of scene.objects.values()) {
    if (link.kind !== "link" || (object && !inside(link))) continue;
    const matrix = view.matrixOf(link);
    for (const { visual, local, batch } of view.bodies.partsOf(link.handle)) {
      if (visual.shape.type === "plane") continue;
      if (!batch.geometry.boundingBox) batch.geometry.computeBoundingBox();
      const box = batch.geometry.boundingBox;
      const world = new Matrix4().multiplyMatrices(matrix, local);
      const size = box.getSize(new Vector3()).applyMatrix4(new Matrix4().extractRotation(world));
      if (!object && link.static && size.length() > 60) continue;
      for (let i = 0; i < 8; ++i) {
        corner
          .set(i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z)
          .applyMatrix4(world);
        low.min(corner);
        high.max(corner);
      }
    }
  }
  if (!Number.isFinite(low.x)) {
    const centre = object ? new Vector3().setFromMatrixPosition(view.matrixOf(object)) : new Vector3();
    return { centre, radius: object ? 0.3 : 2 };
  }
  return { centre: low.clone().add(high).multiplyScalar(0.5), radius: Math.max(high.distanceTo(low) / 2, 0.05) };
}
