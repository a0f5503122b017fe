// SPDX-License-Identifier: BSD-3-Clause
// Materials as the simulator's cameras see them: diffuse reflection, checkerboards, images.
import { Color, DataTexture, DoubleSide, LinearFilter, LinearMipmapLinearFilter, MeshLambertMaterial, RepeatWrapping, RGBAFormat } from "three";

import { cutAway } from "./see_through.js";

/// Two materials of equal key differ in their diffuse colours only.
export function materialKey(material) {
  if (material.texture !== undefined) return `texture ${material.texture} ${material.emissive}`;
  if (material.checker_size) return `checker ${material.checker_size} ${material.checker_color} ${material.emissive}`;
  return `plain ${material.emissive}`;
}

/// `diffuse`: the material has its colour itself, not from its instances.
export function makeMaterial(material, loadTexture, diffuse = false) {
  const made = new MeshLambertMaterial({
    color: diffuse && material.texture === undefined ? new Color(...material.diffuse) : new Color(1, 1, 1),
    emissive: new Color(...material.emissive),
    shadowSide: DoubleSide,
    polygonOffset: true, // edges of the selection lie before their surfaces
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 1,
  });
  if (material.texture !== undefined) {
    loadTexture(material.texture).then((texture) => {
      made.map = texture;
      made.needsUpdate = true;
    });
  }
  const checkered = material.texture === undefined && material.checker_size;
  made.onBeforeCompile = (shader) => {
    if (checkered) addChecker(shader, material);
    cutAway(shader);
  };
  made.customProgramCacheKey = () => (checkered ? "checkered" : "plain");
  return made;
}

/// Squares in the shape's frame, as in the simulator's own shading.
function addChecker(shader, { checker_size: size, checker_color: color }) {
  shader.uniforms.checkerColor = { value: new Color(...color) };
  shader.uniforms.checkerSize = { value: size };
  shader.vertexShader = shader.vertexShader
    .replace("#include <common>", "#include <common>\nvarying vec3 checkerPlace;")
    .replace("#include <begin_vertex>", "#include <begin_vertex>\ncheckerPlace = position;");
  shader.fragmentShader = shader.fragmentShader
    .replace("#include <common>", "#include <common>\nvarying vec3 checkerPlace;\nuniform vec3 checkerColor;\nuniform float checkerSize;")
    .replace(
      "#include <color_fragment>",
      `#include <color_fragment>
      vec3 checkerCell = floor(checkerPlace / checkerSize + 1e-4);
      if (mod(checkerCell.x + checkerCell.y + checkerCell.z, 2.0) > 0.5) diffuseColor.rgb = checkerColor;`,
    );
}

/// The texture of window.texture's result.
export function makeTexture({ width, height, rgb }) {
  const data = new Uint8Array(4 * width * height);
  for (let row = 0; row < height; ++row) {
    // From the bottom: texture coordinates begin there.
    let to = 4 * width * (height - 1 - row);
    for (let from = 3 * width * row; from < 3 * width * (row + 1); from += 3, to += 4) {
      data[to] = rgb[from];
      data[to + 1] = rgb[from + 1];
      data[to + 2] = rgb[from + 2];
      data[to + 3] = 255;
    }
  }
  const texture = new DataTexture(data, width, height, RGBAFormat);
  texture.wrapS = texture.wrapT = RepeatWrapping;
  texture.magFilter = LinearFilter;
  texture.minFilter = LinearMipmapLinearFilter;
  texture.generateMipmaps = true;
  texture.anisotropy = 4;
  texture.needsUpdate = true;
  return texture;
}
