// SPDX-License-Identifier: BSD-3-Clause
// The token, which lets this page in. The address that the simulator prints has it in its fragment, which browsers send
// to no server. The page keeps it for its tab and its origin: a cookie would be sent to all ports of the host.
const KEY = "bubblesim-token";

/// Returns the token, and takes it out of the address line; empty if there is none.
export function takeToken() {
  const given = new URLSearchParams(location.hash.slice(1)).get("token");
  if (given !== null) {
    sessionStorage.setItem(KEY, given);
    history.replaceState(null, "", location.pathname);
  }
  return sessionStorage.getItem(KEY) ?? "";
}

// A browser does not load the page again when only the fragment of its address is another one.
addEventListener("hashchange", () => location.reload());
