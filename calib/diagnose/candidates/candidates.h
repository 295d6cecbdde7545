#pragma once

#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

#include "calib/diagnose/data/baseline.h"
#include "calib/diagnose/data/rows.h"
#include "calib/diagnose/data/screen.h"
#include "model/effects/effects.h"

namespace armcal {

// An effect at a place, its shape given: torque is linear in what is left.
struct GapCandidate {
  const Effect* effect = nullptr;
  int joint = -1;           // from 0; -1: the whole robot
  Eigen::VectorXd p;        // linear parameters 0
  std::vector<int> linear;  // entries of p
  Eigen::VectorXd size;     // of the linear ones: their column's unit
  // Torque of each of them at its size: per joint thinned samples, empty where
  // it is zero.
  std::vector<JointRows> torque;
  std::vector<int> columns;  // of the screen, in the order of `linear`
  int log = -1;  // the one it happened in, of what happens once; -1: all
  // How improbable it was before the data, beyond the number of shapes that
  // were tried, on the scale of chi squared.
  double prior_penalty = 0;
  int tried = 1;           // shapes of the same effect at the same place
  bool is_usual = true;    // its shape is the usual one of its effect
  bool is_larger = false;  // than the first size of its effect
  bool is_fitted = false;  // its shape and size are those of a fit
  // Since a reference, which may have had more of it: a spring's stiffness and
  // a load's mass are positive, a change of them has either sign.
  bool is_change = false;
  // Of its coefficient, where its column is the torque at its size and not at
  // sizes far from it.
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool IsPositive(int parameter) const {
    return !is_change && effect->parameters[parameter].sign ==
                             EffectParameter::Sign::kPositive;
  }
  // Whether it has the sign of the first parameter.
  bool IsAsFirst(int parameter) const {
    return effect->parameters[parameter].sign ==
           EffectParameter::Sign::kAsFirst;
  }
  bool IsIn(int other_log) const { return log < 0 || log == other_log; }
  std::string place() const;
};

// GapCandidate::prior_penalty of an effect. Since a reference: what is asked is
// what changed in an arm since then, which is rarely rebuilt between two logs.
double PriorPenalty(const Effect& effect, bool since_reference);

// Whether a robot file without such a law has a part of it as Coulomb friction.
bool IsCoulombInFiles(const Effect& law);

// Whether they are one effect at one place, of which there are not two.
bool SamePlace(const GapCandidate& a, const GapCandidate& b);

// In their order, without the k-th.
std::vector<GapCandidate> AllBut(std::vector<GapCandidate> effects, size_t k);

// Every effect but those `without` names, at every place, at every value of its
// grids, as a change since a reference or not. Shapes that are found in the
// residual (frequencies, times) come from `residual`, thinned samples x n.
std::vector<GapCandidate> ListCandidates(
    const GapBaseline& baseline, const GapRows& rows, const MotionScale& scale,
    const Eigen::MatrixXd& residual, const std::vector<std::string>& without,
    bool since_reference);

// Whether it is a sine and a cosine of time, whose phase is each log's own.
bool SwingsInTime(const Effect& effect);

// The same candidate at the larger sizes of its effect; at a few of them.
std::vector<GapCandidate> LargerOnes(const GapCandidate& candidate);
std::vector<GapCandidate> FewLargerOnes(const GapCandidate& candidate);
// Whether these few are not all.
bool HasMoreLargerOnes(const GapCandidate& candidate);
// One candidate (index) of each effect that has larger sizes, at each place: of
// its usual shape, else its first.
std::vector<int> UsualShapes(const std::vector<GapCandidate>& candidates);

// Whether its torque is not linear in all of its parameters.
bool HasShape(const GapCandidate& candidate);
// Of effects, those that have a shape as candidates of that shape and size.
std::vector<GapCandidate> Sharper(const std::vector<GapCandidate>& effects);

// Their columns, whitened as the rows are now.
void AddCandidates(const GapRows& rows, std::vector<GapCandidate>* candidates,
                   GapScreen* screen);

}  // namespace armcal
