// SPDX-License-Identifier: BSD-3-Clause
#include "interpreter.hpp"

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace bubblesim::scripting {
namespace {

namespace fs = std::filesystem;
namespace py = pybind11;

/// The folder of the Python package, relative to the program <prefix>/lib/bubblesim/sim, in both development and
/// install spaces.
fs::path package_folder() {
  return fs::read_symlink("/proc/self/exe").parent_path().parent_path() / "python3" / "dist-packages";
}

/// Adds the packages of the active virtual environment, or of the one given at build time, after Debian's packages.
/// An environment of another Python version has no folder of this name and is ignored.
void add_packages_of_virtual_environment() {
  const char* active = std::getenv("VIRTUAL_ENV");
  const fs::path environment = active != nullptr && *active != '\0' ? active : BUBBLESIM_VIRTUAL_ENV;
  const py::object version = py::module_::import("sys").attr("version_info");
  const std::string folder = py::str("python{}.{}").format(version.attr("major"), version.attr("minor"));
  const fs::path packages = environment / "lib" / folder / "site-packages";
  if (!environment.empty() && fs::is_directory(packages)) {
    py::module_::import("site").attr("addsitedir")(packages.string());
  }
}

std::atomic<bool> can_interrupt{false};

/// Nobody sends this signal; interrupt() makes Python believe so. Not SIGINT, which the program handles itself: Python
/// would take it over, and give it its default action, the program's end, when the interpreter ends.
const int kInterruption = SIGRTMAX - 1;  // the last one is valgrind's

void install_interruption() {
  py::module_::import("bubblesim.scripting.host.interruption").attr("install")(kInterruption);
  can_interrupt = true;
}

void check(const PyStatus& status, const char* what) {
  if (PyStatus_Exception(status) == 0) return;
  throw std::runtime_error(std::string("cannot start Python: ") + what + ": " +
                           (status.err_msg != nullptr ? status.err_msg : "unknown error"));
}

void start() {
  PyConfig config;
  PyConfig_InitPythonConfig(&config);
  config.parse_argv = 0;
  config.install_signal_handlers = 0;  // the program handles SIGINT and SIGTERM itself
  config.user_site_directory = 0;      // Debian's modules are not made for the numpy of a `pip install --user`
  config.buffered_stdio = 0;           // shows the output of scripts at once and in order with ours
  // Python derives the folder of its library from its program's name.
  check(PyConfig_SetBytesString(&config, &config.program_name, BUBBLESIM_PYTHON), "its program name");
  const PyStatus status = Py_InitializeFromConfig(&config);
  PyConfig_Clear(&config);
  check(status, "its library");
}

}  // namespace

Interpreter::Interpreter() {
  start();
  try {
    py::module_::import("sys").attr("path").attr("insert")(0, package_folder().string());
    add_packages_of_virtual_environment();
    py::module_::import("bubblesim.scripting.host.host");
    install_interruption();
    // What was imported stays: a collection of garbage that leaves it out stops a step for 0.1 ms, not for 25 to 55.
    py::module_::import("gc").attr("freeze")();
  } catch (const py::error_already_set& error) {
    throw std::runtime_error(std::string("the Python package bubblesim cannot be imported: ") + error.what() +
                             "\nDid you source the workspace's setup.bash?");
  }
  released_ = std::make_unique<py::gil_scoped_release>();
}

Interpreter::~Interpreter() {
  can_interrupt = false;
  released_.reset();
  // Finalizing would wait forever for a script's thread that does not end.
  try {
    if (py::module_::import("bubblesim.scripting.threads.thread_registry").attr("ended")().cast<bool>()) {
      Py_FinalizeEx();
      return;
    }
  } catch (const py::error_already_set& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
  }
  // The threads stay blocked, without the GIL, until the process ends.
}

void interrupt() {
  if (can_interrupt) PyErr_SetInterruptEx(kInterruption);
}

}  // namespace bubblesim::scripting
