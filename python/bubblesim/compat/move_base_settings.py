# SPDX-License-Identifier: BSD-3-Clause
"""The parameters of move_base, its costmaps and its planners, as far as they mean the same here."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from typing import Any

from bubblesim.compat.recovery import DEFAULT_RECOVERIES, Recovery, RecoveryKind
from bubblesim.navigation.driver import Driver
from bubblesim.navigation.local_planning import Body
from bubblesim.navigation.path_planning import Footprint
from bubblesim.navigation.planar import Point

_SPARE, _COMFORT = 0.05, 0.3  # m beside a round robot, as in go_to.py
_PLANNERS = ("DWAPlannerROS", "TebLocalPlannerROS", "TrajectoryPlannerROS")
_OF_PLANNERS = {
    "max_speed": ("max_vel_x", "max_vel_trans", "max_trans_vel"),
    "max_turn": ("max_vel_theta", "max_rot_vel", "max_rotational_vel"),
    "acceleration": ("acc_lim_x",),
    "tolerance": ("xy_goal_tolerance",),
    "yaw_tolerance": ("yaw_goal_tolerance",),
    "turning_radius": ("min_turning_radius",),
}
INFLATION_LAYERS = ("inflation_layer/", "inflater_layer/", "inflation/", "")
_RECOVERY_KINDS = {"ClearCostmapRecovery": RecoveryKind.CLEAR, "RotateRecovery": RecoveryKind.ROTATE}


@dataclass(frozen=True)
class ObstacleLayer:
    """A costmap without a map: it holds what scans have seen."""

    size: tuple[float, float] = (10.0, 10.0)  # m
    corner: Point = (0.0, 0.0)  # m
    resolution: float = 0.05  # m
    rolls: bool = False  # the robot stays in its middle
    frequency: float = 5.0  # Hz, of updates


@dataclass(frozen=True)
class Settings:
    """What the node reads from its parameters."""

    driver: Driver = field(default_factory=Driver)
    footprint: Footprint = field(default_factory=lambda: Footprint(Driver.radius + _SPARE, Driver.radius + _COMFORT))
    body: Body | None = None
    map_frame: str = "map"
    base_frame: str = "base_link"
    map_topic: str = "map"
    scan_topics: tuple[str, ...] = ("scan",)
    obstacle_layer: ObstacleLayer | None = None  # None: the map comes by a topic
    control_frequency: float = 20.0  # Hz
    timeout: float = 10.0  # s without a way on, before a recovery
    recoveries: tuple[Recovery, ...] = DEFAULT_RECOVERIES
    oscillation_timeout: float = 0.0  # s; 0: none
    oscillation_distance: float = 0.5  # m
    global_planner: str = "NavfnROS"
    local_planner: str = "TrajectoryPlannerROS"


class MoveBaseParameters:
    """A dictionary of dictionaries, as the parameter server has them below the node; notes what is read."""

    def __init__(self, given: Mapping[str, Any]) -> None:
        """Nothing is read yet."""
        self._given = given
        self._read: set[str] = set()

    def find(self, *paths: str) -> Any:
        """Return the value of the first path that is given, None without one."""
        found = None
        for path in paths:
            value: Any = self._given
            for key in path.split("/"):
                value = value.get(key) if isinstance(value, Mapping) else None
            if value is not None:
                self._read.add(path)
                found = value if found is None else found
        return found

    def number(self, default: float, *paths: str) -> float:
        """Return a number."""
        value = self.find(*paths)
        return default if value is None else float(value)

    def without_effect(self) -> list[str]:
        """Return the paths that were not read."""
        return [path for path in _leaves(self._given) if not any(_is_in(path, read) for read in self._read)]


def _leaves(given: Mapping[str, Any], prefix: str = "") -> Iterator[str]:
    for key, value in sorted(given.items()):
        if isinstance(value, Mapping):
            yield from _leaves(value, f"{prefix}{key}/")
        else:
            yield f"{prefix}{key}"


def _is_in(path: str, whole: str) -> bool:
    return path == whole or path.startswith(f"{whole}/")


def read_settings(parameters: MoveBaseParameters) -> Settings:
    """Return the settings; raise ValueError for values that cannot be used."""
    find, number = parameters.find, parameters.number
    local = _last_part(find("base_local_planner"), Settings.local_planner)
    driver = _driver(parameters, local)
    driver, footprint, body = _outline(parameters, driver)
    layer, topics = _layers(parameters)
    frame = find("global_costmap/robot_base_frame", "local_costmap/robot_base_frame")
    settings = Settings(
        driver,
        footprint,
        body,
        map_frame=_frame(find("global_costmap/global_frame"), Settings.map_frame),
        base_frame=_frame(frame, Settings.base_frame),
        map_topic=str(find("global_costmap/static_layer/map_topic", "global_costmap/map_topic") or Settings.map_topic),
        scan_topics=topics,
        obstacle_layer=layer,
        control_frequency=number(Settings.control_frequency, "controller_frequency"),
        timeout=number(Settings.timeout, "controller_patience", "planner_patience"),
        recoveries=_recoveries(parameters),
        oscillation_timeout=number(0.0, "oscillation_timeout"),
        oscillation_distance=number(Settings.oscillation_distance, "oscillation_distance"),
        global_planner=_last_part(find("base_global_planner"), Settings.global_planner),
        local_planner=local,
    )
    if not settings.control_frequency > 0.0:
        raise ValueError(f"controller_frequency is {settings.control_frequency}, must be above 0")
    return settings


def _frame(given: Any, default: str) -> str:
    return default if given is None else str(given).lstrip("/")


def _last_part(given: Any, default: str) -> str:
    """Return the name of a planner, as in dwa_local_planner/DWAPlannerROS."""
    return default if given is None else str(given).rpartition("/")[2]


def _driver(parameters: MoveBaseParameters, planner: str) -> Driver:
    planners = [planner, *(each for each in _PLANNERS if each != planner)]
    found = {
        name: parameters.find(*(f"{each}/{alias}" for each in planners for alias in aliases))
        for name, aliases in _OF_PLANNERS.items()
    }
    driver = replace(Driver(), **{name: float(value) for name, value in found.items() if value is not None})
    for each in fields(driver):
        value = getattr(driver, each.name)
        if not value >= 0.0 or (value == 0.0 and each.name != "turning_radius"):
            raise ValueError(f"{each.name} of the planner is {value}, must be above 0")
    return driver


def _outline(parameters: MoveBaseParameters, driver: Driver) -> tuple[Driver, Footprint, Body | None]:
    """Return the driver, the space of paths and the outline, of a round robot or of a polygon's rectangle."""
    costmaps = ("global_costmap", "local_costmap")
    padding = parameters.number(0.0, *(f"{each}/footprint_padding" for each in costmaps))
    polygon = parameters.find(*(f"{each}/footprint" for each in costmaps))
    reach = parameters.find(*(f"{each}/{layer}inflation_radius" for each in costmaps for layer in INFLATION_LAYERS))
    if polygon is None or polygon == [] or parameters.find(*(f"{each}/robot_radius" for each in costmaps)) is not None:
        given = parameters.find(*(f"{each}/robot_radius" for each in costmaps))
        radius = (Driver.radius if given is None else float(given)) + padding
        space, body = radius + _SPARE, None
    else:
        body, space = _rectangle(polygon, padding)
        radius = space
    comfort = radius + _COMFORT if reach is None else max(float(reach), space + 0.01)
    return replace(driver, radius=radius), Footprint(space, comfort), body


