// SPDX-License-Identifier: BSD-3-Clause
// Parts of the properties panel.
import { h, shortNumber } from "../../dom.js";

export function section(title, ...content) {
  return h("section", h("h3", title), content);
}

/// A table of [name, value].
export function fields(rows) {
  return h(
    "dl",
    rows.map(([name, value]) => [h("dt", name), h("dd", value instanceof Node ? value : String(value))]),
  );
}

export function numbers(values, digits = 3) {
  return values.map((each) => shortNumber(each, digits)).join(", ");
}

export function degrees(value) {
  return `${shortNumber((value * 180) / Math.PI, 1)}°`;
}
