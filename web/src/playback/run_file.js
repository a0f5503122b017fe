// SPDX-License-Identifier: BSD-3-Clause
// A recorded run as a file: CBOR, compressed by gzip. Objects have their paths, because handles are those of one session.
import { decode, encode } from "cborg";

import { Run } from "./run.js";

const FORMAT = "bubblesim run";
const VERSION = 1;
const MOST_BYTES = 512 * 2 ** 20; // of an unpacked file

/// A run as a Blob; objects that are no longer in the scene are left out.
export async function runFile(run, scene) {
  const paths = (handles) => [...handles].flatMap((handle) => scene.objects.get(handle)?.path ?? []);
  const places = (table) => [...table].flatMap(([handle, place]) => (scene.objects.has(handle) ? [[scene.objects.get(handle).path, place]] : []));
  const content = {
    format: FORMAT,
    version: VERSION,
    scene: scene.info?.scene ?? "",
    layouts: [...run.layouts].map(([revision, { rows, axes, there }]) => [revision, places(rows), places(axes), paths(there)]),
    frames: run.frames.map(({ time, revision, poses, joints }) => [time, revision, bytesOf(poses), bytesOf(joints)]),
  };
  return new Response(new Blob([encode(content)]).stream().pipeThrough(new CompressionStream("gzip"))).blob();
}

/// Reads a file: { run, missing }, the latter are the paths of links that the scene does not have.
export async function readRun(file, scene) {
  const content = await unpacked(file);
  const run = new Run(file.name);
  const missing = new Set();
  for (const [revision, rows, axes, there] of content.layouts) {
    const handles = (places, kind) =>
      new Map(
        places.flatMap(([path, place]) => {
          const object = scene.byPath(path);
          if (object?.kind === kind) return [[object.handle, place]];
          missing.add(path);
          return [];
        }),
      );
    const links = handles(there.map((path) => [path, 0]), "link");
    run.layouts.set(revision, { rows: handles(rows, "link"), axes: handles(axes, "joint"), there: new Set(links.keys()) });
  }
  if (![...run.layouts.values()].some(({ rows }) => rows.size)) {
    throw new Error(`${file.name} is a run of the scene '${content.scene}': open that scene first, no link of the run is in this one`);
  }
  for (const [time, revision, poses, joints] of content.frames) run.add({ time, revision, poses: floats(poses), joints: floats(joints) });
  return { run, missing: [...missing] };
}

async function unpacked(file) {
  const wrong = (why) => new Error(`${file.name} is not a run that this window can play: ${why}`);
  const parts = [];
  let size = 0;
  try {
    for await (const part of file.stream().pipeThrough(new DecompressionStream("gzip"))) {
      size += part.byteLength;
      if (size > MOST_BYTES) break;
      parts.push(part);
    }
  } catch {
    throw wrong("it is cut off, or not a recording of this window");
  }
  if (size > MOST_BYTES) throw wrong(`it has more than ${MOST_BYTES / 2 ** 20} MB`);
  let content;
  try {
    content = decode(new Uint8Array(await new Blob(parts).arrayBuffer()));
  } catch (error) {
    throw wrong(error.message);
  }
  if (content?.format !== FORMAT) throw wrong("it is not a recording of this window");
  if (content.version !== VERSION) throw wrong(`its version is ${content.version}, this window reads ${VERSION}`);
  const problem = problemOf(content);
  if (problem) throw wrong(problem);
  return content;
}

/// What is wrong with the parts of a file; empty if they fit each other.
function problemOf({ layouts, frames }) {
  if (!Array.isArray(layouts) || !Array.isArray(frames) || frames.length < 2) return "it has less than two frames";
  const most = new Map(); // by revision: the highest place of a link and of a joint
  const highest = (places) => Math.max(-1, ...places.map(([, place]) => place));
  const isTable = (places) => Array.isArray(places) && places.every((each) => typeof each[0] === "string" && Number.isInteger(each[1]) && each[1] >= 0);
  for (const [revision, rows, axes, there] of layouts) {
    const isList = Array.isArray(there) && there.every((path) => typeof path === "string");
    if (!isTable(rows) || !isTable(axes) || !isList) return `the list of objects of revision ${revision} is damaged`;
    most.set(revision, [highest(rows), highest(axes)]);
  }
  let before = -Infinity;
  for (const [time, revision, poses, joints] of frames) {
    if (!(time > before)) return `the frame at ${time} s comes after one at ${before} s`;
    before = time;
    const [row, place] = most.get(revision) ?? [-1, -1];
    if (!(poses instanceof Uint8Array) || poses.length < 28 * (row + 1)) return `the frame at ${time} s has too few poses`;
    if (!(joints instanceof Uint8Array) || joints.length < 4 * (place + 1)) return `the frame at ${time} s has too few joints`;
  }
  return "";
}

function bytesOf({ buffer, byteOffset, byteLength }) {
  return new Uint8Array(buffer, byteOffset, byteLength);
}

/// 32 bit floats in bytes, which need not be aligned.
function floats(bytes) {
  return new Float32Array(bytes.slice(0, bytes.length & ~3).buffer);
}
