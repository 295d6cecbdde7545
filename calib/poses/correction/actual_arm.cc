#include "calib/poses/correction/actual_arm.h"

#include "model/robot/arm_geometry.h"
#include "model/robot/kinematics.h"

namespace armcal {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

Isometry3d Turned(const Vector3d& turn) {
  return Isometry3d(
      Eigen::AngleAxisd(turn.norm(), turn.stableNormalized()).matrix());
}

Robot RefinedLinks(const Robot& file, const VectorXd& values) {
  ArmGeometry geometry(file);
  VectorXd all = geometry.Values();
  for (int k = 0; k < geometry.size(); ++k) {
    if (!ArmGeometry::IsBase(k) && !geometry.IsTool(k)) all[k] = values[k];
  }
  geometry.SetValues(all);
  return geometry.ApplyTo(file);
}

}  // namespace

ActualArm::ActualArm(const PoseModel& model)
    : known_(model.campaign.arm),
      zeros_(model.campaign.zeros),
      links_(
          RefinedLinks(known_.robot, model.estimate.state.unknowns.geometry)) {
  for (size_t e = 0; e < model.effects.size(); ++e) Add(model, e);
}

void ActualArm::Add(const PoseModel& model, size_t effect) {
  for (int k = model.begin[effect]; k < model.begin[effect + 1]; ++k) {
    const PoseTerm& term = model.terms[k];
    const bool in_order = term.goes_with.of == PostureSignal::Of::kNothing;
    const bool of_arm = term.acts == PoseTerm::Acts::kJoint ||
                        (!in_order && (term.acts == PoseTerm::Acts::kBase ||
                                       term.acts == PoseTerm::Acts::kTool));
    if (!of_arm) {
      const PlacedPoseEffect& placed = model.effects[effect];
      left_out_.push_back(
          PlacedName(*placed.effect, model.campaign, placed.place));
      return;
    }
    double amount = model.estimate.state.amounts[k];
    PostureSignal signal = term.goes_with;
    if (in_order) {
      amount *= term.signal[term.signal.size() - 1];
      signal.of = PostureSignal::Of::kOne;
    }
    terms_.push_back({term.acts, term.index, signal, amount});
  }
}

ActualArm::Moved ActualArm::At(const VectorXd& q,
                               const VectorXd& standing) const {
  Moved moved = {VectorXd::Zero(q.size()), Vector3d::Zero(), Vector3d::Zero(),
                 Vector3d::Zero()};
  if (terms_.empty()) return moved;
  PoseMeasurements pose;
  pose.q = q.transpose();
  const PoseCampaign campaign =
      MakeCampaign(known_, pose, standing.transpose(), zeros_);
  for (const Term& term : terms_) {
    const double by = term.amount * SignalAt(campaign, term.signal)[0];
    if (term.acts == PoseTerm::Acts::kJoint) moved.joints[term.index] += by;
    if (term.acts == PoseTerm::Acts::kBase) moved.base[term.index] += by;
    if (term.acts != PoseTerm::Acts::kTool) continue;
    (term.index < 3 ? moved.tool : moved.turn)[term.index % 3] += by;
  }
  return moved;
}

ActualArm::Moved ActualArm::Settled(const VectorXd& q) const {
  return At(q, q + At(q, q).joints);
}

VectorXd ActualArm::Standing(const VectorXd& q) const {
  return q + Settled(q).joints;
}

Isometry3d ActualArm::ToolPose(const VectorXd& q) const {
  const Moved moved = Settled(q);
  Isometry3d X_TB = Turned(moved.turn);
  X_TB.translation() = moved.tool;
  return Turned(moved.base) * armcal::ToolPose(links_, q + moved.joints) * X_TB;
}

}  // namespace armcal
