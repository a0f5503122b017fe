// SPDX-License-Identifier: BSD-3-Clause
// Geometries of shapes, z up. Most are of unit size and scaled per instance, so that equal ones share a batch.
import {
  BoxGeometry,
  BufferAttribute,
  BufferGeometry,
  CapsuleGeometry,
  CylinderGeometry,
  PlaneGeometry,
  Quaternion,
  SphereGeometry,
  Vector3,
} from "three";

// Lines of the grid that stands for an infinite plane, m: large triangles would be imprecise near the camera.
const PLANE = [2, 4, 8, 15, 30, 60, 120, 250, 500, 1000];

/// { key, scale } of a shape: shapes of equal key share a geometry, which is scaled.
export function geometryKey(shape) {
  switch (shape.type) {
    case "box":
      return { key: "box", scale: shape.size };
    case "sphere":
      return { key: "sphere", scale: [shape.radius, shape.radius, shape.radius] };
    case "ellipsoid":
      return { key: "sphere", scale: shape.radii };
    case "cylinder":
      return { key: "cylinder", scale: [shape.radius, shape.radius, shape.length] };
    case "capsule":
      return { key: `capsule ${shape.radius} ${shape.length}`, scale: [1, 1, 1] };
    case "plane":
      return { key: `plane ${shape.normal}`, scale: [1, 1, 1] };
    default:
      return { key: `mesh ${shape.mesh}`, scale: [1, 1, 1] };
  }
}

/// The geometry of a shape's key; for a mesh, of the arrays of window.mesh.
export function makeGeometry(shape, mesh) {
  switch (shape.type) {
    case "box":
      return new BoxGeometry(1, 1, 1);
    case "sphere":
    case "ellipsoid":
      return new SphereGeometry(1, 40, 24).rotateX(Math.PI / 2);
    case "cylinder":
      return new CylinderGeometry(1, 1, 1, 48).rotateX(Math.PI / 2);
    case "capsule":
      return new CapsuleGeometry(shape.radius, shape.length, 12, 32).rotateX(Math.PI / 2);
    case "plane": {
      const turn = new Quaternion().setFromUnitVectors(new Vector3(0, 0, 1), new Vector3(...shape.normal).normalize());
      return planeGeometry().applyQuaternion(turn);
    }
    default:
      return meshGeometry(mesh);
  }
}

function planeGeometry() {
  const lines = [...PLANE.toReversed().map((each) => -each), 0, ...PLANE];
  const geometry = new PlaneGeometry(1, 1, lines.length - 1, lines.length - 1);
  const { position } = geometry.attributes;
  for (let i = 0; i < position.count; ++i) {
    position.setXY(i, lines[i % lines.length], lines[lines.length - 1 - Math.floor(i / lines.length)]);
  }
  return geometry;
}

function meshGeometry(mesh) {
  const vertices = floats(mesh.vertices);
  const triangles = new Uint32Array(copy(mesh.triangles));
  const normals = floats(mesh.normals);
  const coordinates = floats(mesh.texture_coordinates);
  const materialOf = new Uint16Array(copy(mesh.material_of));
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(vertices, 3));
  if (coordinates.length) geometry.setAttribute("uv", new BufferAttribute(coordinates, 2));
  if (normals.length) geometry.setAttribute("normal", new BufferAttribute(normals, 3));
  if (materialOf.length) {
    // Triangles of one material lie together, in a group.
    const order = [...materialOf.keys()].sort((a, b) => materialOf[a] - materialOf[b]);
    const sorted = new Uint32Array(triangles.length);
    order.forEach((from, to) => sorted.set(triangles.subarray(3 * from, 3 * from + 3), 3 * to));
    for (let first = 0; first < order.length; ) {
      let end = first;
      while (end < order.length && materialOf[order[end]] === materialOf[order[first]]) ++end;
      geometry.addGroup(3 * first, 3 * (end - first), materialOf[order[first]]);
      first = end;
    }
    geometry.setIndex(new BufferAttribute(sorted, 1));
  } else {
    geometry.setIndex(new BufferAttribute(triangles, 1));
  }
  if (normals.length) return geometry;
  const flat = geometry.toNonIndexed();
  for (const group of geometry.groups) flat.addGroup(group.start, group.count, group.materialIndex);
  flat.computeVertexNormals();
  return flat;
}

/// The bytes in memory of their own: they may lie unaligned in a message.
function copy(bytes) {
  return bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength);
}

function floats(bytes) {
  return new Float32Array(copy(bytes));
}
