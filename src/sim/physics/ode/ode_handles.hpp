// SPDX-License-Identifier: BSD-3-Clause
// Owning handles for ODE's objects, and the process-wide set-up that ODE needs.
#pragma once

#include <ode/ode.h>

#include <memory>
#include <type_traits>

namespace bubblesim::ode {

/// A unique_ptr deleter that calls one of ODE's destroy functions.
template <auto kDestroy>
struct Destroy {
  template <class T>
  void operator()(T* handle) const {
    kDestroy(handle);
  }
};

using WorldHandle = std::unique_ptr<std::remove_pointer_t<dWorldID>, Destroy<dWorldDestroy>>;
using BodyHandle = std::unique_ptr<std::remove_pointer_t<dBodyID>, Destroy<dBodyDestroy>>;
using JointHandle = std::unique_ptr<std::remove_pointer_t<dJointID>, Destroy<dJointDestroy>>;
using GeomHandle = std::unique_ptr<std::remove_pointer_t<dGeomID>, Destroy<dGeomDestroy>>;
using SpaceHandle = std::unique_ptr<std::remove_pointer_t<dSpaceID>, Destroy<dSpaceDestroy>>;
using JointGroupHandle = std::unique_ptr<std::remove_pointer_t<dJointGroupID>, Destroy<dJointGroupDestroy>>;
using TriMeshDataHandle = std::unique_ptr<std::remove_pointer_t<dTriMeshDataID>, Destroy<dGeomTriMeshDataDestroy>>;
using ThreadingHandle =
    std::unique_ptr<std::remove_pointer_t<dThreadingImplementationID>, Destroy<dThreadingFreeImplementation>>;

/// Initializes ODE once for the process and once for the calling thread, and makes its assertions throw Diverged
/// instead of aborting the process.
void prepare_this_thread();

/// One substep with the iterative solver, whose random numbers continue from `random`. Threads do not wait for each
/// other: see docs/adr/0023.
void step_iteratively(dWorldID world, double step, unsigned long& random);

/// Whether an ODE solver reported a warning on this thread since the last call.
bool solver_warned();

}  // namespace bubblesim::ode
