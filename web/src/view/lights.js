// SPDX-License-Identifier: BSD-3-Clause
// The lights of the scene. Three.js divides by pi what a surface reflects, the simulator's cameras do not.
import { AmbientLight, Color, DirectionalLight, Group, PointLight, SpotLight, Vector3 } from "three";

const SHADOW_SPAN = 12; // m around the point that is looked at
const MAP_SIZE = 2048; // texels
// A texel covers a part of an inclined surface, and the filter looks at its neighbours: a surface shades itself unless
// it is looked up this far in front of it.
const NORMAL_BIAS = 2.5; // texels

export class Lights {
  group = new Group();
  #suns = [];
  #carried = []; // those of links

  /// Shows the lights of the world and those of links.
  set(environment, links, shadows) {
    this.group.clear();
    this.#suns = [];
    this.#carried = [];
    this.group.add(new AmbientLight(new Color(...environment.ambient), Math.PI));
    for (const light of environment.lights) this.#add(light, shadows && environment.shadows);
    for (const link of links) {
      for (const description of link.lights) {
        this.#carried.push({ link, description, ...this.#add(description, shadows && environment.shadows) });
      }
    }
  }

  /// Moves the lights of links; `matrixOf(link)` returns where links are.
  place(matrixOf) {
    for (const { link, description, light, sun } of this.#carried) {
      const matrix = matrixOf(link);
      const direction = new Vector3(...description.direction).transformDirection(matrix);
      if (sun) sun.direction.copy(direction);
      else light.position.set(...description.position).applyMatrix4(matrix);
      if (light.target && !sun) light.target.position.copy(light.position).add(direction);
    }
  }

  /// Keeps the shadows around a point.
  follow(target, distance) {
    const span = Math.min(Math.max(distance, 2), 4 * SHADOW_SPAN);
    for (const { light, direction } of this.#suns) {
      light.target.position.copy(target);
      light.position.copy(target).addScaledVector(direction, -3 * span);
      const { camera } = light.shadow;
      camera.left = camera.bottom = -span;
      camera.right = camera.top = span;
      camera.near = 0.05;
      camera.far = 6 * span;
      camera.updateProjectionMatrix();
      light.shadow.normalBias = (NORMAL_BIAS * 2 * span) / MAP_SIZE; // m
    }
  }

  #add(description, shadows) {
    const colour = new Color(...description.diffuse);
    let light;
    let sun = null;
    if (description.kind === "directional") {
      light = new DirectionalLight(colour, Math.PI);
      sun = { light, direction: new Vector3(...description.direction).normalize() };
      this.#suns.push(sun);
    } else if (description.kind === "point") {
      light = new PointLight(colour, Math.PI, description.range, 1);
      light.position.set(...description.position);
    } else {
      light = new SpotLight(colour, Math.PI, description.range, description.outer_angle / 2, 0.3, 1);
      light.position.set(...description.position);
      light.target.position.copy(light.position).add(new Vector3(...description.direction));
    }
    if (shadows && description.cast_shadows && description.kind !== "point") {
      light.castShadow = true;
      light.shadow.mapSize.set(MAP_SIZE, MAP_SIZE);
      light.shadow.bias = -0.0001;
      light.shadow.normalBias = 0.01; // m; of directional lights: see follow()
    }
    this.group.add(light);
    if (light.target) this.group.add(light.target);
    return { light, sun };
  }
}
