// SPDX-License-Identifier: BSD-3-Clause
// The places of the page: toolbar above, panels left, right and below, the 3D view in the centre. Their sizes are kept.
import { h } from "./dom.js";
import { icon } from "./icons.js";

const SIZES = { left: 260, right: 300, bottom: 240 };
const LEAST = 120;
const STEP = 20; // of a key

export class Layout {
  element = h("div.layout");
  toolbar = h("header.toolbar");
  centre = h("main.centre");
  #under = h("div.under");
  #places = {};

  constructor() {
    for (const name of ["left", "right", "bottom"]) this.#places[name] = new Place(name);
    const { left, right, bottom } = this.#places;
    this.element.append(
      this.toolbar,
      h(
        "div.row",
        left.element,
        left.splitter,
        h("div.column", this.centre, this.#under, bottom.splitter, bottom.element),
        right.splitter,
        right.element,
      ),
    );
  }

  /// Adds a panel, see panels/index.js.
  add(panel, app) {
    this.#places[panel.place].add(panel, app);
  }

  /// Adds a line below the 3D view.
  below(element) {
    this.#under.append(element);
  }

  /// Brings the panel of this id to the front.
  show(id) {
    for (const place of Object.values(this.#places)) place.show(id);
  }

  /// Shows the tabs that a scene can use; `info` describes it, see link.js.
  showFor(info) {
    for (const place of Object.values(this.#places)) place.showFor(info);
  }

  /// Hides or shows a place.
  toggle(name) {
    this.#places[name].toggle();
  }
}

/// An edge of the page, whose panels share it as tabs.
class Place {
  #panels = [];
  #current = null;
  #tabs = h("nav.tabs", { role: "tablist" });
  #body = h("div.body");

  constructor(name) {
    this.name = name;
    this.element = h(`section.place.empty.${name}`, this.#tabs, this.#body);
    this.splitter = h(`div.splitter.${name === "bottom" ? "across" : "along"}`, {
      title: "Drag to resize, or use the arrow keys",
      role: "separator",
      tabIndex: 0,
      "aria-label": `Size of the panels ${name === "bottom" ? "below" : `at the ${name}`}`,
      "aria-orientation": name === "bottom" ? "horizontal" : "vertical",
      onkeydown: (event) => this.#press(event),
    });
    this.#resize(Number(localStorage.getItem(`size-${name}`)) || SIZES[name]);
    if (localStorage.getItem(`hidden-${name}`) === "yes") this.element.hidden = true;
    this.splitter.addEventListener("pointerdown", (event) => this.#drag(event));
    if (name === "bottom") this.#addMaximise();
  }

  add(panel, app) {
    this.element.classList.remove("empty");
    const content = panel.create(app);
    content.classList.add("panel");
    content.dataset.panel = panel.id;
    content.role = "tabpanel";
    content.ariaLabel = panel.title;
    content.hidden = true;
    const tab = h("button.tab", { role: "tab", onclick: () => this.#select(panel.id) }, panel.title);
    tab.dataset.panel = panel.id;
    this.#tabs.insertBefore(tab, this.#tabs.querySelector(".whole"));
    this.#body.append(content);
    this.#panels.push({ id: panel.id, tab, content, panel });
    const wanted = localStorage.getItem(`tab-${this.name}`);
    if (this.#panels.length === 1 || panel.id === wanted) this.#select(panel.id, false);
  }

  show(id) {
    if (!this.#panels.some((each) => each.id === id)) return;
    if (this.element.hidden) this.toggle();
    this.#select(id);
  }

  showFor(info) {
    for (const { panel, tab } of this.#panels) tab.hidden = Boolean(panel.needsRos) && !info.ros;
    if (this.#current.tab.hidden) this.#select(this.#panels.find(({ tab }) => !tab.hidden).id, false);
  }

  toggle() {
    this.element.hidden = !this.element.hidden;
    localStorage.setItem(`hidden-${this.name}`, this.element.hidden ? "yes" : "no");
    window.dispatchEvent(new Event("resize"));
  }

  /// A button, and a double click on the tabs, with which the panels take the place of the 3D view.
  #addMaximise() {
    const toggle = () => {
      const whole = this.element.classList.toggle("whole");
      button.classList.toggle("on", whole);
      button.setAttribute("aria-pressed", whole);
    };
    const title = "Maximise or restore (double click on the tabs)";
    const button = h("button.tool.whole", { title, onclick: toggle, "aria-label": title, "aria-pressed": false }, icon("whole"));
    this.#tabs.append(button);
    this.#tabs.addEventListener("dblclick", (event) => {
      if (!button.contains(event.target)) toggle();
    });
  }

  #select(id, keep = true) {
    for (const each of this.#panels) {
      const on = each.id === id;
      each.content.hidden = !on;
      each.tab.classList.toggle("on", on);
      each.tab.setAttribute("aria-selected", on);
    }
    const chosen = this.#panels.find((each) => each.id === id);
    if (this.#current && this.#current !== chosen) this.#current.panel.hide?.();
    this.#current = chosen;
    chosen.panel.show?.();
    if (keep) localStorage.setItem(`tab-${this.name}`, id);
  }

  #resize(size) {
    const kept = Math.max(LEAST, Math.round(size));
    this.element.style.flexBasis = `${kept}px`;
    return kept;
  }

  /// Resizes by keys: each arrow moves the border its way.
  #press(event) {
    const grows = { left: "ArrowRight", right: "ArrowLeft", bottom: "ArrowUp" }[this.name];
    const shrinks = { left: "ArrowLeft", right: "ArrowRight", bottom: "ArrowDown" }[this.name];
    if (event.key !== grows && event.key !== shrinks) return;
    event.preventDefault();
    event.stopPropagation();
    const box = this.element.getBoundingClientRect();
    const size = this.name === "bottom" ? box.height : box.width;
    this.#keep(size + (event.key === grows ? STEP : -STEP));
  }

  #keep(size) {
    localStorage.setItem(`size-${this.name}`, this.#resize(size));
    window.dispatchEvent(new Event("resize"));
  }

  #drag(event) {
    event.preventDefault();
    this.splitter.setPointerCapture(event.pointerId);
    const box = this.element.getBoundingClientRect();
    const move = ({ clientX, clientY }) => {
      const size = { left: clientX - box.left, right: box.right - clientX, bottom: box.bottom - clientY }[this.name];
      this.#keep(size);
    };
    this.splitter.addEventListener("pointermove", move);
    const end = () => this.splitter.removeEventListener("pointermove", move);
    this.splitter.addEventListener("pointerup", end, { once: true });
    this.splitter.addEventListener("pointercancel", end, { once: true });
  }
}
