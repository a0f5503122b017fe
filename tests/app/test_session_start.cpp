// SPDX-License-Identifier: BSD-3-Clause
// A session whose start fails at each of its steps in turn leaves nothing attached to the node. As in SQLite's tests of
// malloc(), the n-th step fails, for n = 1, 2, 3, ..., until the start has fewer steps. The steps are the allocations
// of our own C++ code.
#include <gtest/gtest.h>
#include <link.h>
#include <pybind11/embed.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <new>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "bridges.hpp"
#include "bubblesim/scene_loader.hpp"
#include "session.hpp"

namespace {

namespace py = pybind11;

/// Allocations of our own code on this thread, until one fails. Others' code may end the process when one of its
/// allocations fails, also pybind11's, which is a part of the module _core.
struct FailingAllocations {
  bool counts = false;
  int left = 0;

  bool fails_for(const void* caller) {
    if (!counts || !is_ours(caller) || --left > 0) return false;
    counts = false;
    return true;
  }

  /// The addresses of this program and of libbubblesim*.so.
  static void find_our_code() {
    const auto add = [](dl_phdr_info* object, std::size_t, void*) {
      const std::string name = std::filesystem::path(object->dlpi_name).filename();
      if (!name.empty() && name.find("libbubblesim") == std::string::npos) return 0;
      for (int i = 0; i < object->dlpi_phnum; ++i) {
        const ElfW(Phdr)& part = object->dlpi_phdr[i];
        if (part.p_type != PT_LOAD || (part.p_flags & PF_X) == 0) continue;
        const std::uintptr_t begin = object->dlpi_addr + part.p_vaddr;
        our_code.emplace_back(begin, begin + part.p_memsz);
      }
      return 0;
    };
    our_code.clear();
    dl_iterate_phdr(add, nullptr);
  }

 private:
  static bool is_ours(const void* address) {
    const auto at = reinterpret_cast<std::uintptr_t>(address);
    return std::any_of(our_code.begin(), our_code.end(),
                       [at](const auto& part) { return part.first <= at && at < part.second; });
  }

  static std::vector<std::pair<std::uintptr_t, std::uintptr_t>> our_code;
};

std::vector<std::pair<std::uintptr_t, std::uintptr_t>> FailingAllocations::our_code;
thread_local FailingAllocations allocations;

}  // namespace

