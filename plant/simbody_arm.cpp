#include "plant/simbody_arm.h"

#include <Eigen/Cholesky>
#include <cstring>
#include <stdexcept>
#include <string>

namespace halyard {
namespace {

using SimTK::Mat33;
using SimTK::Rotation;
using SimTK::SpatialVec;
using SimTK::Stage;
using SimTK::State;
using SimTK::Transform;
using SimTK::Vec3;
using SimTK::Vector;
using SimTK::Vector_;

Eigen::VectorXd to_eigen(const Vector& v) { return Eigen::Map<const Eigen::VectorXd>(&v[0], v.size()); }

Vector to_simbody(const Eigen::VectorXd& v) { return Vector(static_cast<int>(v.size()), v.data()); }

/// Puts the drive train into the System: forces on the joints, and z with its derivatives.
class DriveForce : public SimTK::Force::Custom::Implementation {
 public:
  explicit DriveForce(const SimbodyArm& arm) : arm_(arm) {}

  void realizeTopology(State& state) const override {
    const PlantLayout& l = arm_.drive.layout();
    arm_.forces.allocateZ(state, Vector(l.n_z, 0.0));
    rates_ = arm_.forces.allocateCacheEntry(state, Stage::Dynamics, new SimTK::Value<Vector>(Vector(l.n + l.n_z)));
  }

  void calcForce(const State& state, Vector_<SpatialVec>&, Vector_<Vec3>&, Vector& mobility_forces) const override {
    const PlantLayout& l = arm_.drive.layout();
    const Vector &q = state.getQ(), &u = state.getU(), &z = state.getZ();
    Vector& rates = SimTK::Value<Vector>::updDowncast(arm_.forces.updCacheEntry(state, rates_));
    arm_.drive.rates(DriveTerms::all, state.getTime(), &q[0], &u[0], &z[0], &rates[0], &rates[l.n]);
    if (!Eigen::Map<const Eigen::VectorXd>(&rates[0], rates.size()).allFinite())
      throw std::runtime_error("a force or rate of the drive train is not finite");
    Vector force = rates(0, l.n);
    if (!arm_.drive.rotor_mass().isZero(0)) {
      Eigen::VectorXd a = to_eigen(force);
      arm_.accelerate(state, a.data());
      force -= to_simbody(arm_.drive.rotor_mass() * a);
    }
    mobility_forces += force;
  }

  void realizeAcceleration(const State& state) const override {
    const PlantLayout& l = arm_.drive.layout();
    const Vector& rates = SimTK::Value<Vector>::downcast(arm_.forces.getCacheEntry(state, rates_));
    arm_.forces.updZDot(state) = rates(l.n, l.n_z);
  }

  double calcPotentialEnergy(const State&) const override { return 0; }  // energy() takes the cables' from the drive

 private:
  const SimbodyArm& arm_;
  mutable SimTK::CacheEntryIndex rates_;
};

SimTK::MassProperties mass_properties(const JointParameters<double>& j, int k) {
  const Vec3 com(j.com[0], j.com[1], j.com[2]);
  const double* I = j.inertia;
  try {
    const SimTK::Inertia central(I[0], I[1], I[2], I[3], I[4], I[5]);
    return SimTK::MassProperties(j.mass, com, central.shiftFromMassCenter(com, j.mass));
  } catch (const std::exception& error) {
    if (j.mass == 0)
      throw std::invalid_argument("link " + std::to_string(k + 1) +
                                  ": has inertia and no mass, which Simbody cannot compute; give it a mass, or take "
                                  "engine=\"halyard\"");
    throw std::invalid_argument("link " + std::to_string(k + 1) + ": Simbody refuses its inertia: " + error.what());
  }
}

void build_chain(const ArmParameters<double>& arm, SimTK::SimbodyMatterSubsystem& matter) {
  // Simbody's slider moves along x: turned so that it moves along the joint frame's z.
  const Transform x_to_z(Rotation(-SimTK::Pi / 2, SimTK::YAxis));
  SimTK::MobilizedBody parent = matter.updGround();
  for (int k = 0; k < arm.n; ++k) {
    const JointParameters<double>& j = arm.joint[k];
    Mat33 R;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) R(r, c) = j.frame_R[r][c];
    const Transform frame(Rotation(R, true), Vec3(j.frame_p[0], j.frame_p[1], j.frame_p[2]));
    const SimTK::Body::Rigid body(mass_properties(j, k));
    if (j.type == JointType::revolute) parent = SimTK::MobilizedBody::Pin(parent, frame, body, Transform());
    else parent = SimTK::MobilizedBody::Slider(parent, frame * x_to_z, body, x_to_z);
  }
}

}  // namespace

