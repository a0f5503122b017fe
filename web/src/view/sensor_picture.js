// SPDX-License-Identifier: BSD-3-Clause
// The scene as a camera sensor sees it.
import { MathUtils, Matrix4, PerspectiveCamera, Vector3, WebGLRenderTarget } from "three";

/// The scene as a camera sensor would see it, without overlays: { width, height, rgba }, from the top.
export function pictureFrom(view, sensor) {
  const { width, height, horizontal_fov: fov, near, far } = sensor.parameters;
  const camera = new PerspectiveCamera(1, width / height, near, far);
  camera.fov = MathUtils.radToDeg(2 * Math.atan((Math.tan(fov / 2) * height) / width));
  camera.updateProjectionMatrix();
  const axes = new Matrix4().makeBasis(new Vector3(0, -1, 0), new Vector3(0, 0, 1), new Vector3(-1, 0, 0));
  view.matrixOf(sensor).multiply(axes).decompose(camera.position, camera.quaternion, camera.scale);
  const target = new WebGLRenderTarget(width, height);
  const shown = view.scene3d.children.map((each) => each.visible);
  for (const each of view.scene3d.children) each.visible = each === view.world || each === view.lights.group;
  view.bodies.update((link) => view.poses.of(link));
  view.lights.place((link) => view.matrixOf(link));
  view.lights.follow(camera.position, 10);
  view.renderer.shadowMap.needsUpdate = true;
  view.renderer.setRenderTarget(target);
  view.seeThrough.without(() => view.renderer.render(view.scene3d, camera));
  const pixels = new Uint8Array(4 * width * height);
  view.renderer.readRenderTargetPixels(target, 0, 0, width, height, pixels);
  view.renderer.setRenderTarget(null);
  target.dispose();
  view.scene3d.children.forEach((each, place) => (each.visible = shown[place]));
  view.invalidate();
  const rgba = new Uint8ClampedArray(pixels.length);
  for (let row = 0; row < height; ++row) rgba.set(pixels.subarray(4 * width * row, 4 * width * (row + 1)), 4 * width * (height - 1 - row));
  return { width, height, rgba };
}
