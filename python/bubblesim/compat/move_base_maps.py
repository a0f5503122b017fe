# SPDX-License-Identifier: BSD-3-Clause
"""What move_base shows of its maps: the service make_plan and the topics of the costmaps."""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping
from typing import Any

import rospy
from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import OccupancyGrid
from nav_msgs.msg import Path as PathMessage
from nav_msgs.srv import GetPlan, GetPlanResponse
from sensor_msgs.msg import LaserScan

from bubblesim.compat.costmaps import Inflation, costmap_message, rolling_grid
from bubblesim.controllers.planar_motion import Pose2D
from bubblesim.navigation.grid_map import GridMap
from bubblesim.navigation.path_planning import Footprint, NoPathError, plan
from bubblesim.navigation.planar import Point, hits, placed

_SIDE = 10.0  # m, of the local costmap, as in costmap_2d

PlaceOf = Callable[[str, str], Pose2D | None]
"""The pose of a frame in another one; None without a transform."""


class MoveBaseMaps:
    """Keeps the newest map and scan; both costmaps are published at the local one's publish_frequency."""

    def __init__(
        self, frames: tuple[str, str], footprint: Footprint, given: Mapping[str, Any], place_of: PlaceOf
    ) -> None:
        """:param frames: of the map and of the robot."""
        self._map_frame, self._base_frame = frames
        self._footprint = footprint
        self._place_of = place_of
        local = given.get("local_costmap", {})
        self._local_frame = str(local.get("global_frame", self._map_frame))
        self._size = float(local.get("width", _SIDE)), float(local.get("height", _SIDE))
        self._resolution = float(local.get("resolution", 0.05))
        self._inflations = {
            name: _inflation(given.get(name, {}), footprint.radius) for name in ("global_costmap", "local_costmap")
        }
        self._lock = threading.Lock()
        self._known: Any = None  # origin and cells of the newest map
        self._grid: GridMap | None = None
        self._hits: list[Point] = []  # in the robot's frame
        self._costmaps = {
            name: rospy.Publisher(f"~{name}/costmap", OccupancyGrid, queue_size=1, latch=True)
            for name in self._inflations
        }
        rospy.Subscriber("map", OccupancyGrid, self._on_map, queue_size=1)
        rospy.Subscriber("scan", LaserScan, self._on_scan, queue_size=1)
        rospy.Service("~make_plan", GetPlan, self._make_plan)
        frequency = float(local.get("publish_frequency", 2.0))
        if frequency > 0.0:
            rospy.Timer(rospy.Duration.from_sec(1.0 / frequency), lambda _: self._publish_local(), reset=True)

    def _on_map(self, message: Any) -> None:
        if not message.data or (message.info.origin, message.data) == self._known:
            return
        self._known = message.info.origin, message.data
        grid = GridMap.from_message(message)
        with self._lock:
            self._grid = grid
        costs = costmap_message(self._map_frame, rospy.Time.now(), grid, self._inflations["global_costmap"])
        self._costmaps["global_costmap"].publish(costs)

    def _on_scan(self, scan: Any) -> None:
        lidar = self._place_of(scan.header.frame_id, self._base_frame)
        if lidar is not None:
            found = hits(scan, lidar)
            with self._lock:
                self._hits = found

    def _publish_local(self) -> None:
        publisher = self._costmaps["local_costmap"]
        place = self._place_of(self._base_frame, self._local_frame) if publisher.get_num_connections() else None
        if place is None:
            return
        with self._lock:
            obstacles = [placed(place, point) for point in self._hits]
        grid = rolling_grid((place.x, place.y), self._size, self._resolution, obstacles)
        stamp = rospy.Time.now()
        publisher.publish(costmap_message(self._local_frame, stamp, grid, self._inflations["local_costmap"]))

    def _make_plan(self, request: Any) -> Any:
        """Return the path on the map from a pose, or from the robot if it has no frame; without one, an empty path."""
        response = GetPlanResponse(plan=PathMessage())
        response.plan.header.frame_id = self._map_frame
        response.plan.header.stamp = rospy.Time.now()
        with self._lock:
            grid = self._grid
        start = self._point(request.start) if request.start.header.frame_id else self._robot()
        goal = self._point(request.goal)
        if grid is None or start is None or goal is None:
            rospy.logwarn("make_plan: there is no map, or no transform of the start or the goal")
            return response
        try:
            points = plan(grid, start, goal, self._footprint)
        except NoPathError as error:
            rospy.logwarn(f"make_plan: {error}")
            return response
        for x, y in points:
            pose = PoseStamped(header=response.plan.header)
            pose.pose.position.x, pose.pose.position.y, pose.pose.orientation.w = x, y, 1.0
            response.plan.poses.append(pose)
        response.plan.poses[-1].pose.orientation = request.goal.pose.orientation
        return response

    def _robot(self) -> Point | None:
        place = self._place_of(self._base_frame, self._map_frame)
        return None if place is None else (place.x, place.y)

    def _point(self, pose: Any) -> Point | None:
        frame = self._place_of(pose.header.frame_id, self._map_frame)
        return None if frame is None else placed(frame, (pose.pose.position.x, pose.pose.position.y))


def _inflation(costmap: Mapping[str, Any], radius: float) -> Inflation:
    layer = costmap.get("inflation_layer", costmap)
    layer = layer if isinstance(layer, Mapping) else costmap
    reach = float(layer.get("inflation_radius", Inflation.reach))
    return Inflation(radius, reach, float(layer.get("cost_scaling_factor", Inflation.scaling)))
