// SPDX-License-Identifier: BSD-3-Clause
// When the next picture may be drawn. Without a GPU the processor draws, and the simulator needs it too.

export class Pace {
  #gl;
  #software;
  #fence = null; // of a picture that may not be finished
  #began = 0; // ms
  #next = 0; // ms

  constructor(gl) {
    this.#gl = gl;
    const { UNMASKED_RENDERER_WEBGL } = gl.getExtension("WEBGL_debug_renderer_info") ?? {};
    const renderer = UNMASKED_RENDERER_WEBGL ? gl.getParameter(UNMASKED_RENDERER_WEBGL) : "";
    this.#software = /swiftshader|llvmpipe|softpipe|software|basic render/i.test(renderer);
  }

  /// Call it after each picture.
  drawn() {
    if (!this.#software) return;
    if (this.#fence) this.#gl.deleteSync(this.#fence);
    this.#fence = this.#gl.fenceSync(this.#gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    this.#gl.flush();
    this.#began = performance.now();
  }

  /// Whether the last picture is finished and, where the processor draws, has been followed by a rest of the same time.
  get mayDraw() {
    const now = performance.now();
    if (this.#fence) {
      if (this.#gl.getSyncParameter(this.#fence, this.#gl.SYNC_STATUS) === this.#gl.UNSIGNALED) return false;
      this.#gl.deleteSync(this.#fence);
      this.#fence = null;
      this.#next = now + (now - this.#began);
    }
    return now >= this.#next;
  }
}
