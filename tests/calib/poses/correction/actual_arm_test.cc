// The arm that a pose model describes, and what a controller adds for it: by
// models made of every effect of the list that is an arm's.

#include "calib/poses/correction/actual_arm.h"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cstdlib>
#include <set>
#include <string>

#include "calib/poses/correction/correction_check.h"
#include "calib/poses/correction/correction_code.h"
#include "calib/poses/correction/correction_table.h"
#include "calib/poses/correction/joint_correction.h"
#include "calib/poses/diagnosis/diagnosis.h"
#include "model/robot/kinematics.h"
#include "tests/fixtures/hidden_poses.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::actual_arm_test {

using Eigen::Isometry3d;
using Eigen::VectorXd;

constexpr char kArm[] = "PUMA560 6R";
constexpr int kPoses = 40;

// Every effect in its last place (sag of both parts), with amounts that turn
// and shift by some thousandths.
PoseModel EveryEffect(const Robot& robot, const PoseMeasurements& measured,
                      bool weighed) {
  PoseModel model;
  KnownArm arm = {robot, weighed, {}};
  for (int i = 0; i < robot.num_joints(); ++i) {
    arm.robot.links[i].inertial = InertialParameters::FromCenterOfMass(
        7 - i, Eigen::Vector3d(.1, -.05 * i, .02), Eigen::Matrix3d::Identity());
    arm.gear_ratios.push_back(60.5 + i);
  }
  model.campaign = MakeCampaign(arm, measured, measured.q);
  model.begin = {0};
  for (const PoseEffect& effect : PoseEffects()) {
    const std::vector<PosePlace> places = effect.places(model.campaign);
    if (places.empty()) continue;
    model.effects.push_back({&effect, places.back()});
    for (const PoseTerm& term : effect.terms(model.campaign, places.back())) {
      model.terms.push_back(term);
    }
    model.begin.push_back(static_cast<int>(model.terms.size()));
  }
  const auto count = static_cast<Eigen::Index>(model.terms.size());
  model.estimate.state.amounts = VectorXd::LinSpaced(count, -3e-3, 4e-3);
  VectorXd& geometry = model.estimate.state.unknowns.geometry;
  geometry = ArmGeometry(robot).Values();
  geometry += VectorXd::LinSpaced(geometry.size(), 2e-3, -1e-3);
  return model;
}

class Corrections : public ::testing::Test {
 protected:
  Corrections()
      : campaign_(kArm, Instrument::kTargets, 1, kPoses, 11),
        measured_(campaign_.Measure({}, 0, 1)),
        model_(EveryEffect(campaign_.nominal(), measured_, false)),
        arm_(model_) {}

  HiddenPoses campaign_;
  PoseMeasurements measured_;
  PoseModel model_;
  ActualArm arm_;
};

double Apart(const Isometry3d& a, const Isometry3d& b) {
  return (a.matrix() - b.matrix()).cwiseAbs().maxCoeff();
}

TEST_F(Corrections, KnowEachSignalAndWhatIsNotTheArms) {
  std::set<PostureSignal::Of> kinds;
  for (const ActualArm::Term& term : arm_.terms()) kinds.insert(term.signal.of);
  // All but kNothing and, since the arm was not weighed, kWeightMoment.
  EXPECT_EQ(kinds.size(), 9u);
  const ActualArm weighed(EveryEffect(campaign_.nominal(), measured_, true));
  int moments = 0;
  for (const ActualArm::Term& term : weighed.terms()) {
    moments += term.signal.of == PostureSignal::Of::kWeightMoment;
    EXPECT_NE(term.signal.of, PostureSignal::Of::kLinkMoment);
  }
  EXPECT_GT(moments, 2);
  std::set<std::string> named;
  for (const std::string& name : arm_.left_out()) {
    named.insert(name.substr(0, name.find_first_of(" ,")));
  }
  for (const char* name : {"scale", "tool_step", "frame_drift", "growth"}) {
    EXPECT_EQ(named.count(name), 1u) << name;
  }
  EXPECT_EQ(named.count("joint_step"), 0u);
}

// Whether joints reach every small motion of the tool: the least singular value
// of position and 0.1 m times angle by the joints is above 0.03 m.
bool IsRegular(const Robot& robot, const VectorXd& q) {
  Eigen::MatrixXd J(6, q.size());
  const Isometry3d X = ToolPose(robot, q);
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const Isometry3d moved = ToolPose(robot, q + 1e-6 * VectorXd::Unit(6, i));
    const Eigen::AngleAxisd turn(moved.linear() * X.linear().transpose());
    J.col(i) << 1e6 * (moved.translation() - X.translation()),
        1e5 * turn.angle() * turn.axis();
  }
  return Eigen::JacobiSVD<Eigen::MatrixXd>(J).singularValues()[5] > .03;
}

