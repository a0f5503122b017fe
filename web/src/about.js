// SPDX-License-Identifier: BSD-3-Clause
// The page "About": what this is, the shortcuts, and the licences of third-party modules.
import { h } from "./dom.js";

const SHORTCUTS = [
  ["Space", "play, pause"],
  ["Shift+Space", "stop"],
  ["N", "one step"],
  ["L", "play the last run back; back to live"],
  ["Left, Right", "one frame of the playback back, on"],
  ["W, E, Q, Esc", "move, turn, pull, select"],
  ["B", "snap to 0.1 m and 15 degrees"],
  ["Ctrl+Z, Ctrl+Y", "undo, redo"],
  ["Ctrl+S", "save the scene as; in the editor: save the script"],
  ["Ctrl+O", "open a recorded run, or a scene of CoppeliaSim"],
  ["Ctrl+D, Delete", "copy, delete the selected model"],
  ["F", "follow the selected object"],
  ["Home, 7, 1, 3", "whole scene, from above, front, right"],
  ["?", "this list"],
];

export async function showAbout(app) {
  const licences = await (await fetch("licences.json")).json();
  const dialog = h(
    "dialog.about",
    h("h2", "bubblesim"),
    h("p", "A robot simulator for ROS. Licence: BSD-3-Clause."),
    h("h3", "Shortcuts"),
    h(
      "dl",
      [...SHORTCUTS, ...app.view.overlays.filter(({ key }) => key).map(({ key, title }) => [key.toUpperCase(), title])].map(([key, text]) => [
        h("dt", h("kbd", key)),
        h("dd", text),
      ]),
    ),
    h("h3", "Third-party modules of this page"),
    licences.map(({ name, version, license, text }) => h("details", h("summary", `${name} ${version} (${license})`), h("pre", text))),
    h("form", { method: "dialog" }, h("button", "Close")),
  );
  dialog.addEventListener("close", () => dialog.remove());
  document.body.append(dialog);
  dialog.showModal();
}
