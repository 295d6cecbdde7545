#include "problems/weak_rows.h"

#include <algorithm>
#include <cmath>

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// phi and dphi/dt at the samples of a window, times dt (quadrature weights).
struct TestFunction {
  TestFunction(int steps, double dt) : phi(steps + 1), rate(steps + 1) {
    for (int k = 0; k <= steps; ++k) {
      const double s = 2.0 * k / steps - 1;
      const double u = 1 - s * s;
      phi[k] = u * u * u * u;
      rate[k] = -8 * s * u * u * u * 2 / (steps * dt);
    }
    rate /= phi.sum();
    phi /= phi.sum();
  }
  VectorXd phi, rate;
};

// Windows under way while samples pass: window w covers [w hop, w hop + steps].
class WindowSums {
 public:
  WindowSums(int steps, double dt) : steps_(steps), test_(steps, dt) {}

  void Start(long sample, int n, int m) {
    open_.push_back({sample, MatrixXd::Zero(n, m), VectorXd::Zero(n), true});
  }
  void Add(long sample, const MatrixXd& P, const MatrixXd& D,
           const VectorXd& tau, bool useless) {
    for (Window& w : open_) {
      const long k = sample - w.begin;
      w.U.noalias() -= test_.rate[k] * P + test_.phi[k] * D;
      w.Y += test_.phi[k] * tau;
      w.use = w.use && !useless;
    }
  }
  // Emits the window that ends at `sample`, if one does.
  void Emit(long sample, double time, const RowSink& sink) {
    if (open_.empty() || open_.front().begin + steps_ != sample) return;
    Window& w = open_.front();
    if (w.use) sink({time, std::move(w.U), std::move(w.Y)});
    open_.erase(open_.begin());
  }

 private:
  struct Window {
    long begin;
    MatrixXd U;
    VectorXd Y;
    bool use;
  };
  int steps_;
  TestFunction test_;
  std::vector<Window> open_;
};

}  // namespace

void ForEachWeakRow(const Trajectory& trajectory, const RowOptions& options,
                    MotionFunctions* functions, const RowSink& sink) {
  if (options.window_s > trajectory.size() * trajectory.dt) return;
  const int n = trajectory.num_joints();
  const int steps = std::max(
      8, static_cast<int>(std::lround(options.window_s / trajectory.dt)));
  const long hop = std::max(1, steps / options.hops);

  // Windows whose middle lies in the core.
  const long first = trajectory.first_index;
  const long core_begin = first + trajectory.core_begin;
  const long core_end = first + trajectory.core_end;
  long begin = std::max(first, core_begin - steps / 2);
  begin = (begin + hop - 1) / hop * hop;
  const long end = std::min(first + trajectory.size(), core_end + steps);

  WindowSums windows(steps, trajectory.dt);
  MatrixXd P, D;
  for (long sample = begin; sample < end; ++sample) {
    const int k = static_cast<int>(sample - first);
    if (sample % hop == 0 && sample + steps / 2 < core_end &&
        sample + steps < first + trajectory.size()) {
      windows.Start(sample, n, functions->size());
    }
    functions->Momentum(k, &P, &D);
    windows.Add(sample, P, D, trajectory.tau.row(k), functions->Useless(k));
    windows.Emit(sample, trajectory.time(k - steps / 2), sink);
  }
}

}  // namespace armcal
