// SPDX-License-Identifier: BSD-3-Clause
// What can be drawn over the scene. An overlay is a file with an object:
//   id, title, key   its name in the menu "Show", and its shortcut (optional)
//   live             it shows what the simulator has now, and is left out of a playback (optional)
//   on               whether it is shown at first
//   create(app)      returns { object3d, update(), toggle(on) }: what is added to the picture; update is called before
//                    each picture while it is shown, toggle when it is switched (both optional)
import { centres } from "./centres.js";
import { collisions } from "./collisions.js";
import { contacts } from "./contacts.js";
import { drawings } from "./drawings.js";
import { frames } from "./frames.js";
import { grid } from "./grid.js";
import { joints } from "./joints.js";
import { lidarPoints, lidarRays } from "./lidar_points.js";
import { outline } from "./outline.js";
import { paths } from "./paths.js";
import { rosMarkers } from "./ros_markers.js";
import { sensors } from "./sensors.js";

export const overlays = [
  grid,
  outline,
  paths,
  frames,
  joints,
  collisions,
  contacts,
  centres,
  sensors,
  lidarPoints,
  lidarRays,
  drawings,
  rosMarkers,
];
