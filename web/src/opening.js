// SPDX-License-Identifier: BSD-3-Clause
// Opening a file of CoppeliaSim: what is in it, which programs it holds, and where its scene is written.
import { h } from "./dom.js";

const MOST_BYTES = 60 * 2 ** 20; // of a message to the server

export async function showOpening(app, file) {
  if (!app.link.mayEdit) throw new Error(`${file.name}: this window is read-only`);
  if (file.size > MOST_BYTES) throw new Error(`${file.name} has more than ${MOST_BYTES / 2 ** 20} MB: open it in a terminal, bubblesim run ${file.name}`);
  const folders = await app.link.call("server.sceneFolders");
  if (!folders.length) throw new Error(`${file.name}: you may write in no folder of the scene or the window, where its scene would be written`);
  const content = new Uint8Array(await file.arrayBuffer());
  const found = await app.link.call("server.readForeign", [file.name, content], "save");
  const inPython = found.scripts.filter((each) => each.endsWith(".py"));
  const folder = h("select", { "aria-label": "Folder" }, folders.map((each) => h("option", { value: each }, each)));
  const python = h("input", { type: "checkbox" });
  const open = h("button.primary", { type: "submit" }, "Open");
  const dialog = h(
    "dialog.saving.opening",
    h("h2", `Open ${file.name}`),
    h(
      "form",
      { method: "dialog", onsubmit: (event) => submit(event) },
      h("p", `It is written as ${found.name}.sdf, with its meshes and scripts beside it, and takes the place of this scene.`),
      h("label", "Folder", folder),
      found.scripts.length
        ? h("div", h("h3", "It holds programs"), h("ul", found.scripts.map((each) => h("li", `${each.split("/").at(-1)} (${each.endsWith(".py") ? "Python" : "Lua, in the sandbox"})`))))
        : h("p.hint", "It holds no programs that would run."),
      inPython.length
        ? h("p.trust", h("label.choice", python, "Run its Python scripts, which may do whatever you may. Without this they are written, and do not run: read them first."))
        : null,
      found.left_out ? h("details", h("summary", "What does not come over"), h("pre", found.left_out)) : null,
      h("details", h("summary", "What is in it"), h("pre", found.description)),
      h("div.actions", open, h("button", { type: "button", onclick: () => dialog.close() }, "Cancel")),
    ),
  );
  const submit = async (event) => {
    event.preventDefault();
    open.disabled = true;
    const written = await app.attempt("server.openForeign", [folder.value, python.checked], "save");
    if (written) app.notify(`Written to ${written}`, "info");
    dialog.close(); // a message would be behind it
  };
  dialog.addEventListener("close", () => dialog.remove());
  document.body.append(dialog);
  dialog.showModal();
}
