// SPDX-License-Identifier: BSD-3-Clause
// A running scene: the world, its sensors, the clock, and the simulation step.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "bubblesim/error.hpp"
#include "bubblesim/prepared_scene.hpp"
#include "bubblesim/scene.hpp"
#include "bubblesim/sensor.hpp"
#include "bubblesim/wind.hpp"
#include "bubblesim/world.hpp"

namespace bubblesim {

class Randomization;

/// Extends the simulation step, such as child scripts and the ROS bridge. The phases are called in the order below.
/// `time` is state_time(), s: the time of the state of `world`.
class System {
 public:
  virtual ~System() = default;
  /// Processes pending input. Also called while the simulation is paused.
  virtual void process_input() {}
  /// Commands the world, before the physics: at the start of the step.
  virtual void actuate(World& world, double time);
  /// Reads the world, after physics and sensors: at the end of the step.
  virtual void sense(const World& world, double time);
  /// Publishes results.
  virtual void publish(const World& world, double time);
  /// Called after the last step of a stopped simulation, before the reset of world and time.
  virtual void stop() {}
  /// Called when a stopped simulation starts again.
  virtual void start() {}
  /// Called after world and sensors were reset.
  virtual void reset() {}
  /// Called after a model was added: between steps, or while another system runs process_input().
  virtual void model_added(World& world, ObjectId model);
  /// Called before a model is removed.
  virtual void model_removing(World& world, ObjectId model);
  /// Its name in saved states; empty: it has no state of its own there.
  virtual std::string state_name() const;
  /// Returns what determines its future, empty for nothing, and takes it back.
  virtual std::string save_state();
  virtual void restore_state(std::string_view state);
};

/// A thread that uses a simulation while another thread steps it must hold world().access(). step() holds it except
/// during process_input(). The functions that change what is simulated take it themselves; the others do not.
class Simulation {
 public:
  explicit Simulation(std::shared_ptr<const Scene> scene, std::uint64_t seed = 0);
  /// Throws SceneError when the description cannot be simulated.
  explicit Simulation(SceneDescription scene, std::uint64_t seed = 0);
  ~Simulation();

  /// Systems are not owned. They are called in the order in which they were added.
  void add(System& system);

  /// Whether a divergence writes the last states to a file; true at first.
  void set_writes_last_states(bool writes) { writes_last_states_ = writes; }
  /// Runs one step of time_step() seconds. On divergence, the last states are written to a file and the scene's
  /// on_divergence is applied; kPause throws Diverged. Models that fell below the scene are removed. Threads that step
  /// take turns. Throws std::logic_error when a system calls it.
  void step();
  /// Runs the part of a step that also runs while paused.
  void process_input();

  /// The following functions change what is simulated. Call them between steps, or in a system's process_input(), where
  /// they take effect at once. They wait for a step that another thread runs. They throw std::logic_error in the other
  /// phases of a step, and in another thread while Python systems are in a step. Run state and requests are not
  /// changed. Models can also be added and removed in a system's actuate(), by the stepping thread or its StandIn.

  /// Throws what they throw at the wrong time. For a thread that holds world().access().
  void check_may_change() const;
  /// Resets the models that are there now, and the sensors, to the start; time goes on.
  void reset_world();
  /// Like reset_world(), and sets time to 0: from here on the simulation equals a new one of these models, bit by bit.
  /// Both put back mass, friction, gravity, motor gains, noise and brightness too. What the scene randomizes is drawn
  /// again, by the seed.
  void reset();
  /// Like reset() with another seed; and models that were removed are back, models that were added are gone. For
  /// simulations without systems.
  void reset_to_scene(std::uint64_t seed);
  /// Whether the models are those of the scene: none was added or removed.
  bool has_scene_models() const { return world_.has_scene_models(); }
  /// Sets the seed of what is random from now on. What the scene randomizes is drawn in the next reset.
  void set_seed(std::uint64_t seed);
  /// During its lifetime this thread may add and remove models in actuate() like the stepping thread, which waits for
  /// it: the thread of a script, in its turn.
  class StandIn {
   public:
    explicit StandIn(Simulation& simulation) : simulation_(simulation) {
      simulation_.stand_in_ = std::this_thread::get_id();
    }
    ~StandIn() { simulation_.stand_in_ = std::thread::id(); }
    StandIn(const StandIn&) = delete;
    StandIn& operator=(const StandIn&) = delete;

