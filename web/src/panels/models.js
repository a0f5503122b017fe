// SPDX-License-Identifier: BSD-3-Clause
// The models of the model folders, with pictures: drag one into the view, or double-click it.
import { h } from "../dom.js";
import { Thumbnails } from "../view/thumbnails.js";

export const models = { id: "models", title: "Models", place: "left", create: (app) => new Models(app).element };

class Models {
  #app;
  #thumbnails;
  #search = h("input.search", { type: "search", placeholder: "Search models", oninput: () => this.#filter() });
  #grid = h("div.modelgrid");
  #wanted = new IntersectionObserver((entries) => this.#draw(entries));

  constructor(app) {
    this.#app = app;
    this.#thumbnails = new Thumbnails(app);
    this.element = h("div.models", h("div.bar", this.#search), this.#grid);
    app.link.on("scene", () => this.#list());
    app.view.element.addEventListener("dragover", (event) => {
      if (event.dataTransfer.types.includes("application/x-model")) event.preventDefault();
    });
    app.view.element.addEventListener("drop", (event) => {
      const name = event.dataTransfer.getData("application/x-model");
      if (!name) return;
      event.preventDefault();
      this.#add(name, app.view.picker.ground(event.clientX, event.clientY));
    });
  }

  async #list() {
    const { link } = this.#app;
    try {
      const found = await link.call("server.models");
      this.#grid.replaceChildren(...found.map(({ name, file }) => this.#card(name, file)));
      if (!found.length) this.#grid.append(h("p.hint", "There are no models in the model folders."));
      this.#filter();
    } catch (error) {
      if (link.connected) console.warn(error.message);
    }
  }

  #card(name, file) {
    const { link } = this.#app;
    const add = () => link.mayEdit && this.#add(name, this.#app.view.viewpoint.controls.target.toArray().with(2, 0));
    const card = h(
      "figure.modelcard",
      {
        title: `${file}\nDrag it into the view, double-click, or press Enter.`,
        role: "button",
        tabIndex: 0,
        "aria-label": `Add ${name}`,
        onkeydown: (event) => event.key === "Enter" && add(),
        draggable: link.mayEdit,
        ondragstart: (event) => {
          event.dataTransfer.setData("application/x-model", name);
          event.dataTransfer.effectAllowed = "copy";
        },
        ondblclick: add,
      },
      h("div.picture"),
      h("figcaption", name),
    );
    card.dataset.model = name;
    this.#wanted.observe(card);
    return card;
  }

  #add(name, [x, y, z]) {
    return this.#app.editing.addModel(name, [x, y, z]);
  }

  #filter() {
    const text = this.#search.value.trim().toLowerCase();
    for (const card of this.#grid.children) card.hidden = Boolean(text) && !card.dataset.model?.toLowerCase().includes(text);
  }

  async #draw(entries) {
    for (const { isIntersecting, target } of entries) {
      if (!isIntersecting) continue;
      this.#wanted.unobserve(target);
      try {
        const url = await this.#thumbnails.of(target.dataset.model);
        target.querySelector(".picture").style.backgroundImage = `url(${url})`;
      } catch (error) {
        target.querySelector(".picture").textContent = "?";
        target.title += `\n${error.message}`;
      }
    }
  }
}
