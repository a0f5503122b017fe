// SPDX-License-Identifier: BSD-3-Clause
// The panels of the page, in the order of their tabs. A panel is a file with an object:
//   id, title
//   place          left, right or bottom
//   create(app)    returns its element; app is described in main.js
//   needsRos       its tab is hidden for scenes without ROS (optional)
//   show(), hide() called when its tab is selected, and when another one is (both optional)
import { build } from "./build.js";
import { cameras } from "./cameras.js";
import { output } from "./console.js";
import { dialogs } from "./dialogs.js";
import { driving } from "./driving.js";
import { models } from "./models.js";
import { plots } from "./plots.js";
import { problems } from "./problems.js";
import { properties } from "./properties.js";
import { record } from "./record.js";
import { scripts } from "./scripts.js";
import { tree } from "./tree.js";

export const panels = [tree, models, build, properties, dialogs, driving, record, output, scripts, plots, cameras, problems];
