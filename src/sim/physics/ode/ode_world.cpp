// SPDX-License-Identifier: BSD-3-Clause
#include "physics/ode/ode_world.hpp"

#include "physics/ode/constraint_defaults.hpp"

namespace bubblesim {
namespace {

constexpr unsigned kLeastMemory = 4096;  // bytes of working memory of a world; by default ODE takes 64 kB
constexpr int kIterations = 50;          // of the iterative solver

}  // namespace

OdeWorld::OdeWorld(const Vector3& gravity, std::uint64_t seed) : random(static_cast<std::uint32_t>(seed)) {
  ode::prepare_this_thread();
  threading.reset(dThreadingAllocateSelfThreadedImplementation());
  world.reset(dWorldCreate());
  dWorldSetStepThreadingImplementation(world.get(), dThreadingImplementationGetFunctions(threading.get()),
                                       threading.get());
  dWorldStepReserveInfo memory{};
  memory.struct_size = sizeof memory;
  memory.reserve_factor = 1.2F;  // ODE's default
  memory.reserve_minimum = kLeastMemory;
  dWorldSetStepMemoryReservationPolicy(world.get(), &memory);
  dWorldSetGravity(world.get(), gravity.x(), gravity.y(), gravity.z());
  dWorldSetCFM(world.get(), kConstraintSoftness);
  dWorldSetContactSurfaceLayer(world.get(), kSurfaceLayer);
  dWorldSetQuickStepNumIterations(world.get(), kIterations);
  contact_joints.reset(dJointGroupCreate(0));
}

}  // namespace bubblesim
