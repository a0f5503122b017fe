// SPDX-License-Identifier: BSD-3-Clause
// The tree of objects with a search.
import { h } from "../dom.js";
import { icon } from "../icons.js";

const ROW = 24; // px

export const tree = { id: "tree", title: "Scene", place: "left", create: (app) => new Tree(app).element };

/// Rows are made for what is visible only: scenes have thousands of objects.
class Tree {
  #app;
  #open = new Set(); // handles whose children are shown
  #rows = []; // { object, depth }
  #search = h("input.search", { type: "search", placeholder: "Search objects", oninput: () => this.#list() });
  #kind = h(
    "select.kind",
    { title: "Kind of objects", onchange: () => this.#list() },
    [["", "All"], ["model", "Models"], ["link", "Links"], ["joint", "Joints"], ["sensor", "Sensors"], ["frame", "Frames"]].map(([value, text]) => h("option", { value }, text)),
  );
  #space = h("div.space");
  #box = h("div.rows", { role: "tree", tabIndex: 0 }, this.#space);

  constructor(app) {
    this.#app = app;
    this.element = h("div.tree", h("div.bar", this.#search, this.#kind), this.#box);
    this.#box.addEventListener("scroll", () => this.#draw());
    new ResizeObserver(() => this.#draw()).observe(this.#box);
    this.#box.addEventListener("keydown", (event) => this.#key(event));
    app.scene.on("changed", () => this.#list());
    app.selection.on("changed", (object) => this.#reveal(object));
  }

  #list() {
    const text = this.#search.value.trim().toLowerCase();
    const kind = this.#kind.value;
    const rows = [];
    const { scene } = this.#app;
    if (text || kind) {
      for (const object of scene.objects.values()) {
        if (object.hidden) continue;
        if ((!kind || object.kind === kind) && (!text || object.path.toLowerCase().includes(text))) rows.push({ object, depth: 0, flat: true });
      }
    } else {
      const add = (object, depth) => {
        rows.push({ object, depth });
        if (this.#open.has(object.handle)) for (const child of object.children) add(child, depth + 1);
      };
      for (const model of scene.children()) add(model, 0);
    }
    this.#rows = rows;
    this.#space.style.height = `${ROW * rows.length}px`;
    this.#draw();
  }

  #draw() {
    const { scrollTop, clientHeight } = this.#box;
    const first = Math.max(0, Math.floor(scrollTop / ROW) - 5);
    const last = Math.min(this.#rows.length, Math.ceil((scrollTop + clientHeight) / ROW) + 5);
    this.#space.replaceChildren(...this.#rows.slice(first, last).map((row, place) => this.#row(row, first + place)));
  }

  #row({ object, depth, flat }, place) {
    const open = this.#open.has(object.handle);
    const twisty = h(
      "span.twisty",
      { onclick: (event) => (event.stopPropagation(), this.#toggle(object)) },
      !flat && object.children.length ? icon("chevron") : null,
    );
    twisty.classList.toggle("open", open);
    const row = h(
      `div.treerow.${object.kind}`,
      {
        role: "treeitem",
        title: object.path,
        onclick: () => this.#app.selection.select(object),
        ondblclick: () => this.#app.view.viewpoint.look(object),
      },
      twisty,
      icon(object.kind),
      h("span.name", flat ? object.path.slice(1) : object.name),
      object.script ? h("span.badge", { title: `script: ${object.script}` }, icon("script")) : null,
      ["joint", "sensor", "frame"].includes(object.kind) ? h("span.type", object.type) : null,
    );
    row.style.top = `${ROW * place}px`;
    row.style.paddingLeft = `${6 + 14 * depth}px`;
    row.classList.toggle("selected", object === this.#app.selection.object);
    row.setAttribute("aria-selected", object === this.#app.selection.object);
    row.dataset.path = object.path;
    return row;
  }

  #toggle(object) {
    if (!this.#open.delete(object.handle)) this.#open.add(object.handle);
    this.#list();
  }

  #reveal(object) {
    const { scene } = this.#app;
    for (let each = object && scene.objects.get(object.parent); each; each = scene.objects.get(each.parent)) this.#open.add(each.handle);
    this.#list();
    const place = this.#rows.findIndex((row) => row.object === object);
    if (place < 0) return;
    const { scrollTop, clientHeight } = this.#box;
    if (ROW * place < scrollTop || ROW * (place + 1) > scrollTop + clientHeight) this.#box.scrollTop = ROW * place - clientHeight / 2;
    this.#draw();
  }

  #key(event) {
    const { selection } = this.#app;
    const place = this.#rows.findIndex(({ object }) => object === selection.object);
    const object = this.#rows[place]?.object;
    if (event.key === "ArrowDown" && place + 1 < this.#rows.length) selection.select(this.#rows[place + 1].object);
    else if (event.key === "ArrowUp" && place > 0) selection.select(this.#rows[place - 1].object);
    else if (event.key === "ArrowRight" && object?.children.length && !this.#open.has(object.handle)) this.#toggle(object);
    else if (event.key === "ArrowLeft" && object && this.#open.has(object.handle)) this.#toggle(object);
    else if (event.key === "Enter" && object) this.#app.view.viewpoint.look(object);
    else return;
    event.preventDefault();
    event.stopPropagation();
  }
}
