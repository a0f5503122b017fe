# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions about sensors in general, and random numbers; called by scripts that check the results themselves."""

from pathlib import Path

from node_support import run_script


def test_a_proximity_sensor_is_asked_for_one_object(tmp_path: Path) -> None:
    code = """\
        def sysCall_init():
            sonar = sim.getObject('/Sonar')
            result, distance, point, thing, normal = sim.checkProximitySensor(sonar, sim.handle_all)
            assert result == 1 and thing == sim.getObject('/Floor/link')
            assert sim.checkProximitySensor(sonar, sim.getObject('/Floor')) == (1, distance, point, thing, normal)
            assert sim.checkProximitySensor(sonar, sim.getObject('/Table')) == (0, 0.0, [0, 0, 0], -1, [0, 0, 0])
        """
    run = run_script(tmp_path, code, "--strict", scene="sensors", target="/Mast", until=0.1)
    assert (run.stderr, run.returncode) == ("", 0)


def test_types_of_sensors_are_distinguished(tmp_path: Path) -> None:
    code = """\
        def sysCall_init():
            kinds = {'/Sonar': sim.object_proximitysensor_type, '/Camera': sim.object_visionsensor_type,
                     '/DepthCamera': sim.object_visionsensor_type, '/Lidar': sim.object_dummy_type,
                     '/Imu': sim.object_dummy_type, '/Ball': sim.object_shape_type}
            for path, kind in kinds.items():
                assert sim.getObjectType(sim.getObject(path)) == kind, path
        """
    run = run_script(tmp_path, code, "--strict", scene="sensors", target="/Mast", until=0.1)
    assert (run.stderr, run.returncode) == ("", 0)


def test_a_reading_has_the_time_of_the_state_that_it_shows(tmp_path: Path) -> None:
    code = """\
        def sysCall_init():
            self.times = []

        def sysCall_sensing():
            measured, start = sim.getReadingTime(sim.getObject('/Lidar')), sim.getSimulationTime()
            self.times.append(round(measured, 6))  # 10 Hz in steps of 50 ms
            assert (measured > start) == (len(self.times) % 2 == 0), 'a reading of this step shows its end'

        def sysCall_cleanup():
            print(self.times)
        """
    run = run_script(tmp_path, code, "--strict", scene="sensors", target="/Mast", until=0.4)
    assert (run.stderr, run.stdout) == ("", "[0.0, 0.1, 0.1, 0.2, 0.2, 0.3, 0.3, 0.4]\n")


def test_altimeters_and_magnetometers_are_read(tmp_path: Path) -> None:
    code = """\
        def sysCall_init():
            height, velocity = sim.readAltimeter(sim.getObject('/Altimeter'))
            assert (height, velocity) == (0.0, 0.0)
            field = sim.readMagnetometer(sim.getObject('/Magnetometer'))
            assert [round(part * 1e7) for part in field] == [56, 229, -424]  # the default field; the sensor faces x
        """
    run = run_script(tmp_path, code, "--strict", scene="sensors", target="/Mast", until=0.1)
    assert (run.stderr, run.returncode) == ("", 0)


def test_random_numbers_follow_from_the_seed(tmp_path: Path) -> None:
    code = """\
        def sysCall_init():
            first = [sim.getRandom() for _ in range(1000)]
            assert all(0 <= number < 1 for number in first) and 0.45 < sum(first) / 1000 < 0.55
            assert sim.getRandom(7) == sim.getRandom(7) != sim.getRandom()
            print(first[0])
        """

    def first(seed: int) -> str:
        return run_script(tmp_path, code, "--strict", "--seed", seed, until=0.1).stdout

    assert first(1) == first(1) != first(2)


def test_a_proximity_sensor_is_asked_with_a_threshold_or_for_points(tmp_path: Path) -> None:
    code = """\
        def sysCall_init():
            sonar, floor = sim.getObject('/Sonar'), sim.getObject('/Floor')
            result, distance, point, thing, normal = sim.checkProximitySensor(sonar, floor)
            assert sim.checkProximitySensorEx(sonar, floor) == (result, distance, point, thing, normal)
            assert sim.checkProximitySensorEx(sonar, floor, 0, distance + 0.01)[0] == 0
            pose = sim.getObjectPose(sonar)
            axis = sim.multiplyVector(pose, [1, 0, 0])
            near = [a + 0.5 * (b - a) for a, b in zip(pose, axis)]
            found, away, *_ = sim.checkProximitySensorEx2(sonar, near, 0, 1)
            assert found == 1 and abs(away - 0.5) < 1e-6
            behind = [a - 0.5 * (b - a) for a, b in zip(pose, axis)]
            assert sim.checkProximitySensorEx2(sonar, behind, 0, 1)[0] == 0
        """
    run = run_script(tmp_path, code, "--strict", scene="sensors", target="/Mast", until=0.1)
    assert (run.stderr, run.returncode) == ("", 0)


def test_a_gps_has_the_place_of_the_scene_and_its_velocity(tmp_path: Path) -> None:
    code = """\
        def sysCall_sensing():
            place, velocity = sim.readNavSat(sim.getObject('/Gps'))
            assert len(place) == len(velocity) == 3 and abs(place[0]) <= 90 and abs(velocity[2]) < 1

        def sysCall_init():
            pass
        """
    run = run_script(tmp_path, code, "--strict", scene="tricycle", target="/Tricycle", until=1.5)
    assert (run.stderr, run.returncode) == ("", 0)


def test_a_force_sensor_of_a_script_is_a_frame_that_does_not_break(tmp_path: Path) -> None:
    code = """\
        def sysCall_init():
            made = sim.createForceSensor(0, [0] * 5, [0.01] * 5)
            assert sim.isHandle(made)
            assert sim.readForceSensor(made)[0] == 0
            assert sim.breakForceSensor(made) == 1
        """
    run = run_script(tmp_path, code, scene="tricycle", target="/Tricycle", until=0.1)
    assert "measures nothing" in run.stderr
    assert run.returncode == 0
