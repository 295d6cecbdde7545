#include "calib/linear/transition_search.h"

#include <algorithm>

#include "calib/linear/log_factors.h"
#include "calib/linear/transition_choice.h"

namespace armcal {
namespace {

// The equations with several Coulomb columns per joint to choose from.
struct Screening {
  Screening(const Robot& robot, const LinearCalibrationOptions& options,
            const RowOptions& rows, const Transitions& transitions,
            const PreparedLogs& training)
      : parameters(MakeParameters(robot, options, transitions)),
        factor(parameters) {
    const LogFactors factors(parameters, rows, options.progress, training);
    factor = factors.Merged(parameters, FindNonzero(factors));
  }
  ModelParameters parameters;
  BlockTriangularFactor factor;
};

// What `choose` makes of the equations, all at once or joint by joint.
template <class Choose>
auto ChooseFrom(const Screening& screening, TorqueUnits scale, Choose choose) {
  const Eigen::VectorXd noise = RightSideRms(screening.factor);
  auto all = choose(screening.factor, screening.parameters, noise);
  if (scale == TorqueUnits::kCommon) return all;
  for (Eigen::Index i = 0; i < noise.size(); ++i) {
    Eigen::VectorXd alone = Eigen::VectorXd::Zero(noise.size());
    alone[i] = noise[i];
    all[i] = choose(screening.factor, screening.parameters, alone)[i];
  }
  return all;
}

// Finer widths of each joint's law about the one given, and the best of them.
Transitions Refine(const Robot& robot, const LinearCalibrationOptions& options,
                   const RowOptions& rows,
                   const std::vector<CoulombTransition>& about,
                   TorqueUnits scale, const PreparedLogs& training) {
  Transitions finer;
  for (const CoulombTransition& t : about) finer.push_back(FinerTransitions(t));
  const Screening fine(robot, options, rows, finer, training);
  Transitions transitions;
  for (const CoulombTransition& t :
       ChooseFrom(fine, scale, RefineTransitions)) {
    transitions.push_back({t});
  }
  return transitions;
}

}  // namespace

// The residual as a function of a width has several minima (friction by
// velocity and by displacement, sharp and wide), so that a descent from one
// width may end in the wrong one. A grid over all of them comes first, and a
// finer one about its best.
Transitions FindTransitions(const Robot& robot,
                            const LinearCalibrationOptions& options,
                            const RowOptions& rows,
                            const PreparedLogs& training, TorqueUnits scale) {
  const size_t n = robot.links.size();
  if (std::count(options.joint_terms.begin(), options.joint_terms.end(),
                 JointTerm::kCoulomb) == 0) {
    return {};
  }
  if (const auto given = GivenTransitions(robot, options)) return *given;
  const auto candidates = CandidateTransitions();
  const Screening coarse(robot, options, rows, {n, candidates}, training);
  std::vector<CoulombTransition> about;
  for (const int choice : ChooseFrom(coarse, scale, ChooseTransitions)) {
    about.push_back(candidates[choice]);
  }
  return Refine(robot, options, rows, about, scale, training);
}

Transitions FollowTransitions(const Robot& robot,
                              const LinearCalibrationOptions& options,
                              const RowOptions& rows,
                              const std::vector<CoulombTransition>& found,
                              const PreparedLogs& training) {
  if (found.empty()) return {};
  if (const auto given = GivenTransitions(robot, options)) return *given;
  return Refine(robot, options, rows, found, TorqueUnits::kCommon, training);
}

}  // namespace armcal
