// SPDX-License-Identifier: BSD-3-Clause
// Makes a video of pictures, by WebCodecs.
import { webm } from "./webm.js";

const CODECS = [
  ["vp8", "V_VP8"], // needs less of the processor than the second, and the simulator has it, too
  ["vp09.00.40.08", "V_VP9"],
];
const BITS = 0.12; // per pixel
export const RATE = 30; // pictures per second
const KEY = 2000; // ms between two pictures that need no other, from which players can begin
const QUEUE = 4; // pictures that wait for the encoder

export class VideoEncoding {
  #encoder;
  #canvas;
  #codec;
  #chunks = [];
  #error = null;
  #key = -Infinity;
  #last = -Infinity; // ms

  /// Begins a video of this size in pixels, which is made even. `live`: pictures come at their times.
  static async begin(width, height, live) {
    if (!("VideoEncoder" in window)) {
      const why = window.isSecureContext ? "this browser has no WebCodecs" : "browsers allow it only at https and at 127.0.0.1";
      throw new Error(`A video cannot be made: ${why}`);
    }
    const size = { width: width & ~1, height: height & ~1 };
    const bitrate = Math.round(BITS * RATE * size.width * size.height);
    for (const [codec, name] of CODECS) {
      const config = { codec, ...size, bitrate, framerate: RATE, latencyMode: live ? "realtime" : "quality" };
      const { supported } = await VideoEncoder.isConfigSupported(config);
      if (supported) return new VideoEncoding(config, name);
    }
    throw new Error("A video cannot be made: this browser encodes neither VP8 nor VP9");
  }

  constructor(config, name) {
    this.#codec = name;
    this.#canvas = new OffscreenCanvas(config.width, config.height);
    this.#encoder = new VideoEncoder({
      output: (chunk) => {
        const data = new Uint8Array(chunk.byteLength);
        chunk.copyTo(data);
        this.#chunks.push({ data, time: Math.round(chunk.timestamp / 1000), key: chunk.type === "key" });
      },
      error: (error) => (this.#error = error),
    });
    this.#encoder.configure(config);
  }

  /// Whether the encoder is behind.
  get isBusy() {
    return this.#encoder.encodeQueueSize >= QUEUE;
  }

  /// Adds what a canvas shows at a time, ms from the begin.
  add(canvas, time) {
    if (this.#error) throw this.#error;
    const { width, height } = this.#canvas;
    this.#canvas.getContext("2d").drawImage(canvas, 0, 0, width, height);
    const keyFrame = time - this.#key >= KEY;
    if (keyFrame) this.#key = time;
    this.#last = time;
    const frame = new VideoFrame(this.#canvas, { timestamp: Math.round(1000 * time) });
    this.#encoder.encode(frame, { keyFrame });
    frame.close();
  }

  /// Resolves when the encoder takes pictures again.
  async ready() {
    while (this.isBusy && !this.#error) await new Promise((resolve) => setTimeout(resolve, 2));
  }

  /// Ends it, and returns the file as a Blob.
  async end() {
    await this.#encoder.flush();
    this.#encoder.close();
    if (this.#error) throw this.#error;
    const { width, height } = this.#canvas;
    return webm({ codec: this.#codec, width, height, chunks: this.#chunks, duration: this.#last + 1000 / RATE });
  }

  cancel() {
    if (this.#encoder.state !== "closed") this.#encoder.close();
  }
}
