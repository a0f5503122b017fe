# SPDX-License-Identifier: BSD-3-Clause

from ros_support import roscore as roscore
