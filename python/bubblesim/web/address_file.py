# SPDX-License-Identifier: BSD-3-Clause
"""A file with the whole address of the window, for its owner only.

The address has the token in it: a command line would show it to other users, and a log may be read by them. The file is
a page that leads to the window, so that a browser can open it.
"""

from __future__ import annotations

import errno
import html
import os
import tempfile
from pathlib import Path

from bubblesim.running.ros_home import ros_home

_PAGE = """\
<!doctype html>
<meta charset="utf-8" />
<meta name="referrer" content="no-referrer" />
<meta http-equiv="refresh" content="0; url={address}" />
<title>bubblesim</title>
<a href="{address}">The window of bubblesim</a>
"""


def write_address(address: str, port: int) -> Path:
    """Write the file of the window on a port, in place of one that a server has left behind; return its path.

    :raises OSError: if it cannot be written.
    """
    folder = _folder()
    folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    if folder.is_symlink() or folder.stat().st_uid != os.geteuid():  # who made it could put another page there
        raise PermissionError(errno.EPERM, f"{folder} belongs to another user: the token is not written there")
    folder.chmod(0o700)
    number, name = tempfile.mkstemp(dir=folder, prefix=".window-")  # its mode is 0600
    try:
        with os.fdopen(number, "w", encoding="utf-8") as stream:
            stream.write(_PAGE.format(address=html.escape(address)))
        file = folder / f"window-{port}.html"
        Path(name).replace(file)
    except BaseException:
        Path(name).unlink(missing_ok=True)
        raise
    return file


def newest_address_file() -> Path | None:
    """Return the file of the window that was opened last, None if there is none."""
    try:
        return max(_folder().glob("window-*.html"), key=lambda file: file.stat().st_mtime, default=None)
    except OSError:  # one was removed meanwhile
        return None


def _folder() -> Path:
    runtime = os.environ.get("XDG_RUNTIME_DIR", "")
    if Path(runtime).is_absolute() and os.access(runtime, os.W_OK):  # after su it may be that of another user
        return Path(runtime) / "bubblesim"
    return ros_home() / "bubblesim"
