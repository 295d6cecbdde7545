#include "model/plant/simbody_arm.h"

#include <Simbody.h>

#include <cmath>
#include <string>

#include "model/text/input_error.h"

namespace armcal {

namespace {

SimTK::Vec3 ToVec3(const Eigen::Vector3d& v) {
  return SimTK::Vec3(v.x(), v.y(), v.z());
}

SimTK::Transform ToTransform(const Eigen::Isometry3d& X) {
  SimTK::Mat33 R;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) R(i, j) = X.linear()(i, j);
  }
  // Without projection, which would turn the frame by rounding.
  return SimTK::Transform(SimTK::Rotation(R, true), ToVec3(X.translation()));
}

Eigen::Isometry3d FromTransform(const SimTK::Transform& X) {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) result.linear()(i, j) = X.R()[i][j];
    result.translation()[i] = X.p()[i];
  }
  return result;
}

Eigen::VectorXd FromVector(const SimTK::Vector& v) {
  Eigen::VectorXd result(v.size());
  for (int i = 0; i < v.size(); ++i) result[i] = v[i];
  return result;
}

SimTK::MassProperties ToMassProperties(const InertialParameters& inertial) {
  const Eigen::Vector3d com =
      inertial.mass == 0
          ? Eigen::Vector3d::Zero()
          : Eigen::Vector3d(inertial.first_moment / inertial.mass);
  const Eigen::Matrix3d& I = inertial.inertia;
  return SimTK::MassProperties(
      inertial.mass, ToVec3(com),
      SimTK::Inertia(I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2)));
}

// Simbody's messages end with the place in its source.
std::string FirstLine(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

// Simbody subtracts the mass's own share from the moments about the origin.
void RequireFinite(const Robot& robot, const Link& link) {
  const InertialParameters& inertial = link.inertial;
  if (inertial.mass == 0 ||
      std::isfinite(inertial.first_moment.squaredNorm() / inertial.mass)) {
    return;
  }
  throw InputError(robot.name, "link " + link.name, "",
                   "its mass and first moment are too large to calculate with");
}

[[noreturn]] void Refuse(const Robot& robot, const Link& link,
                         const std::string& why) {
  throw InputError(robot.name, "link " + link.name, "",
                   "Simbody cannot simulate it: " + why);
}

// Simbody looks at the inertia in the axes of its matrix, where some that no
// body has pass, and stumbles over it later in other axes.
void RequirePossible(const Robot& robot, const Link& link) {
  const std::string why = WhyUnphysical(link.inertial);
  if (link.inertial.mass > 0 && !why.empty()) Refuse(robot, link, why);
}

}  // namespace

struct SimbodyArm::Impl {
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter;
  SimTK::GeneralForceSubsystem forces;
  SimTK::State state;
  std::vector<SimTK::MobilizedBodyIndex> links;
  SimTK::Vector residual;
  SimTK::Vector no_acceleration;

  explicit Impl(const Robot& robot) try : matter(system), forces(system) {
    const SimTK::Force::UniformGravity gravity(forces, matter,
                                               ToVec3(robot.gravity));
    for (int i = 0; i < robot.num_joints(); ++i) {
      SimTK::MobilizedBody parent =
          robot.parent(i) < 0 ? SimTK::MobilizedBody(matter.updGround())
                              : matter.updMobilizedBody(links[robot.parent(i)]);
      Add(robot, robot.links[i], parent);
    }
    system.realizeTopology();
    state = system.getDefaultState();
    system.realizeModel(state);
    no_acceleration.resize(robot.num_joints());
    no_acceleration = 0;
  } catch (const SimTK::Exception::Base& error) {
    // Its tolerances are absolute: a heavy link's rounding is beyond them.
    Refuse(robot, robot.links.back(), FirstLine(error.getMessage()));
  }

  void Add(const Robot& robot, const Link& link,
           SimTK::MobilizedBody& parent) try {
    RequireFinite(robot, link);
    RequirePossible(robot, link);
    const SimTK::Body::Rigid body(ToMassProperties(link.inertial));
    SimTK::Transform X_PF = ToTransform(link.X_PF);
    SimTK::Transform X_LM = ToTransform(link.X_ML.inverse());
    if (IsRotational(link.joint.type)) {
      SimTK::MobilizedBody::Pin mobilizer(parent, X_PF, body, X_LM);
      links.push_back(mobilizer);
      return;
    }
    // Simbody slides along x, we along z.
    const SimTK::Transform x_to_z(
        SimTK::Rotation(-SimTK::Pi / 2, SimTK::YAxis));
    SimTK::MobilizedBody::Slider mobilizer(parent, X_PF * x_to_z, body,
                                           X_LM * x_to_z);
    links.push_back(mobilizer);
  } catch (const SimTK::Exception::Base& error) {
    const std::string why = WhyUnphysical(link.inertial);
    Refuse(robot, link, why.empty() ? FirstLine(error.getMessage()) : why);
  }

  void Set(const Eigen::VectorXd& q, const Eigen::VectorXd& qd) {
    for (int i = 0; i < q.size(); ++i) {
      state.updQ()[i] = q[i];
      state.updU()[i] = qd[i];
    }
  }

  // Torque for the accelerations at the state's q and qd, gravity included.
  const SimTK::Vector& Residual(const SimTK::Vector& acceleration) {
    system.realize(state, SimTK::Stage::Dynamics);
    matter.calcResidualForceIgnoringConstraints(
        state, system.getMobilityForces(state, SimTK::Stage::Dynamics),
        system.getRigidBodyForces(state, SimTK::Stage::Dynamics), acceleration,
        residual);
    return residual;
  }

