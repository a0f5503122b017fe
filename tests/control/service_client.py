# SPDX-License-Identifier: BSD-3-Clause
"""Takes lines [service, request] in JSON on stdin, calls as rosservice does, writes each response as a line of JSON."""

import json
import sys

import rosservice
import yaml

for line in sys.stdin:
    service, request = json.loads(line)
    _, response = rosservice.call_service(service, [request])
    print(json.dumps(yaml.safe_load(str(response))), flush=True)
