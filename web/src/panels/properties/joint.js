// SPDX-License-Identifier: BSD-3-Clause
// The axes of a joint: position, velocity and effort now, and its motor's mode and target.
import { h, shortNumber } from "../../dom.js";
import { fields, section } from "./sections.js";

const MODES = ["none", "velocity", "position", "effort"];
const OPEN = { velocity: 10, position: Math.PI, effort: 10 }; // ranges of sliders without limits

export function jointSection(app, joint) {
  if (!joint.axes.length) return { element: section("Joint", h("p.hint", "It has no axis that moves.")), update() {} };
  const parts = joint.axes.map((axis, number) => axisPart(app, joint, axis, number));
  return {
    element: h("div", parts.map(({ element }) => element)),
    update: ({ axes }) => axes?.forEach((state, number) => parts[number]?.update(state)),
  };
}

function axisPart(app, joint, axis, number) {
  const slides = joint.type === "prismatic";
  const unit = slides ? "m" : "rad";
  const position = h("span.value");
  const velocity = h("span.value");
  const effort = h("span.value");
  const mode = h("select", { disabled: !app.link.mayEdit, title: "Mode of the motor" }, MODES.map((each) => h("option", { value: each }, each)));
  const slider = h("input", { type: "range", step: "any", disabled: !app.link.mayEdit });
  const target = h("input", { type: "number", step: "any", disabled: !app.link.mayEdit, title: "Target" });
  const send = (value) => app.attempt("window.set_joint_target", [joint.handle, number, mode.value, value]);
  const setRange = () => {
    const limits = {
      velocity: [-(axis.max_velocity ?? OPEN.velocity), axis.max_velocity ?? OPEN.velocity],
      position: [axis.lower ?? -OPEN.position, axis.upper ?? OPEN.position],
      effort: [-(axis.max_force ?? OPEN.effort), axis.max_force ?? OPEN.effort],
    }[mode.value];
    slider.hidden = target.hidden = !limits;
    if (limits) [slider.min, slider.max] = limits;
  };
  mode.onchange = () => {
    setRange();
    send(0);
  };
  slider.oninput = () => {
    target.value = shortNumber(Number(slider.value));
    send(Number(slider.value));
  };
  target.onchange = () => send(Number(target.value));
  let shownMode = null;
  return {
    element: section(
      joint.axes.length > 1 ? `Axis ${number + 1}` : "Joint",
      fields([
        ["Position", position],
        ["Velocity", velocity],
        ["Motor effort", effort],
        ["Limits", `${shortNumber(axis.lower ?? -Infinity)} to ${shortNumber(axis.upper ?? Infinity)} ${unit}`],
        ["Damping", shortNumber(axis.damping)],
        ["Friction", shortNumber(axis.friction)],
        ["Motor", mode],
        ["Target", target],
      ]),
      slider,
    ),
    update(state) {
      position.textContent = `${shortNumber(state.position)} ${unit}${slides ? "" : ` (${shortNumber((state.position * 180) / Math.PI, 1)}°)`}`;
      velocity.textContent = `${shortNumber(state.velocity)} ${unit}/s`;
      effort.textContent = `${shortNumber(state.effort)} ${slides ? "N" : "N m"}`;
      if (state.mode !== shownMode && document.activeElement !== mode) {
        shownMode = mode.value = state.mode;
        setRange();
      }
      const value = state[`target_${mode.value}`];
      if (value === undefined) return;
      if (document.activeElement !== slider) slider.value = value;
      if (document.activeElement !== target) target.value = shortNumber(value);
    },
  };
}
