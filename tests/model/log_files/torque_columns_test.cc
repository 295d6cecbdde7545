#include "model/log_files/torque_columns.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "model/log_files/log_reader.h"
#include "model/log_files/log_writer.h"
#include "model/text/input_error.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::torque_columns_test {

LogReaderOptions Options(TorqueKind kind, std::vector<double> constants = {},
                         std::vector<double> gears = {}) {
  LogReaderOptions options;
  options.joint_names = {"shoulder", "elbow"};
  options.torque_kind = kind;
  options.torque_constants = std::move(constants);
  options.gear_ratios = std::move(gears);
  return options;
}

// "tau columns: 3*1 4*1", the source, indices and scales; or the refusal.
std::string Find(const std::string& header, const LogReaderOptions& options) {
  std::string found;
  const std::string refusal = MessageOf<InputError>("log.csv", [&] {
    CheckTorqueFactors(options);
    const LogColumns columns("log.csv", header, options.joint_names);
    const TorqueColumns torque = FindTorqueColumns("log.csv", columns, options);
    found = torque.source + ":";
    for (const LogColumn& column : torque.columns) {
      char text[64];
      std::snprintf(text, sizeof(text), " %d*%g", column.index, column.scale);
      found += text;
    }
  });
  return found + refusal;
}

TEST(TorqueColumns, AreTakenAsTheyAre) {
  const std::string header = "t,tau1,tau2,i1,i2";
  EXPECT_EQ(Find(header, Options(TorqueKind::kLink)), "tau columns: 1*1 2*1");
  EXPECT_EQ(Find(header, Options(TorqueKind::kAuto)), "tau columns: 1*1 2*1");
  EXPECT_EQ(Find(header, Options(TorqueKind::kAuto, {2, 3})),
            "tau columns (the torque constants are not used): 1*1 2*1");
  EXPECT_EQ(Find(header, Options(TorqueKind::kCommand)),
            "commanded tau columns: 1*1 2*1");
  EXPECT_EQ(Find("t,tau1 [mNm],tau2", Options(TorqueKind::kLink)),
            "tau columns: 1*0.001 2*1");
}

// Currents beside them are read where they are wanted and the torques are the
// joints' own; from text and from arrays.
TEST(TorqueColumns, CurrentsStandBesideJointTorques) {
  Log log;
  log.t = Eigen::Vector3d(0, .004, .008);
  log.q = Eigen::MatrixXd::Random(3, 2);
  log.tau = Eigen::MatrixXd::Random(3, 2);
  log.current = Eigen::MatrixXd::Random(3, 2);
  const auto read = [&](const LogSource& source, TorqueKind kind, bool want) {
    LogReaderOptions options = Options(kind);
    options.want_current = want;
    LogReader reader(source, options);
    Log back;
    reader.Read(10, &back);
    EXPECT_EQ(reader.has_current(), back.current.size() > 0);
    return back.current;
  };
  for (const LogSource& source :
       {LogSource(WriteFile(LogText(log))), LogSource("memory", log)}) {
    EXPECT_TRUE(
        read(source, TorqueKind::kAuto, true).isApprox(log.current, 1e-8));
    EXPECT_EQ(read(source, TorqueKind::kAuto, false).size(), 0);
    EXPECT_EQ(read(source, TorqueKind::kMotor, true).size(), 0);
  }
  log.current.resize(0, 0);
  EXPECT_EQ(read({"memory", log}, TorqueKind::kAuto, true).size(), 0);
}

TEST(TorqueColumns, AreMultipliedByGearRatios) {
  const std::string header = "t,tau1,tau2";
  EXPECT_EQ(Find(header, Options(TorqueKind::kMotor, {}, {100, -50})),
            "motor-side tau columns times gear ratios 100 -50: 1*100 2*-50");
  EXPECT_EQ(Find(header, Options(TorqueKind::kMotor)),
            "motor-side tau columns (gear ratio 1): 1*1 2*1");
  EXPECT_EQ(Find(header, Options(TorqueKind::kLink, {}, {100, -50})),
            "tau columns: 1*1 2*1");
}