  Eigen::MatrixXd MassMatrix() {
    SimTK::Matrix M;
    matter.calcM(state, M);
    Eigen::MatrixXd result(M.nrow(), M.ncol());
    for (int i = 0; i < M.nrow(); ++i) {
      for (int j = 0; j < M.ncol(); ++j) result(i, j) = M(i, j);
    }
    return result;
  }

  ArmTerms::Point PointAt(const Attachment& attachment) {
    const SimTK::MobilizedBody& body =
        matter.getMobilizedBody(links[attachment.link]);
    ArmTerms::Point point;
    point.X_WP = FromTransform(body.getBodyTransform(state));
    point.X_WP.translation() = point.X_WP * attachment.p_LP;
    SimTK::Matrix jacobian;
    matter.calcFrameJacobian(state, links[attachment.link],
                             ToVec3(attachment.p_LP), jacobian);
    point.jacobian.resize(6, jacobian.ncol());
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < jacobian.ncol(); ++j) {
        point.jacobian(i, j) = jacobian(i, j);
      }
    }
    return point;
  }
};

SimbodyArm::SimbodyArm(const Robot& robot)
    : impl_(std::make_unique<Impl>(robot)) {}
SimbodyArm::~SimbodyArm() = default;
SimbodyArm::SimbodyArm(SimbodyArm&&) noexcept = default;

int SimbodyArm::num_joints() const {
  return static_cast<int>(impl_->links.size());
}

void SimbodyArm::Evaluate(const Eigen::VectorXd& q, const Eigen::VectorXd& qd,
                          const std::vector<Attachment>& attachments,
                          ArmTerms* terms) {
  impl_->Set(q, qd);
  terms->bias = FromVector(impl_->Residual(impl_->no_acceleration));
  terms->mass_matrix = impl_->MassMatrix();
  terms->points.clear();
  for (const Attachment& attachment : attachments) {
    terms->points.push_back(impl_->PointAt(attachment));
  }
}

Eigen::VectorXd SimbodyArm::InverseDynamics(const Eigen::VectorXd& q,
                                            const Eigen::VectorXd& qd,
                                            const Eigen::VectorXd& qdd) {
  impl_->Set(q, qd);
  SimTK::Vector acceleration(num_joints());
  for (int i = 0; i < num_joints(); ++i) acceleration[i] = qdd[i];
  return FromVector(impl_->Residual(acceleration));
}

// Each joint's acceleration is prescribed; the reaction is given at the
// mobilizer's outboard frame M, in ground, and moved to Lo.
Eigen::Matrix<double, 6, 1> SimbodyArm::LastReaction(
    const Eigen::VectorXd& q, const Eigen::VectorXd& qd,
    const Eigen::VectorXd& qdd) {
  Impl& s = *impl_;
  s.Set(q, qd);
  SimTK::State state = s.state;
  for (int i = 0; i < num_joints(); ++i) {
    s.matter.getMobilizedBody(s.links[i])
        .lockAt(state, qdd[i], SimTK::Motion::Acceleration);
  }
  s.system.realize(state, SimTK::Stage::Acceleration);
  SimTK::Vector_<SimTK::SpatialVec> reactions;
  s.matter.calcMobilizerReactionForces(state, reactions);
  const SimTK::MobilizedBody& last = s.matter.getMobilizedBody(s.links.back());
  const SimTK::SpatialVec& at_M = reactions[s.links.back()];
  const SimTK::Rotation& R_GL = last.getBodyRotation(state);
  const SimTK::Vec3 force = ~R_GL * at_M[1];
  const SimTK::Vec3 moment =
      ~R_GL * at_M[0] + last.getOutboardFrame(state).p() % force;
  Eigen::Matrix<double, 6, 1> wrench;
  wrench << force[0], force[1], force[2], moment[0], moment[1], moment[2];
  return wrench;
}

Eigen::MatrixXd SimbodyArm::MassMatrix(const Eigen::VectorXd& q) {
  impl_->Set(q, Eigen::VectorXd::Zero(q.size()));
  impl_->system.realize(impl_->state, SimTK::Stage::Position);
  return impl_->MassMatrix();
}

Eigen::VectorXd SimbodyArm::GravityTorque(const Eigen::VectorXd& q) {
  impl_->Set(q, Eigen::VectorXd::Zero(q.size()));
  return FromVector(impl_->Residual(impl_->no_acceleration));
}

double SimbodyArm::KineticEnergy(const Eigen::VectorXd& q,
                                 const Eigen::VectorXd& qd) {
  impl_->Set(q, qd);
  impl_->system.realize(impl_->state, SimTK::Stage::Velocity);
  return impl_->system.calcKineticEnergy(impl_->state);
}

double SimbodyArm::PotentialEnergy(const Eigen::VectorXd& q) {
  impl_->Set(q, Eigen::VectorXd::Zero(q.size()));
  impl_->system.realize(impl_->state, SimTK::Stage::Dynamics);
  return impl_->system.calcPotentialEnergy(impl_->state);
}

bool SimbodyArm::Swing(double duration, double accuracy, int max_steps,
                       Eigen::VectorXd* q, Eigen::VectorXd* qd) try {
  impl_->Set(*q, *qd);
  impl_->state.setTime(0);
  SimTK::RungeKuttaMersonIntegrator integrator(impl_->system);
  integrator.setAccuracy(accuracy);
  integrator.setInternalStepLimit(max_steps);
  integrator.initialize(impl_->state);
  while (integrator.getTime() < duration) {
    if (integrator.stepTo(duration) == SimTK::Integrator::ReachedStepLimit) {
      return false;
    }
  }
  *q = FromVector(integrator.getState().getQ());
  *qd = FromVector(integrator.getState().getU());
  return q->allFinite() && qd->allFinite();
} catch (const SimTK::Exception::Base&) {
  return false;
}

}  // namespace armcal
