// SPDX-License-Identifier: BSD-3-Clause
#include "options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <iostream>
#include <limits>
#include <regex>

#include "bubblesim/nearest_names.hpp"
#include "bubblesim/scene_loader.hpp"

namespace bubblesim::app {
namespace {

constexpr int kRemotePort = 23000;  // of CoppeliaSim's ZeroMQ remote API

double parse_speed(const std::string& text) {
  if (text == "max") return std::numeric_limits<double>::infinity();
  double speed = 0;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), speed);
  if (parsed.ec != std::errc() || parsed.ptr != text.data() + text.size() || !(speed > 0)) {
    throw CLI::ValidationError("--speed", "expected a number above 0 or 'max', found '" + text + "'");
  }
  return speed;
}

/// CLI11 takes negative numbers, too, modulo 2^64.
bool is_seed(const std::string& text) {
  std::uint64_t seed = 0;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), seed);
  return parsed.ec == std::errc() && parsed.ptr == text.data() + text.size();
}

std::pair<std::string, std::filesystem::path> parse_child_script(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) {
    throw CLI::ValidationError("--child-script", "expected OBJECT=FILE such as /Tricycle=my.py, found '" + text + "'");
  }
  const std::string object = text.substr(0, equals);
  return {object.front() == '/' ? object : "/" + object, text.substr(equals + 1)};
}

/// The arguments without ROS remappings, in reverse order as CLI11 expects them.
std::vector<std::string> own_arguments(int argc, char** argv) {
  std::vector<std::string> own;
  for (int i = argc - 1; i > 0; --i) {
    if (std::string argument = argv[i]; argument.find(":=") == std::string::npos) own.push_back(std::move(argument));
  }
  return own;
}

/// The error message for unexpected arguments.
std::string unexpected(const CLI::App& app) {
  std::vector<std::string> known;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  }
  std::string text;
  bool after_option = false;
  for (const std::string& argument : app.remaining()) {
    const bool is_option = argument.size() > 1 && argument.front() == '-';
    const std::string name = argument.substr(0, argument.find('='));
    if (is_option) {
      text += "error: unknown option " + name + did_you_mean(name, known) + "\n";
    } else if (!after_option) {
      text += "error: unexpected argument '" + argument + "': expected one SCENE\n";
    }
    after_option = is_option;  // the next argument may be its value
  }
  return text + "Run with --help for more information.\n";
}

/// The arguments that may be for xacro. Names that begin with an underscore are reserved by ROS.
std::vector<std::string> xacro_arguments(int argc, char** argv) {
  std::vector<std::string> arguments;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    const std::size_t sign = argument.find(":=");
    if (sign != std::string::npos && sign > 0 && argument.front() != '_') arguments.push_back(argument);
  }
  return arguments;
}

bool is_remapping(const std::string& argument) {
  static const std::regex pattern("_.*|[~/]?[A-Za-z][A-Za-z0-9_/]*:=[~/]?[A-Za-z][A-Za-z0-9_/]*");
  return std::regex_match(argument, pattern);
}

}  // namespace

void remove_xacro_arguments(const Options& options, int& argc, char** argv) {
  if (std::filesystem::path(options.scene).extension() != ".xacro") return;
  const auto is_other = [](const char* argument) {
    return std::string(argument).find(":=") != std::string::npos && !is_remapping(argument);
  };
  char** end = std::remove_if(argv + 1, argv + argc, is_other);
  argc = static_cast<int>(end - argv);
  argv[argc] = nullptr;
}

