// SPDX-License-Identifier: BSD-3-Clause
// What scripts draw: the drawing objects of sim.addDrawingObject.
import {
  BoxGeometry,
  BufferGeometry,
  CircleGeometry,
  Color,
  DoubleSide,
  Group,
  InstancedMesh,
  Float32BufferAttribute,
  Line,
  LineBasicMaterial,
  LineSegments,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  PlaneGeometry,
  Points,
  PointsMaterial,
  Quaternion,
  SphereGeometry,
  Vector3,
} from "three";

import { Poll } from "../../poll.js";
import { poseMatrix } from "../pose_matrix.js";

const PERIOD = 100; // ms between two polls
const SHAPES = {
  sphere: () => new SphereGeometry(0.5, 20, 12),
  cube: () => new BoxGeometry(1, 1, 1),
  disc: () => new CircleGeometry(0.5, 32),
  quad: () => new PlaneGeometry(1, 1),
  triangle: () => new BufferGeometry().setAttribute("position", new Float32BufferAttribute([-0.5, -0.2887, 0, 0.5, -0.2887, 0, 0, 0.5774, 0], 3)),
};

/// A drawing with the items that are known so far.
class Drawing {
  group = new Group();
  #rows = new Float32Array(0); // `values` for each item, from number #first on
  #first = 0;

  /// Takes what sim.getDrawings returns for it.
  take(changes) {
    const width = changes.values;
    const added = new Float32Array(changes.items.slice().buffer);
    const kept = Math.max(0, Math.min(changes.start, this.#first + this.#rows.length / width) - changes.first);
    const from = changes.first - this.#first;
    const rows = new Float32Array(kept * width + added.length);
    if (kept) rows.set(this.#rows.subarray(from * width, (from + kept) * width));
    rows.set(added, kept * width);
    this.#rows = rows;
    this.#first = changes.first;
    this.changes = changes;
    this.#build();
  }

  get count() {
    return this.changes ? this.#rows.length / this.changes.values : 0;
  }

  dispose() {
    for (const child of this.group.children) {
      child.geometry.dispose();
      child.material.dispose();
      child.dispose?.();
    }
    this.group.clear();
  }

  #build() {
    this.dispose();
    if (!this.count) return;
    const { kind } = this.changes;
    const child = kind in SHAPES ? this.#shapes() : this.#lines();
    child.frustumCulled = false;
    if (this.changes.overlay) {
      child.renderOrder = 10;
      child.material.depthTest = false;
    }
    this.group.add(child);
  }

  #material(Kind, more = {}) {
    const { changes } = this;
    const plain = changes.colour.map((value, i) => Math.max(value, changes.emission[i]));
    return new Kind({
      color: changes.colours ? 0xffffff : new Color(...plain),
      transparent: changes.opacity < 1,
      opacity: changes.opacity,
      depthWrite: changes.opacity === 1,
      ...more,
    });
  }

  #lines() {
    const { kind, coordinates, values, colours, size } = this.changes;
    const vertices = coordinates / 3;
    const positions = new Float32Array(this.count * coordinates);
    const shades = colours ? new Float32Array(this.count * coordinates) : null;
    for (let item = 0; item < this.count; ++item) {
      const row = this.#rows.subarray(item * values, (item + 1) * values);
      positions.set(row.subarray(0, coordinates), item * coordinates);
      for (let vertex = 0; shades && vertex < vertices; ++vertex) {
        const from = coordinates + (colours > 3 ? 3 * vertex : 0);
        shades.set(row.subarray(from, from + 3), item * coordinates + 3 * vertex);
      }
    }
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new Float32BufferAttribute(positions, 3));
    if (shades) geometry.setAttribute("color", new Float32BufferAttribute(shades, 3));
    const more = { vertexColors: Boolean(shades) };
    if (kind === "points") return new Points(geometry, this.#material(PointsMaterial, { ...more, size, sizeAttenuation: false }));
    if (kind === "triangles") {
      geometry.computeVertexNormals();
      return new Mesh(geometry, this.#material(MeshBasicMaterial, { ...more, side: DoubleSide, wireframe: this.changes.wireframe }));
    }
    const material = this.#material(LineBasicMaterial, { ...more, linewidth: size });
    return kind === "linestrip" ? new Line(geometry, material) : new LineSegments(geometry, material);
  }

  #shapes() {
    const { kind, coordinates, values, colours, sizes, size, emission, wireframe } = this.changes;
    const glows = emission.some(Boolean);
    const Kind = glows ? MeshBasicMaterial : MeshLambertMaterial;
    const geometry = SHAPES[kind]();
    if (!geometry.getAttribute("normal")) geometry.computeVertexNormals();
    const mesh = new InstancedMesh(geometry, this.#material(Kind, { side: DoubleSide, wireframe }), this.count);
    const matrix = new Matrix4();
    const place = new Vector3();
    const turn = new Quaternion();
    const scale = new Vector3();
    const colour = new Color();
    for (let item = 0; item < this.count; ++item) {
      const row = this.#rows.subarray(item * values, (item + 1) * values);
      place.fromArray(row);
      if (coordinates === 7) turn.fromArray(row, 3);
      scale.setScalar(sizes ? row[coordinates + colours] : size);
      mesh.setMatrixAt(item, matrix.compose(place, turn, scale));
      if (colours) mesh.setColorAt(item, colour.setRGB(row[coordinates], row[coordinates + 1], row[coordinates + 2]));
    }
    return mesh;
  }
}

export const drawings = {
  id: "drawings",
  title: "Drawings of scripts",
  key: undefined,
  live: true,
  on: true,
  create(app) {
    const object3d = new Group();
    const known = new Map(); // by handle
    let revision = 0;
    let poses = {};
    const clear = () => {
      for (const each of known.values()) each.dispose();
      known.clear();
      object3d.clear();
      revision = 0;
    };
    const poll = new Poll(app, PERIOD, async () => {
      const changes = await app.link.call("sim.getDrawings", [revision], "overlays");
      if (changes.revision < revision) clear();
      const there = new Set(changes.handles);
      let changed = changes.revision !== revision;
      for (const [handle, drawing] of known) {
        if (there.has(handle)) continue;
        object3d.remove(drawing.group);
        drawing.dispose();
        known.delete(handle);
      }
      for (const each of changes.changed) {
        if (!known.has(each.handle)) {
          const drawing = new Drawing();
          known.set(each.handle, drawing);
          object3d.add(drawing.group);
        }
        known.get(each.handle).take(each);
      }
      revision = changes.revision;
      changed ||= Object.keys(changes.poses).length > 0;
      poses = changes.poses;
      if (changed) app.view.invalidate();
    });
    app.link.on("scene", clear);
    app.drawings = known; // for tests
    return {
      object3d,
      update() {
        for (const { group, changes } of known.values()) {
          if (changes.parent === -1) continue;
          const object = app.scene.objects.get(changes.parent);
          group.matrixAutoUpdate = false;
          if (object) app.view.matrixOf(object, group.matrix);
          else if (poses[changes.parent]) poseMatrix(poses[changes.parent], group.matrix); // a dummy
          group.matrixWorldNeedsUpdate = true;
        }
      },
      toggle(on) {
        if (on) poll.start();
        else poll.stop();
      },
    };
  },
};
