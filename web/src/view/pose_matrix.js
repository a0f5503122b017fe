// SPDX-License-Identifier: BSD-3-Clause
import { Matrix4, Quaternion, Vector3 } from "three";

const ONE = new Vector3(1, 1, 1);
const place = new Vector3();
const turn = new Quaternion();

/// The matrix of a pose: x, y, z (m) and the quaternion x, y, z, w.
export function poseMatrix(pose, target = new Matrix4()) {
  return target.compose(place.set(pose[0], pose[1], pose[2]), turn.set(pose[3], pose[4], pose[5], pose[6]), ONE);
}
