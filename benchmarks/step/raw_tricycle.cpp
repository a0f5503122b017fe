// SPDX-License-Identifier: BSD-3-Clause
#include "raw_tricycle.hpp"

#include <ode/ode.h>

#include <algorithm>
#include <cmath>

namespace bubblesim::benchmarks {
namespace {

constexpr unsigned long kGround = 1;
constexpr unsigned long kObstacle = 2;

void bits(dGeomID geom, unsigned long mask) {
  dGeomSetCategoryBits(geom, mask);
  dGeomSetCollideBits(geom, mask);
}

}  // namespace

struct RawTricycle::State {
  dThreadingImplementationID threading = dThreadingAllocateSelfThreadedImplementation();
  dWorldID world = dWorldCreate();
  dSpaceID movers = dSimpleSpaceCreate(nullptr);
  dSpaceID statics = nullptr;
  dGeomID floor = nullptr;
  dJointGroupID contacts = dJointGroupCreate(0);
  dBodyID frame = nullptr;
  dJointID steering = nullptr;
  dJointID motor = nullptr;
  double target = 0;

  dBodyID body(double x, double y, double z, double mass, double ixx, double iyy, double izz) {
    dBodyID made = dBodyCreate(world);
    dMass m;
    dMassSetParameters(&m, mass, 0, 0, 0, ixx, iyy, izz, 0, 0, 0);
    dBodySetMass(made, &m);
    dBodySetPosition(made, x, y, z);
    return made;
  }

  dBodyID wheel(double x, double y) {
    dBodyID made = body(x, y, 0.3, 2, 0.05, 0.09, 0.05);
    dGeomID tread = dCreateSphere(movers, 0.3);
    dGeomSetBody(tread, made);
    bits(tread, kGround);
    dGeomID rim = dCreateCylinder(movers, 0.29, 0.06);
    dGeomSetBody(rim, made);
    bits(rim, kObstacle);
    dMatrix3 sideways;
    dRFromAxisAndAngle(sideways, 1, 0, 0, M_PI / 2);
    dGeomSetOffsetRotation(rim, sideways);
    return made;
  }

  dJointID hinge(dBodyID child, dBodyID parent, double y, double z) {
    dJointID made = dJointCreateHinge(world, nullptr);
    dJointAttach(made, child, parent);
    const dReal* anchor = dBodyGetPosition(child);
    dJointSetHingeAnchor(made, anchor[0], anchor[1], anchor[2]);
    dJointSetHingeAxis(made, 0, y, z);
    return made;
  }

  void obstacle(dGeomID geom, double x, double y, double z, double turn = 0) {
    dMatrix3 rotation;
    dRFromAxisAndAngle(rotation, 0, 0, 1, turn);
    dGeomSetPosition(geom, x, y, z);
    dGeomSetRotation(geom, rotation);
    bits(geom, kObstacle);
  }