TEST(TorqueColumns, CurrentsAreMultipliedByConstants) {
  const std::string header = "t,i1,i2 [mA],tau1,tau2";
  EXPECT_EQ(Find(header, Options(TorqueKind::kCurrent, {14.87, 2})),
            "currents times 14.87 2 N m/A: 1*14.87 2*0.002");
  EXPECT_EQ(Find(header, Options(TorqueKind::kCurrent, {0.1, 2}, {100, 10})),
            "currents times 0.1 2 N m/A times gear ratios 100 10: 1*10 2*0.02");
  EXPECT_EQ(Find("t,i1,i2", Options(TorqueKind::kAuto, {2, 3})),
            "currents times 2 3 N m/A: 1*2 2*3");
  EXPECT_EQ(Find("t,i1,i2,tau1", Options(TorqueKind::kAuto, {2, 3})),
            "currents times 2 3 N m/A: 1*2 2*3");
  EXPECT_EQ(Find("t,shoulder/effort [A],elbow/effort [A]",
                 Options(TorqueKind::kAuto, {2, 3})),
            "currents times 2 3 N m/A: 1*2 2*3");
}

// As drivers of servos report them, where the log has no currents of its own
// and its header does not say that they are torques.
TEST(TorqueColumns, EffortsAreCurrentsWhereTheKindSaysSo) {
  const std::string header = "t,shoulder/effort,elbow/effort";
  EXPECT_EQ(Find(header, Options(TorqueKind::kCurrent, {2, 3}, {10, 1})),
            "currents in tau columns times 2 3 N m/A times gear ratios 10 1: "
            "1*20 2*3");
  EXPECT_EQ(Find(header, Options(TorqueKind::kAuto, {2, 3})),
            "tau columns (the torque constants are not used): 1*1 2*1");
  EXPECT_EQ(Find("t,tau1,tau2,i1,i2", Options(TorqueKind::kCurrent, {2, 3})),
            "currents times 2 3 N m/A: 3*2 4*3");
  EXPECT_EQ(Find(header, Options(TorqueKind::kCurrent)),
            "FILE: the torque comes from currents (shoulder/effort to "
            "elbow/effort), its scale is not observable from them alone: "
            "expected `torque_constants`=K1,.. in N m/A, one per joint, or "
            "`payload_mass` and `payload_log` to estimate them");
}

TEST(TorqueColumns, VoltagesAreMultipliedByTorquePerVolt) {
  EXPECT_EQ(Find("t,u1,u2 [mV]", Options(TorqueKind::kAuto, {.5, 2}, {10, 1})),
            "voltages times 0.5 2 N m/V times gear ratios 10 1: 1*5 2*0.002");
  EXPECT_EQ(Find("t,shoulder/voltage,elbow/effort [V],q1",
                 Options(TorqueKind::kAuto, {2, 3})),
            "voltages times 2 3 N m/V: 1*2 2*3");
  // Torques come first, then currents.
  EXPECT_EQ(Find("t,u1,u2,i1,i2", Options(TorqueKind::kAuto, {2, 3})),
            "currents times 2 3 N m/A: 3*2 4*3");
  EXPECT_EQ(Find("t,u1,u2,i1,i2", Options(TorqueKind::kVoltage, {2, 3})),
            "voltages times 2 3 N m/V: 1*2 2*3");
  // A known payload tells no voltages' scale.
  EXPECT_EQ(Find("t,u1,u2", Options(TorqueKind::kAuto)),
            "FILE: the torque comes from voltages (u1 to u2), its scale is not "
            "observable from them alone: expected `torque_constants`=K1,.. in "
            "N m/V, one per joint");
  EXPECT_EQ(Find("t,tau1,tau2", Options(TorqueKind::kVoltage, {2, 3})),
            "voltages in tau columns times 2 3 N m/V: 1*2 2*3");
  EXPECT_EQ(Find("t,u1,tau1,tau2", Options(TorqueKind::kVoltage, {2, 3})),
            "FILE: row 1: missing u2 or elbow/voltage; the robot has 2 joints, "
            "the log holds u1; where effort columns hold voltages, say so with "
            "[V]");
}

