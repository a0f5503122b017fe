// SPDX-License-Identifier: BSD-3-Clause
// Where static shapes hide the robot that one looks at, only a part of their pixels is drawn: nothing has to be sorted,
// and what is behind keeps its depth.
import { Matrix4, Vector3 } from "three";

import { extentOf } from "./extent.js";

const LARGEST = 3; // m, radius of what is worth it

/// Uniforms of all materials: a ball that is to be seen, in the world, and the height of the ground below it.
const uniforms = { seenPlace: { value: new Vector3() }, seenRadius: { value: 0 }, seenBottom: { value: 0 } };

/// Lets a material of three.js be seen through; its geometry's attribute `still` is 1 for static shapes.
export function cutAway(shader) {
  Object.assign(shader.uniforms, uniforms);
  shader.vertexShader = shader.vertexShader
    .replace("#include <common>", "#include <common>\nattribute float still;\nvarying float seenStill;\nvarying vec3 seenAt;")
    .replace(
      "#include <project_vertex>",
      `#include <project_vertex>
      vec4 seenVertex = vec4(transformed, 1.0);
      #ifdef USE_INSTANCING
        seenVertex = instanceMatrix * seenVertex;
      #endif
      seenAt = (modelMatrix * seenVertex).xyz;
      seenStill = still;`,
    );
  shader.fragmentShader = shader.fragmentShader
    .replace(
      "#include <common>",
      `#include <common>
      varying float seenStill;
      varying vec3 seenAt;
      uniform vec3 seenPlace;
      uniform float seenRadius;
      uniform float seenBottom;`,
    )
    .replace(
      "void main() {",
      `void main() {
        if (seenStill > 0.5 && seenRadius > 0.0 && seenAt.z > seenBottom) {
          vec3 way = seenPlace - cameraPosition;
          float along = dot(seenAt - cameraPosition, way) / dot(way, way);
          float aside = distance(seenAt, cameraPosition + along * way) / (seenRadius * max(along, 1e-3));
          vec2 cell = mod(floor(gl_FragCoord.xy), 2.0);
          if (along > 0.0 && along < 1.0 - seenRadius / length(way)) {
            if (aside < 1.1 && cell.x + cell.y > 0.5) discard; // one pixel in four stays
            if (aside < 1.4 && cell.x != cell.y) discard; // at the edge every other one
          }
        }`,
    );
}

export class SeeThrough {
  on = localStorage.getItem("see-through") !== "no";
  #app;
  #seen = null; // { object, centre in its frame, radius, bottom below the centre }

  constructor(app) {
    this.#app = app;
    app.scene.on("changed", () => (this.#seen = null));
  }

  set(on) {
    this.on = on;
    localStorage.setItem("see-through", on ? "yes" : "no");
  }

  /// Call it before each picture from `camera`.
  update() {
    uniforms.seenRadius.value = 0;
    const object = this.on ? this.#object() : null;
    if (!object) return;
    const matrix = this.#app.view.matrixOf(object);
    if (this.#seen?.object !== object) {
      const { centre, radius } = extentOf(this.#app, object);
      this.#seen = { object, centre: centre.applyMatrix4(new Matrix4().copy(matrix).invert()), radius };
    }
    const { centre, radius } = this.#seen;
    if (radius > LARGEST) return;
    uniforms.seenPlace.value.copy(centre).applyMatrix4(matrix);
    uniforms.seenRadius.value = radius;
    uniforms.seenBottom.value = uniforms.seenPlace.value.z - radius / 2; // floors stay
  }

  /// Draws a picture in which nothing is seen through.
  without(draw) {
    const radius = uniforms.seenRadius.value;
    uniforms.seenRadius.value = 0;
    draw();
    uniforms.seenRadius.value = radius;
  }

  /// What is followed or selected, else the first model that moves.
  #object() {
    const { scene, selection, view } = this.#app;
    const chosen = view.viewpoint.following ?? selection.object;
    const model = chosen && scene.outermost(chosen);
    if (model && !model.static) return model;
    return scene.models.map((handle) => scene.objects.get(handle)).find((each) => each && !each.static) ?? null;
  }
}