  static void touch(void* data, dGeomID a, dGeomID b) {
    auto& state = *static_cast<State*>(data);
    dBodyID body_a = dGeomGetBody(a);
    dBodyID body_b = dGeomGetBody(b);
    if (body_a != nullptr && body_b != nullptr) return;
    dContact contacts[8];
    const int count = dCollide(a, b, 8, &contacts[0].geom, sizeof(dContact));
    for (int i = 0; i < count; ++i) {
      contacts[i].surface.mode = dContactApprox1;
      contacts[i].surface.mu = 1;
      dJointAttach(dJointCreateContact(state.world, state.contacts, &contacts[i]), body_a, body_b);
    }
  }
};

RawTricycle::RawTricycle() : state_(std::make_unique<State>()) {
  State& s = *state_;
  dWorldSetStepThreadingImplementation(s.world, dThreadingImplementationGetFunctions(s.threading), s.threading);
  dWorldSetGravity(s.world, 0, 0, -9.81);
  dWorldSetERP(s.world, 0.2);
  dWorldSetCFM(s.world, 1e-10);
  dWorldSetContactMaxCorrectingVel(s.world, 0.1);
  dWorldSetContactSurfaceLayer(s.world, 0.001);

  s.floor = dCreatePlane(nullptr, 0, 0, 1, 0);
  bits(s.floor, kGround);
  const dVector3 centre = {0, 0, 0};
  const dVector3 half = {5.2, 5.2, 1};
  s.statics = dQuadTreeSpaceCreate(nullptr, centre, half, 6);
  s.obstacle(dCreateBox(s.statics, 10.4, 0.2, 1), 0, 5.1, 0.5);
  s.obstacle(dCreateBox(s.statics, 10.4, 0.2, 1), 0, -5.1, 0.5);
  s.obstacle(dCreateBox(s.statics, 0.2, 10, 1), 5.1, 0, 0.5);
  s.obstacle(dCreateBox(s.statics, 0.2, 10, 1), -5.1, 0, 0.5);
  s.obstacle(dCreateBox(s.statics, 1, 1, 1), 3.4, -1.2, 0.5, 0.4);
  s.obstacle(dCreateCylinder(s.statics, 0.4, 1), -0.8, 3.2, 0.5);
  s.obstacle(dCreateBox(s.statics, 2, 0.6, 1), -4, -4.7, 0.5);
  s.obstacle(dCreateSphere(s.statics, 0.6), 1.6, -4, 0.3);

  const double x = -2.5;
  const double y = -1.2;
  s.frame = s.body(x + 0.4, y, 0.4, 20, 0.6, 2.6, 3.0);
  dGeomID frame = dCreateBox(s.movers, 1.3, 0.4, 0.3);
  dGeomSetBody(frame, s.frame);
  dGeomSetOffsetPosition(frame, 0.1, 0, 0.05);
  bits(frame, kObstacle);
  dBodyID fork = s.body(x + 1, y, 0.3, 2, 0.02, 0.02, 0.02);
  s.steering = s.hinge(fork, s.frame, 0, 1);
  dJointSetHingeParam(s.steering, dParamLoStop, -1.5);
  dJointSetHingeParam(s.steering, dParamHiStop, 1.5);
  dJointSetHingeParam(s.steering, dParamFMax, 100);
  s.motor = s.hinge(s.wheel(x + 1, y), fork, 1, 0);
  dJointSetHingeParam(s.motor, dParamFMax, 50);
  s.hinge(s.wheel(x, y + 0.4), s.frame, 1, 0);
  s.hinge(s.wheel(x, y - 0.4), s.frame, 1, 0);
}

RawTricycle::~RawTricycle() {
  dJointGroupDestroy(state_->contacts);
  dSpaceDestroy(state_->movers);
  dSpaceDestroy(state_->statics);
  dGeomDestroy(state_->floor);
  dWorldDestroy(state_->world);
  dThreadingFreeImplementation(state_->threading);
}

void RawTricycle::drive(double steering, double speed) {
  state_->target = steering;
  dJointSetHingeParam(state_->motor, dParamVel, speed);
}

void RawTricycle::step() {
  State& s = *state_;
  for (int substep = 0; substep < 10; ++substep) {
    dJointGroupEmpty(s.contacts);
    dSpaceCollide2(reinterpret_cast<dGeomID>(s.movers), reinterpret_cast<dGeomID>(s.statics), &s, State::touch);
    dSpaceCollide2(reinterpret_cast<dGeomID>(s.movers), s.floor, &s, State::touch);
    const double gap = s.target - dJointGetHingeAngle(s.steering);
    dJointSetHingeParam(s.steering, dParamVel, std::clamp(gap / 0.05, -3.0, 3.0));
    dWorldStep(s.world, 0.005);
  }
}

double RawTricycle::x() const { return dBodyGetPosition(state_->frame)[0]; }
double RawTricycle::y() const { return dBodyGetPosition(state_->frame)[1]; }

}  // namespace bubblesim::benchmarks
