// SPDX-License-Identifier: BSD-3-Clause
// The connection to the server: calls, events and frames. See python/bubblesim/web/page.py for the messages.
import { decode, encode } from "cborg";

import { Emitter } from "./emitter.js";

const RETRY = 700; // ms

export const STATES = ["stopped", "paused", "running", "stopping"];

/// Emits the events of the server by their names, and
/// "connection" (true or false), "frame" (see readFrame).
export class Link extends Emitter {
  connected = false;
  mayEdit = true;
  frame = null;
  #socket = null;
  #next = 1;
  #open = new Map();

  connect() {
    const scheme = location.protocol === "https:" ? "wss" : "ws";
    const socket = new WebSocket(`${scheme}://${location.host}/socket`);
    socket.binaryType = "arraybuffer";
    this.#socket = socket;
    socket.onopen = () => this.#setConnected(true);
    socket.onmessage = ({ data }) => this.#receive(data);
    socket.onclose = () => {
      this.#setConnected(false);
      for (const { reject } of this.#open.values()) reject(new Error("the connection to the server is lost"));
      this.#open.clear();
      setTimeout(() => this.connect(), RETRY);
    };
  }

  /// Calls a function: "sim.NAME", "window.NAME" (the simulator's) or "server.NAME" (the server's). Calls on one line
  /// are carried out one after the other; give long ones a line of their own.
  call(name, args = [], line = "") {
    return new Promise((resolve, reject) => {
      if (!this.connected) {
        reject(new Error("there is no connection to the server"));
        return;
      }
      const number = this.#next++;
      this.#open.set(number, { resolve, reject });
      this.#socket.send(encode([number, name, args, line]));
    });
  }

  #setConnected(connected) {
    if (this.connected === connected) return;
    this.connected = connected;
    this.emit("connection", connected);
  }

  #receive(data) {
    if (new Uint8Array(data)[0] === 0) {
      // Answered first: the server waits for it, whatever becomes of the frame here.
      this.#socket.send(encode([new DataView(data).getUint32(4, true)]));
      this.frame = readFrame(data);
      this.emit("frame", this.frame);
      return;
    }
    const message = decode(new Uint8Array(data));
    if (message[0] === null) {
      if (message[1] === "hello") this.mayEdit = message[2].edit;
      this.emit(message[1], message[2]);
      return;
    }
    const [number, reply] = message;
    const call = this.#open.get(number);
    this.#open.delete(number);
    if (!call) return;
    if ("err" in reply) call.reject(new Error(reply.err));
    else call.resolve(reply.ret.length > 1 ? reply.ret : reply.ret[0]);
  }
}

/// A frame: { count, time, written, revision, state, links, poses, joints }; poses has x, y, z and a quaternion x, y, z,
/// w for each link.
function readFrame(data) {
  const view = new DataView(data);
  const links = view.getUint32(32, true);
  const axes = view.getUint32(36, true);
  return {
    count: view.getUint32(4, true),
    time: view.getFloat64(8, true),
    written: view.getFloat64(16, true),
    revision: view.getUint32(24, true),
    state: STATES[view.getUint32(28, true)],
    poses: new Float32Array(data, 40, 7 * links),
    joints: new Float32Array(data, 40 + 28 * links, axes),
  };
}
