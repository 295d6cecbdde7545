#include "calib/transition_search.h"

#include <algorithm>

#include "calib/log_factors.h"
#include "calib/transition_choice.h"

namespace armcal {
namespace {

// The equations with several Coulomb columns per joint to choose from.
struct Screening {
  Screening(const Robot& robot, const LinearCalibrationOptions& options,
            const RowOptions& rows, const Transitions& transitions,
            LogSet* training)
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
auto ChooseFrom(const Screening& screening, TorqueScale scale, Choose choose) {
  const Eigen::VectorXd noise = RightSideRms(screening.factor);
  auto all = choose(screening.factor, screening.parameters, noise);
  if (scale == TorqueScale::kCommon) return all;
  for (Eigen::Index i = 0; i < noise.size(); ++i) {
    Eigen::VectorXd alone = Eigen::VectorXd::Zero(noise.size());
    alone[i] = noise[i];
    all[i] = choose(screening.factor, screening.parameters, alone)[i];
  }
  return all;
}

}  // namespace

Transitions FindTransitions(const Robot& robot,
                            const LinearCalibrationOptions& options,
                            const RowOptions& rows, LogSet* training,
                            TorqueScale scale) {
  const size_t n = robot.links.size();
  if (std::count(options.joint_terms.begin(), options.joint_terms.end(),
                 JointTerm::kCoulomb) == 0) {
    return {};
  }
  if (options.transition) return {n, {*options.transition}};
  const auto candidates = CandidateTransitions();
  const Screening coarse(robot, options, rows, {n, candidates}, training);
  Transitions finer;
  for (const int choice : ChooseFrom(coarse, scale, ChooseTransitions)) {
    finer.push_back(FinerTransitions(candidates[choice]));
  }
  const Screening fine(robot, options, rows, finer, training);
  Transitions transitions;
  for (const CoulombTransition& t :
       ChooseFrom(fine, scale, RefineTransitions)) {
    transitions.push_back({t});
  }
  return transitions;
}

}  // namespace armcal
