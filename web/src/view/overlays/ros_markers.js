// SPDX-License-Identifier: BSD-3-Clause
// Markers that ROS nodes publish. A marker's frame is that of a link of the scene of this name, or comes from tf; frames
// above which nothing is known are taken as the world.
import {
  ArrowHelper,
  BoxGeometry,
  BufferGeometry,
  CanvasTexture,
  Color,
  CylinderGeometry,
  DoubleSide,
  Float32BufferAttribute,
  Group,
  InstancedMesh,
  Line,
  LineBasicMaterial,
  LineSegments,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  Points,
  PointsMaterial,
  Quaternion,
  SphereGeometry,
  Sprite,
  SpriteMaterial,
  Vector3,
} from "three";

import { Poll } from "../../poll.js";
import { poseMatrix } from "../pose_matrix.js";

const PERIOD = 100; // ms between two polls
const [ARROW, CUBE, SPHERE, CYLINDER, LINE_STRIP, LINE_LIST, CUBE_LIST, SPHERE_LIST, POINTS, TEXT, , TRIANGLES] = Array(12).keys();
const SHAPES = {
  [CUBE]: () => new BoxGeometry(1, 1, 1),
  [CUBE_LIST]: () => new BoxGeometry(1, 1, 1),
  [SPHERE]: () => new SphereGeometry(0.5, 20, 12),
  [SPHERE_LIST]: () => new SphereGeometry(0.5, 12, 8),
  [CYLINDER]: () => new CylinderGeometry(0.5, 0.5, 1, 24).rotateX(Math.PI / 2),
};

const floats = (bytes) => new Float32Array(bytes.slice().buffer);

function material(Kind, { colour: [r, g, b, a], colours }, more = {}) {
  return new Kind({
    color: colours.length ? 0xffffff : new Color(r, g, b),
    transparent: a < 1,
    opacity: a,
    depthWrite: a === 1,
    ...more,
  });
}

/// The object of a marker in the marker's frame, or null: meshes are not drawn.
function build(marker) {
  const { type, scale, colour } = marker;
  const points = floats(marker.points);
  if (type === ARROW) {
    const from = points.length >= 6 ? new Vector3(...points.subarray(0, 3)) : new Vector3();
    const to = points.length >= 6 ? new Vector3(...points.subarray(3, 6)) : new Vector3(scale[0], 0, 0);
    const along = to.clone().sub(from);
    return new ArrowHelper(along.clone().normalize(), from, along.length(), new Color(...colour.slice(0, 3)));
  }
  if (type === TEXT) return text(marker);
  if (type in SHAPES) return shapes(marker, type === CUBE_LIST || type === SPHERE_LIST ? points : new Float32Array(3));
  if (![LINE_STRIP, LINE_LIST, POINTS, TRIANGLES].includes(type)) return null;
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute(points, 3));
  const vertexColors = marker.colours.length > 0;
  if (vertexColors) geometry.setAttribute("color", new Float32BufferAttribute(floats(marker.colours), 3));
  if (type === POINTS) return new Points(geometry, material(PointsMaterial, marker, { vertexColors, size: scale[0] }));
  if (type === TRIANGLES) return new Mesh(geometry, material(MeshBasicMaterial, marker, { vertexColors, side: DoubleSide }));
  return new (type === LINE_STRIP ? Line : LineSegments)(geometry, material(LineBasicMaterial, marker, { vertexColors }));
}

function shapes(marker, points) {
  const mesh = new InstancedMesh(SHAPES[marker.type](), material(MeshLambertMaterial, marker), points.length / 3);
  const colours = floats(marker.colours);
  const size = new Vector3(...marker.scale);
  for (let i = 0; i < mesh.count; ++i) {
    mesh.setMatrixAt(i, new Matrix4().compose(new Vector3(...points.subarray(3 * i, 3 * i + 3)), new Quaternion(), size));
    if (colours.length) mesh.setColorAt(i, new Color(...colours.subarray(3 * i, 3 * i + 3)));
  }
  return mesh;
}

function text({ text: words, scale, colour: [r, g, b] }) {
  const canvas = document.createElement("canvas");
  const pen = canvas.getContext("2d");
  const font = "48px sans-serif";
  pen.font = font;
  canvas.width = Math.ceil(pen.measureText(words).width) + 8;
  canvas.height = 64;
  pen.font = font;
  pen.fillStyle = new Color(r, g, b).getStyle();
  pen.fillText(words, 4, 48);
  const sprite = new Sprite(new SpriteMaterial({ map: new CanvasTexture(canvas), depthTest: false, transparent: true }));
  sprite.scale.set((scale[2] * canvas.width) / canvas.height, scale[2], 1);
  return sprite;
}

function dispose(group) {
  group.traverse((each) => {
    each.geometry?.dispose();
    each.material?.map?.dispose();
    each.material?.dispose();
    if (each.isInstancedMesh) each.dispose();
  });
  group.clear();
}

export const rosMarkers = {
  id: "ros_markers",
  title: "Markers of ROS nodes",
  live: true,
  on: false,
  create(app) {
    const object3d = new Group();
    const holders = new Map(); // by frame
    let revision = -1;
    let frames = {};
    const links = new Map(); // by the names that frames may have
    app.scene.on("changed", () => {
      links.clear();
      for (const each of app.scene.objects.values()) {
        if (each.kind !== "link") continue;
        for (const name of [each.path.slice(1), each.name]) if (!links.has(name)) links.set(name, each);
      }
    });
    const show = (markers) => {
      dispose(object3d);
      holders.clear();
      for (const marker of markers) {
        const child = build(marker);
        if (!child) continue;
        if (!holders.has(marker.frame)) {
          const holder = new Group();
          holder.matrixAutoUpdate = false;
          holders.set(marker.frame, holder);
          object3d.add(holder);
        }
        const placed = new Group();
        placed.position.fromArray(marker.position);
        placed.quaternion.fromArray(marker.orientation);
        placed.add(child);
        child.frustumCulled = false;
        holders.get(marker.frame).add(placed);
      }
      app.rosMarkers = markers; // for tests
    };
    const poll = new Poll(app, PERIOD, async () => {
      const changes = await app.link.call("server.markers", [revision], "markers");
      ({ revision, frames } = changes);
      if (changes.markers) show(changes.markers);
      app.view.invalidate();
    });
    app.link.on("connection", () => (revision = -1));
    return {
      object3d,
      update() {
        for (const [frame, holder] of holders) {
          const above = frames[frame] ?? [[frame, []]];
          const [name, poses] = above.find(([each]) => links.has(each)) ?? above.at(-1);
          if (links.has(name)) app.view.matrixOf(links.get(name), holder.matrix);
          else holder.matrix.identity();
          for (const pose of poses) holder.matrix.multiply(poseMatrix(pose));
          holder.matrixWorldNeedsUpdate = true;
        }
      },
      toggle(on) {
        if (on) poll.start();
        else {
          poll.stop();
          revision = -1;
          if (app.link.connected) app.link.call("server.endMarkers", [], "markers").catch(() => {});
        }
      },
    };
  },
};
