// SPDX-License-Identifier: BSD-3-Clause
// The shapes of the scene. Shapes of equal geometry and material are drawn together, as instances: thousands of boxes
// cost one draw call.
import { Color, DynamicDrawUsage, Group, InstancedBufferAttribute, InstancedMesh, Matrix4, Vector3 } from "three";

import { geometryKey, makeGeometry } from "./geometry.js";
import { makeMaterial, makeTexture, materialKey } from "./materials.js";
import { poseMatrix } from "./pose_matrix.js";

/// Instances of one geometry and material.
class Batch {
  mesh = null;
  parts = []; // { link, visual, local, colour }, in the order of the instances

  constructor(owner, geometry, material, key) {
    Object.assign(this, { owner, geometry, material, key });
  }

  rebuild(group) {
    if (this.mesh) {
      group.remove(this.mesh);
      this.mesh.dispose();
      this.mesh = null;
    }
    if (!this.parts.length) return;
    const still = Float32Array.from(this.parts, ({ link }) => (link.static ? 1 : 0));
    this.geometry.setAttribute("still", new InstancedBufferAttribute(still, 1));
    const mesh = new InstancedMesh(this.geometry, this.material, this.parts.length);
    mesh.instanceMatrix.setUsage(DynamicDrawUsage);
    mesh.frustumCulled = false;
    mesh.castShadow = this.key.endsWith("shadow");
    mesh.receiveShadow = true;
    mesh.userData.parts = this.parts;
    this.parts.forEach((part, place) => mesh.setColorAt(place, part.colour));
    this.mesh = mesh;
    group.add(mesh);
  }
}

/// The visuals or the collision shapes of all links.
export class Bodies {
  group = new Group();
  /// Where the links are: a matrix for each handle.
  matrices = new Map();
  #batches = new Map();
  #byLink = new Map(); // handle: parts
  #app;
  #options;
  #meshes = new Map();
  #textures = new Map();
  #world = new Matrix4();

  /// `options`: shapes(link) lists the shapes, material(shape) replaces their material.
  constructor(app, options) {
    this.#app = app;
    this.#options = options;
    app.scene.on("cleared", () => {
      this.#meshes.clear();
      this.#textures.clear();
    });
  }