TEST(TorqueColumns, SayWhatIsMissing) {
  EXPECT_EQ(
      Find("t,q1,q2", Options(TorqueKind::kAuto)),
      "FILE: row 1: no torque: missing tau1 or shoulder/effort, tau2 or "
      "elbow/effort; or currents (i1 or shoulder/current, ..) or voltages "
      "(u1, ..) with `torque_constants`");
  EXPECT_EQ(
      Find("t,q1,q2,qref1,qref2", Options(TorqueKind::kAuto)),
      "FILE: row 1: no torque: missing tau1 or shoulder/effort, tau2 or "
      "elbow/effort; or currents (i1 or shoulder/current, ..) or voltages "
      "(u1, ..) with `torque_constants`; or `controller`, under which "
      "calibrate and verify simulate how the log's commands (qref) are "
      "followed");
  EXPECT_EQ(Find("t,i1,i2", Options(TorqueKind::kAuto)),
            "FILE: the torque comes from currents (i1 to i2), its scale is not "
            "observable from them alone: expected `torque_constants`=K1,.. in "
            "N m/A, one per joint, or `payload_mass` and `payload_log` to "
            "estimate them");
  EXPECT_EQ(Find("t,tau2,i1", Options(TorqueKind::kAuto)),
            "FILE: row 1: missing tau1 or shoulder/effort; the robot has 2 "
            "joints, the log holds tau2");
  EXPECT_EQ(Find("t,i1", Options(TorqueKind::kAuto, {1, 1})),
            "FILE: row 1: missing i2 or elbow/current; the robot has 2 joints, "
            "the log holds i1");
  EXPECT_EQ(Find("t,tau1 [Nm],tau2", Options(TorqueKind::kCurrent, {1, 1})),
            "FILE: row 1: missing i1 or shoulder/current, i2 or elbow/current; "
            "the robot has 2 joints, the log holds 0 such columns; where "
            "effort columns hold currents, say so with [A]");
  EXPECT_EQ(Find("t,i1,i2", Options(TorqueKind::kLink, {1, 1})),
            "FILE: row 1: missing tau1 or shoulder/effort, tau2 or "
            "elbow/effort; the robot has 2 joints, the log holds 0 such "
            "columns");
}

TEST(TorqueColumns, NamesDrivesThatWaitForConstants) {
  const auto names = [](const std::string& header,
                        const LogReaderOptions& options) {
    return FindUnscaledDrives(LogColumns("FILE", header, options.joint_names),
                              options)
        .columns;
  };
  EXPECT_EQ(names("t,u1,u2", Options(TorqueKind::kAuto)), "u1 to u2");
  EXPECT_EQ(names("t,u1,u2,i1,i2", Options(TorqueKind::kAuto)), "i1 to i2");
  EXPECT_EQ(names("t,u1,u2,tau1,tau2", Options(TorqueKind::kAuto)), "");
  EXPECT_EQ(names("t,u1", Options(TorqueKind::kAuto)), "");
  EXPECT_EQ(names("t,i1,i2", Options(TorqueKind::kAuto)), "i1 to i2");
  EXPECT_EQ(names("t,shoulder/effort [A],elbow/effort [A]",
                  Options(TorqueKind::kAuto)),
            "shoulder/effort [A] to elbow/effort [A]");
  EXPECT_EQ(names("t,i1,i2", Options(TorqueKind::kAuto, {1, 1})), "");
  EXPECT_EQ(names("t,i1,i2,tau1,tau2", Options(TorqueKind::kAuto)), "");
  EXPECT_EQ(names("t,i1,i2,tau1,tau2", Options(TorqueKind::kCurrent)),
            "i1 to i2");
  EXPECT_EQ(names("t,i1,tau1,tau2", Options(TorqueKind::kCurrent)), "");
  EXPECT_EQ(names("t,tau1,tau2", Options(TorqueKind::kCurrent)),
            "tau1 to tau2");
}

TEST(TorqueColumns, RefuseFactorsThatDoNotFit) {
  const std::string header = "t,i1,i2";
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(Find(header, Options(TorqueKind::kAuto, {1.5, 2, 3})),
            "`torque_constants`: found '1.5 2 3': expected one value per "
            "joint, the robot has 2");
  EXPECT_EQ(Find(header, Options(TorqueKind::kAuto, {1, 1}, {100})),
            "`gear_ratios`: found '100': expected one value per joint, the "
            "robot has 2");
  EXPECT_EQ(Find(header, Options(TorqueKind::kAuto, {1, 0})),
            "`torque_constants`, joint elbow: found '0': expected a finite "
            "number other than 0");
  EXPECT_EQ(Find(header, Options(TorqueKind::kAuto, {1, 1}, {inf, 1})),
            "`gear_ratios`, joint shoulder: found 'inf': expected a finite "
            "number other than 0");
  EXPECT_EQ(Find(header, Options(TorqueKind::kAuto, {std::nan(""), 1})),
            "`torque_constants`, joint shoulder: found 'nan': expected a "
            "finite number other than 0");
}

}  // namespace armcal::torque_columns_test
