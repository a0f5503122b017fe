// SPDX-License-Identifier: BSD-3-Clause
// Dialogs, consoles and user interfaces that scripts have opened, with the widgets that they describe.
import morphdom from "morphdom";

import { h } from "../dom.js";
import { Poll } from "../poll.js";

const PERIOD = 250; // ms between two questions for changes

/// The parts of Qt's style sheets that widgets show, as CSS.
const STYLES = ["color", "background-color", "font-size", "font-weight", "font-style", "text-align"];

function styleOf(text = "") {
  const body = text.includes("{") ? text.slice(text.indexOf("{") + 1, text.lastIndexOf("}")) : text;
  const found = {};
  for (const rule of body.split(";")) {
    const [name, value] = rule.split(":").map((each) => each?.trim());
    if (STYLES.includes(name) && value) found[name] = value;
  }
  return found;
}

/// Plain text of a label, which may have Qt's rich text.
function plain(text) {
  if (!/<[a-z/][^>]*>|&\w+;/i.test(text)) return text;
  const page = new DOMParser().parseFromString(text.replace(/<br\s*\/?>/gi, "\n"), "text/html");
  return page.body.textContent;
}

function paint(canvas, { data, columns, rows }) {
  if (!data || !columns) return;
  Object.assign(canvas, { width: columns, height: rows });
  const context = canvas.getContext("2d");
  const image = context.createImageData(columns, rows);
  const channels = data.length / (columns * rows);
  for (let i = 0; i < columns * rows; ++i) {
    for (let c = 0; c < 3; ++c) image.data[4 * i + c] = data[channels * i + c];
    image.data[4 * i + 3] = 255;
  }
  context.putImageData(image, 0, 0);
}

function drawCurves(canvas, { curves, ranges = {} }) {
  const context = canvas.getContext("2d");
  const { width, height } = canvas;
  context.clearRect(0, 0, width, height);
  const all = Object.values(curves ?? {});
  const limits = (axis) => {
    if (ranges[axis]) return ranges[axis];
    const numbers = all.flatMap((each) => each[axis]);
    return numbers.length ? [numbers.reduce((a, b) => Math.min(a, b)), numbers.reduce((a, b) => Math.max(a, b))] : [0, 1];
  };
  const [left, right] = limits("x");
  const [low, high] = limits("y");
  for (const { x, y, colour } of all) {
    context.strokeStyle = `rgb(${colour.join(",")})`;
    context.beginPath();
    x.forEach((each, i) => {
      const at = [((each - left) / (right - left || 1)) * width, height - ((y[i] - low) / (high - low || 1)) * height];
      if (i) context.lineTo(...at);
      else context.moveTo(...at);
    });
    context.stroke();
  }
}

function slider(values, send, extra = {}) {
  const { minimum, maximum, value } = values;
  return h("input", {
    type: "range", min: minimum, max: maximum, step: 1, value, ...extra,
    oninput: ({ target }) => send("change", Number(target.value)),
  });
}

function table({ headers, rows }, send) {
  const cell = (text, row, column) =>
    h("td", {
      onclick: () => send("selectionchange", [row, column]),
      ondblclick: ({ target }) => send("cellactivate", [row, column, target.textContent]),
    }, text);
  return h(
    "table.cells",
    headers.some(Boolean) ? h("tr", headers.map((each) => h("th", each))) : null,
    rows.map((row, number) => h("tr", row.map((text, column) => cell(text, number, column)))),
  );
}

function tabs(part, make, send) {
  const current = part.values.currenttab ?? 0;
  const heads = part.parts.map((each, index) =>
    h(`button.tab${index === current ? ".on" : ""}`, { onclick: () => send("change", index) }, each.values.title ?? ""));
  return h("div.tabs", h("nav", heads), part.parts[current] ? make(part.parts[current]) : null);
}

/// What is shown of each kind of widget; `send(event, value)` reports what a user has done.
const MAKERS = {
  label: ({ values }) => h("span.label", plain(values.text)),
  button: ({ values }, send) => h(`button${values.checked ? ".primary" : ""}`, { onclick: () => send("click", null) }, values.text),
  checkbox: ({ values }, send) =>
    h("label", h("input", { type: "checkbox", checked: values.checked, onchange: ({ target }) => send("change", target.checked) }), values.text),
  radiobutton: ({ values }, send) =>
    h("label", h("input", { type: "radio", checked: values.checked, onchange: () => send("click", true) }), values.text),
  edit: ({ values }, send) =>
    h("input", {
      type: "text", value: values.value,
      oninput: ({ target }) => send("change", target.value),
      onchange: ({ target }) => send("editingfinished", target.value),
    }),
  textbrowser: ({ values }) => h("pre.text", values.value),
  spinbox: ({ values }, send) =>
    h("span", values.prefix ?? "", h("input", {
      type: "number", min: values.minimum, max: values.maximum, step: values.step ?? (values.decimals ? 0.1 : 1), value: values.value,
      oninput: ({ target }) => (target.dataset.unsent = ""),
      onchange: ({ target }) => {
        delete target.dataset.unsent;
        send("change", Number(target.value));
      },
    }), values.suffix ?? ""),
  hslider: ({ values }, send) => slider(values, send),
  dial: ({ values }, send) => slider(values, send),
  vslider: ({ values }, send) => slider(values, send, { className: "upright" }),
  progressbar: ({ values }) => h("progress", { max: values.maximum - values.minimum, value: values.value - values.minimum }),
  combobox: ({ values }, send) =>
    h("select", { onchange: ({ target }) => send("change", target.selectedIndex) },
      values.items.map((item, index) => h("option", { selected: index === values.value }, item))),
  table: ({ values }, send) => table(values, send),
  image: ({ values }) => {
    const canvas = h("canvas.image");
    paint(canvas, values);
    return canvas;
  },
  plot: ({ values }) => {
    const canvas = h("canvas.curves", { width: 300, height: 150 });
    drawCurves(canvas, values);
    return canvas;
  },
  separator: () => h("hr"),
  stretch: () => h("span.stretch"),
  br: () => h("span.break"),
};

