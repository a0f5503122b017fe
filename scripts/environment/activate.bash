# SPDX-License-Identifier: BSD-3-Clause
# Source this file to use the workspace and the virtual environment that scripts/setup created.
# Unsets the caller's variables for Python and ROS workspaces; keeps the address of the ROS master.
unset PYTHONHOME PYTHONPATH CMAKE_PREFIX_PATH ROS_PACKAGE_PATH ROS_ROOT
_bubblesim_root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd -P)
set +u  # catkin's setup files read variables that may not be set
# shellcheck disable=SC1091
source "$_bubblesim_root/.ws/devel/setup.bash"
export VIRTUAL_ENV=$_bubblesim_root/.ws/venv
export PYTHONNOUSERSITE=1  # Debian's modules are not made for the numpy of a `pip install --user`
export PATH=$VIRTUAL_ENV/bin:/usr/bin:/bin:$PATH
unset _bubblesim_root
