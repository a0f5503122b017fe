// SPDX-License-Identifier: BSD-3-Clause
// Dialogs that write the scene to a new file, in a folder that the user chooses.
import { h } from "./dom.js";

/// "Save scene as": the scene as it is now. Asks before a file is overwritten.
export async function showSaving(app) {
  const folders = await app.attempt("server.sceneFolders");
  if (!folders) return;
  ask(app, {
    title: "Save scene as",
    hint: "With all models and poses as they are now.",
    none: "You may write in no folder of the scene or the window.",
    folders,
    name: `${app.scene.info?.scene ?? "scene"}.sdf`,
    async save(folder, name) {
      const call = (overwrite) => app.link.call("server.saveScene", [folder, name, overwrite], "save");
      let done = await call(false);
      if (!done.saved && window.confirm(`${done.file} exists. Overwrite it?`)) done = await call(true);
      if (done.saved) app.notify(`Saved to ${done.file}`, "info");
      return done.saved;
    },
  });
}

/// "Save a copy" of a shipped scene, which then takes its place; `edited` are handle and text of the scripts that were edited.
export async function showCopying(app, edited) {
  const folders = await app.attempt("server.copyFolders");
  if (!folders) return;
  ask(app, {
    title: "Save a copy",
    hint: "The scene's file, with its scripts as you have edited them in a folder beside it. The copy is opened.",
    none: "You may not write in the folder where the window was started: start it in a folder of yours.",
    folders,
    name: `my_${app.scene.info?.scene ?? "scene"}`,
    async save(folder, name) {
      const file = await app.link.call("server.openCopy", [folder, name, edited], "save");
      app.notify(`Written to ${file}`, "info");
      return true;
    },
  });
}

function ask(app, { title, hint, none, folders, name, save }) {
  const folder = h("select", { title: "Folder" }, folders.map((each) => h("option", { value: each }, each)));
  const written = h("input", { title: "Name of the file", value: name, required: true });
  const button = h("button.primary", { type: "submit", disabled: !folders.length }, "Save");
  const submit = async (event) => {
    event.preventDefault();
    button.disabled = true;
    try {
      if (await save(folder.value, written.value.trim())) dialog.close();
    } catch (error) {
      app.notify(error.message, "error");
      dialog.close(); // its message would be behind
    }
    button.disabled = false;
  };
  const dialog = h(
    "dialog.saving",
    h("h2", title),
    h(
      "form",
      { method: "dialog", onsubmit: submit },
      h("label", "Folder", folder),
      h("label", "Name", written),
      h("p.hint", folders.length ? hint : none),
      h("div.actions", button, h("button", { type: "button", onclick: () => dialog.close() }, "Cancel")),
    ),
  );
  dialog.addEventListener("close", () => dialog.remove());
  document.body.append(dialog);
  dialog.showModal();
  written.select();
}