   private:
    Simulation& simulation_;
  };
  /// Adds a model with its sensors, and calls model_added() of the systems. Throws like World::add_model; nothing is
  /// changed then. Adds warnings to `warnings`, unless it is null.
  ObjectId add_model(ModelDescription model, std::vector<Problem>* warnings = nullptr);
  /// Adds several models at once, whose parts may be below each other in the tree. Throws likewise.
  std::vector<ObjectId> add_models(std::vector<ModelDescription> models, std::vector<Problem>* warnings = nullptr);
  /// Calls model_removing() of the systems, and removes a model with its sensors. Throws like World::remove_model.
  void remove_model(ObjectId model);

  /// The state as bytes, which a file may keep: from restore() on, the simulation, or another one of the same scene in
  /// any process, continues bit by bit as this one did after save(). With sensors' readings and schedules, devices,
  /// random numbers, the seed and the states of systems; without child scripts. Throws Diverged after a divergence.
  std::string save();
  /// Likewise, into a string that may be used again.
  void save(std::string& bytes);
  /// Restores a saved state. Models that were added since are removed. Throws InvalidInput, and changes nothing, when
  /// the bytes are no state of this version and scene or are damaged, and when models, devices or systems are missing
  /// or are others. What a device or a system throws is thrown after the state was put back, as far as no model was
  /// removed; then the simulation must be reset.
  void restore(std::string_view state);

  /// Simulation time in s: the start of the current step, constant during a step, 0 in the first one. Between steps it
  /// equals state_time().
  double time() const { return after_physics_ ? step_start_ : state_time(); }
  /// Time in s of the state that the world shows: time(), and after the physics of a step the end of the step. Readings
  /// and messages are stamped with it (docs/time.md).
  double state_time() const { return time_before_ + static_cast<double>(steps_ - steps_before_) * time_step_; }
  double time_step() const { return time_step_; }
  /// Sets the time step in s, from 1e-4 to 10, from the current step on until reset(). Physics substeps keep their
  /// length or become shorter. Throws InvalidInput for other values.
  void set_time_step(double seconds);
  /// The scene as it was loaded.
  const SceneDescription& scene() const { return scene_->description(); }
  /// The same with its prepared parts, for other simulations of it.
  const std::shared_ptr<const Scene>& shared_scene() const { return scene_; }
  std::uint64_t seed() const { return seed_; }

  /// Call stop() and start() of the systems; for a Runner.
  void stop_systems();
  void start_systems();

  /// The wind; for devices such as propellers, wings and drag.
  const std::shared_ptr<Wind>& wind() const { return wind_; }

  World& world() { return world_; }
  const World& world() const { return world_; }

