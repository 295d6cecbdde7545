#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

namespace armcal {

// x' = f(t, x): writes as many rates as x has entries.
using StateRate = std::function<void(double t, const Eigen::VectorXd& x,
                                     Eigen::VectorXd* rate)>;

struct IntegrationOptions {
  // Local error per step, per state: absolute + relative * |x|.
  double relative = 1e-9;
  double absolute = 1e-9;
  long max_steps = 1'000'000;
  // Where a state is of no use any more; asked after every step unless empty.
  std::function<bool(double t, const Eigen::VectorXd& x)> is_lost;
};

struct Integration {
  bool finished = false;
  std::string reason;  // why it did not finish
  bool lost = false;   // whether that is IntegrationOptions::is_lost
  // The state at every output time that was reached, in rows.
  Eigen::MatrixXd x;
  long steps = 0;  // accepted
};

// Integrates from x0 at t0 by the Runge-Kutta pair of Dormand and Prince (order
// 5, with the step's length from the error estimate) to each of `times`, which
// rise from t0. Rates that bend there (a signal recorded at these times) cost
// no steps. A state that is lost or does not stay finite, a step that would
// have to vanish and too many steps end it early: see `reason`.
Integration Integrate(const StateRate& rate, const Eigen::VectorXd& x0,
                      double t0, const std::vector<double>& times,
                      const IntegrationOptions& options = {});

}  // namespace armcal
