// SPDX-License-Identifier: BSD-3-Clause
// The line of a first visit: how to look around and drive. It comes until it is closed.
import { h } from "./dom.js";

const STEPS = [
  ["Drag", "turns the view"],
  ["Right drag", "shifts"],
  ["Wheel", "zooms"],
  ["Double click", "looks at an object"],
  ["F", "follows it"],
  ["W A S D", "drives: tab Drive"],
  ["?", "all keys"],
];
const KEPT = "first-steps";

/// Returns the line, or null if it was closed in this browser.
export function firstSteps() {
  if (localStorage.getItem(KEPT) === "known") return null;
  const close = () => {
    localStorage.setItem(KEPT, "known");
    line.remove();
  };
  const line = h(
    "aside.first-steps",
    { "aria-label": "First steps" },
    h(
      "p",
      STEPS.map(([what, text]) => h("span", h("kbd", what), ` ${text}`)),
    ),
    h("button", { onclick: close }, "Got it"),
  );
  return line;
}