  /// Resolves when everything that was asked for is there.
  async settled() {
    await Promise.all([...this.#meshes.values(), ...this.#textures.values()]);
  }

  async add(objects) {
    const waiting = [];
    for (const object of objects) {
      if (object.kind !== "link") continue;
      this.#byLink.set(object.handle, []);
      for (const visual of this.#options.shapes(object)) waiting.push(this.#addShape(object, visual));
    }
    await Promise.all(waiting);
    this.#rebuildChanged();
  }

  remove(objects) {
    const gone = new Set(objects.map(({ handle }) => handle));
    for (const batch of this.#batches.values()) {
      const left = batch.parts.filter((part) => !gone.has(part.link.handle));
      if (left.length !== batch.parts.length) {
        batch.parts = left;
        batch.changed = true;
      }
    }
    for (const handle of gone) {
      this.#byLink.delete(handle);
      this.matrices.delete(handle);
    }
    this.#rebuildChanged();
  }

  /// Moves all instances to the poses of their links; `poseOf(link)` returns them, null hides a link.
  update(poseOf, all = false) {
    for (const [handle, parts] of this.#byLink) {
      const link = parts[0]?.link;
      if (!link || (!all && !this.#app.scene.linkIndex.has(handle) && this.matrices.has(handle))) continue;
      let matrix = this.matrices.get(handle);
      if (!matrix) this.matrices.set(handle, (matrix = new Matrix4()));
      const pose = poseOf(link);
      if (pose) poseMatrix(pose, matrix);
      else matrix.makeScale(0, 0, 0);
      for (const part of parts) {
        if (part.place === undefined || !part.batch.mesh) continue;
        part.batch.mesh.setMatrixAt(part.place, this.#world.multiplyMatrices(matrix, part.local));
        part.batch.mesh.instanceMatrix.needsUpdate = true;
        part.batch.mesh.boundingSphere = null; // for rays
      }
    }
  }

  /// The parts of a link: { mesh geometry, world matrix } for outlines.
  partsOf(handle) {
    return this.#byLink.get(handle) ?? [];
  }

  /// Shows links in the colours that were set for them.
  async recolour(links) {
    const others = [];
    for (const link of links) {
      const parts = this.partsOf(link.handle);
      const colour = this.#app.scene.colours.get(link.handle);
      if (!colour) continue; // of a scene that is gone
      if (!parts.every(({ coloured }) => coloured)) {
        others.push(link);
        continue;
      }
      for (const part of parts) {
        part.colour.setRGB(...colour);
        if (!part.batch.mesh || part.place === undefined) continue;
        part.batch.mesh.setColorAt(part.place, part.colour);
        part.batch.mesh.instanceColor.needsUpdate = true;
      }
    }
    this.remove(others);
    await this.add(others);
    this.#app.view.invalidate();
  }

  async #addShape(link, visual) {
    const { shape } = visual;
    const set = visual.material && this.#app.scene.colours.get(link.handle);
    const material = set ? { diffuse: set, emissive: [0, 0, 0] } : (visual.material ?? this.#options.material(visual, link));
    const materials = set ? undefined : visual.materials;
    const { key, scale } = geometryKey(shape);
    const shared = !materials && !material.checker_size;
    const name = [
      key,
      shared ? materialKey(material) : `own ${JSON.stringify([scale, materials ?? material])}`,
      visual.cast_shadows === false ? "" : "shadow",
    ].join(" | ");
    let mesh;
    if (shape.type === "mesh") {
      try {
        mesh = await this.#load(this.#meshes, "window.mesh", shape.mesh);
      } catch (error) {
        if (this.#app.link.connected) console.warn(`a mesh of ${link.path}: ${error.message}`);
        return;
      }
    }
    if (!this.#byLink.has(link.handle)) return; // removed meanwhile
    let batch = this.#batches.get(name);
    if (!batch) {
      const geometry = makeGeometry(shape, mesh);
      const loadTexture = (number) => this.#texture(number);
      let made;
      if (this.#options.makeMaterial) made = this.#options.makeMaterial(visual, link);
      else if (materials) made = materials.map((each) => makeMaterial(each, loadTexture, true));
      else made = makeMaterial(material, loadTexture);
      if (!shared) geometry.scale(...scale); // checkers count in metres
      batch = new Batch(this, geometry, made, name);
      this.#batches.set(name, batch);
    }
    const local = poseMatrix(visual.pose);
    if (shared) local.scale(new Vector3(...scale));
    const plain = shared && material.texture === undefined;
    const colour = plain || material.checker_size ? new Color(...material.diffuse) : new Color(1, 1, 1);
    const part = { link, visual, local, colour, batch, coloured: Boolean(set) };
    batch.parts.push(part);
    batch.changed = true;
    this.#byLink.get(link.handle).push(part);
  }

  #rebuildChanged() {
    for (const [name, batch] of this.#batches) {
      if (!batch.changed) continue;
      batch.changed = false;
      batch.parts.forEach((part, place) => (part.place = place));
      batch.rebuild(this.group);
      if (!batch.parts.length) {
        batch.geometry.dispose();
        for (const each of [batch.material].flat()) each.dispose();
        this.#batches.delete(name);
      }
    }
    this.matrices.clear(); // all are set again
    this.#app.view.invalidate();
  }

  #load(table, name, number) {
    if (!table.has(number)) table.set(number, this.#app.link.call(name, [number], "meshes"));
    return table.get(number);
  }

  #texture(number) {
    if (!this.#textures.has(number)) {
      const loading = this.#app.link.call("window.texture", [number], "meshes").then(makeTexture);
      loading.then(() => this.#app.view.invalidate());
      this.#textures.set(number, loading);
    }
    return this.#textures.get(number);
  }
}
