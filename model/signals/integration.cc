#include "model/signals/integration.h"

#include <glog/logging.h>

#include <algorithm>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <cmath>
#include <utility>

namespace armcal {
namespace {

namespace odeint = boost::numeric::odeint;
using Eigen::VectorXd;
using State = std::vector<double>;  // odeint resizes it by itself

bool AllFinite(const State& x) {
  return std::all_of(x.begin(), x.end(),
                     [](double value) { return std::isfinite(value); });
}

class Integrator {
 public:
  Integrator(const StateRate& rate, const VectorXd& x0, double t0,
             const IntegrationOptions& options)
      : rate_(rate),
        options_(options),
        stepper_(odeint::make_controlled(options.absolute, options.relative,
                                         odeint::runge_kutta_dopri5<State>())),
        x_(x0.begin(), x0.end()),
        t_(t0) {}

  const State& state() const { return x_; }
  long steps() const { return steps_; }
  bool lost() const { return lost_; }

  // Empty, or why it does not get to `end`.
  std::string AdvanceTo(double end) {
    while (t_ < end) {
      // The step that is left may be shorter than the one that would do.
      const double left = end - t_;
      const bool last = step_ >= left * (1 - 1e-9);
      const double taken = last ? left : step_;
      if (!TryStep(taken)) {
        if (!(step_ > 1e-14 * (1 + std::abs(t_)))) return StuckText();
        if (++tries_ > options_.max_steps) return TooManyText();
        continue;
      }
      if (last) t_ = end;
      if (++steps_ > options_.max_steps) return TooManyText();
      lost_ = IsLost();
      if (lost_) return "lost at t = " + std::to_string(t_) + " s";
    }
    return "";
  }

 private:
  bool IsLost() {
    if (!options_.is_lost) return false;
    state_ = Eigen::Map<const VectorXd>(x_.data(), x_.size());
    return options_.is_lost(t_, state_);
  }

  // Takes a step or makes the next one shorter. The error estimate of a step
  // that is not finite compares as small, so that odeint would take it.
  bool TryStep(double dt) {
    const State before = x_;
    const double t_before = t_;
    double next = dt;
    const auto system = [this](const State& x, State& dxdt, double t) {
      state_ = Eigen::Map<const VectorXd>(x.data(), x.size());
      derivative_.resize(state_.size());
      rate_(t, state_, &derivative_);
      dxdt.assign(derivative_.begin(), derivative_.end());
    };
    const bool taken =
        stepper_.try_step(system, x_, t_, next) == odeint::success;
    if (taken && !AllFinite(x_)) {
      x_ = before;
      t_ = t_before;
      stepper_.reset();
      step_ = 0.1 * dt;
      return false;
    }
    if (!std::isfinite(next)) next = 0.1 * dt;
    // A step cut short by an output time says little of the next one's length.
    step_ = taken && dt < step_ ? std::max(step_, next) : next;
    return taken;
  }

  std::string StuckText() const {
    return "the state does not stay finite after t = " + std::to_string(t_) +
           " s";
  }
  std::string TooManyText() const {
    return "more than " + std::to_string(options_.max_steps) +
           " steps up to t = " + std::to_string(t_) + " s";
  }

  const StateRate& rate_;
  IntegrationOptions options_;
  odeint::controlled_runge_kutta<odeint::runge_kutta_dopri5<State>> stepper_;
  State x_;
  double t_;
  double step_ = 1e-3;  // s; adapts itself
  long steps_ = 0;
  long tries_ = 0;  // steps that were not taken
  bool lost_ = false;
  VectorXd state_, derivative_;
};

}  // namespace

Integration Integrate(const StateRate& rate, const VectorXd& x0, double t0,
                      const std::vector<double>& times,
                      const IntegrationOptions& options) {
  CHECK(options.relative > 0 || options.absolute > 0);
  CHECK(std::is_sorted(times.begin(), times.end()));
  CHECK(times.empty() || times.front() >= t0);
  Integration result;
  result.x.resize(times.size(), x0.size());
  Integrator integrator(rate, x0, t0, options);
  Eigen::Index row = 0;
  for (const double end : times) {
    result.reason = integrator.AdvanceTo(end);
    if (!result.reason.empty()) break;
    result.x.row(row++) =
        Eigen::Map<const VectorXd>(integrator.state().data(), x0.size());
  }
  result.x.conservativeResize(row, Eigen::NoChange);
  result.steps = integrator.steps();
  result.lost = integrator.lost();
  result.finished = result.reason.empty();
  return result;
}

}  // namespace armcal
