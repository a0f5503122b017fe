// SPDX-License-Identifier: BSD-3-Clause

/// Writes the pose at a share of the way between two rows of frames, and returns it: x, y, z and a quaternion x, y, z, w.
export function poseBetween(from, to, share, pose) {
  // The shorter way between the quaternions.
  const sign = from[3] * to[3] + from[4] * to[4] + from[5] * to[5] + from[6] * to[6] < 0 ? -1 : 1;
  let norm = 0;
  for (let i = 0; i < 7; ++i) {
    pose[i] = from[i] + share * ((i > 2 ? sign : 1) * to[i] - from[i]);
    if (i > 2) norm += pose[i] * pose[i];
  }
  norm = 1 / Math.sqrt(norm);
  for (let i = 3; i < 7; ++i) pose[i] *= norm;
  return pose;
}
