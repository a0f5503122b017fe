// SPDX-License-Identifier: BSD-3-Clause
// The output of all scripts, and a prompt that calls functions of sim.
import { h } from "../dom.js";
import { Poll } from "../poll.js";

const MOST = 2000; // lines
const KINDS = ["error", "warning", "print", "info", "debug"];

/// What a level of sim.verbosity_ is called here.
export function kindOf(level) {
  if (level <= 200 || level === 420) return "error";
  if (level <= 300 || level === 430) return "warning";
  if (level <= 450) return level === 400 ? "info" : "print";
  return level <= 500 ? "info" : "debug";
}

export const output = {
  id: "console",
  title: "Console",
  place: "bottom",
  create(app) {
    const rows = h("div.log", { tabIndex: 0, role: "log" });
    const object = h("select", { title: "Only lines of this object", className: "of" }, h("option", { value: "" }, "All objects"));
    const level = h(
      "select",
      { title: "Lines up to this level" },
      h("option", { value: 0 }, "Errors"),
      h("option", { value: 1 }, "Errors, warnings"),
      h("option", { value: 3, selected: true }, "All but debug"),
      h("option", { value: 4 }, "All"),
    );
    const search = h("input.search", { type: "search", placeholder: "Filter", title: "Only lines with this text" });
    const prompt = h("input.prompt", {
      placeholder: "sim.getObjectPosition(sim.getObject('/Name'))",
      title: "Calls a function of sim. Up and Down: earlier lines, Tab: complete",
      spellcheck: false,
      autocomplete: "off",
    });
    const known = new Set();
    let last = 0;
    let names = null;
    const lines = [];
    let place = 0;

    const fits = (row) =>
      (!object.value || row.dataset.object === object.value) &&
      KINDS.indexOf(row.dataset.kind) <= Number(level.value) &&
      (!search.value || row.textContent.toLowerCase().includes(search.value.toLowerCase()));
    const filter = () => {
      for (const row of rows.children) row.hidden = !fits(row);
      rows.scrollTop = rows.scrollHeight;
    };
    for (const each of [object, level]) each.onchange = filter;
    search.oninput = filter;

    const add = (entries) => {
      const atEnd = rows.scrollTop + rows.clientHeight > rows.scrollHeight - 30;
      for (const { time, kind, object: path, text } of entries) {
        const row = h(
          "div.entryrow",
          h("span.when", time === null ? "" : `${time.toFixed(3)} s`),
          h("span.who", { title: path }, path),
          h("span.what", text),
        );
        Object.assign(row.dataset, { kind, object: path });
        row.hidden = !fits(row);
        rows.append(row);
        if (path && !known.has(path)) {
          known.add(path);
          object.append(h("option", { value: path }, path));
        }
      }
      while (rows.children.length > MOST) rows.firstChild.remove();
      if (atEnd) rows.scrollTop = rows.scrollHeight;
    };

    const poll = new Poll(app, 250, async () => {
      const changes = await app.link.call("sim.getLog", [last], "log");
      if (changes.last < last) last = 0; // another simulator
      else {
        last = changes.last;
        if (changes.entries.length) add(changes.entries.map((each) => ({ ...each, kind: kindOf(each.level) })));
      }
    });
    app.link.on("scene", () => {
      last = 0;
      rows.replaceChildren();
    });

    const run = async (line) => {
      add([{ time: null, kind: "print", object: "", text: `> ${line}` }]);
      try {
        add([{ time: null, kind: "print", object: "", text: await app.link.call("server.run", [line], "prompt") }]);
      } catch (error) {
        add([{ time: null, kind: "error", object: "", text: error.message }]);
      }
      rows.scrollTop = rows.scrollHeight;
    };
    const complete = async () => {
      names ??= (await app.link.call("server.api")).functions.sim.map((each) => each.name);
      const end = prompt.selectionStart;
      const found = /sim\.(\w*)$/.exec(prompt.value.slice(0, end));
      if (!found) return;
      const fitting = names.filter((each) => each.toLowerCase().startsWith(found[1].toLowerCase()));
      if (!fitting.length) return;
      let common = fitting[0];
      for (const each of fitting) while (!each.startsWith(common)) common = common.slice(0, -1);
      const text = fitting.length === 1 ? `${common}(` : common.length >= found[1].length ? common : found[1];
      prompt.setRangeText(text, end - found[1].length, end, "end");
      if (fitting.length > 1) add([{ time: null, kind: "print", object: "", text: fitting.slice(0, 60).join("  ") }]);
    };
    prompt.addEventListener("keydown", (event) => {
      event.stopPropagation(); // no shortcuts of the page
      if (event.key === "Enter" && prompt.value.trim()) {
        lines.push(prompt.value);
        place = lines.length;
        run(prompt.value);
        prompt.value = "";
      } else if (event.key === "Tab") {
        event.preventDefault();
        complete().catch((error) => app.notify(error.message, "error"));
      } else if (event.key === "ArrowUp" || event.key === "ArrowDown") {
        event.preventDefault();
        place = Math.min(Math.max(place + (event.key === "ArrowUp" ? -1 : 1), 0), lines.length);
        prompt.value = lines[place] ?? "";
      }
    });
    this.poll = poll;
    return h(
      "div.console",
      h("div.bar", object, level, search, h("button", { title: "Remove all lines here", onclick: () => rows.replaceChildren() }, "Clear")),
      rows,
      h("label.promptline", h("span", "›"), prompt),
    );
  },
  show() {
    this.poll.start();
  },
  hide() {
    this.poll.stop();
  },
};
