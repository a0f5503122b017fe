// SPDX-License-Identifier: BSD-3-Clause
// Encoded pictures as a WebM file (RFC 9559 with RFC 8794), which browsers and players show.

const CLUSTER = 5000; // ms of a cluster at most; times in it are 16 bit numbers

/// An element: its id, and as content bytes, a string, a whole number or a list of elements.
function element(id, content) {
  const body = Array.isArray(content) ? joined(content) : typeof content === "number" ? whole(content) : content;
  const bytes = typeof body === "string" ? new TextEncoder().encode(body) : body;
  return joined([whole(id), size(bytes.length), bytes]);
}

function joined(parts) {
  const all = new Uint8Array(parts.reduce((sum, { length }) => sum + length, 0));
  let at = 0;
  for (const part of parts) {
    all.set(part, at);
    at += part.length;
  }
  return all;
}

/// A whole number in as few bytes as it needs, the highest first.
function whole(value) {
  const bytes = [];
  for (let rest = value; rest > 0 || !bytes.length; rest = Math.floor(rest / 256)) bytes.unshift(rest % 256);
  return new Uint8Array(bytes);
}

/// The size of an element: eight bytes, of which the first bits give their number.
function size(value) {
  const bytes = new Uint8Array(8);
  new DataView(bytes.buffer).setBigUint64(0, (1n << 56n) | BigInt(value));
  return bytes;
}

function double(value) {
  const bytes = new Uint8Array(8);
  new DataView(bytes.buffer).setFloat64(0, value);
  return bytes;
}

/// Returns a Blob. `chunks` are { data, time, key } in the order of their times, in ms; `codec` is V_VP8 or V_VP9.
export function webm({ codec, width, height, chunks, duration }) {
  const head = element(0x1a45dfa3, [
    element(0x4286, 1), // EBML version
    element(0x42f7, 1),
    element(0x42f2, 4),
    element(0x42f3, 8),
    element(0x4282, "webm"),
    element(0x4287, 4),
    element(0x4285, 2),
  ]);
  const info = element(0x1549a966, [
    element(0x2ad7b1, 1_000_000), // ns per unit of time
    element(0x4d80, "bubblesim"),
    element(0x5741, "bubblesim"),
    element(0x4489, double(duration)),
  ]);
  const tracks = element(0x1654ae6b, [
    element(0xae, [
      element(0xd7, 1), // number
      element(0x73c5, 1), // UID
      element(0x83, 1), // video
      element(0x9c, 0), // no lacing
      element(0x86, codec),
      element(0xe0, [element(0xb0, width), element(0xba, height)]),
    ]),
  ]);
  const clusters = [];
  const cues = [];
  let begin = info.length + tracks.length; // of a cluster, from the begin of the segment's content
  let blocks = [];
  let first = 0;
  const end = () => {
    if (!blocks.length) return;
    const cluster = element(0x1f43b675, [element(0xe7, first), ...blocks]);
    cues.push(element(0xbb, [element(0xb3, first), element(0xb7, [element(0xf7, 1), element(0xf1, begin)])]));
    begin += cluster.length;
    clusters.push(cluster);
    blocks = [];
  };
  for (const { data, time, key } of chunks) {
    if (key || time - first > CLUSTER) {
      end();
      first = time;
    }
    const since = time - first;
    blocks.push(element(0xa3, [new Uint8Array([0x81, since >> 8, since & 255, key ? 0x80 : 0]), data]));
  }
  end();
  const segment = element(0x18538067, [info, tracks, ...clusters, element(0x1c53bb6b, cues)]);
  return new Blob([head, segment], { type: "video/webm" });
}