def _rectangle(polygon: Any, padding: float) -> tuple[Body, float]:
    """Return discs that cover the rectangle around a footprint, and the radius of the circle in it."""
    points = ast.literal_eval(polygon) if isinstance(polygon, str) else polygon
    try:
        xs, ys = zip(*((float(x), float(y)) for x, y in points), strict=True)
    except (TypeError, ValueError):
        raise ValueError(f"footprint is {polygon}, must be a list of points [x, y]") from None
    length, width = max(xs) - min(xs) + 2 * padding, 2 * (max(map(abs, ys)) + padding)
    if not (length > 0.0 and width > 0.0):
        raise ValueError(f"footprint is {polygon}, which has no area")
    body = Body.rectangle(length, width)
    middle = (max(xs) + min(xs)) / 2
    return replace(body, centres=tuple(centre + middle for centre in body.centres)), min(length, width) / 2


def _layers(parameters: MoveBaseParameters) -> tuple[ObstacleLayer | None, tuple[str, ...]]:
    """Return the global costmap's layer if it has no map, and the topics of the scans."""
    topics = [topic for costmap in ("global_costmap", "local_costmap") for topic in _scan_topics(parameters, costmap)]
    scans = tuple(dict.fromkeys(topics)) or Settings.scan_topics
    plugins = parameters.find("global_costmap/plugins")
    if plugins is None:
        has_map = bool(parameters.find("global_costmap/static_map") in (None, True))
    else:
        parameters.find("global_costmap/static_map")
        has_map = any(str(each.get("type", "")).endswith("StaticLayer") for each in plugins)
    if has_map:
        return None, scans

    def number(name: str, default: float) -> float:
        return parameters.number(default, f"global_costmap/{name}")

    layer = ObstacleLayer(
        (number("width", 10.0), number("height", 10.0)),
        (number("origin_x", 0.0), number("origin_y", 0.0)),
        number("resolution", ObstacleLayer.resolution),
        parameters.find("global_costmap/rolling_window") is True,
        number("update_frequency", ObstacleLayer.frequency),
    )
    if not (min(layer.size) > 0.0 and layer.resolution > 0.0 and layer.frequency > 0.0):
        raise ValueError("width, height, resolution and update_frequency of global_costmap must be above 0")
    return layer, scans


