# SPDX-License-Identifier: BSD-3-Clause
"""What move_base shows of its maps: the service make_plan and the topics of the costmaps."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import rospy
from nav_msgs.msg import OccupancyGrid
from nav_msgs.srv import GetPlan, GetPlanResponse

from bubblesim.compat.costmaps import Inflation, costmap_message, rolling_grid
from bubblesim.compat.move_base_settings import INFLATION_LAYERS, MoveBaseParameters, Settings
from bubblesim.controllers.planar_motion import Pose2D
from bubblesim.navigation.grid_map import GridMap
from bubblesim.navigation.path_planning import NoPathError, plan
from bubblesim.navigation.planar import Point, placed
from bubblesim.nodes.path_message import path_message

_SIDE, _RATE = 10.0, 2.0  # m, of the local costmap, and Hz

PlaceOf = Callable[[str, str], Pose2D | None]
"""The pose of a frame in another one; None without a transform."""


class MoveBaseMaps:
    """Both costmaps are published at their publish_frequency, the global one of a map when that has changed."""

    def __init__(
        self,
        settings: Settings,
        parameters: MoveBaseParameters,
        place_of: PlaceOf,
        grid: Callable[[], GridMap | None],
        hits: Callable[[], list[Point]],
    ) -> None:
        """Advertise the topics and the service.

        :param grid: returns the map.
        :param hits: returns the points of the newest scans, in the robot's frame.
        """
        self._settings = settings
        self._place_of = place_of
        self._grid = grid
        self._hits = hits
        self._local_frame = str(parameters.find("local_costmap/global_frame") or settings.map_frame).lstrip("/")
        self._size = tuple(parameters.number(_SIDE, f"local_costmap/{name}") for name in ("width", "height"))
        self._resolution = parameters.number(0.05, "local_costmap/resolution")
        radius = settings.footprint.radius
        self._inflations = {name: _inflation(parameters, name, radius) for name in ("global_costmap", "local_costmap")}
        self._costmaps = {
            name: rospy.Publisher(f"~{name}/costmap", OccupancyGrid, queue_size=1, latch=True)
            for name in self._inflations
        }
        rospy.Service("~make_plan", GetPlan, self._make_plan)
        self._repeat("local_costmap", parameters, self._publish_local)
        if settings.obstacle_layer is not None:
            self._repeat("global_costmap", parameters, self._publish_seen)

    def _repeat(self, name: str, parameters: MoveBaseParameters, publish: Callable[[], None]) -> None:
        frequency = parameters.number(_RATE, f"{name}/publish_frequency")
        if frequency > 0.0:
            rospy.Timer(rospy.Duration.from_sec(1.0 / frequency), lambda _: publish(), reset=True)

    def publish_global(self) -> None:
        """Publish the global costmap."""
        grid = self._grid()
        if grid is not None:
            inflation = self._inflations["global_costmap"]
            costs = costmap_message(self._settings.map_frame, rospy.Time.now(), grid, inflation)
            self._costmaps["global_costmap"].publish(costs)

    def _publish_seen(self) -> None:
        if self._costmaps["global_costmap"].get_num_connections():
            self.publish_global()

    def _publish_local(self) -> None:
        publisher = self._costmaps["local_costmap"]
        base = self._settings.base_frame
        place = self._place_of(base, self._local_frame) if publisher.get_num_connections() else None
        if place is None:
            return
        obstacles = [placed(place, point) for point in self._hits()]
        grid = rolling_grid((place.x, place.y), (self._size[0], self._size[1]), self._resolution, obstacles)
        stamp = rospy.Time.now()
        publisher.publish(costmap_message(self._local_frame, stamp, grid, self._inflations["local_costmap"]))

    def _make_plan(self, request: Any) -> Any:
        """Return the path on the map from a pose, or from the robot if it has no frame; without one, an empty path."""
        grid = self._grid()
        start = self._point(request.start) if request.start.header.frame_id else self._robot()
        goal = self._point(request.goal)
        if grid is None or start is None or goal is None:
            rospy.logwarn("make_plan: there is no map, or no transform of the start or the goal")
            return GetPlanResponse(plan=path_message(self._settings.map_frame, []))
        try:
            points = plan(grid, start, goal, self._settings.footprint)
        except NoPathError as error:
            rospy.logwarn(f"make_plan: {error}")
            return GetPlanResponse(plan=path_message(self._settings.map_frame, []))
        found = path_message(self._settings.map_frame, points)
        found.poses[-1].pose.orientation = request.goal.pose.orientation
        return GetPlanResponse(plan=found)

    def _robot(self) -> Point | None:
        place = self._place_of(self._settings.base_frame, self._settings.map_frame)
        return None if place is None else (place.x, place.y)

    def _point(self, pose: Any) -> Point | None:
        frame = self._place_of(pose.header.frame_id.lstrip("/"), self._settings.map_frame)
        return None if frame is None else placed(frame, (pose.pose.position.x, pose.pose.position.y))


def _inflation(parameters: MoveBaseParameters, costmap: str, radius: float) -> Inflation:
    layers = [f"{costmap}/{layer}" for layer in INFLATION_LAYERS]
    reach = parameters.number(Inflation.reach, *(f"{layer}inflation_radius" for layer in layers))
    scaling = parameters.number(Inflation.scaling, *(f"{layer}cost_scaling_factor" for layer in layers))
    return Inflation(radius, reach, scaling)
