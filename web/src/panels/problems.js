// SPDX-License-Identifier: BSD-3-Clause
// Warnings of the scene's files and errors of scripts; a click leads to object, file and line.
import { h } from "../dom.js";
import { Poll } from "../poll.js";

export const problems = {
  id: "problems",
  title: "Problems",
  place: "bottom",
  create(app) {
    const rows = h("div.problemlist");
    let revision = -1;
    const open = ({ source, object, file, line }) => {
      // Collisions and visuals, which have a name in the file, are no objects of the scene: their link is.
      let path = object;
      while (path && !app.scene.byPath(path)) path = path.slice(0, path.lastIndexOf("/"));
      if (path) app.selection.select(app.scene.byPath(path));
      if (source === "script") app.openScript?.(object, file, line);
    };
    const show = (list) => {
      rows.replaceChildren(
        ...list.map((each) =>
          h(
            `button.problem.${each.level}`,
            { onclick: () => open(each), title: each.file },
            h("span.mark", each.level === "error" ? "●" : "▲"),
            h("span.what", each.text),
            h("span.who", each.object),
            h("span.where", each.file ? `${each.file.split("/").pop()}${each.line ? `:${each.line}` : ""}` : ""),
          ),
        ),
      );
      if (!list.length) rows.append(h("p.hint", "No warnings of the scene's files, no errors of scripts."));
      const tab = document.querySelector('.tab[data-panel="problems"]');
      if (tab) {
        const errors = list.filter((each) => each.level === "error").length;
        tab.textContent = list.length ? `Problems ${list.length}` : "Problems";
        tab.classList.toggle("bad", errors > 0);
      }
      app.problems = list;
      app.link.emit("problems", list);
    };
    const poll = new Poll(app, 700, async () => {
      const found = await app.link.call("sim.getProblems", [], "log");
      if (found.revision === revision) return;
      revision = found.revision;
      show(found.problems);
    });
    app.link.on("scene", () => (revision = -1));
    show([]);
    poll.start(); // always: the tab shows their number
    return h("div.problems", rows);
  },
};
