// SPDX-License-Identifier: BSD-3-Clause
#include "state_files.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <system_error>

#include "bubblesim/error.hpp"

namespace bubblesim::app {

void load_state(Simulation& simulation, const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string state((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  if (!in) throw std::runtime_error(file.string() + ": cannot read the saved state: " + std::strerror(errno));
  try {
    simulation.restore(state);
  } catch (const InvalidInput& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

void save_state(Simulation& simulation, const std::filesystem::path& file) {
  const std::string state = simulation.save();
  std::filesystem::path part = file;
  part += ".part";
  std::ofstream out(part, std::ios::binary);
  out << state;
  out.close();
  std::error_code failed;
  if (out) std::filesystem::rename(part, file, failed);
  if (out && !failed) return;
  const std::string why = failed ? failed.message() : std::strerror(errno);
  throw std::runtime_error(file.string() + ": cannot write the state: " + why);
}

}  // namespace bubblesim::app
