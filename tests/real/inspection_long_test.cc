// Real logs (../shared/data) and a simulated one with one fault each: whether
// the inspection names it, and nothing else. Skipped where the logs are absent.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <filesystem>
#include <functional>
#include <set>

#include "calib/inspect/inspection.h"
#include "model/log_files/log_writer.h"
#include "model/robot_files/robot_reader.h"
#include "tests/fixtures/inspected_arm.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::inspection_long_test {

const std::vector<double> kUr10eConstants = {14.87, 13.26, 11.13,
                                             10.62, 11.03, 11.47};

struct Recording {
  std::string name;
  Robot robot;
  Log log;
  std::vector<double> torque_constants;  // of one logged as currents
};

Recording Ur10e(const std::string& name) {
  const std::string folder = std::string(SHARED_DIR) + "/data/ur10e_free/";
  Recording recording{
      name, ReadRobot(folder + "robot.urdf", {}), {}, kUr10eConstants};
  LogReaderOptions options;
  options.joint_names = recording.robot.JointNames();
  options.torque_constants = kUr10eConstants;
  options.want_velocity = true;
  recording.log = ReadWholeLog(folder + name + ".csv", options);
  return recording;
}

Recording Panda() {
  const std::string folder = std::string(SHARED_DIR) + "/data/panda/";
  Recording recording{"panda",
                      ReadRobot(folder + "robot.urdf", {}),
                      {},
                      {80, 80, 80, 80, 50, 50, 50}};
  LogReaderOptions options;
  options.joint_names = recording.robot.JointNames();
  options.want_velocity = true;
  recording.log = ReadWholeLog(folder + "log.csv", options);
  return recording;
}

Recording Simulated() {
  const InspectedArm arm;
  Recording recording{"simulated", arm.robot, arm.log,
                      std::vector<double>(6, 9)};
  recording.log.qdd.resize(0, 0);
  return recording;
}

void KeepRows(const std::vector<int>& rows, Log* log) {
  log->t = Eigen::VectorXd(log->t(rows));
  for (Eigen::MatrixXd* x : {&log->q, &log->qd, &log->tau}) {
    *x = Eigen::MatrixXd((*x)(rows, Eigen::all));
  }
}

void Exchange(int a, int b, Log* log) {
  for (Eigen::MatrixXd* x : {&log->q, &log->qd, &log->tau}) {
    x->col(a).swap(x->col(b));
  }
}

// The torque as recorded `delay` s ago.
void Delay(double delay, Log* log) {
  const Eigen::MatrixXd tau = log->tau;
  int from = 0;
  for (int k = 0; k < log->size(); ++k) {
    while (from + 1 < log->size() && log->t[from + 1] <= log->t[k] - delay) {
      ++from;
    }
    log->tau.row(k) = tau.row(from);
  }
}

struct Fault {
  std::string name;
  std::string finding;
  int joint;                      // of the finding, from 0; -1: any
  std::set<std::string> besides;  // that follow from it
  std::function<void(Recording*)> make;
};