/// Gives the elements on the page the content of newly made ones. They stay the same elements, with their handlers, so
/// that a press, a drag and the text cursor of the user survive what scripts change meanwhile.
const MORPHING = {
  childrenOnly: true,
  getNodeKey: (node) => node.dataset?.path,
  onBeforeElUpdated(shown, made) {
    if ("unsent" in shown.dataset) return false;
    if (shown.tagName !== "CANVAS") return true;
    shown.replaceWith(made); // pixels are no attributes
    return false;
  },
};

/// The elements of a panel.
class View {
  constructor(app, panel) {
    this.app = app;
    this.handle = panel.handle;
    this.unanswered = 0; // events of the user
    this.element = h("section.dialog");
    this.element.dataset.dialog = panel.handle;
    this.update(panel);
  }

  /// Returns whether the panel is shown as it is now. It is not while events of the user are unanswered.
  update(panel) {
    if (this.unanswered > 0) return false;
    const text = JSON.stringify(panel, (name, value) => (value instanceof Uint8Array ? value.length + value.at(-1) : value));
    if (text === this.text && !text.includes('"columns"')) return true;
    this.text = text;
    const { title, closeable, visible } = panel.values;
    this.element.hidden = !visible;
    const close = closeable ? h("button.close", { title: "Close", onclick: () => this.send([], "close") }, "×") : null;
    const whole = this.make(panel);
    whole.disabled = false;
    morphdom(this.element, h("section", h("header", h("b", title), h("span.hint", panel.owner), close), whole), MORPHING);
    return true;
  }

  make(part) {
    const { kind, values, parts, path } = part;
    const send = (event, value) => this.send(path, event, value);
    let element;
    if (kind === "tabs") element = tabs(part, (each) => this.make(each), send);
    else if (MAKERS[kind]) element = MAKERS[kind](part, send);
    else element = h(`div.layout-${values.layout ?? "vbox"}`, parts.map((each) => this.make(each)));
    if (kind === "group") element = h("fieldset", values.text ? h("legend", values.text) : null, element);
    element.dataset.path = path.join(".");
    element.classList.add("widget");
    element.hidden = values.visible === false && kind !== "ui";
    for (const each of [element, ...element.querySelectorAll(":scope > input")]) {
      if ("disabled" in each) each.disabled = values.enabled === false || !this.app.link.mayEdit;
    }
    for (const [name, value] of Object.entries(styleOf(values.style))) element.style.setProperty(name, value);
    return element;
  }

  async send(path, event, value = null) {
    ++this.unanswered;
    try {
      await this.app.link.call("window.send_panel_event", [this.handle, path, event, value], "dialogs");
    } catch (error) {
      this.app.notify(error.message, "error");
    } finally {
      --this.unanswered;
    }
    dialogs.poll.now();
  }
}

export const dialogs = {
  id: "dialogs",
  title: "Dialogs",
  place: "right",
  create(app) {
    const area = h("div.dialogs");
    const none = h("p.hint", "No script has opened a dialog or a user interface.");
    const views = new Map();
    let revision = -1;
    const show = (panels) => {
      const kept = new Set(panels.map(({ handle }) => handle));
      for (const handle of [...views.keys()]) if (!kept.has(handle)) views.delete(handle);
      let current = true;
      for (const panel of panels) {
        if (!views.has(panel.handle)) views.set(panel.handle, new View(app, panel));
        else if (!views.get(panel.handle).update(panel)) current = false;
      }
      const elements = views.size ? [...views.values()].map(({ element }) => element) : [none];
      if (elements.length !== area.children.length || elements.some((each, i) => each !== area.children[i])) {
        area.replaceChildren(...elements);
      }
      const tab = document.querySelector('.tab[data-panel="dialogs"]');
      const open = panels.filter(({ values }) => values.visible).length;
      if (tab) tab.textContent = open ? `Dialogs ${open}` : "Dialogs";
      return current;
    };
    this.poll = new Poll(app, PERIOD, async () => {
      const found = await app.link.call("window.get_panels", [revision], "dialogs");
      if (found === null || found === undefined) return;
      revision = show(found.panels) ? found.revision : -1;
    });
    app.link.on("scene", () => (revision = -1));
    show([]);
    this.poll.start(); // always: the tab shows their number
    return area;
  },
};
