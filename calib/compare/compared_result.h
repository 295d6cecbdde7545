#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "model/robot/robot.h"

namespace armcal {

// A number that a result has.
struct ComparedValue {
  std::string name;
  std::string unit;
  double value;
  double stddev;  // 0: exact, NaN: not known
};

// Values that are known together. A calibration has them twice: as numbers of
// the torque's equations, which no prior touches, and as a robot's.
struct ComparedValues {
  std::vector<ComparedValue> values;
  // Of all of them, or empty: they are independent. NaN where not known.
  Eigen::MatrixXd covariance;
};

// An effect that a diagnosis claims, or weighed.
struct ComparedClaim {
  std::string name;  // "payload", "stribeck of elbow"
  double probability;
  bool claimed;                     // with a probability of a half or more
  std::vector<std::string> rivals;  // what else it may be
};

// Part of a log that a result was made of, s.
struct ComparedLog {
  std::string file;
  double begin, end;

  bool Overlaps(const ComparedLog& other) const {
    return file == other.file && begin < other.end && end > other.begin;
  }
};

// A result file of armcal, or a robot file, as far as it can be compared.
struct ComparedResult {
  enum class Kind { kCalibration, kDiagnosis, kVerification, kRobot };
  std::string name;  // as it was given
  Kind kind;
  std::string robot;
  std::string verdict;  // in words
  std::vector<ComparedLog> logs;
  // The values in the order in which they are to be compared: the first that
  // both of two results have.
  std::vector<ComparedValues> sets;
  std::vector<ComparedClaim> claims;
  std::vector<std::string> untestable;  // "friction of elbow"
  std::string file = "";  // of a result of armcal: `name`, or in that folder
  std::optional<Robot> robot_file = std::nullopt;  // where it is one
};

const char* KindName(ComparedResult::Kind kind);

// Reads a calibration.json, diagnosis.json or verification.json, a folder that
// has one of them, or, by `read_robot`, a robot file. Throws InputError.
using RobotReader = std::function<Robot(const std::string& path)>;
ComparedResult ReadResult(const std::string& path,
                          const RobotReader& read_robot);

}  // namespace armcal