def _scan_topics(parameters: MoveBaseParameters, costmap: str) -> list[str]:
    plugins = parameters.find(f"{costmap}/plugins") or ()
    names = [str(each.get("name", "")) for each in plugins if isinstance(each, Mapping)]
    found = []
    for layer in [*(f"{costmap}/{name}" for name in names), f"{costmap}/obstacle_layer", costmap]:
        for source in str(parameters.find(f"{layer}/observation_sources") or "").split():
            if parameters.find(f"{layer}/{source}/data_type") == "LaserScan":
                found.append(str(parameters.find(f"{layer}/{source}/topic") or source))
    return found


def _recoveries(parameters: MoveBaseParameters) -> tuple[Recovery, ...]:
    if parameters.find("recovery_behavior_enabled") is False:
        return ()
    listed = parameters.find("recovery_behaviors")
    if listed is None:
        distance = parameters.number(3.0, "conservative_reset_dist")
        found = [replace(each, distance=distance) if each.name == "conservative_reset" else each
                 for each in DEFAULT_RECOVERIES]  # fmt: skip
    else:
        found = list(_listed_recoveries(parameters, listed))
    if parameters.find("clearing_rotation_allowed") is False:
        found = [each for each in found if each.kind != RecoveryKind.ROTATE]
    return tuple(found)


def _listed_recoveries(parameters: MoveBaseParameters, listed: Sequence[Mapping[str, Any]]) -> Iterator[Recovery]:
    for each in listed:
        name, kind = str(each.get("name", "")), _RECOVERY_KINDS.get(str(each.get("type", "")).rpartition("/")[2])
        if kind is None:
            known = " or ".join(_RECOVERY_KINDS)
            raise ValueError(f"the recovery behavior '{name}' has the type {each.get('type')}; use {known}")
        yield Recovery(name, kind, parameters.number(3.0, f"{name}/reset_distance"))