void* operator new(std::size_t size) {
  if (allocations.fails_for(__builtin_return_address(0))) throw std::bad_alloc();
  if (void* memory = std::malloc(size != 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return std::malloc(size != 0 ? size : 1); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace bubblesim::app {
namespace {

/// What a session must not leave: threads, descriptors, objects of Python.
struct Attached {
  int threads = 0;
  std::multiset<std::string> descriptors;
  std::string objects;
  bool has_runner = false;

  bool operator==(const Attached& other) const {
    return threads == other.threads && descriptors == other.descriptors && objects == other.objects &&
           has_runner == other.has_runner;
  }
};

std::ostream& operator<<(std::ostream& out, const Attached& attached) {
  out << attached.threads << " threads, runner: " << attached.has_runner << ", objects: " << attached.objects;
  for (const std::string& descriptor : attached.descriptors) out << "\n  " << descriptor;
  return out;
}

/// The kinds of descriptors; numbers of sockets differ from session to session.
std::multiset<std::string> open_descriptors() {
  std::multiset<std::string> found;
  std::error_code ignored;
  for (const auto& each : std::filesystem::directory_iterator("/proc/self/fd")) {
    const std::string target = std::filesystem::read_symlink(each.path(), ignored);
    found.insert(target.substr(0, target.find('[')));
  }
  return found;
}

/// Instances of the classes that belong to a scene.
std::string python_objects() {
  const py::gil_scoped_acquire gil;
  py::dict names;
  py::exec(R"(
import gc
import sys

parts = {"ScriptHost", "ChildScript", "GazeboPlugins", "NodeServices", "Observers", "Watchdog", "Runner", "Simulation"}
sys.last_traceback = None
gc.collect()
left = sorted(type(each).__name__ for each in gc.get_objects() if type(each).__name__ in parts)
)",
           names);
  return py::str(names["left"]);
}

/// The node of all tests: Python and roscpp start once in a process.
struct OneNode {
  Options options;
  Node node{options};
};
OneNode* one_node = nullptr;

class SessionStart : public testing::Test {
 protected:
  SessionStart() {
    Options& options = one_node->options;
    options = {};
    options.ros = Ros::kNone;
    options.child_scripts = {{"/Ball", folder_ / "script.py"}};
    options.window_socket = folder_ / "api";
    std::ofstream(folder_ / "script.py") << R"(#python
def sysCall_init():
    self.ball = sim.getObject('.')
    if simROS:
        self.topic = simROS.advertise('/time', 'std_msgs/Float32')
        simROS.subscribe('/time', 'std_msgs/Float32', 'on_time')

def on_time(message):
    pass
)";
    node_.first_scene.clear();
  }
  ~SessionStart() override {
    node_.remote_api.reset();
    std::filesystem::remove_all(folder_);
  }

  /// The bridge waits for a master that is not there, as a node does that is started before its master.
  void use_ros() {
    Options& options = one_node->options;
    options.ros = Ros::kRos1;
    options.record = folder_ / "bag.bag";
    options.lockstep = {"/speed"};
    setenv("ROS_MASTER_URI", "http://localhost:1", 1);
    int argc = 1;
    std::string name = "test_session";
    std::vector<char*> argv{name.data(), nullptr};
    if (node_.bridges.empty()) node_.bridges = make_bridges(node_, argc, argv.data());
  }

  /// Loads all modules and starts the threads that stay.
  void start_once() {
    if (ends_remote_api_) node_.remote_api.reset();
    Session(node_, std::make_unique<Simulation>(scene_, 0), true);
    if (ends_remote_api_) node_.remote_api.reset();
    const py::gil_scoped_acquire gil;
    const py::module_ gc = py::module_::import("gc");
    gc.attr("collect")();
    gc.attr("freeze")();                                                     // so that looking for objects is fast
    py::module_::import("bubblesim.remote.control_lane").attr("_LOOK") = 1;  // ms; so is closing the server
    FailingAllocations::find_our_code();
  }

  /// Starts sessions until none of the steps fails.
  void fail_at_each_step() {
    start_once();
    const Attached before = attached_at_rest();
    int step = 0;
    bool failed = true;
    while (failed) {
      std::string error;
      try {
        auto simulation = std::make_unique<Simulation>(scene_, 0);
        allocations = {true, ++step};
        const Session session(node_, std::move(simulation), true);
        failed = !std::exchange(allocations.counts, false);
      } catch (const std::exception& caught) {
        allocations.counts = false;
        error = caught.what();
      }
      if (ends_remote_api_) node_.remote_api.reset();
      const auto is_as_before = [&before](const Attached& now) { return now == before; };
      ASSERT_EQ(attached_after(is_as_before), before) << "after step " << step << ": " << error;
      ASSERT_LT(step, 100'000);
    }
    EXPECT_GT(step, 20);
    RecordProperty("steps", step);
  }

  Node& node_ = one_node->node;
  std::filesystem::path folder_ = make_folder();
  std::shared_ptr<const Scene> scene_ = load_scene("ball", {});
  bool ends_remote_api_ = true;  // so that each session makes one

 private:
  static std::filesystem::path make_folder() {
    std::string name = "/tmp/test_session-XXXXXX";
    return mkdtemp(name.data());
  }

  Attached attached() {
    Attached all;
    for (const auto& each : std::filesystem::directory_iterator("/proc/self/task"))
      all.threads += each.exists() ? 1 : 0;
    all.descriptors = open_descriptors();
    all.objects = python_objects();
    all.has_runner = node_.runner.with([](Runner&) { return true; }, false);
    return all;
  }

  /// What is attached when it has not changed for a while.
  Attached attached_at_rest() {
    Attached before;
    return attached_after([&before, equal = 0](const Attached& now) mutable {
      equal = now == before ? equal + 1 : 0;
      before = now;
      return equal > 50;
    });
  }

  /// What is attached when `is_settled` holds, or in 30 s: threads of ZeroMQ and ROS end later than their last use.
  template <class Condition>
  Attached attached_after(Condition is_settled) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    Attached now = attached();
    while (!is_settled(now) && std::chrono::steady_clock::now() < end) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      now = attached();
    }
    return now;
  }
};

TEST_F(SessionStart, LeavesNothingWhenAnAllocationFails) { fail_at_each_step(); }

TEST_F(SessionStart, LeavesNothingInANodeWithRosWhenAnAllocationFails) {
  use_ros();
  fail_at_each_step();
}

}  // namespace
}  // namespace bubblesim::app

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  bubblesim::app::one_node = new bubblesim::app::OneNode;
  const int failed = RUN_ALL_TESTS();
  delete bubblesim::app::one_node;
  std::fflush(nullptr);
  std::quick_exit(failed);  // as the node ends
}
