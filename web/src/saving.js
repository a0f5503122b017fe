// SPDX-License-Identifier: BSD-3-Clause
// "Save scene as": asks for folder and name, and before a file is overwritten.
import { h } from "./dom.js";

export async function showSaving(app) {
  const folders = await app.attempt("server.sceneFolders");
  if (!folders) return;
  const folder = h("select", { title: "Folder" }, folders.map((each) => h("option", { value: each }, each)));
  const name = h("input", { title: "Name of the file", value: `${app.scene.info?.scene ?? "scene"}.sdf`, required: true });
  const save = h("button.primary", { type: "submit", disabled: !folders.length }, "Save");
  const dialog = h(
    "dialog.saving",
    h("h2", "Save scene as"),
    h(
      "form",
      { method: "dialog", onsubmit: (event) => submit(event) },
      h("label", "Folder", folder),
      h("label", "Name", name),
      h("p.hint", folders.length ? "With all models and poses as they are now." : "You may write in no folder of the scene or the window."),
      h("div.actions", save, h("button", { type: "button", onclick: () => dialog.close() }, "Cancel")),
    ),
  );
  const submit = async (event) => {
    event.preventDefault();
    save.disabled = true;
    const call = (overwrite) => app.link.call("server.saveScene", [folder.value, name.value.trim(), overwrite], "save");
    try {
      let done = await call(false);
      if (!done.saved && window.confirm(`${done.file} exists. Overwrite it?`)) done = await call(true);
      if (done.saved) {
        app.notify(`Saved to ${done.file}`, "info");
        dialog.close();
      }
    } catch (error) {
      app.notify(error.message, "error");
      dialog.close(); // its message would be behind
    }
    save.disabled = false;
  };
  dialog.addEventListener("close", () => dialog.remove());
  document.body.append(dialog);
  dialog.showModal();
  name.select();
}
