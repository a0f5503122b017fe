// SPDX-License-Identifier: BSD-3-Clause
#include "load/ttt/read_objects.hpp"

namespace bubblesim::ttt {
namespace {

constexpr double kShortest = 1e-5;
constexpr double kLongest = 10;
constexpr double kMostGravity = 1e4;  // m/s^2

double step_of(std::optional<double> step, double otherwise) {
  return step && *step >= kShortest && *step <= kLongest ? *step : otherwise;
}

void read_time_step(const TagList& sim, Settings& settings) {
  std::optional<double> step = sim.number("", "_t3");
  if (!step) step = sim.number("St3", "");
  if (auto bytes = sim.item("St2"); bytes && bytes->left() >= sizeof(std::uint64_t) && !step)
    step = 1e-6 * static_cast<double>(bytes->u64());
  if (!step) step = sim.number("Sts", "");
  settings.time_step = step_of(step, settings.time_step);
}

void read_dynamics(const TagList& dyn, Settings& settings) {
  for (const char* tag : {"_n3", "En3", "En2", "Eng"}) {
    auto bytes = dyn.item(tag);
    if (!bytes) continue;
    note_damage(dyn.damage(), [&] {
      const std::size_t start = bytes->offset();
      settings.engine = bytes->i32();
      const auto n = bytes->numbers(3, std::string_view(tag) == "_n3");
      const Vector3 gravity(n[0], n[1], n[2]);
      if (!(gravity.norm() <= kMostGravity)) fail_at(start, "gravity is out of range");
      settings.gravity = gravity;
    });
    break;
  }
  std::optional<double> step = dyn.number("Stp", "_tp");
  if (!step) {
    const auto block = settings.engine == 0 ? dyn.block("BuN", "_uN") : dyn.block("OdN", "_dN");
    if (!block.empty()) step = block.front();
  }
  settings.engine_step = step_of(step, settings.engine_step);
  settings.is_dynamics_enabled = (dyn.u8("Var").value_or(1) & 1U) != 0;
}

}  // namespace

Settings read_settings(const TagList& sim, const TagList& dyn, const TagList& env, const TagList& set) {
  Settings settings;
  read_time_step(sim, settings);
  read_dynamics(dyn, settings);
  if (const auto n = env.numbers("Al2", "", 3); !n.empty()) settings.ambient = {n[0], n[1], n[2]};
  if (const auto n = env.numbers("Cld", "", 3); !n.empty()) settings.background = {n[0], n[1], n[2]};
  settings.active_layers = env.u16("Vil").value_or(set.u16("Al2").value_or(settings.active_layers));
  return settings;
}

}  // namespace bubblesim::ttt
