// SPDX-License-Identifier: BSD-3-Clause
// The connection to the server: calls, events and frames. See python/bubblesim/web/page.py for the messages.
import { decode, encode } from "cborg";

import { Emitter } from "./emitter.js";
import { takeToken } from "./token.js";

const RETRY = 700; // ms
const MOST_CALLS = 48; // without an answer; the server refuses more than 64
const NO_TOKEN = 4401; // close code: the token is not that of the server
const LOST = "No connection to the server";

export const STATES = ["stopped", "paused", "running", "stopping"];

/// Emits the events of the server by their names, and
/// "connection" (true or false), "frame" (see readFrame), "problem" when `problem` may be another one.
export class Link extends Emitter {
  connected = false;
  mayEdit = true;
  frame = null;
  problem = LOST; // why there is no connection
  #socket = null;
  #next = 1;
  #open = new Map();
  #waiting = [];

  connect() {
    const scheme = location.protocol === "https:" ? "wss" : "ws";
    const socket = new WebSocket(`${scheme}://${location.host}/socket`);
    socket.binaryType = "arraybuffer";
    this.#socket = socket;
    socket.onopen = () => socket.send(takeToken());
    socket.onmessage = ({ data }) => this.#receive(data);
    socket.onclose = ({ code, reason }) => {
      this.problem = reason || LOST;
      this.#setConnected(false);
      this.emit("problem");
      for (const { reject } of [...this.#open.values(), ...this.#waiting]) reject(new Error("the connection to the server is lost"));
      this.#open.clear();
      this.#waiting = [];
      if (code !== NO_TOKEN) setTimeout(() => this.connect(), RETRY);
    };
  }

  /// Calls a function: "sim.NAME", "window.NAME" (the simulator's) or "server.NAME" (the server's). Calls on one
  /// connection to the simulator are carried out one after the other; give long ones a connection of their own.
  call(name, args = [], connection = "") {
    return new Promise((resolve, reject) => {
      if (!this.connected) {
        reject(new Error("there is no connection to the server"));
        return;
      }
      const number = this.#next++;
      this.#waiting.push({ number, bytes: encode([number, name, args, connection]), resolve, reject });
      this.#sendCalls();
    });
  }

  #sendCalls() {
    while (this.#waiting.length > 0 && this.#open.size < MOST_CALLS) {
      const call = this.#waiting.shift();
      this.#open.set(call.number, call);
      this.#socket.send(call.bytes);
    }
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
      if (message[1] === "hello") {
        this.mayEdit = message[2].edit;
        this.#setConnected(true); // the server has accepted the token
      }
      this.emit(message[1], message[2]);
      return;
    }
    const [number, reply] = message;
    const call = this.#open.get(number);
    this.#open.delete(number);
    this.#sendCalls();
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
