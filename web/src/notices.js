// SPDX-License-Identifier: BSD-3-Clause
// Short messages in a corner of the page.
import { h } from "./dom.js";

const SECONDS = { info: 4, warning: 8, error: 12 };

export class Notices {
  element = h("div.notices", { role: "status" });

  /// Shows a message for a while; `level` is info, warning or error.
  show(text, level = "info") {
    const notice = h(`div.notice.${level}`, { title: "Click to close" }, text);
    const end = () => notice.remove();
    notice.onclick = end;
    setTimeout(end, 1000 * SECONDS[level]);
    this.element.append(notice);
    while (this.element.children.length > 5) this.element.firstChild.remove();
  }
}
