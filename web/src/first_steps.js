// SPDX-License-Identifier: BSD-3-Clause
// The line of a first visit: how to look around and drive. It comes until it is closed.
import { h } from "./dom.js";

const STEPS = [
  ["Drag", "turns the view"],
  ["Right drag", "shifts"],
  ["Wheel", "zooms"],
  ["Double click", "looks at an object"],
  ["F", "follows it"],
  ["?", "all keys"],
];
const step = ([what, text]) => h("span", h("kbd", what), ` ${text}`);
const KEPT = "first-steps";

/// Shows the line, unless it was closed in this browser.
export function showFirstSteps(app) {
  if (localStorage.getItem(KEPT) === "known") return;
  const close = () => {
    localStorage.setItem(KEPT, "known");
    line.remove();
  };
  const drive = step(["W A S D", "drives: tab Drive"]);
  app.link.on("scene", ({ ros }) => (drive.hidden = !ros));
  const line = h(
    "aside.first-steps",
    { "aria-label": "First steps" },
    h("p", STEPS.map(step), drive),
    h("button", { onclick: close }, "Got it"),
  );
  app.layout.centre.append(line);
}
