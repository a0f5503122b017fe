// SPDX-License-Identifier: BSD-3-Clause
// The properties of the selected object: what stays, what changes while the scene runs, and what can be edited.
import { h, shortNumber } from "../dom.js";
import { icon } from "../icons.js";
import { anglesOf, quaternionOf } from "../rotation.js";
import { jointSection } from "./properties/joint.js";
import { readingSection } from "./properties/reading.js";
import { degrees, fields, numbers, section } from "./properties/sections.js";

const PERIOD = 120; // ms between two polls of the state
const NUMBERS = [
  { name: "mass", title: "Mass", unit: "kg", kinds: ["model", "link"], hint: "Inertias and the other links of a model are scaled with it" },
  { name: "friction", title: "Friction", kinds: ["model", "link"], hint: "Coefficient of all collisions, in all directions" },
  { name: "motor_gain", title: "Motor gain", kinds: ["joint"], hint: "Factor of the targets, until the simulation is stopped" },
  { name: "noise_scale", title: "Noise", kinds: ["sensor"], hint: "Factor of the standard deviations, until the simulation is stopped" },
];

export const properties = { id: "properties", title: "Properties", place: "right", create: (app) => new Properties(app).element };

class Properties {
  element = h("div.properties");
  #app;
  #updates = []; // functions of the state
  #waiting = false;

  constructor(app) {
    this.#app = app;
    app.selection.on("changed", () => this.#show());
    app.link.on("hello", () => this.#show());
    app.scene.on("changed", () => {
      if (!app.selection.object) this.#show();
    });
    this.#show();
    setInterval(() => this.#look(), PERIOD);
  }

  #show() {
    const { object } = this.#app.selection;
    this.#updates = [];
    if (!object) {
      this.element.replaceChildren(this.#sceneProperties());
      return;
    }
    const parts = [this.#head(object), this.#pose(object), this.#numbers(object)];
    if (object.kind === "model") parts.push(this.#velocity(), this.#model(object));
    if (object.kind === "link") parts.push(this.#velocity(), this.#link(object), ...this.#surfaces(object));
    if (object.kind === "joint") {
      const { element, update } = jointSection(this.#app, object);
      parts.push(element);
      this.#updates.push(update);
    }
    if (object.kind === "sensor") {
      const { element, update } = readingSection(this.#app, object);
      parts.push(this.#sensor(object), element);
      this.#updates.push(update);
    }
    this.element.replaceChildren(...parts.filter(Boolean));
    this.#look();
  }

  async #look() {
    const { selection, link, playback } = this.#app;
    const { object } = selection;
    this.element.inert = playback.run !== null;
    this.element.classList.toggle("past", this.element.inert);
    if (!object || this.#waiting || !link.connected || !link.frame || this.element.hidden || !this.element.isConnected) return;
    this.#waiting = true;
    try {
      const state = await link.call("window.get_state", [object.handle], "properties");
      if (selection.object === object) for (const update of this.#updates) await update(state);
    } catch (error) {
      if (link.connected) console.debug(error.message); // it was removed
    } finally {
      this.#waiting = false;
    }
  }

  #sceneProperties() {
    const { info, models, objects } = this.#app.scene;
    if (!info) return h("p.hint", "Waiting for the simulator.");
    return h(
      "div",
      h("h2", info.scene),
      h("p.path", info.file),
      section("Scene", fields([
        ["Models", models.length],
        ["Objects", objects.size],
        ["Time step", `${shortNumber(1000 * info.time_step, 1)} ms`],
        ["ROS", info.ros ? "connected" : "not used"],
      ])),
      h("p.hint", "Select an object in the view or in the tree."),
    );
  }

  #head(object) {
    const { app } = { app: this.#app };
    const kind = object.type ? `${object.kind}, ${object.type}` : object.static && object.kind === "model" ? "static model" : object.kind;
    return h(
      "header",
      h("h2", object.name),
      h("p.path", { title: "Click to copy", onclick: () => navigator.clipboard?.writeText(object.path) }, object.path),
      h("p.kindline", icon(object.kind), kind, h("button.small", { title: "Look at it", onclick: () => app.view.viewpoint.look(object) }, "Look at")),
    );
  }

  #pose(object) {
    const editable = this.#app.link.mayEdit && (object.kind === "model" || object.kind === "link");
    const inputs = ["x", "y", "z", "roll", "pitch", "yaw"].map((name, place) =>
      h("input", {
        type: "number",
        step: place < 3 ? 0.05 : 5,
        title: place < 3 ? `${name}, m` : `${name}, degrees`,
        readOnly: !editable,
        onchange: () => apply(),
      }),
    );
    const apply = () => {
      const values = inputs.map((input) => Number(input.value));
      const turn = quaternionOf(values.slice(3).map((each) => (each * Math.PI) / 180));
      this.#app.editing.move(object, [...values.slice(0, 3), ...turn]);
    };
    this.#updates.push(({ pose }) => {
      const values = [...pose.slice(0, 3), ...anglesOf(pose.slice(3)).map((each) => (each * 180) / Math.PI)];
      values.forEach((value, place) => {
        if (document.activeElement !== inputs[place]) inputs[place].value = shortNumber(value, place < 3 ? 3 : 1);
      });
    });
    return section(
      "Pose in the world",
      h("div.six", ["x", "y", "z"].map((name, i) => h("label", name, inputs[i])), ["R", "P", "Y"].map((name, i) => h("label", name, inputs[3 + i]))),
      h("p.unit", "m, and roll, pitch, yaw in degrees"),
    );
  }

  /// What can be set: mass and friction of models and links, gain of motors, noise of sensors.
  #numbers(object) {
    const rows = NUMBERS.filter(({ kinds }) => kinds.includes(object.kind)).map(({ name, title, unit, hint }) => {
      let present; // in the simulation
      let shown; // in the input, but for what is being typed
      const input = h("input", {
        type: "number",
        name,
        min: 0,
        step: "any",
        title: hint,
        readOnly: !this.#app.link.mayEdit,
        onchange: async () => {
          input.blur(); // the keys are those of the window again
          await this.#app.editing.number(object, name, Number(input.value), present);
          shown = undefined; // what was typed may have been refused
        },
      });
      const term = h("dt", unit ? `${title}, ${unit}` : title);
      const value = h("dd", input);
      this.#updates.push(({ numbers: found }) => {
        term.hidden = value.hidden = !(name in found);
        present = found[name];
        if (shown === present || document.activeElement === input) return;
        shown = present;
        input.value = present === undefined ? "" : String(Number(present.toPrecision(6)));
      });
      return [term, value];
    });
    return section("Can be set", h("dl", rows));
  }

  #velocity() {
    const linear = h("span.value");
    const angular = h("span.value");
    this.#updates.push((state) => {
      linear.textContent = `${numbers(state.linear_velocity)} m/s`;
      angular.textContent = `${numbers(state.angular_velocity)} rad/s`;
    });
    return section("Velocity", fields([["Linear", linear], ["Angular", angular]]));
  }