  /// The last due measurement of the sensor. A sensor with a rate is due at multiples of its period, counted from time
  /// 0 or from when it was added; without a rate after the physics of each step. A sensor without recent readers
  /// measures on this call. Throws WrongObject when the object is not a sensor.
  std::shared_ptr<const Reading> read(ObjectId sensor);
  /// The state_time() of the sensor's last measurement; for a sensor without readers, of when it was last due. Equal to
  /// state_time() when there is a reading of the current state. Does not measure. Throws WrongObject when the object is
  /// not a sensor.
  double reading_time(ObjectId sensor);
  /// Measures now, regardless of the sensor's rate.
  std::shared_ptr<const Reading> measure(ObjectId sensor);
  /// Replaces the image of a camera: three bytes per pixel, the top row first. The camera stops measuring until the
  /// world or the simulation is reset. Throws WrongObject when the object is not a camera, InvalidInput when the size
  /// is wrong.
  void override_image(ObjectId camera, const std::vector<std::uint8_t>& rgb);
  /// Factor of the standard deviations of a sensor's noise and of its bias, 1 at first and after a reset. Throws
  /// WrongObject when the object is not a sensor, InvalidInput for numbers below 0.
  void set_noise_scale(ObjectId sensor, double scale);
  double noise_scale(ObjectId sensor);
  /// Factor of all lights and of the ambient light that cameras see, 1 at first and after a reset. Throws InvalidInput
  /// for numbers below 0.
  void set_brightness(double brightness);
  double brightness() const { return brightness_; }
  /// Gives all visuals of a link, or of a model with its nested models, one colour in place of their own, which cameras
  /// see from their next measurement on. It stays when the world is reset. Throws WrongObject for other objects,
  /// InvalidInput unless the parts are from 0 to 1.
  void set_color(ObjectId object, const Color& color);
  /// The colour that was set, or the diffuse colour of the first visual.
  Color color(ObjectId object) const;
  /// Number of measurements of all sensors so far.
  std::uint64_t measurements() const { return measurements_; }
  /// SensorDefinition::name. Does not measure.
  std::string_view sensor_kind(ObjectId sensor);
  /// Like read() and measure() for proximity sensors. Throw WrongObject for other sensors.
  ProximityReading read_proximity(ObjectId sensor);
  ProximityReading measure_proximity(ObjectId sensor);

  /// Hash of the number of steps, the seed and World::state_hash(). Equal histories give equal hashes in every process.
  /// Not covered: variables of child scripts and plugins. The noise of sensors depends on the time and the seed alone.
  std::uint64_t state_hash() const;

 private:
  struct SensorSlot;
  void advance_physics(double substep);
  void handle(const Diverged& divergence);
  void remove_model_now(ObjectId model);
  void check_may_change_models() const;
  void make_sensors(ObjectId model);
  void make_devices(ObjectId model);
  void reset_sensors();
  void restart_sensors();
  void index_sensors();
  SensorSlot& slot(ObjectId sensor, const char* wanted = "sensor");
  MeasurementContext context_of(const SensorSlot& slot);
  void update(SensorSlot& slot);
  void require_proximity(ObjectId sensor);
  void update_sensors();
  struct Backup;
  void transfer(StateArchive& archive);
  std::map<std::string, std::string> system_states();
  System& system_named(const std::string& name);
  void restore_systems(const std::map<std::string, std::string>& states);
  void check_models(const std::vector<ObjectId>& saved) const;
  void remove_models_except(const std::vector<ObjectId>& saved);
  Backup make_backup();
  void put_back(const Backup& backup);
  void randomize();

  std::shared_ptr<const Scene> scene_;
  std::uint64_t seed_;
  World world_;
  std::shared_ptr<Wind> wind_;
  std::unique_ptr<const Randomization> randomization_;  // of the scene; null when nothing is random
  std::unique_ptr<RayScene> rays_;
  std::vector<SensorSlot> sensors_;
  std::vector<std::size_t> slot_at_;  // index into sensors_ by SceneTree::index_of(); out of range: not a sensor
  std::uint64_t measurements_ = 0;
  double brightness_ = 1;
  std::vector<System*> systems_;
  bool writes_last_states_ = true;
  std::uint64_t steps_ = 0;     // whose physics have run
  double time_step_;            // s
  bool after_physics_ = false;  // of the current step
  double step_start_ = 0;       // s, of the current step
  // Before the time step was last changed:
  std::uint64_t steps_before_ = 0;
  double time_before_ = 0;  // s
  AccessLock stepping_;     // held by step()
  bool in_step_ = false;    // after its process_input(); guarded by world_.access()
  bool actuates_ = false;   // within it: the systems command the world
  std::thread::id stand_in_;
};

}  // namespace bubblesim
