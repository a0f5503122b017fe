# SPDX-License-Identifier: BSD-3-Clause
"""The Python packages that catkin puts on the path. Run by catkin, not by hand."""

from catkin_pkg.python_setup import generate_distutils_setup
from setuptools import find_packages, setup

setup(
    **generate_distutils_setup(
        packages=find_packages("python"),
        package_dir={"": "python"},
        package_data={
            "bubblesim.scripting.language": ["*.lua"],
            "bubblesim.cli": ["templates/*.in", "templates/*/*.in"],
            "bubblesim.messages": ["ros2/*/*/*", "ros2_before_iron/*/*/*"],
            "bubblesim.gym_tasks": ["scenes/*.sdf"],
        },
    )
)
