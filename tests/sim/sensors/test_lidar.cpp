// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "bubblesim/error.hpp"
#include "bubblesim/simulation.hpp"
#include "scenes.hpp"
#include "surfaces.hpp"

namespace bubblesim::test::test_lidar {
namespace {

constexpr double kExact = 1e-4;  // m

/// A lidar at `pose` among `others`.
SceneDescription with_lidar(const LidarDescription& lidar, std::vector<ModelDescription> others,
                            const Pose& pose = {}) {
  return with_sensor("Lidar", lidar, std::move(others), pose);
}

/// Its measurement; holds the reading.
class Scan {
 public:
  explicit Scan(const SceneDescription& scene, std::uint64_t seed = 0) {
    Simulation simulation(scene, seed);
    reading_ = simulation.read(simulation.world().tree().find("/Lidar"));
  }
  const LidarScan* operator->() const { return &reading_->measurement.get<LidarScan>(); }

 private:
  std::shared_ptr<const Reading> reading_;
};

LidarDescription turn_of(int samples) {
  LidarDescription lidar;
  lidar.horizontal = {samples, -M_PI, M_PI};
  lidar.min_range = 0.1;
  lidar.max_range = 30;
  return lidar;
}

ModelDescription wall(const std::string& name, const Vector3& size, const Pose& pose) {
  return still(model(name, link_with(Box{size}), pose));
}

/// Its face is at x = 3.
ModelDescription wall_ahead() { return wall("Wall", {1, 1, 1}, at(3.5, 0, 1)); }

/// Four walls whose inner faces lie at x = 4, x = -3, y = 2, y = -1.
std::vector<ModelDescription> room() {
  return {wall("Front", {1, 20, 9}, at(4.5, 0, 0)), wall("Back", {1, 20, 9}, at(-3.5, 0, 0)),
          wall("Left", {20, 1, 9}, at(0, 2.5, 0)), wall("Right", {20, 1, 9}, at(0, -1.5, 0))};
}

double distance_in_room(double angle) {
  const double x = std::cos(angle);
  const double y = std::sin(angle);
  return std::min((x > 0 ? 4 : 3) / std::abs(x), (y > 0 ? 2 : 1) / std::abs(y));
}

TEST(Lidar, MeasuresARoomAtItsAngles) {
  const Scan scan(with_lidar(turn_of(361), room()));
  ASSERT_EQ(scan->ranges.size(), 361U);
  for (int i = 0; i <= 360; ++i) {
    EXPECT_NEAR(scan->ranges[i], distance_in_room(-M_PI + i * M_PI / 180), kExact) << i;
  }
}

TEST(Lidar, TurnsWithItsRobot) {
  const Scan scan(with_lidar(turn_of(361), room(), Pose(0, 0, 0, 0, 0, M_PI / 2)));
  EXPECT_NEAR(scan->ranges[180], 2, kExact) << "ahead is the left wall";
  EXPECT_NEAR(scan->ranges[90], 4, kExact) << "to the right is the front wall";
}

TEST(Lidar, MeasuresFromItsLeastToItsGreatestRange) {
  LidarDescription lidar = turn_of(3);
  lidar.horizontal = {3, -M_PI / 2, M_PI / 2};
  const Scan scan(with_lidar(lidar, {wall("Ahead", {1, 1, 1}, at(0.55, 0, 0)), wall("Far", {1, 1, 1}, at(0, 30.6, 0)),
                                     wall("Right", {1, 1, 1}, at(0, -1.5, 0))}));
  EXPECT_NEAR(scan->ranges[0], 1, kExact);
  EXPECT_EQ(scan->ranges[1], INFINITY) << "nearer than the minimum range, where the ray begins";
  EXPECT_EQ(scan->ranges[2], INFINITY) << "beyond the maximum range (REP 117)";
}

TEST(Lidar, SeesPastWhatIsNearerThanItsMinimalRange) {
  SceneDescription described = with_lidar(turn_of(361), room());
  VisualDescription housing;  // its outside faces the lidar
  housing.geometry = Box{{0.02, 1, 1}};
  housing.pose = at(0.06, 0, 0);
  described.models.back().links[0].visuals.push_back(housing);
  EXPECT_NEAR(Scan(described)->ranges[180], 4, kExact) << "the housing, at 0.05 m, is nearer than 0.1 m";
  described.models.back().links[0].visuals[0].pose = at(0.2, 0, 0);
  EXPECT_NEAR(Scan(described)->ranges[180], 0.19, kExact);
}

TEST(Lidar, HasItsRingsFromTheLowestUp) {
  LidarDescription lidar = turn_of(16);
  lidar.vertical = {3, -0.3, 0.3};
  const Scan scan(with_lidar(lidar, {floor()}, at(0, 0, 1)));
  ASSERT_EQ(scan->ranges.size(), 48U);
  for (int i = 0; i < 16; ++i) {
    EXPECT_NEAR(scan->ranges[i], 1 / std::sin(0.3), kExact);
    EXPECT_EQ(scan->ranges[16 + i], INFINITY);
    EXPECT_EQ(scan->ranges[32 + i], INFINITY);
  }
}

TEST(Lidar, OfOneRayLooksAlongItsFirstAngle) {
  LidarDescription lidar = turn_of(1);
  lidar.horizontal = {1, M_PI / 2, M_PI / 2};
  EXPECT_NEAR(Scan(with_lidar(lidar, room()))->ranges.at(0), 2, kExact);
}

TEST(Lidar, LooksOutOfItsOwnHousing) {
  SceneDescription described = with_lidar(turn_of(361), room());
  described.models.back().links[0].collisions.push_back(shape(Cylinder{0.2, 0.3}));
  EXPECT_NEAR(Scan(described)->ranges[180], 4, kExact);
}

TEST(Lidar, LooksOutOfHousingsOfAnyShape) {
  for (const Geometry& geometry : {Geometry(Box{{0.4, 0.5, 0.3}}), Geometry(box_mesh({0.4, 0.5, 0.3})),
                                   Geometry(Capsule{0.3, 0.2}), Geometry(Ellipsoid{{0.3, 0.4, 0.2}})}) {
    for (const bool moves : {false, true}) {
      SceneDescription described = with_lidar(turn_of(361), room());
      ModelDescription& eye = described.models.back();
      eye.is_static = !moves;
      eye.links[0].collisions.push_back(shape(geometry));
      eye.links[0].collisions.push_back(shape(Box{{0.1, 0.1, 0.1}}));  // it stands beside the lidar
      eye.links[0].collisions.back().pose = at(0, -0.6, 0);
      const Scan scan(described);
      for (int i = 0; i <= 360; ++i) {
        const double angle = -M_PI + i * M_PI / 180;
        if (std::abs(angle + M_PI / 2) < 0.2) continue;
        EXPECT_NEAR(scan->ranges[i], distance_in_room(angle), kExact) << geometry.index() << ", ray " << i;
      }
      EXPECT_NEAR(scan->ranges[90], 0.55, kExact) << geometry.index();
    }
  }
}

TEST(Lidar, SeesTheHousingOfAnotherLidar) {
  for (const bool moves : {false, true}) {
    ModelDescription other = model("Other", link_with(Box{{0.4, 0.5, 0.3}}), Pose(2, 0, 0, 0, 0, M_PI / 2));
    other.is_static = !moves;
    SensorDescription housed;
    housed.name = "Housed";
    housed.kind = turn_of(3);
    other.links[0].sensors.push_back(housed);
    Simulation simulation(with_lidar(turn_of(361), room()));
    const auto ahead = [&] {
      const auto reading = simulation.measure(simulation.world().tree().find("/Lidar"));
      return reading->measurement.get<LidarScan>().ranges[180];
    };
    for (int i = 0; i < 2; ++i) {
      EXPECT_NEAR(ahead(), 4, kExact);
      const ObjectId added = simulation.add_model(other);
      EXPECT_NEAR(ahead(), 1.75, kExact);
      const auto reading = simulation.measure(simulation.world().tree().find("/Housed"));
      EXPECT_NEAR(reading->measurement.get<LidarScan>().ranges[1], 2, kExact) << "the left wall";
      simulation.remove_model(added);
    }
  }
}

void expect_range(float found, float expected, const char* what) {
  if (std::isinf(expected)) {
    EXPECT_EQ(found, expected) << what;
  } else {
    EXPECT_NEAR(found, expected, kExact) << what;
  }
}

/// A lidar at a height of 1 m with a ray ahead and one that falls at 45 degrees, read twice at each place.
class StandingLidar {
 public:
  StandingLidar() : simulation_(with_lidar(two_rays(), {model("Ball", link_with(Sphere{0.5}), at(0, 9, 1))}, kPlace)) {
    expect(INFINITY, INFINITY, "nothing");
  }
  World& world() { return simulation_.world(); }
  Simulation& simulation() { return simulation_; }
  ObjectId find(const char* path) { return world().tree().find(path); }

