#pragma once

#include <string>
#include <utility>
#include <vector>

#include "calib/diagnose/candidates/candidates.h"
#include "calib/diagnose/select/regression.h"

namespace armcal {

// The candidates of a regression, and their columns in its screen.
class CandidatePool {
 public:
  // Keeps `regression`. `without`: effects that are not considered.
  CandidatePool(GapRegression* regression, std::vector<std::string> without);

  // Lists candidates for the regression as it is now, and factors its screen
  // with them: those that are not linear in their size at larger ones as well,
  // at a few where there is more than noise, at all of them and in all shapes
  // where they show most.
  void List();
  // Adds those of these fitted effects that have a shape, at that shape.
  void Sharpen(const std::vector<GapCandidate>& fitted);
  // Does without this candidate's effect at its place, in any shape and size,
  // until all are listed again.
  void Bar(int candidate);

  // Those that were listed, for another pool of the same rows, whose List()
  // takes torques from them; nothing else may be asked of this one afterwards.
  std::vector<GapCandidate> TakeEvaluated();
  void Reuse(std::vector<GapCandidate> evaluated) {
    evaluated_ = std::move(evaluated);
  }

  const std::vector<GapCandidate>& candidates() const { return candidates_; }
  // Those (indices) with their linear parameters, fitted together.
  std::vector<GapCandidate> Fitted(const std::vector<int>& which) const;

 private:
  // Adds some, and factors again.
  void Add(std::vector<GapCandidate> more);
  std::vector<GapCandidate> AFewLargerOnes() const;
  std::vector<GapCandidate> LargerOnesWhereTheyShow() const;
  // Whether a refit without effects leaves more than the noise, per joint.
  std::vector<bool> MoreThanNoise() const;
  void Evaluate(std::vector<GapCandidate>* candidates);
  void Forget();

  GapRegression& regression_;
  std::vector<std::string> without_;
  std::vector<GapCandidate> candidates_;
  std::vector<GapCandidate> evaluated_;  // of lists before
};

}  // namespace armcal
