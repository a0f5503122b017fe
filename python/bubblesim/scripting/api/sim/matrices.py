# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions that compute with poses and matrices."""

from __future__ import annotations

from bubblesim.geometry import poses, rotations
from bubblesim.scripting.api.kinds import Numbers, Vector3, Vector4, Vector7, Vector12
from bubblesim.scripting.api.sim.context import ApiContext

Vector = list[float]


class MatrixFunctions(ApiContext):
    """A pose is [x, y, z, qx, qy, qz, qw]; a matrix the upper three rows of a 4x4 matrix, 12 numbers row by row."""

    def buildIdentityMatrix(self) -> Vector:
        """Return the identity matrix."""
        return rotations.matrix_of_pose(poses.IDENTITY)

    def buildMatrix(self, position: Vector3, angles: Vector3) -> Vector:
        """Return the matrix of a position and Euler angles."""
        return rotations.matrix_of_pose([*position, *rotations.quaternion_of_euler(angles)])

    def buildPose(self, position: Vector3, angles: Vector3) -> Vector:
        """Return the pose of a position and Euler angles."""
        return [*position, *rotations.quaternion_of_euler(angles)]

    def buildMatrixQ(self, position: Vector3, quaternion: Vector4) -> Vector:
        """Return the matrix of a position and a quaternion."""
        return rotations.matrix_of_pose([*position, *quaternion])

    def getQuaternionInverse(self, quaternion: Vector4) -> Vector:
        """Return the inverse of a quaternion."""
        x, y, z, w = quaternion
        return [-x, -y, -z, w]

    def poseToMatrix(self, pose: Vector7) -> Vector:
        """Return the matrix of a pose."""
        return rotations.matrix_of_pose(pose)

    def matrixToPose(self, matrix: Vector12) -> Vector:
        """Return the pose of a matrix."""
        return poses.of_matrix(matrix)

    def multiplyMatrices(self, first: Vector12, second: Vector12) -> Vector:
        """Return the product of two matrices."""
        result: Vector = []
        for row in (first[0:4], first[4:8], first[8:12]):
            for column in range(4):
                last = row[3] if column == 3 else 0.0
                result.append(sum(row[k] * second[4 * k + column] for k in range(3)) + last)
        return result

    def multiplyPoses(self, first: Vector7, second: Vector7) -> Vector:
        """Return the product of two poses."""
        return poses.multiply(first, second)

    def getMatrixInverse(self, matrix: Vector12) -> Vector:
        """Return the inverse of the matrix of a pose."""
        rows = (matrix[0:3], matrix[4:7], matrix[8:11])
        position = matrix[3::4]
        result: Vector = []
        for column in range(3):
            turned = [row[column] for row in rows]
            result += [*turned, -sum(x * y for x, y in zip(turned, position, strict=True))]
        return result

    def invertMatrix(self, matrix: Vector12) -> Vector:
        """Return the inverse of a matrix (old name). In Lua, the argument changes, as in the original."""
        return self.getMatrixInverse(matrix)

    def getPoseInverse(self, pose: Vector7) -> Vector:
        """Return the inverse of a pose."""
        return poses.inverse(pose)

    def multiplyVector(self, frame: Numbers, points: Numbers) -> Vector:
        """Transform one or several points, 3 numbers each, by a matrix (12 or 16 numbers) or a pose (7 numbers).
        Numbers after the last point are ignored."""
        if len(frame) not in (7, 12, 16):
            raise ValueError(f"sim.multiplyVector: expected a pose or a matrix, found {len(frame)} numbers")
        if len(points) < 3:
            raise ValueError(f"sim.multiplyVector: expected 3 numbers per point, found {len(points)}")
        rows = rotations.matrix_of_pose(frame) if len(frame) == 7 else frame
        return [
            sum(rows[4 * row + k] * points[start + k] for k in range(3)) + rows[4 * row + 3]
            for start in range(0, len(points) - 2, 3)
            for row in range(3)
        ]

    def getEulerAnglesFromMatrix(self, matrix: Vector12) -> Vector:
        """Return the Euler angles of a matrix."""
        return rotations.euler_angles(poses.of_matrix(matrix)[3:])

    def getQuaternionFromMatrix(self, matrix: Vector12) -> Vector:
        """Return the quaternion of a matrix."""
        return poses.of_matrix(matrix)[3:]

    def interpolateMatrices(self, first: Vector12, second: Vector12, factor: float) -> Vector:
        """Return a matrix between two, for a factor from 0 to 1."""
        between = poses.interpolate(poses.of_matrix(first), poses.of_matrix(second), factor)
        return rotations.matrix_of_pose(between)

    def interpolatePoses(self, first: Vector7, second: Vector7, factor: float) -> Vector:
        """Return a pose between two, for a factor from 0 to 1."""
        return poses.interpolate(first, second, factor)

    def getRotationAxis(self, first: Vector12, second: Vector12) -> tuple[Vector, float]:
        """Return axis and angle of the rotation, in the world, from the first to the second matrix."""
        begin, end = poses.of_matrix(first)[3:], poses.of_matrix(second)[3:]
        return poses.axis_angle(rotations.product(end, [-begin[0], -begin[1], -begin[2], begin[3]]))

    def rotateAroundAxis(self, frame: Numbers, axis: Vector3, point: Vector3, angle: float) -> Vector:
        """Rotate a matrix (12 or 16 numbers) or a pose (7 numbers) by an angle about an axis through a point."""
        if len(frame) not in (7, 12, 16):
            raise ValueError(f"sim.rotateAroundAxis: expected a pose or a matrix, found {len(frame)} numbers")
        pose = frame if len(frame) == 7 else poses.of_matrix(frame)
        turn = [0.0, 0.0, 0.0, *poses.about_axis(axis, angle)]
        moved = [x - y for x, y in zip(pose[:3], point, strict=True)]
        turned = poses.multiply(turn, [*moved, *pose[3:]])
        result = [*(x + y for x, y in zip(turned[:3], point, strict=True)), *turned[3:]]
        return result if len(frame) == 7 else rotations.matrix_of_pose(result)

    def yawPitchRollToAlphaBetaGamma(self, yaw: float, pitch: float, roll: float) -> tuple[float, float, float]:
        """Return the Euler angles of yaw, pitch and roll: R = Rz(yaw) Ry(pitch) Rx(roll)."""
        alpha, beta, gamma = rotations.euler_angles(rotations.quaternion_of_rpy([roll, pitch, yaw]))
        return alpha, beta, gamma

    def alphaBetaGammaToYawPitchRoll(self, alpha: float, beta: float, gamma: float) -> tuple[float, float, float]:
        """Return yaw, pitch and roll of Euler angles."""
        x, y, z, w = rotations.quaternion_of_euler([alpha, beta, gamma])
        # R = Rz(yaw) Ry(pitch) Rx(roll): the Euler angles of its inverse are -roll, -pitch and -yaw.
        roll, pitch, yaw = rotations.euler_angles([-x, -y, -z, w])
        return -yaw, -pitch, -roll

    def yprToAbg(self, yaw: float, pitch: float, roll: float) -> tuple[float, float, float]:
        """Return the Euler angles of yaw, pitch and roll (newer name of yawPitchRollToAlphaBetaGamma)."""
        return self.yawPitchRollToAlphaBetaGamma(yaw, pitch, roll)

    def abgToYpr(self, alpha: float, beta: float, gamma: float) -> tuple[float, float, float]:
        """Return yaw, pitch and roll of Euler angles (newer name of alphaBetaGammaToYawPitchRoll)."""
        return self.alphaBetaGammaToYawPitchRoll(alpha, beta, gamma)