TEST_F(Corrections, MeetTheOtherPose) {
  int regular = 0;
  for (int k = 0; k < kPoses; ++k) {
    const VectorXd q = measured_.q.row(k);
    if (!IsRegular(arm_.file(), q)) continue;
    ++regular;
    const Isometry3d said = ToolPose(arm_.file(), q);
    EXPECT_GT(Apart(arm_.ToolPose(q), said), 1e-3);
    EXPECT_LT(Apart(arm_.ToolPose(q + CommandCorrection(arm_, q)), said), 1e-8);
    EXPECT_LT(Apart(ToolPose(arm_.file(), q + ForwardCorrection(arm_, q)),
                    arm_.ToolPose(q)),
              1e-8);
  }
  EXPECT_GT(regular, kPoses / 4);
}

TEST_F(Corrections, OfPosesThatAreExplainedAreExact) {
  // A target's place by the model's equations and by the arm.
  const VectorXd q = measured_.q.row(3);
  model_.estimate.state.unknowns.geometry.head<6>().setZero();
  PoseModel only;
  only.begin = {0};
  only.campaign = model_.campaign;
  for (size_t e = 0; e < model_.effects.size(); ++e) {
    const std::string& name = model_.effects[e].effect->name;
    if (name != "coupling" && name != "base_sag" && name != "tool_sag")
      continue;
    only.effects.push_back(model_.effects[e]);
    for (int k = model_.begin[e]; k < model_.begin[e + 1]; ++k) {
      only.terms.push_back(model_.terms[k]);
    }
    only.begin.push_back(static_cast<int>(only.terms.size()));
  }
  only.estimate.state.amounts =
      VectorXd::Constant(static_cast<Eigen::Index>(only.terms.size()), 2e-3);
  PoseUnknowns& unknowns = only.estimate.state.unknowns;
  unknowns.geometry = ArmGeometry(campaign_.nominal()).Values();
  unknowns.geometry.head<6>().setZero();
  unknowns.other = Eigen::Vector3d(.01, .02, .05);
  const PoseFit fit(campaign_.nominal(), measured_, {});
  const VectorXd r =
      PoseEquations(fit, measured_).Residuals(only.terms, only.estimate.state);
  const ActualArm arm(only);
  const Eigen::Vector3d predicted =
      r.segment<3>(9) + measured_.targets[0].row(3).transpose();
  // Signals are of where joints stand, which the model's terms were not made
  // from: second order in 2e-3.
  EXPECT_LT(
      (arm.ToolPose(q) * Eigen::Vector3d(unknowns.other) - predicted).norm(),
      2e-5);
  EXPECT_GT(
      (ToolPose(arm.file(), q) * Eigen::Vector3d(unknowns.other) - predicted)
          .norm(),
      1e-3);
}

class Compiled {
 public:
  explicit Compiled(const std::string& code) {
    const std::string source = WriteFile(code, "correction.c");
    const std::string library = source + ".so";
    const std::string command =
        "cc -std=c99 -pedantic -Wall -Wextra -Werror -O1 -shared -fPIC -o '" +
        library + "' '" + source + "' -lm";
    EXPECT_EQ(std::system(command.c_str()), 0);
    library_ = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
    EXPECT_NE(library_, nullptr);
  }
  ~Compiled() {
    if (library_ != nullptr) dlclose(library_);
  }
  VectorXd Call(const char* function, const VectorXd& q, int size) const {
    const auto call = reinterpret_cast<void (*)(const double*, double*)>(
        dlsym(library_, function));
    VectorXd result(size);
    call(q.data(), result.data());
    return result;
  }

 private:
  void* library_ = nullptr;
};

