#pragma once

#include <optional>
#include <string>
#include <vector>

namespace armcal {

// An effect and where: joints from 1, 0 for all or the whole robot.
struct NamedEffect {
  std::string effect;
  int joint_index = 0;

  std::string Text() const;  // "stribeck@2"
};
inline bool operator==(const NamedEffect& a, const NamedEffect& b) {
  return a.effect == b.effect && a.joint_index == b.joint_index;
}

// A value of an effect, SI units.
struct NamedValue {
  std::string name, unit;
  double value;
};

// What a case hides, as far as it is scored: its label.
struct BlindLabel {
  struct Effect {
    NamedEffect placed;
    bool in_catalogue = true;
    double enr = 0;
    std::vector<NamedValue> values;  // the first is its size
    std::string size_limit;
  };

  std::string name;  // "case_0007"
  std::string stratum, arm, excitation;
  std::string log;  // of a real robot; empty: simulated
  std::vector<Effect> effects;
  // Of the oracle (OracleGap): what it removes, and how much there is to
  // remove, mean over the joints of (refit - after) / floor.
  std::optional<double> oracle_removed_percent;
  double removable = 0;

  bool rich() const { return excitation == "rich"; }
  double least_enr() const;  // of its effects; 0 where there is none
};
// Throws InputError.
BlindLabel ReadBlindLabel(const std::string& path);

// What a diagnosis says of it (diagnosis.json).
struct BlindAnswer {
  struct Effect {
    NamedEffect placed;
    double probability = 0;
    std::vector<NamedValue> estimates;
    std::vector<NamedEffect> equivalent;
  };
  // Held-out figures of the torque or of the simulated motion; nothing where
  // the diagnosis does not say.
  struct Gap {
    std::optional<double> removed_percent, removed_from_nominal_percent;
    // 95 % interval of removed_percent; without `high` it is open.
    std::optional<double> low, high;
    std::optional<double> refit, after;  // mean squares
    // What it is an estimate of (TrueRemovedPercent), where that is known.
    std::optional<double> true_removed_percent;
  };

  std::string verdict;  // empty: there is no answer
  std::vector<Effect> effects;
  std::vector<NamedEffect> candidates;  // the 95 % set
  Gap torque, forward;
};
// No file is no answer. Throws InputError where its keys are not those
// of docs/diagnose.md.
BlindAnswer ReadBlindAnswer(const std::string& path);

}  // namespace armcal
