// SPDX-License-Identifier: BSD-3-Clause
// A scene that runs: the world, its sensors, the clock, and the step that moves them on.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string_view>
#include <vector>

#include "bubblesim/error.hpp"
#include "bubblesim/scene.hpp"
#include "bubblesim/sensor.hpp"
#include "bubblesim/world.hpp"

namespace bubblesim {

/// Takes part in each step: child scripts, the ROS bridge. Its phases are called in the order in which they stand here.
class System {
 public:
  virtual ~System() = default;
  /// Takes in what came from outside; also called while the simulation is paused.
  virtual void process_input() {}
  /// Commands the world before the physics run.
  virtual void actuate(World& world, double time);
  /// Looks at the world after physics and sensors.
  virtual void sense(const World& world, double time);
  /// Tells the outside.
  virtual void publish(const World& world, double time);
  /// The simulation stops after its last step; then world and time go back to the start.
  virtual void stop() {}
  /// It starts again.
  virtual void start() {}
  /// World and sensors were put back to the start.
  virtual void reset() {}
  /// A model has come into the world; between steps, or while others process_input.
  virtual void model_added(World& world, ObjectId model);
  /// A model is about to leave the world; it is still there.
  virtual void model_removing(World& world, ObjectId model);
};

enum class RunState { kStopped, kPaused, kRunning, kStopping };  // stopping: in the last step of all

/// Who uses a simulation that another thread steps holds world().access() meanwhile. step() has it but for
/// process_input(), and the functions that change what is simulated take it by themselves; others do not.
class Simulation {
 public:
  explicit Simulation(SceneDescription scene, std::uint64_t seed = 0);
  ~Simulation();

  /// Systems are not owned and act in the order in which they were added.
  void add(System& system);

  /// One step of time_step() seconds. When the physics diverge, the last states are written to a file, and the scene's
  /// on_divergence says what comes of it; to pause throws Diverged. Models that fell off the world are removed. Threads
  /// that step take turns. Throws std::logic_error in a system.
  void step();
  /// The part of a step that goes on while paused.
  void process_input();

  /// These change what is simulated: between steps, or in a system's process_input(), where they take effect at once.
  /// They wait for a step that another thread runs. They throw std::logic_error in the other phases of a step, and in
  /// another thread while systems in Python have the step. The state and the requests stay as they are.

  /// Puts the models that are there now, and what the sensors remember, back to the start; time goes on.
  void reset_world();
  /// The same, and time starts at 0 again: what follows equals a new simulation of these models, bit by bit.
  void reset();
  /// Adds a model with its sensors, and tells the systems. Throws as World::add_model does; then nothing changed.
  ObjectId add_model(ModelDescription model);
  /// Removes a model with its sensors, after the systems were told. Throws as World::remove_model does.
  void remove_model(ObjectId model);

  /// Seconds of simulation time; 0 in the first step, constant through a step.
  double time() const { return time_before_ + static_cast<double>(steps_ - steps_before_) * scene_.time_step; }
  double time_step() const { return scene_.time_step; }
  /// Seconds that steps take from now on, the one that is being run included, until reset(). Physics substeps stay as
  /// long as they are or become shorter. InvalidInput unless it is from 1e-4 to 10.
  void set_time_step(double seconds);
  /// As it was loaded.
  const SceneDescription& scene() const { return scene_; }
  std::uint64_t seed() const { return seed_; }

  /// Requests to whoever runs the steps, who carries them out in their order by carry_out_requests(); step() does not
  /// look at them. Any thread may make them. What does not fit the state then does nothing: to pause what is stopped.
  void start();  ///< from the start of the scene; after a pause, where it was
  void pause();
  void stop();  ///< one more step, then world and time go back to the start
  void end() { ending_ = true; }
  /// In synchronous mode steps wait to be triggered, each by one trigger; those that came too early are not lost, but
  /// for a stop. step() does not wait for them. Any thread.
  void set_synchronous(bool synchronous);
  void trigger_step();
  /// From now on a stop is an end: after its last step the world stays as it is.
  void end_at_stop() { ends_at_stop_ = true; }
  bool ends_at_a_stop() const { return ends_at_stop_; }

