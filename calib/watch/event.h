#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace armcal {

// A number that was estimated, with its standard deviation.
struct WatchedValue {
  std::string name, unit;
  double value = 0, stddev = 0;
};

// Something that is told while a log is watched.
struct WatchEvent {
  enum class Kind {
    kLearned,       // the first seconds are over, tests begin
    kContact,       // a torque from outside, now
    kContactEnded,  // it is gone
    kPayload,       // a body was fixed to the last link, or taken from it
    kFriction,      // of one joint
    kUndecided,     // something lasts, and more than one cause explains it
    kHole,          // rows are missing
    kBadRow,        // a row that was skipped
  };
  Kind kind = Kind::kLearned;
  double time = 0;   // s since the log's first row, when it was told
  double onset = 0;  // when it began, as far as that is known
  std::vector<std::string> joints;  // it shows in, or whose friction it is
  std::vector<WatchedValue> values;
  double log_bayes = 0;  // against no change, of lasting ones
  // Against the calibration, at the end of learning; else against before.
  bool since_calibration = false;
  std::string text;  // what else there is to say

  double delay() const { return time - onset; }
};

// What a page shows of the moment.
struct WatchState {
  double time = 0;  // s since the log's first row
  bool learning = true;
  bool contact = false;
  Eigen::VectorXd residual, limit;    // per joint, N m or N; no limit at first
  std::vector<WatchedValue> changes;  // that last, since the calibration
};

const char* WatchEventName(WatchEvent::Kind kind);
// Whether it is a change of robot or surroundings, not one of the log.
bool IsChange(WatchEvent::Kind kind);
std::string ToText(const WatchEvent& event);  // one line, without its end
nlohmann::json ToJson(const WatchEvent& event);

}  // namespace armcal