  void expect(float down, float ahead, const char* what) {
    for (int scan = 0; scan < 2; ++scan) {
      simulation_.step();
      const std::vector<float> ranges = simulation_.measure(find("/Lidar"))->measurement.get<LidarScan>().ranges;
      expect_range(ranges[0], down, what);
      expect_range(ranges[1], ahead, what);
    }
  }

 private:
  static LidarDescription two_rays() {
    LidarDescription lidar;
    lidar.horizontal = {1, 0, 0};
    lidar.vertical = {2, -M_PI / 4, 0};
    lidar.min_range = 0.1;
    lidar.max_range = 30;
    return lidar;
  }

  static inline const Pose kPlace = at(0, 0, 1);
  Simulation simulation_;
};

TEST(LidarThatStands, SeesWhatMoves) {
  StandingLidar lidar;
  const ObjectId ball = lidar.find("/Ball");
  lidar.world().set_pose(ball, at(3, 0, 1));
  lidar.expect(INFINITY, 2.5F, "the ball came");
  lidar.world().set_pose(ball, at(5, 0, 1));
  lidar.expect(INFINITY, 4.5F, "the ball moved");
  lidar.world().set_pose(ball, at(0, 9, 1));
  lidar.expect(INFINITY, INFINITY, "the ball left");
  lidar.world().set_pose(ball, at(0.1, 0, 1));
  lidar.expect(INFINITY, INFINITY, "the ball is around the lidar, and seen from inside");
}

TEST(LidarThatStands, SeesWhatIsAddedMovedAndRemoved) {
  StandingLidar lidar;
  const ObjectId wall = lidar.simulation().add_model(wall_ahead());
  lidar.expect(INFINITY, 3, "a wall was added");
  const ObjectId ground = lidar.simulation().add_model(floor());
  lidar.expect(std::sqrt(2.0F), 3, "a floor was added");
  lidar.world().set_pose(lidar.find("/Wall"), at(2.5, 0, 1));
  lidar.expect(std::sqrt(2.0F), 2, "the wall was moved");
  lidar.simulation().remove_model(wall);
  lidar.expect(std::sqrt(2.0F), INFINITY, "the wall was removed");
  lidar.simulation().remove_model(ground);
  lidar.expect(INFINITY, INFINITY, "the floor was removed");
}

TEST(LidarThatStands, LooksFromWhereItIsMoved) {
  StandingLidar lidar;
  lidar.simulation().add_model(wall_ahead());
  lidar.expect(INFINITY, 3, "a wall was added");
  lidar.world().set_pose(lidar.find("/Eye"), at(1, 0, 1));
  lidar.expect(INFINITY, 2, "the lidar moved");
  lidar.world().set_pose(lidar.find("/Eye"), Pose(0, 0, 1, 0, 0, M_PI));
  lidar.expect(INFINITY, INFINITY, "the lidar turned");
  lidar.simulation().reset();
  lidar.expect(INFINITY, 3, "the world was reset");
}

TEST(Lidar, OfManyRaysMeasuresAsOneOfFew) {
  LidarDescription many = turn_of(20 * 360 + 1);
  const Scan scan(with_lidar(many, room()));
  const Scan few(with_lidar(turn_of(361), room()));
  for (int i = 0; i <= 360; ++i) EXPECT_NEAR(scan->ranges[20 * i], few->ranges[i], 1e-5) << i;
}

TEST(Lidar, MeasuresTheRetroOfWhatItHits) {
  ModelDescription mirror = still(model("Mirror", link("link")));
  VisualDescription visual;
  visual.geometry = Sphere{1};
  visual.pose = at(5, 0, 0);
  visual.laser_retro = 250;
  mirror.links[0].visuals.push_back(visual);
  const Scan scan(with_lidar(turn_of(361), {mirror}));
  EXPECT_EQ(scan->intensities[180], 250);
  EXPECT_EQ(scan->intensities[0], 0);
}

TEST(Lidar, RoundsToItsResolution) {
  LidarDescription lidar = turn_of(361);
  lidar.resolution = 0.25;
  const Scan scan(with_lidar(lidar, room()));
  for (int i = 0; i <= 360; ++i) {
    const double exact = distance_in_room(-M_PI + i * M_PI / 180);
    EXPECT_NEAR(scan->ranges[i], exact, 0.125 + kExact);
    EXPECT_EQ(std::fmod(scan->ranges[i], 0.25F), 0);
  }
}

LidarDescription noisy() {
  LidarDescription lidar = turn_of(2000);
  lidar.max_range = 1000;
  lidar.noise.stddev = 0.02;
  return lidar;
}

const SceneDescription& inside_a_well() {
  static const SceneDescription well = [] {
    std::vector<ModelDescription> walls;
    for (int i = 0; i < 4; ++i) {
      walls.push_back(wall("Wall" + std::to_string(i), {1, 40, 9}, Pose(10.5, 0, 0, 0, 0, 0)));
      walls.back().pose = Pose(0, 0, 0, 0, 0, i * M_PI / 2) * walls.back().pose;
    }
    return with_lidar(noisy(), walls);
  }();
  return well;
}

TEST(LidarNoise, HasTheMeanAndDeviationAsked) {
  SceneDescription quiet = inside_a_well();
  NoiseDescription& noise = quiet.models.back().links[0].sensors[0].kind.get<LidarDescription>().noise;
  noise = {};
  const Scan exact(quiet);
  noise = {0.05, 0.02, 0, 0, 0};
  const Scan measured(quiet);
  double sum = 0;
  double squares = 0;
  for (std::size_t i = 0; i < 2000; ++i) {
    const double error = measured->ranges[i] - exact->ranges[i];
    sum += error;
    squares += error * error;
  }
  const double mean = sum / 2000;
  // Five standard errors of a mean and of a deviation from 2000 samples.
  EXPECT_NEAR(mean, 0.05, 5 * 0.02 / std::sqrt(2000.0));
  EXPECT_NEAR(std::sqrt(squares / 2000 - mean * mean), 0.02, 5 * 0.02 / std::sqrt(4000.0));
}

TEST(LidarNoise, FollowsFromTheSeed) {
  EXPECT_EQ(Scan(inside_a_well(), 3)->ranges, Scan(inside_a_well(), 3)->ranges);
  EXPECT_NE(Scan(inside_a_well(), 3)->ranges, Scan(inside_a_well(), 4)->ranges);
}

TEST(LidarNoise, IsAnotherInEachPassWhetherOrNotSomebodyReadBefore) {
  Simulation read_often(inside_a_well());
  Simulation read_once(inside_a_well());
  const ObjectId lidar = read_once.world().tree().find("/Lidar");
  std::vector<std::vector<float>> scans;
  for (int i = 0; i < 3; ++i) {
    read_often.step();
    read_once.step();
    scans.push_back(read_often.measure(lidar)->measurement.get<LidarScan>().ranges);
  }
  EXPECT_NE(scans[0], scans[1]);
  EXPECT_NE(scans[1], scans[2]);
  EXPECT_EQ(read_once.measure(lidar)->measurement.get<LidarScan>().ranges, scans[2]);
}

TEST(LidarNoise, DrawsItsBiasOnce) {
  SceneDescription biased = inside_a_well();
  biased.models.back().links[0].sensors[0].kind.get<LidarDescription>().noise = {0, 0, 0.5, 0.1, 0};
  Simulation simulation(biased, 11);
  const ObjectId lidar = simulation.world().tree().find("/Lidar");
  const auto ahead = [&] { return simulation.measure(lidar)->measurement.get<LidarScan>().ranges[1000]; };
  const float first = ahead();
  EXPECT_GT(std::abs(first - 10), 0.01);
  for (int i = 0; i < 5; ++i) {
    simulation.step();
    EXPECT_EQ(ahead(), first);
  }
}

TEST(Reading, StaysAsItIsWhileSomebodyHoldsIt) {
  Simulation simulation(inside_a_well());
  const ObjectId lidar = simulation.world().tree().find("/Lidar");
  const std::shared_ptr<const Reading> held = simulation.measure(lidar);
  const std::vector<float> before = held->measurement.get<LidarScan>().ranges;
  simulation.step();
  const std::shared_ptr<const Reading> next = simulation.measure(lidar);
  EXPECT_EQ(held->measurement.get<LidarScan>().ranges, before);
  EXPECT_NE(next->measurement.get<LidarScan>().ranges, before);
  EXPECT_EQ(held->time, 0);
  EXPECT_DOUBLE_EQ(next->time, 0.05);
}

TEST(Reading, OfALidarIsNoProximity) {
  Simulation simulation(inside_a_well());
  EXPECT_THROW(simulation.read_proximity(simulation.world().tree().find("/Lidar")), WrongObject);
}

}  // namespace
}  // namespace bubblesim::test::test_lidar
