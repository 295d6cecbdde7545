// Poses that mean something else than their header says: other units, frames,
// quaternions, columns, directions.

#include "calib/poses/reading_audit.h"

#include <gmock/gmock.h>

#include <cmath>

#include "calib/calibrate_parts.h"
#include "calib/diagnose_poses.h"
#include "calib/poses/diagnosis/diagnosis.h"
#include "model/text/option_error.h"
#include "model/text/option_name.h"
#include "tests/fixtures/sample_poses.h"

namespace armcal::reading_audit_test {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

void Scale(double angles, double lengths, PoseMeasurements* m) {
  m->q *= angles;
  for (auto& target : m->targets) target *= lengths;
  if (m->poses.size() > 0) m->poses.leftCols(3) *= lengths;
  m->lengths *= lengths;
}

TEST(ReadingAudit, SaysInWhichUnitsPosesWereMeant) {
  for (const auto instrument :
       {Instrument::kTargets, Instrument::kPoses, Instrument::kWire}) {
    Plant plant("UR5 6R", 3);
    const PoseMeasurements right = plant.Measure(instrument, 60, kNoise);
    EXPECT_EQ(WrongReading(plant.nominal, right), "");
    const auto told = [&](double angles, double lengths) {
      PoseMeasurements wrong = right;
      Scale(angles, lengths, &wrong);
      return WrongReading(plant.nominal, wrong);
    };
    EXPECT_THAT(told(180 / M_PI, 1),
                AllOf(HasSubstr("[deg]"), Not(HasSubstr("[mm]"))));
    EXPECT_THAT(told(1, 1000),
                AllOf(HasSubstr("[mm]"), Not(HasSubstr("[deg]"))));
    EXPECT_THAT(told(180 / M_PI, 1000),
                AllOf(HasSubstr("'q1 [deg]'"), HasSubstr("[mm]")));
    EXPECT_THAT(told(M_PI / 180, 1), HasSubstr("without [deg]"));
    EXPECT_THAT(told(1, 1e-3), HasSubstr("without [mm]"));
    EXPECT_THAT(told(1, 1 / .0254), StartsWith("lengths are inches"));
  }
}

// Both files are looked at before either is used.
TEST(ReadingAudit, LooksAtPosesThatWereKeptOut) {
  Plant plant("UR5 6R", 3);
  CalibrateOptions calibrate;
  DiagnosePosesOptions diagnose;
  calibrate.poses = plant.Measure(Instrument::kTargets, 30, kNoise);
  PoseMeasurements others = plant.Measure(Instrument::kTargets, 20, kNoise);
  Scale(180 / M_PI, 1, &others);
  calibrate.pose_validation = diagnose.validation = others;
  const auto refusal = [](const auto& run) -> std::string {
    try {
      run();
    } catch (const OptionError& e) {
      return e.what();
    }
    return "";
  };
  const auto says =
      AllOf(HasSubstr(OptionName("validate") + ": "), HasSubstr("'q1 [deg]'"));
  EXPECT_THAT(refusal([&] { CalibrateFromPoses(plant.nominal, calibrate); }),
              says);
  EXPECT_THAT(refusal([&] {
                DiagnosePoses(plant.nominal, *calibrate.poses, diagnose);
              }),
              says);
}

TEST(ReadingAudit, NamesTheJointsThatAreExchangedOrCountTheOtherWay) {
  for (const auto instrument : {Instrument::kTargets, Instrument::kPoses}) {
    Plant plant("PUMA560 6R", 4);
    const PoseMeasurements right = plant.Measure(instrument, 40, kNoise);
    const auto name = [&](int i) { return plant.nominal.links[i].joint.name; };
    for (int i = 0; i < 6; ++i) {
      PoseMeasurements turned = right;
      turned.q.col(i) *= -1;
      EXPECT_THAT(WrongReading(plant.nominal, turned),
                  StartsWith("joint " + name(i) + " counts the other way"));
      EXPECT_EQ(WrongReading(plant.nominal, turned, TurnedJoints::kAreFindings),
                "");
      for (int j = i + 1; j < 6; ++j) {
        PoseMeasurements exchanged = right;
        exchanged.q.col(i).swap(exchanged.q.col(j));
        EXPECT_THAT(WrongReading(plant.nominal, exchanged),
                    StartsWith("the columns of joints " + name(i) + " and " +
                               name(j) + " are exchanged"));
      }
    }
  }
}

TEST(ReadingAudit, KnowsALeftHandedFrame) {
  Plant plant("PUMA560 6R", 4);
  const PoseMeasurements right =
      plant.Measure(Instrument::kTargets, 40, kNoise);
  PoseMeasurements negated = right, exchanged = right;
  for (auto& target : negated.targets) target.col(2) *= -1;
  for (auto& target : exchanged.targets) target.col(0).swap(target.col(1));
  EXPECT_THAT(WrongReading(plant.nominal, negated),
              StartsWith("positions are in a left-handed frame"));
  EXPECT_THAT(WrongReading(plant.nominal, exchanged),
              StartsWith("positions are in a left-handed frame"));
  PoseMeasurements poses = plant.Measure(Instrument::kPoses, 40, kNoise);
  poses.poses.col(0).swap(poses.poses.col(1));
  EXPECT_THAT(WrongReading(plant.nominal, poses),
              HasSubstr("columns x and y exchanged"));
  poses.poses.col(0).swap(poses.poses.col(1));
  // As of Unity: all is mirrored, here along x.
  poses.poses.col(0) *= -1;
  poses.poses.rightCols(2) *= -1;
  EXPECT_THAT(WrongReading(plant.nominal, poses),
              HasSubstr("and so are orientations"));
}

TEST(ReadingAudit, KnowsOtherConventionsOfPoses) {
  Plant plant("UR5 6R", 5);
  const PoseMeasurements right = plant.Measure(Instrument::kPoses, 40, kNoise);
  EXPECT_EQ(WrongReading(plant.nominal, right), "");
  PoseMeasurements inverse = right, xyzw = right, wxyz = right, turned = right;
  for (int k = 0; k < right.size(); ++k) {
    const Eigen::RowVectorXd row = right.poses.row(k);
    const Eigen::Quaterniond R(row[3], row[4], row[5], row[6]);
    const Eigen::Vector3d p = -(R.conjugate() * row.head<3>().transpose());
    inverse.poses.row(k) << p.transpose(), row[3], -row[4], -row[5], -row[6];
    turned.poses.row(k).tail<3>() *= -1;
    // Numbers x y z w where w x y z is read, and the reverse.
    xyzw.poses.row(k).tail<4>() << row[4], row[5], row[6], row[3];
    wxyz.poses.row(k).tail<4>() << row[6], row[3], row[4], row[5];
  }
  EXPECT_THAT(WrongReading(plant.nominal, inverse),
              HasSubstr("expected their inverse"));
  EXPECT_THAT(WrongReading(plant.nominal, xyzw),
              HasSubstr("are in the order x y z w"));
  EXPECT_THAT(WrongReading(plant.nominal, wxyz),
              HasSubstr("are in the order w x y z"));
  EXPECT_THAT(WrongReading(plant.nominal, turned),
              HasSubstr("with qx, qy and qz negated"));
}

// A zero that is off, of a joint that hardly moves, is all that the file has
// wrong: its negation would explain it, and no motion asks for that.
TEST(ReadingAudit, AWrongZeroIsNoOtherDirection) {
  Plant plant("UR5 6R", 6);
  plant.robot = plant.nominal;
  Eigen::VectorXd held = Eigen::VectorXd::Constant(6, std::nan(""));
  held[1] = .1;
  PoseMeasurements m = plant.Measure(Instrument::kTargets, 40, kNoise, held);
  m.q.col(1) *= -1;
  for (int k = 0; k < m.size(); ++k) m.q(k, 1) += 6e-3 * (k % 2 - .5);
  EXPECT_EQ(WrongReading(plant.nominal, m), "");
}

// What other readings do not explain is no matter of them, and no effect
// either.
TEST(ReadingAudit, LeavesOtherMistakesToTheVerdict) {
  Plant plant("UR5 6R", 3);
  PoseMeasurements m = plant.Measure(Instrument::kTargets, 25, kNoise);
  m.q = m.q.rowwise().reverse().eval();
  EXPECT_EQ(WrongReading(plant.nominal, m), "");
  const PoseDiagnosis diagnosis = DiagnosePoseGap(plant.nominal, m, {});
  EXPECT_EQ(diagnosis.verdict, PoseVerdict::kNotTestable);
  EXPECT_TRUE(diagnosis.findings.empty());
  EXPECT_THAT(diagnosis.reason, HasSubstr("do not follow the joints"));
}

}  // namespace armcal::reading_audit_test