  /// Between steps. Throws what step() throws.
  void carry_out_requests();
  bool has_requests() const;
  /// Whether a stop was asked for and is not done yet. Any thread.
  bool stop_is_due() const;
  /// Whether whoever runs the steps should run one.
  bool step_is_due() const;
  /// step(), by which a trigger is used up.
  void run_step();
  /// Running to begin with.
  RunState state() const { return state_; }
  /// Whether no more steps are wanted of whoever runs them.
  bool ending() const { return ending_; }

  World& world() { return world_; }
  const World& world() const { return world_; }

  /// What the sensor measured in its last due step. A sensor that nobody read for a while measures when it is asked.
  /// Throws WrongObject when the object is not a sensor.
  std::shared_ptr<const Reading> read(ObjectId sensor);
  /// Seconds of simulation time at which the sensor was last due, or measured for measure(): another one means another
  /// reading. It measures nothing. Throws WrongObject when the object is not a sensor.
  double reading_time(ObjectId sensor);
  /// Measures now, whatever the sensor's rate.
  std::shared_ptr<const Reading> measure(ObjectId sensor);
  /// Makes a camera show a picture: three bytes a pixel, the uppermost row first. It measures no more then, until the
  /// world or the simulation is reset. Throws WrongObject when it is not a camera, InvalidInput when sizes differ.
  void override_image(ObjectId camera, const std::vector<std::uint8_t>& rgb);
  /// How many times sensors have measured so far.
  std::uint64_t measurements() const { return measurements_; }
  /// See kind_name(); it measures nothing.
  std::string_view sensor_kind(ObjectId sensor);
  /// The same for sensors of one kind; WrongObject for sensors of other kinds.
  ProximityReading read_proximity(ObjectId sensor);
  ProximityReading measure_proximity(ObjectId sensor);

  /// Hash of the number of steps, the seed and World::state_hash(). Equal histories give equal hashes in every process.
  /// It leaves out what child scripts and plugins keep in their own variables. Noise of sensors depends on the time and
  /// the seed alone.
  std::uint64_t state_hash() const;

 private:
  struct SensorSlot;
  enum class Request { kStart, kPause, kStop };

  void request(Request wanted);
  void carry_out(Request wanted);
  void forget_triggers();

  void advance_physics(double substep);
  void handle(const Diverged& divergence);
  void remove_model_now(ObjectId model);
  void check_may_change() const;
  void make_sensors(ObjectId model);
  void make_all_sensors();
  SensorSlot& slot(ObjectId sensor, const char* wanted = "sensor");
  void update(SensorSlot& slot);
  void require_proximity(ObjectId sensor);
  void update_sensors();

  SceneDescription scene_;
  std::uint64_t seed_;
  World world_;
  std::unique_ptr<RayScene> rays_;
  std::vector<SensorSlot> sensors_;
  std::uint64_t measurements_ = 0;
  std::vector<System*> systems_;
  std::uint64_t steps_ = 0;
  double first_time_step_;  // s, of the scene
  // Before the time step was last changed:
  std::uint64_t steps_before_ = 0;
  double time_before_ = 0;  // s
  AccessLock stepping_;     // held by step()
  bool in_step_ = false;    // after its process_input(); guarded by world_.access()
  std::atomic<RunState> state_{RunState::kRunning};
  std::atomic<bool> ending_{false};
  bool ends_at_stop_ = false;
  mutable std::mutex requests_mutex_;  // guards what follows
  std::vector<Request> requests_;
  bool synchronous_ = false;
  std::uint64_t triggers_ = 0;  // not used up yet
};

}  // namespace bubblesim
