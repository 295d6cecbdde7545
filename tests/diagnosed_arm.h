#pragma once

#include <gmock/gmock.h>

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "calib/gap_diagnosis.h"
#include "tests/effect_plant.h"
#include "tests/temp_file.h"

namespace armcal {

inline constexpr double kNoise = .1;  // N m, of torques of some 20 N m

// Logs of a 2R arm that Simbody moves in a closed loop, its motion repeated
// every 10 s, and its file.
template <int kSeconds>
class DiagnosedArm : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    plant_ = new EffectPlant(kSeconds, "2R planar (vertical plane)");
  }
  static void TearDownTestSuite() { delete plant_; }

  const Robot& File() const { return plant_->arm().robot; }
  // Adds an effect with these parameters to the true robot.
  void Add(const std::string& name, int joint, const std::vector<double>& p) {
    AddTo(name, joint, p, &truth_);
  }
  // To what it was before as well.
  void AddAlways(const std::string& name, int joint,
                 const std::vector<double>& p) {
    Add(name, joint, p);
    AddTo(name, joint, p, &before_);
  }
  static void AddTo(const std::string& name, int joint,
                    const std::vector<double>& p, SimulatedRobot* robot) {
    FindEffect(name)->apply(
        plant_->arm().Site(joint),
        Eigen::Map<const Eigen::VectorXd>(p.data(), static_cast<int>(p.size())),
        robot);
  }
  std::string Record(const SimulatedRobot& robot, const std::string& name) {
    Log log = plant_->Run(robot);
    AddNoise(&random_, Eigen::VectorXd::Constant(2, kNoise), &log.tau);
    return WriteFile(LogCsv(log), name);
  }
  GapDiagnosis Diagnose(const Robot& file, bool with_reference = false) {
    LogReaderOptions reader;
    reader.joint_names = file.JointNames();
    LogSet training({Record(truth_, "after.csv")}, reader, {});
    std::unique_ptr<LogSet> reference;
    if (with_reference) {
      reference = std::make_unique<LogSet>(
          std::vector<std::string>{Record(before_, "before.csv")}, reader,
          TimeRange());
    }
    std::unique_ptr<LogSet> validation;
    if (later_) {
      validation = std::make_unique<LogSet>(
          std::vector<std::string>{Record(*later_, "later.csv")}, reader,
          TimeRange());
    }
    DiagnosisOptions options;
    options.bandwidth_hz = 6;
    options.forward = false;  // gap_forward_test
    return DiagnoseGap(file, options, &training, validation.get(),
                       reference.get());
  }

  static const EffectPlant* plant_;
  SimulatedRobot truth_ = plant_->Bare(), before_ = truth_;
  // In a log to judge by; none: by the last part of the same log.
  std::optional<SimulatedRobot> later_;
  std::mt19937_64 random_{1};
};
template <int kSeconds>
const EffectPlant* DiagnosedArm<kSeconds>::plant_ = nullptr;

inline void ExpectFirst(const GapDiagnosis& diagnosis,
                        const std::string& effect, int joint) {
  ASSERT_FALSE(diagnosis.effects.empty());
  const FoundEffect& found = diagnosis.effects[0];
  EXPECT_EQ(found.effect->name, effect);
  EXPECT_EQ(found.joint, joint);
  EXPECT_GT(found.probability, .8);
  EXPECT_GT(diagnosis.torque.removed_from_nominal_percent, 80);
}
// Within four of its standard deviations and a share of it, since filters bend
// what forms do not.
template <typename Found>
void ExpectEstimate(const Found& found, const std::string& name, double truth,
                    double share) {
  for (size_t k = 0; k < found.estimates.size(); ++k) {
    if (found.estimates[k].name != name) continue;
    EXPECT_NEAR(found.estimates[k].value, truth,
                4 * found.stddev[k] + share * std::abs(truth))
        << name << " +- " << found.stddev[k];
    EXPECT_GT(found.stddev[k], 0) << name;
    return;
  }
  ADD_FAILURE() << "no " << name;
}

}  // namespace armcal