void CompareWithC(const ActualArm& arm, const Eigen::MatrixXd& postures) {
  const Compiled c(CorrectionCode(arm, {}));
  for (int k = 0; k < kPoses; ++k) {
    const VectorXd q = postures.row(k);
    const VectorXd pose = c.Call("armcal_actual_pose", q, 12);
    Isometry3d X = Isometry3d::Identity();
    X.matrix().topRows<3>() =
        Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(
            pose.data());
    EXPECT_LT(Apart(X, arm.ToolPose(q)), 1e-13);
    if (!IsRegular(arm.file(), q)) continue;
    EXPECT_LT(
        (c.Call("armcal_command_correction", q, 6) - CommandCorrection(arm, q))
            .cwiseAbs()
            .maxCoeff(),
        1e-7);
    EXPECT_LT(
        (c.Call("armcal_forward_correction", q, 6) - ForwardCorrection(arm, q))
            .cwiseAbs()
            .maxCoeff(),
        1e-7);
  }
}

TEST_F(Corrections, AreTheSameInC) {
  for (const bool weighed : {false, true}) {
    SCOPED_TRACE(weighed ? "weighed" : "not weighed");
    const ActualArm arm(EveryEffect(campaign_.nominal(), measured_, weighed));
    CompareWithC(arm, measured_.q);
  }
}
TEST_F(Corrections, OfOneGearAreALinearTable) {
  PoseModel gear = model_;
  gear.effects.clear();
  gear.terms.clear();
  gear.begin = {0};
  gear.estimate.state.unknowns.geometry =
      ArmGeometry(campaign_.nominal()).Values();
  const auto& effects = PoseEffects();
  const auto ratio =
      std::find_if(effects.begin(), effects.end(),
                   [](const PoseEffect& e) { return e.name == "gear_ratio"; });
  PosePlace place;
  place.joint = 2;
  gear.effects.push_back({&*ratio, place});
  gear.terms = ratio->terms(gear.campaign, place);
  gear.begin.push_back(1);
  gear.estimate.state.amounts = VectorXd::Constant(1, .01);
  const ActualArm arm(gear);
  Eigen::MatrixX2d range(6, 2);
  range.col(0).setConstant(-1);
  range.col(1).setConstant(1);
  range.row(4) << .7, .7;  // does not move, nor is it singular
  const CorrectionTable table = MakeCorrectionTable(arm, range, 100);
  EXPECT_LE(table.size(), 100);
  EXPECT_EQ(table.nodes[4].size(), 1);
  VectorXd q(6), wanted = VectorXd::Zero(6);
  q << .3, -.2, .77, .1, .7, -.9;
  wanted[2] = .0077;
  EXPECT_LT((table.Interpolate(table.forward, q) - wanted).norm(), 1e-9);
  wanted[2] = .77 / 1.01 - .77;
  EXPECT_LT((table.Interpolate(table.command, q) - wanted).norm(), 1e-9);
  q[2] = 5;  // beyond the edge: as there
  EXPECT_NEAR(table.Interpolate(table.forward, q)[2], .01, 1e-9);
  EXPECT_EQ(table.At(1)[5], table.nodes[5][1]);  // the last changes fastest
  const CorrectionErrors errors = MeasureCorrection(arm, table, range);
  EXPECT_LT(errors.by_table.most, 1e-8);
  EXPECT_GT(errors.before.median, 1e-4);
}

TEST(CorrectionCheck, HeldOutPosesAreMetToTheNoise) {
  HiddenPoseEffect coupling;
  coupling.name = "coupling";
  coupling.joint = 3;
  coupling.by = 2;
  coupling.size = .01;
  const HiddenPoses arm(kArm, Instrument::kTargets, 3, 120, 21);
  const PoseMeasurements all = arm.Measure({coupling}, 1e-4, 3);
  PoseMeasurements fitted = all, held_out = all;
  fitted.q = all.q.topRows(80);
  held_out.q = all.q.bottomRows(40);
  for (size_t t = 0; t < all.targets.size(); ++t) {
    fitted.targets[t] = all.targets[t].topRows(80);
    held_out.targets[t] = all.targets[t].bottomRows(40);
  }
  fitted.row.resize(80);
  held_out.row.erase(held_out.row.begin(), held_out.row.begin() + 80);
  const PoseDiagnosis diagnosis = DiagnosePoseGap(arm.nominal(), fitted, {});
  ASSERT_EQ(diagnosis.findings.size(), 1u);
  const CorrectionCheck check =
      CheckCorrection(ActualArm(diagnosis.model), held_out);
  EXPECT_EQ(check.poses, 40);
  EXPECT_GT(check.before, 3e-3);
  // A distance has three coordinates of noise 1e-4; the geometry's own error
  // adds to it.
  EXPECT_LT(check.after, 1.4 * std::sqrt(3) * 1e-4);
}

}  // namespace armcal::actual_arm_test
