// SPDX-License-Identifier: BSD-3-Clause
// Bundles the page: node build.mjs FOLDER_OF_NODE_MODULES OUTPUT_FOLDER
import { cpSync, existsSync, mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";
import { fileURLToPath } from "node:url";

const source = path.dirname(fileURLToPath(import.meta.url));
const [modules, output] = process.argv.slice(2).map((each) => path.resolve(each));
const esbuild = createRequire(path.join(modules, "anything.js"))("esbuild");

rmSync(output, { recursive: true, force: true });
mkdirSync(output, { recursive: true });
const result = await esbuild.build({
  entryPoints: [path.join(source, "src/main.js")],
  outdir: output,
  bundle: true,
  splitting: true,
  format: "esm",
  minify: true,
  target: "es2022",
  legalComments: "none",
  metafile: true,
  nodePaths: [modules],
  entryNames: "[name]",
  chunkNames: "parts/[name]-[hash]",
  loader: { ".svg": "text" },
});
for (const file of ["index.html", "icon.svg"]) cpSync(path.join(source, file), path.join(output, file));

// The licences of what is in the bundle, for the page "About".
const packages = new Set();
for (const input of Object.keys(result.metafile.inputs)) {
  const found = /node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(input);
  if (found) packages.add(found[1]);
}
const licences = [...packages].sort().map((name) => {
  const folder = path.join(modules, name);
  const { version, license } = JSON.parse(readFileSync(path.join(folder, "package.json"), "utf8"));
  const file = readdirSync(folder).find((each) => /^licen[cs]e/i.test(each));
  return { name, version, license, text: file ? readFileSync(path.join(folder, file), "utf8") : "" };
});
writeFileSync(path.join(output, "licences.json"), JSON.stringify(licences));
if (!existsSync(path.join(output, "main.js"))) process.exit(1);
