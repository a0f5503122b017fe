# SPDX-License-Identifier: BSD-3-Clause
"""Prints the hashes of the types in a package's folder as JSON, by ROS 2's own generator. For the environment of rclpy.

usage: ros2_type_hashes.py PACKAGE_FOLDER EMPTY_FOLDER
"""

import json
import sys
from pathlib import Path

from rosidl_adapter.action import convert_action_to_idl
from rosidl_adapter.msg import convert_msg_to_idl
from rosidl_adapter.srv import convert_srv_to_idl
from rosidl_generator_type_description import generate_type_hash

CONVERTERS = {"msg": convert_msg_to_idl, "srv": convert_srv_to_idl, "action": convert_action_to_idl}


def main() -> None:
    package, output = Path(sys.argv[1]), Path(sys.argv[2])
    idl_files = []
    for kind, convert in CONVERTERS.items():
        (output / kind).mkdir()
        for file in sorted((package / kind).glob(f"*.{kind}")):
            convert(package, package.name, file.relative_to(package), output / kind)
            idl_files.append(f"{kind}/{file.stem}.idl")
    arguments = output / "arguments.json"
    shares = [path for path in (Path(sys.prefix) / "share").iterdir() if path.is_dir()]
    arguments.write_text(
        json.dumps(
            {
                "package_name": package.name,
                "output_dir": str(output),
                "idl_tuples": [f"{output}:{name}" for name in idl_files],
                "include_paths": [f"{path.name}:{path}" for path in shares if path.name != package.name],
            }
        )
    )
    generate_type_hash(str(arguments))
    hashes = {}
    for name in idl_files:
        for each in json.loads((output / name).with_suffix(".json").read_text())["type_hashes"]:
            hashes[each["type_name"]] = each["hash_string"]
    print(json.dumps(hashes))


if __name__ == "__main__":
    main()