SimbodyArm::SimbodyArm(const DriveTrain& drive_train)
    : drive(drive_train),
      matter(system),
      forces(system),
      gravity(forces, matter, Vec3(drive.arm().gravity[0], drive.arm().gravity[1], drive.arm().gravity[2])) {
  build_chain(drive.arm(), matter);
  SimTK::Force::Custom(forces, new DriveForce(*this));
  state = system.realizeTopology();
  system.realizeModel(state);
  force_.resize(drive.layout().n);
}

void SimbodyArm::realize(const double* y, Stage stage) {
  const int n = drive.layout().n;
  if (std::memcmp(&state.getQ()[0], y, n * sizeof(double)) != 0) std::memcpy(&state.updQ()[0], y, n * sizeof(double));
  std::memcpy(&state.updU()[0], y + n, n * sizeof(double));
  system.realize(state, stage);
}

void SimbodyArm::accelerate(const State& s, double* force) const {
  const int n = drive.layout().n;
  std::memcpy(&force_[0], force, n * sizeof(double));
  matter.calcResidualForceIgnoringConstraints(s, force_, gravity.getBodyForces(s), no_acceleration_, residual_);
  const Eigen::Map<const Eigen::VectorXd> residual(&residual_[0], n);
  Eigen::Map<Eigen::VectorXd>(force, n) = total_mass(s).llt().solve(-residual);
}

void SimbodyArm::derivative(double time_s, const double* y, double* y_dot) {
  const PlantLayout& l = drive.layout();
  realize(y, Stage::Velocity);
  drive.rates(DriveTerms::all, time_s, y, y + l.n, y + 2 * l.n, y_dot + l.n, y_dot + 2 * l.n);
  accelerate(state, y_dot + l.n);
  std::memcpy(y_dot, y + l.n, l.n * sizeof(double));
}

const Eigen::MatrixXd& SimbodyArm::total_mass(double, const double* y) {
  realize(y, Stage::Position);
  return total_mass(state);
}

const Eigen::MatrixXd& SimbodyArm::total_mass(const SimTK::State& s) const {
  matter.calcM(s, M_);
  total_ = drive.rotor_mass();
  for (int r = 0; r < M_.nrow(); ++r)
    for (int c = 0; c < M_.ncol(); ++c) total_(r, c) += M_(r, c);
  return total_;
}

Eigen::VectorXd SimbodyArm::holding_force(const Eigen::VectorXd& q) {
  state.updQ() = to_simbody(q);
  state.updU() = 0;
  system.realize(state, Stage::Velocity);
  Vector force;
  matter.calcResidualForceIgnoringConstraints(state, Vector(), gravity.getBodyForces(state), Vector(), force);
  return to_eigen(force);
}

Eigen::VectorXd SimbodyArm::velocity_force(const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
  state.updQ() = to_simbody(q);
  state.updU() = to_simbody(v);
  system.realize(state, Stage::Velocity);
  Vector force;
  matter.calcResidualForceIgnoringConstraints(state, Vector(), Vector_<SpatialVec>(), Vector(), force);
  return to_eigen(force);
}

Eigen::Vector3d SimbodyArm::position_of(const double* point, const Eigen::VectorXd& q) {
  state.updQ() = to_simbody(q);
  system.realize(state, Stage::Position);
  const SimTK::MobilizedBodyIndex last(matter.getNumBodies() - 1);
  const Vec3 at = matter.getMobilizedBody(last).findStationLocationInGround(state, Vec3(point[0], point[1], point[2]));
  return {at[0], at[1], at[2]};
}

double SimbodyArm::energy(double time_s, const double* y) {
  state.setTime(time_s);
  state.updY() = Vector(drive.layout().size(), y);
  system.realize(state, Stage::Dynamics);
  return system.calcEnergy(state);
}

std::unique_ptr<RigidArm> make_simbody_arm(const DriveTrain& drive) { return std::make_unique<SimbodyArm>(drive); }

}  // namespace halyard