std::vector<Fault> FaultsOf(const Recording& recording) {
  const int n = recording.robot.num_joints();
  std::vector<Fault> faults;
  for (const auto& [a, b] : {std::pair(0, 1), std::pair(1, 2),
                             std::pair(n - 3, n - 2), std::pair(2, n - 1)}) {
    faults.push_back(
        {"exchanged", "joint_order", a, {}, [a = a, b = b](Recording* r) {
           Exchange(a, b, &r->log);
         }});
  }
  faults.push_back(
      {"positions exchanged", "position_order", 1, {}, [](Recording* r) {
         r->log.q.col(1).swap(r->log.q.col(2));
         r->log.qd.col(1).swap(r->log.qd.col(2));
       }});
  faults.push_back(
      {"torques exchanged", "torque_order", 0, {}, [](Recording* r) {
         r->log.tau.col(0).swap(r->log.tau.col(2));
       }});
  for (const int j : {0, 1, n - 2}) {
    faults.push_back(
        {"position sign", "position_sign", j, {}, [j](Recording* r) {
           r->log.q.col(j) *= -1;
           r->log.qd.col(j) *= -1;
         }});
    faults.push_back({"torque sign", "torque_sign", j, {}, [j](Recording* r) {
                        r->log.tau.col(j) *= -1;
                      }});
  }
  faults.push_back({"joint sign", "joint_sign", 1, {}, [](Recording* r) {
                      r->log.q.col(1) *= -1;
                      r->log.qd.col(1) *= -1;
                      r->log.tau.col(1) *= -1;
                    }});
  faults.push_back(
      {"degrees", "position_unit", -1, {"velocity"}, [](Recording* r) {
         r->log.q *= 180 / M_PI;
         r->log.qd *= 180 / M_PI;
       }});
  faults.push_back({"ms", "time_unit", -1, {"velocity"}, [](Recording* r) {
                      r->log.t *= 1e3;
                    }});
  faults.push_back({"currents", "torque_is_current", -1, {}, [](Recording* r) {
                      for (int j = 0; j < r->log.tau.cols(); ++j) {
                        r->log.tau.col(j) /= r->torque_constants[j];
                      }
                    }});
  faults.push_back(
      {"delay", "delay", -1, {}, [](Recording* r) { Delay(.02, &r->log); }});
  faults.push_back(
      {"stuck position", "stuck", 1, {"velocity"}, [](Recording* r) {
         r->log.q.col(1).setConstant(r->log.q(0, 1));
       }});
  faults.push_back({"stuck torque", "stuck", 2, {}, [](Recording* r) {
                      r->log.tau.col(2).setConstant(r->log.tau(9, 2));
                    }});
  faults.push_back({"lost", "lost_samples", -1, {}, [](Recording* r) {
                      std::vector<int> rows;
                      for (int k = 0; k < r->log.size(); ++k) {
                        if (k % 3 != 0) rows.push_back(k);
                      }
                      KeepRows(rows, &r->log);
                    }});
  const Eigen::Vector3d g = recording.robot.gravity;
  for (const Eigen::Vector3d& other :
       {Eigen::Vector3d(-g), Eigen::Vector3d(g.norm(), 0, 0),
        Eigen::Vector3d(Eigen::AngleAxisd(.3, Eigen::Vector3d::UnitY()) * g)}) {
    faults.push_back({"gravity", "gravity", -1, {}, [other](Recording* r) {
                        r->robot.gravity = other;
                      }});
  }
  return faults;
}

LogInspection Inspect(const Recording& recording) {
  LogReaderOptions options;
  options.joint_names = recording.robot.JointNames();
  return InspectLog(recording.robot,
                    WriteFile(LogText(recording.log), recording.name + ".csv"),
                    options);
}

std::string Describe(const LogInspection& inspection) {
  std::string text;
  for (const InspectionFinding& finding : inspection.findings) {
    text += finding.finding + "@" + std::to_string(finding.joint + 1) + " (" +
            finding.evidence + ") ";
  }
  return text;
}

bool Names(const Fault& fault, const LogInspection& inspection) {
  bool named = false;
  for (const InspectionFinding& finding : inspection.findings) {
    const bool either_sign =
        finding.sentence.find(", or its ") != std::string::npos &&
        (fault.finding == "position_sign" || fault.finding == "torque_sign");
    const bool is_it = (finding.finding == fault.finding || either_sign) &&
                       (fault.joint < 0 || finding.joint == fault.joint);
    if (!is_it && fault.besides.count(finding.finding) == 0) return false;
    named = named || is_it;
  }
  return named;
}

std::vector<Recording> Recordings() {
  return {Ur10e("id_20s"), Ur10e("id_40s"), Ur10e("val_ptp"), Panda(),
          Simulated()};
}

bool LogsAreHere() {
  return std::filesystem::exists(std::string(SHARED_DIR) + "/data/panda");
}

TEST(RealInspection, NamesWhatIsWrong) {
  if (!LogsAreHere()) GTEST_SKIP() << "no ../shared/data";
  int cases = 0, named = 0;
  for (const Recording& recording : Recordings()) {
    for (const Fault& fault : FaultsOf(recording)) {
      Recording faulty = recording;
      fault.make(&faulty);
      const LogInspection inspection = Inspect(faulty);
      ++cases;
      const bool right = Names(fault, inspection);
      named += right;
      if (!right) {
        std::printf("%s, %s %d: %s\n", recording.name.c_str(),
                    fault.name.c_str(), fault.joint + 1,
                    Describe(inspection).c_str());
      }
    }
  }
  std::printf("%d of %d named\n", named, cases);
  EXPECT_GE(cases, 60);
  // 20 ms in three UR10e logs explain less than half of what a fit leaves, and
  // so do an exchange and a tilt in the one from point to point: they are not
  // told, as real logs that are right differ by as much.
  EXPECT_GE(named, .95 * cases);
}

TEST(RealInspection, CleanLogsAreClean) {
  if (!LogsAreHere()) GTEST_SKIP() << "no ../shared/data";
  std::vector<Recording> clean = Recordings();
  for (const char* name : {"id_30s", "id_50s"}) clean.push_back(Ur10e(name));
  for (const Recording& recording : clean) {
    const LogInspection inspection = Inspect(recording);
    EXPECT_TRUE(inspection.findings.empty())
        << recording.name << ": " << Describe(inspection);
  }
}

}  // namespace armcal::inspection_long_test