  #model(object) {
    const { scene, link } = this.#app;
    const links = [...scene.objects.values()].filter((each) => each.kind === "link" && scene.outermost(each) === object);
    return section(
      "Model",
      fields([
        ["Static", object.static ? "yes" : "no"],
        ["Links", links.length],
        ["Script", object.script ? object.script.split("/").at(-1) : "none"],
        ["File", object.file ? `${object.file.split("/").at(-1)}:${object.line}` : "-"],
      ]),
      link.mayEdit && object.parent === -1
        ? h(
            "div.actions",
            h("button", { onclick: () => this.#app.editing.duplicate(object) }, icon("copy"), " Duplicate"),
            h("button", { onclick: () => this.#app.editing.remove(object) }, icon("trash"), " Delete"),
          )
        : null,
    );
  }

  #link(object) {
    if (object.static) return null;
    const [xx, yy, zz] = object.inertia_diagonal;
    return section(
      "Body",
      fields([
        ["Centre of mass", `${numbers(object.centre_of_mass)} m`],
        ["Inertia", `${[xx, yy, zz].map((each) => each.toPrecision(3)).join(", ")} kg m²`],
        ["Gravity", object.gravity ? "on" : "off"],
      ]),
    );
  }

  #surfaces(object) {
    return [
      ...object.collisions.map((collision) =>
        section(
          `Collision ${collision.name}`,
          fields([
            ["Shape", shapeText(collision.shape)],
            ["Restitution", shortNumber(collision.restitution, 2)],
          ]),
        ),
      ),
      ...object.visuals.map((visual) => section(`Visual ${visual.name}`, fields([["Shape", shapeText(visual.shape)]]))),
      object.visuals.length ? section("Surface", fields([["Colour", this.#colour(object)], ["Material", this.#material(object)]])) : null,
    ];
  }

  #material(object) {
    const select = h("select", { disabled: !this.#app.link.mayEdit, "aria-label": "Material", title: "Sets colour and friction; the mass stays" }, h("option", { value: "" }, "choose…"));
    this.#app.link.call("window.get_materials", [], "properties").then(
      (materials) => {
        select.append(...Object.keys(materials).map((value) => h("option", { value }, value)));
        select.onchange = () => {
          this.#app.editing.material(object, select.value, materials[select.value]);
          select.value = "";
          select.blur(); // the keys are those of the window again
        };
      },
      () => (select.disabled = true),
    );
    return select;
  }

  #colour(object) {
    const hex = (part) => Math.round(255 * Math.min(Math.max(part, 0), 1)).toString(16).padStart(2, "0");
    const input = h("input.colour", {
      type: "color",
      disabled: !this.#app.link.mayEdit,
      title: "One colour for all visuals of the link, which cameras see, too",
      onchange: () => this.#app.editing.colour(object, [1, 3, 5].map((at) => parseInt(input.value.slice(at, at + 2), 16) / 255)),
    });
    this.#updates.push(() => {
      const colour = this.#app.scene.colours.get(object.handle) ?? object.visuals[0].material.diffuse;
      if (document.activeElement !== input) input.value = `#${colour.map(hex).join("")}`;
    });
    return input;
  }

  #sensor(object) {
    const rows = Object.entries(object.parameters)
      .filter(([name]) => name !== "kind")
      .map(([name, value]) => [
        name.replaceAll("_", " "),
        typeof value !== "number" ? value : /angle|fov|elevation/.test(name) ? degrees(value) : Number.isInteger(value) ? value : shortNumber(value),
      ]);
    rows.unshift(["update rate", object.update_rate ? `${shortNumber(object.update_rate, 1)} Hz` : "each step"]);
    if (object.topic) rows.push(["topic", object.topic]);
    return section("Sensor", fields(rows));
  }
}

function shapeText(shape) {
  const size = shape.size ?? shape.radii ?? (shape.radius !== undefined ? [shape.radius, shape.length].filter((each) => each !== undefined) : null);
  return size ? `${shape.type} ${size.map((each) => shortNumber(each)).join(" × ")} m` : shape.type;
}
