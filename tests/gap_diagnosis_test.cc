#include "calib/gap_diagnosis.h"

#include <gmock/gmock.h>

#include <cmath>
#include <memory>

#include "tests/effect_plant.h"
#include "tests/temp_file.h"

namespace armcal {
namespace {

using Eigen::VectorXd;
using testing::AnyOf;
using testing::IsEmpty;

constexpr double kNoise = .1;  // N m, of torques of some 20 N m

// Logs of an elbow that Simbody moves in a closed loop, its motion repeated
// every 10 s, and the file of that elbow.
class GapDiagnosisTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { plant_ = new EffectPlant(32); }
  static void TearDownTestSuite() { delete plant_; }

  const Robot& File() const { return plant_->arm().robot; }
  // Adds an effect with these parameters to the true robot.
  void Add(const std::string& name, int joint, std::vector<double> p) {
    FindEffect(name)->apply(
        plant_->arm().Site(joint),
        Eigen::Map<const VectorXd>(p.data(), static_cast<int>(p.size())),
        &truth_);
  }
  std::string Record(const SimulatedRobot& robot, const std::string& name) {
    Log log = plant_->Run(robot);
    AddNoise(&random_, VectorXd::Constant(3, kNoise), &log.tau);
    return WriteFile(LogCsv(log), name);
  }
  GapDiagnosis Diagnose(const Robot& file, bool with_reference = false) {
    LogReaderOptions reader;
    reader.joint_names = file.JointNames();
    LogSet training({Record(truth_, "after.csv")}, reader, {});
    std::unique_ptr<LogSet> reference;
    if (with_reference) {
      reference = std::make_unique<LogSet>(
          std::vector<std::string>{Record(plant_->Bare(), "before.csv")},
          reader, TimeRange());
    }
    DiagnosisOptions options;
    options.bandwidth_hz = 6;
    return DiagnoseGap(file, options, &training, nullptr, reference.get());
  }

  static const EffectPlant* plant_;
  SimulatedRobot truth_ = plant_->Bare();
  std::mt19937_64 random_{1};
};
const EffectPlant* GapDiagnosisTest::plant_ = nullptr;

void ExpectFirst(const GapDiagnosis& diagnosis, const std::string& effect,
                 int joint) {
  ASSERT_FALSE(diagnosis.effects.empty());
  const FoundEffect& found = diagnosis.effects[0];
  EXPECT_EQ(found.effect->name, effect);
  EXPECT_EQ(found.joint, joint);
  EXPECT_GT(found.probability, .8);
  EXPECT_GT(diagnosis.torque.removed_percent, 80);
}
// Within four of its standard deviations and a share of it, since filters bend
// what forms do not.
void ExpectEstimate(const FoundEffect& found, const std::string& name,
                    double truth, double share) {
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

TEST_F(GapDiagnosisTest, NothingIsMissing) {
  const GapDiagnosis diagnosis = Diagnose(File());
  EXPECT_THAT(diagnosis.effects, IsEmpty());
  EXPECT_STREQ(GapVerdictName(diagnosis.verdict), "noise_floor");
  EXPECT_EQ(diagnosis.floor, NoiseFloor::kRepeats);
  EXPECT_NEAR(diagnosis.torque.after, 1, .4);
}

// The file's friction of one joint is half of what it is.
TEST_F(GapDiagnosisTest, OnlyAParameterWasWrong) {
  Robot file = File();
  file.links[1].joint.viscous = .5;  // .8
  DiagnosisOptions options;
  const GapDiagnosis diagnosis = Diagnose(file);
  EXPECT_THAT(diagnosis.effects, IsEmpty());
  EXPECT_STREQ(GapVerdictName(diagnosis.verdict), "absorbed");
  ASSERT_FALSE(diagnosis.moved.empty());
  EXPECT_EQ(diagnosis.moved[0].name, "joint2.viscous");
  EXPECT_NEAR(diagnosis.moved[0].value, .8, 4 * diagnosis.moved[0].stddev);
}

TEST_F(GapDiagnosisTest, FrictionFallsWithSpeed) {
  Add("stribeck", 1, {1.2, .14});
  const GapDiagnosis diagnosis = Diagnose(File());
  ExpectFirst(diagnosis, "stribeck", 1);
  EXPECT_EQ(diagnosis.verdict, GapVerdict::kExplained);
  ExpectEstimate(diagnosis.effects[0], "stribeck", 1.2, .1);
  ExpectEstimate(diagnosis.effects[0], "stribeck_velocity", .14, .1);
  EXPECT_EQ(diagnosis.effects.size(), 1u);
}

TEST_F(GapDiagnosisTest, AGearYields) {
  const EffectSite site = plant_->arm().Site(1);
  const Effect& elasticity = *FindEffect("elasticity");
  VectorXd p(elasticity.parameters.size());
  for (int k = 0; k < p.size(); ++k) p[k] = elasticity.parameters[k].size(site);
  p[0] *= 4;
  Add("elasticity", 1, {p.begin(), p.end()});
  ExpectFirst(Diagnose(File()), "elasticity", 1);
}

TEST_F(GapDiagnosisTest, APayloadSinceTheReference) {
  const Effect& payload = *FindEffect("payload");
  std::vector<double> p(payload.parameters.size(), 0);
  p[0] = .6;  // kg
  Add("payload", -1, p);
  const GapDiagnosis diagnosis = Diagnose(File(), true);
  ExpectFirst(diagnosis, "payload", -1);
  EXPECT_EQ(diagnosis.floor, NoiseFloor::kReference);
  ExpectEstimate(diagnosis.effects[0], "mass", .6, .02);
}

TEST_F(GapDiagnosisTest, TwoAreFound) {
  Add("stribeck", 0, {1.5, .14});
  Add("torque_ripple", 2, {1, .5, 23});
  const GapDiagnosis diagnosis = Diagnose(File());
  ASSERT_EQ(diagnosis.effects.size(), 2u);
  std::vector<std::string> places;
  for (const FoundEffect& found : diagnosis.effects) {
    places.push_back(found.effect->name + std::to_string(found.joint));
  }
  EXPECT_THAT(places,
              testing::UnorderedElementsAre("stribeck0", "torque_ripple2"));
}

// A torque that no catalogue has: of the product of two joints' positions.
TEST_F(GapDiagnosisTest, WhatHasNoNameIsUnknown) {
  truth_.joint_laws.push_back(
      {0, {}, false, [](const ArmInstant& at, const double*, double*) {
         return 2 * std::sin(9 * at.position[1]) * std::cos(7 * at.position[2]);
       }});
  const GapDiagnosis diagnosis = Diagnose(File());
  EXPECT_THAT(diagnosis.verdict,
              AnyOf(GapVerdict::kUnknown, GapVerdict::kPartlyExplained));
  EXPECT_EQ(diagnosis.unexplained.joint, "joint1");
  EXPECT_GT(diagnosis.unexplained.share, .3);
}

}  // namespace
}  // namespace armcal
