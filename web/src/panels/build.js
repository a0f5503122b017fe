// SPDX-License-Identifier: BSD-3-Clause
// The palette: shapes, lights, joints and sensors. Drag one into the view, or press it.
import { h } from "../dom.js";
import { icon } from "../icons.js";

const GROUPS = [
  ["Shapes", [["box", "Box"], ["sphere", "Sphere"], ["cylinder", "Cylinder"], ["cone", "Cone"], ["capsule", "Capsule"]]],
  ["Lights", [["lamp", "Lamp"], ["spotlight", "Spotlight"]]],
  ["Joints", [["hinge", "Hinge"], ["slider", "Slider"]]],
  ["Sensors", [["lidar", "Lidar"], ["camera", "Camera"], ["depth_camera", "Depth camera"], ["sonar", "Sonar"], ["imu", "IMU"]]],
];
const ICONS = { Shapes: "model", Lights: "light", Joints: "joint", Sensors: "sensor" };
const TYPE = "application/x-part";
const SIZE = { box: [0.3, 0.3, 0.3], sphere: [0.3, 0.3, 0.3], cylinder: [0.2, 0.2, 0.4], cone: [0.3, 0.3, 0.4], capsule: [0.2, 0.2, 0.5] };
const ROOM = 0.3; // m around a part
const LARGE = 3; // m: floors and rooms, in which parts stand
const ABOVE = 0.02; // m, of a sensor over the shapes of its carrier

export const build = { id: "build", title: "Build", place: "left", create: (app) => new Build(app).element };

class Build {
  #app;
  #size = ["x", "y", "z"].map((name) => h("input", { type: "number", min: 0.001, step: 0.05, "aria-label": `Size along ${name}, m` }));
  #sized = h("input", { type: "checkbox" });
  #material = h("select", { "aria-label": "Material" });
  #fixed = h("input", { type: "checkbox" });
  #mounted = h("input", { type: "checkbox" });
  #hint = h("p.hint");

  constructor(app) {
    this.#app = app;
    for (const input of this.#size) input.value = 0.3;
    this.element = h(
      "div.build",
      GROUPS.map(([title, kinds]) => h("section", h("h3", title), h("div.palette", kinds.map(([kind, name]) => this.#button(kind, name, ICONS[title]))), this.#options(title))),
    );
    app.link.on("scene", () => this.#listMaterials());
    app.link.on("hello", ({ edit }) => (this.element.inert = !edit));
    app.selection.on("changed", () => this.#showCarrier());
    this.#showCarrier();
    app.view.element.addEventListener("dragover", (event) => {
      if (event.dataTransfer.types.includes(TYPE)) event.preventDefault();
    });
    app.view.element.addEventListener("drop", (event) => {
      const kind = event.dataTransfer.getData(TYPE);
      if (!kind) return;
      event.preventDefault();
      this.#add(kind, app.view.picker.ground(event.clientX, event.clientY));
    });
  }

  #button(kind, name, image) {
    return h(
      "button.part",
      {
        draggable: true,
        title: `Add a ${name.toLowerCase()}: press, or drag it into the view`,
        onclick: () => this.#add(kind, this.#free()),
        ondragstart: (event) => {
          event.dataTransfer.setData(TYPE, kind);
          event.dataTransfer.effectAllowed = "copy";
        },
      },
      icon(kind in SIZE ? kind : image),
      name,
    );
  }

  #options(title) {
    if (title === "Shapes") {
      const lengths = h("div.six", { hidden: true }, ["x", "y", "z"].map((name, place) => h("label", name, this.#size[place])));
      this.#sized.onchange = () => (lengths.hidden = !this.#sized.checked);
      return [
        h("label.choice", this.#sized, "Size of my own, m"),
        lengths,
        h("label.pair", "Material", this.#material),
        h("label.choice", this.#fixed, "Fixed: it stands still"),
      ];
    }
    if (title === "Joints") return h("p.hint", "A motor to drive from the properties.");
    return title === "Sensors" ? [h("label.choice", this.#mounted, "On the selected link"), this.#hint] : null;
  }

  async #listMaterials() {
    const materials = await this.#app.link.call("window.get_materials").catch(() => ({}));
    this.#material.replaceChildren(...Object.keys(materials).map((value) => h("option", { value }, value)));
  }

  /// The link of the selected object, if it moves.
  get #carrier() {
    const { scene, selection } = this.#app;
    const { object } = selection;
    const link = object?.kind === "link" ? object : scene.objects.get(object?.carrier);
    return link && !link.static ? link : null;
  }

  /// A place on the ground in the middle of the view, or beside what is there: shapes that overlap burst apart.
  #free() {
    const { scene, view } = this.#app;
    const taken = scene.children().map((model) => view.extent(model)).filter(({ radius }) => radius < LARGE);
    const place = view.viewpoint.controls.target.clone().setZ(0);
    const isTaken = () => taken.some(({ centre, radius }) => Math.hypot(centre.x - place.x, centre.y - place.y) < radius + ROOM);
    for (let tries = 0; tries < 100 && isTaken(); ++tries) place.x += ROOM;
    return place.toArray();
  }

  #showCarrier() {
    const carrier = this.#carrier;
    this.#mounted.disabled = !carrier;
    this.#mounted.checked = Boolean(carrier);
    this.#hint.textContent = carrier ? `Moves with ${carrier.path}` : "Select a robot or one of its links to mount a sensor on it.";
  }

  #add(kind, position) {
    const { editing, view } = this.#app;
    const options = {};
    if (kind in SIZE) {
      options.size = this.#sized.checked ? this.#size.map(({ value }) => Number(value)) : SIZE[kind];
      options.material = this.#material.value || "plastic";
      options.fixed = this.#fixed.checked;
    }
    const carrier = this.#mounted.checked ? this.#carrier : null;
    if (carrier && GROUPS[3][1].some(([name]) => name === kind)) {
      options.carrier = carrier.handle;
      const { centre, radius } = view.extent(carrier);
      position = [centre.x, centre.y, centre.z + radius + ABOVE];
    }
    return editing.build(kind, position, options);
  }
}