ParsedOptions parse_options(int argc, char** argv) {
  Options options;
  std::string speed = "1";
  std::vector<std::string> child_scripts;
  std::vector<std::string> script_paths;
  bool list_scenes = false;
  bool no_ros = false;
  std::string ros = "1";
  double until = 0;
  int remote_port = kRemotePort;
  int web_port = 0;

  options.arguments = xacro_arguments(argc, argv);
  CLI::App app("Runs a robot scene with its child scripts as a ROS node.", "sim");
  app.footer(
      "Exit codes: 0 success, 1 stdout is full or closed, 2 bad input, 3 a script failed, 4 the physics diverged.\n"
      "ROS remappings (name:=value, --ros-args) are accepted; in a xacro scene they are also arguments of xacro.");
  app.set_version_flag("--version", std::string("bubblesim ") + BUBBLESIM_VERSION);
  app.add_option("SCENE", options.scene,
                 "scene name, or path of an .sdf file; with --remote it may be left to the clients");
  app.add_option("--seed", options.seed, "random seed (default 0)")->check([](const std::string& text) {
    return is_seed(text) ? "" : "expected a whole number from 0 to 18446744073709551615, found '" + text + "'";
  });
  CLI::Option* until_option =
      app.add_option("--until", until, "end at this simulation time in seconds, or when stopped");
  until_option->check([](const std::string& text) {
    return CLI::NonNegativeNumber(text).empty() && text != "nan" ? ""
                                                                 : "expected seconds, 0 or more, found '" + text + "'";
  });
  app.add_option("--speed", speed, "simulated seconds per second, or 'max' (default 1)");
  app.add_flag("--paused", options.paused, "start paused; the service ~unpause starts it");
  CLI::Option* ros_option = app.add_option("--ros", ros, "version of ROS that the node uses: 1, 2 or both (default 1)")
                                ->check(CLI::IsMember({"1", "2", "both"}));
  app.add_flag("--no-ros", no_ros, "run without ROS; simROS is false in scripts")->excludes(ros_option);
  app.add_option("--child-script", child_scripts, "OBJECT=FILE: run FILE as the object's script (repeatable)")
      ->allow_extra_args(false);
  app.add_option("--script-path", script_paths, "DIR to search for files that scripts include (repeatable)")
      ->allow_extra_args(false);
  app.add_flag("--gazebo-compat", options.gazebo_compat, "also provide Gazebo's services and topics in /gazebo");
  app.add_flag("--lua-unsafe", options.lua_unsafe, "allow Lua scripts to use os, io, debug and package");
  app.add_flag("--allow-python-scripts", options.python_of_foreign_scenes,
               "run the Python scripts in a file of CoppeliaSim; they may do whatever you may, so read them first");
  app.add_option("--allow-programs", options.allowed_programs,
                 "PROGRAM or folder of programs that Lua scripts may start, besides those of ROS packages "
                 "(repeatable)")
      ->allow_extra_args(false);
  app.add_flag("--watch", options.watch, "reload a script when its file changes");
  app.add_option("--record", options.record,
                 "FILE: record the messages that scripts publish and receive in a bag, with ROS 2 in FILE.mcap");
  app.add_option("--lockstep", options.lockstep, "TOPIC: in each step, wait for one message on it (repeatable)")
      ->allow_extra_args(false);
  CLI::Option* remote = app.add_option("--remote", remote_port,
                                       "PORT: serve CoppeliaSim's remote API clients (default 23000); the simulation "
                                       "is stopped until a client or ~unpause starts it")
                            ->expected(0, 1)
                            ->default_str("23000")
                            ->check(CLI::Range(0, 65535));
  app.add_option("--remote-address", options.remote_address,
                 "address that the remote API server listens on (default 127.0.0.1)")
      ->needs(remote);
  app.add_option("--remote-token", options.remote_token,
                 "FILE: refuse clients that do not send the text in FILE; made with a new token if there is none. "
                 "Without it, every user of this machine can connect")
      ->needs(remote);
  app.add_flag("--remote-trusted", options.remote_trusted,
               "clients may do what Python child scripts may: start any program, load scenes and models from any file, "
               "save scenes")
      ->needs(remote);
  app.add_flag("--start", options.start, "with --remote: start the simulation at once")->needs(remote);
  CLI::Option* web =
      app.add_option("--web", web_port, "PORT: show the window in a browser (default 8080 or the next free port)")
          ->expected(0, 1)
          ->check(CLI::Range(1, 65535));
  app.add_option("--web-address", options.web_address,
                 "address that the window listens on (default 127.0.0.1); there, all who have its token control the "
                 "simulation, over a connection that is not encrypted")
      ->needs(web);
  app.add_option("--web-edit", options.web_edit, "false: the window may look, and change nothing (default true)")
      ->needs(web);
  app.add_flag("--replace", options.replace, "shut down a running node of the same name");
  app.add_flag("--strict", options.strict, "end with exit code 3 when a script fails");
  app.add_flag("--state-hash", options.state_hash, "print a hash of the whole state at the end");
  app.add_option("--load-state", options.load_state, "FILE: begin with a state that --save-state saved");
  app.add_option("--save-state", options.save_state, "FILE: save the state at the end");
  app.add_flag("--list-scenes", list_scenes, "print the names of the scenes and exit");
  try {
    app.parse(own_arguments(argc, argv));
    if (list_scenes) {
      for (const std::string& name : scene_names()) std::cout << name << "\n";
      return {std::nullopt, kFine};
    }
    if (options.scene.empty() && !*remote) throw CLI::RequiredError("SCENE (see --list-scenes)");
    if (*until_option) options.until = until;
    if (*remote) options.remote_port = remote_port;
    options.web = static_cast<bool>(*web);
    if (web_port != 0) options.web_port = web_port;
    options.speed = parse_speed(speed);
    options.ros = no_ros ? Ros::kNone : ros == "both" ? Ros::kBoth : ros == "2" ? Ros::kRos2 : Ros::kRos1;
    if (*remote && !options.web_edit && options.remote_token.empty()) {
      throw CLI::ValidationError("--web-edit=false",
                                 "with --remote it needs --remote-token: without one, each user who may "
                                 "only look could connect there and change the simulation");
    }
    if (no_ros && !options.record.empty()) throw CLI::ValidationError("--record", "needs ROS");
    const bool mcap = options.record.extension() == ".mcap";
    if (options.ros == Ros::kRos2 && !options.record.empty() && !mcap) {
      throw CLI::ValidationError("--record", "the files of ROS 2 are named FILE.mcap");
    }
    if (options.ros == Ros::kRos1 && mcap) throw CLI::ValidationError("--record", ".mcap is of ROS 2: --ros=2");
    if (options.ros == Ros::kRos2 && options.replace) {
      throw CLI::ValidationError("--replace", "needs ROS 1: nodes of ROS 2 may have the same name");
    }
    if (no_ros && !options.lockstep.empty()) throw CLI::ValidationError("--lockstep", "needs ROS");
    for (const std::string& text : child_scripts) options.child_scripts.push_back(parse_child_script(text));
    options.script_paths.assign(script_paths.begin(), script_paths.end());
  } catch (const CLI::ExtrasError&) {
    std::cerr << unexpected(app);
    return {std::nullopt, kBadInput};
  } catch (const CLI::ParseError& error) {
    return {std::nullopt, app.exit(error) == 0 ? kFine : kBadInput};
  }
  return {options, kFine};
}

}  // namespace bubblesim::app
