# SPDX-License-Identifier: BSD-3-Clause
"""Generates the C++ and Python code of a package's messages and services with gencpp and genpy, all in one process."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import genmsg
from genmsg.template_tools import generate_from_file
from genpy.generate_initpy import write_modules
from genpy.generator import Generator, MsgGenerator, SrvGenerator

_HEADERS = ({"msg.h.template": "@NAME@.h"}, {"srv.h.template": "@NAME@.h"})  # by template, for messages and services
_MODULES: dict[str, type[Generator]] = {"msg": MsgGenerator, "srv": SrvGenerator}


def main() -> int:
    """Generate the code; return 1 after an error, which is on stderr."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("package")
    parser.add_argument("definitions", nargs="+", type=Path, help="the .msg and .srv files of the package")
    parser.add_argument("--folder", nargs=2, action="append", metavar=("PACKAGE", "FOLDER"), default=[])
    parser.add_argument("--templates", required=True, help="folder of gencpp's templates")
    parser.add_argument("--headers", required=True, type=Path, help="folder for the C++ headers")
    parser.add_argument("--modules", required=True, type=Path, help="folder for the Python package")
    options = parser.parse_args()
    try:
        _write_headers(options)
        return _write_modules(options)
    except (genmsg.InvalidMsgSpec, genmsg.MsgGenerationException) as error:
        print(f"{options.package}: {error}", file=sys.stderr)
        return 1


def _write_headers(options: argparse.Namespace) -> None:
    places = [f"{package}:{folder}" for package, folder in options.folder]
    for definition in options.definitions:
        generate_from_file(str(definition), options.package, str(options.headers), options.templates, places, *_HEADERS)


def _write_modules(options: argparse.Namespace) -> int:
    places: dict[str, list[str]] = {}
    for package, folder in options.folder:
        places.setdefault(package, []).append(folder)
    options.modules.mkdir(parents=True, exist_ok=True)
    (options.modules / "__init__.py").touch()
    for kind, generator in _MODULES.items():
        definitions = [str(each) for each in options.definitions if each.suffix == f".{kind}"]
        if not definitions:
            continue
        folder = options.modules / kind
        folder.mkdir(exist_ok=True)
        if failed := generator().generate_messages(options.package, definitions, str(folder), places):
            return int(failed)
        write_modules(str(folder))
    return 0


if __name__ == "__main__":
    sys.exit(main())
