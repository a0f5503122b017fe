# SPDX-License-Identifier: BSD-3-Clause
"""The secret that remote clients must know, in a file that only its owner can read."""

from __future__ import annotations

import os
import secrets
import stat
from pathlib import Path

_FEWEST = 16  # characters: a shorter text can be guessed


def make_or_read(file: Path) -> str:
    """Return the token in a file, which is made with a new one, for its owner only, if there is none.

    :raises RuntimeError: if the file cannot be made or read.
    """
    try:
        descriptor = os.open(file, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
    except FileExistsError:
        return read(file)
    except OSError as error:
        raise RuntimeError(f"cannot make the token's file {file}: {error.strerror}") from None
    token = secrets.token_urlsafe(24)
    with os.fdopen(descriptor, "w") as stream:
        stream.write(f"{token}\n")
    return token


def read(file: Path) -> str:
    """Return the token in a file.

    :raises RuntimeError: if the file cannot be read, can be read by others, or holds no token.
    """
    try:
        with file.open() as stream:
            if os.fstat(stream.fileno()).st_mode & (stat.S_IRWXG | stat.S_IRWXO):
                raise RuntimeError(f"other users can read or write the token's file {file}: chmod 600 {file}")
            token = stream.read(1000).strip()
    except (OSError, UnicodeDecodeError) as error:
        raise RuntimeError(f"cannot read the token's file {file}: {error}") from None
    if len(token) < _FEWEST:
        raise RuntimeError(f"the token in {file} has {len(token)} characters: at least {_FEWEST} are needed")
    return token


def is_same(one: str, other: str) -> bool:
    """Compare two tokens in a time that does not depend on them."""
    return secrets.compare_digest(one.encode(), other.encode())
