#pragma once

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "calib/diagnose/select/selection.h"
#include "tests/fixtures/sample_motion.h"

namespace armcal {

inline constexpr int kRows = 1000;  // of each of two joints

inline Eigen::VectorXd Noise(std::mt19937_64* random, double size = 1) {
  Eigen::VectorXd x(kRows);
  for (double& value : x) value = size * Normal(random);
  return x;
}

// Effects that are columns, beside a baseline of one constant that is known.
class SelectedColumns : public testing::Test {
 protected:
  SelectedColumns() : effects_(20), target_(2, Eigen::VectorXd::Zero(kRows)) {
    for (Effect& effect : effects_) effect.parameters.resize(1);
  }

  // The k-th effect's next shape on a joint.
  int Add(int effect, int joint, const Eigen::VectorXd& column, int tried = 1) {
    GapCandidate candidate;
    candidate.effect = &effects_[effect];
    candidate.joint = joint;
    candidate.linear = {0};
    candidate.tried = tried;
    candidate.columns = {static_cast<int>(columns_.size())};
    JointRows rows(2);
    rows[joint] = column;
    columns_.push_back(rows);
    candidates_.push_back(candidate);
    return static_cast<int>(candidates_.size()) - 1;
  }
  // Each an effect of its own on joint 1.
  void AddRandom(int count) {
    for (int k = 0; k < count; ++k) Add(k, 0, Noise(&random_));
  }
  // A second linear parameter of the candidate's effect, and its column.
  Eigen::VectorXd AddPart(int candidate) {
    const Eigen::VectorXd column = Noise(&random_);
    GapCandidate& law = candidates_[candidate];
    law.linear = {0, 1};
    law.columns.push_back(static_cast<int>(columns_.size()));
    columns_.push_back({column, {}});
    effects_[candidate].parameters.resize(2);
    return column;
  }
  GapScreen Screen() const {
    const Eigen::MatrixXd baseline = Eigen::MatrixXd::Constant(kRows, 1, 1e-3);
    GapScreen screen(OnEachJoint({baseline, baseline}), 1, target_);
    for (const JointRows& column : columns_) screen.AddColumn(column);
    screen.Factor();
    return screen;
  }
  Selection Select(const SelectionOptions& options = {}) const {
    return SelectEffects(Screen(), candidates_, options);
  }
  const Eigen::VectorXd& Column(int candidate) const {
    return columns_[candidate][candidates_[candidate].joint];
  }

  std::mt19937_64 random_{7};
  std::vector<Effect> effects_;
  std::vector<GapCandidate> candidates_;
  std::vector<JointRows> columns_;
  JointRows target_;
};

}  // namespace armcal
