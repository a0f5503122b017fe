# SPDX-License-Identifier: BSD-3-Clause
"""Reads lines [service, request] in JSON from stdin, calls like rosservice, writes each response as a line of JSON:
{"error": TEXT} for a call that failed.
"""

import json
import sys

import rosservice
import yaml

for line in sys.stdin:
    service, request = json.loads(line)
    try:
        _, response = rosservice.call_service(service, [request])
        answer = yaml.safe_load(str(response))
    except rosservice.ROSServiceException as error:
        answer = {"error": str(error)}
    print(json.dumps(answer), flush=True)
