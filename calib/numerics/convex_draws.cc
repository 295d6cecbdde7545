#include "calib/numerics/convex_draws.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <random>

#include "calib/numerics/posterior.h"
#include "model/text/uniform_draw.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// The share of a standard normal distribution above x.
double Above(double x) { return std::erfc(x / std::sqrt(2.0)) / 2; }

// A draw from a standard normal distribution between two numbers: where its
// distribution function is as far between those of the ends as a uniform draw
// says, found by halving. Ends above 0 are mirrored, as that function has
// digits in its lower tail only.
double NormalBetween(double least, double most, std::mt19937_64* random) {
  constexpr int kHalvings = 60;
  constexpr double kFar = 37;  // beyond it doubles have no share left
  if (least > 0) return -NormalBetween(-most, -least, random);
  least = std::max(least, -kFar), most = std::min(most, kFar);
  if (!(least < most)) return most;
  const double below = Above(-least), share = Above(-most) - below;
  const double target = below + UniformDraw(random) * share;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = (least + most) / 2;
    (Above(-middle) < target ? least : most) = middle;
  }
  return (least + most) / 2;
}

// mean + F u, u standard normal but for the set.
class Chain {
 public:
  Chain(const VectorXd& mean, const MatrixXd& covariance,
        const RangeOnLine& range, uint64_t seed)
      : F_(SquareRoot(covariance).transpose()),
        range_(range),
        random_(seed),
        at_(mean),
        u_(VectorXd::Zero(F_.cols())),
        axes_(MatrixXd::Identity(F_.cols(), F_.cols())) {}

  // From another point, whose u is solved for in coordinates of variance 1.
  void StartAt(const VectorXd& start, const VectorXd& stddev) {
    const auto unscale = stddev.cwiseInverse().asDiagonal();
    u_ = MatrixXd(unscale * F_)
             .completeOrthogonalDecomposition()
             .solve(unscale * (start - at_));
    at_ = start;
  }

  // Moves along every axis.
  void Sweep() {
    for (Eigen::Index k = 0; k < axes_.cols(); ++k) {
      const VectorXd along = F_ * axes_.col(k);
      const double here = axes_.col(k).dot(u_);
      const LineRange ends = range_(at_, along);
      const double to =
          NormalBetween(here + ends.least, here + ends.most, &random_);
      u_ += (to - here) * axes_.col(k);
      at_ += (to - here) * along;
    }
  }
  // The axes of what this many further sweeps visit become the lines.
  void FindAxes(int sweeps) {
    MatrixXd visited(u_.size(), sweeps);
    for (int s = 0; s < sweeps; ++s) Sweep(), visited.col(s) = u_;
    visited.colwise() -= visited.rowwise().mean().eval();
    axes_ =
        Eigen::SelfAdjointEigenSolver<MatrixXd>(visited * visited.transpose())
            .eigenvectors();
  }
  const VectorXd& at() const { return at_; }

 private:
  const MatrixXd F_;
  const RangeOnLine& range_;
  std::mt19937_64 random_;
  VectorXd at_, u_;
  MatrixXd axes_;
};

}  // namespace

MatrixXd DrawWithin(const VectorXd& mean, const MatrixXd& covariance,
                    const RangeOnLine& range, int count, uint64_t seed,
                    const VectorXd& start) {
  Chain chain(mean, covariance, range, seed);
  if (start.size() > 0) {
    chain.StartAt(start, covariance.diagonal().cwiseSqrt());
  }
  const int unknowns = static_cast<int>(mean.size());
  // In a narrow set steps are first as short as it is narrow. Those of s sweeps
  // spread sqrt(s) times as far along it as across it, which tells its axis to
  // so much, and steps along that one are longer by as much: ten times over, so
  // that a set 10^-6 of the deviation wide is walked through in the end.
  constexpr int kRounds = 10;
  for (int round = 0; round < kRounds; ++round) {
    chain.FindAxes(20 + 4 * unknowns);
  }
  constexpr int kBetween = 30;  // sweeps, so that draws are independent
  MatrixXd draws(unknowns, count);
  for (int k = 0; k < count; ++k) {
    for (int s = 0; s < kBetween; ++s) chain.Sweep();
    draws.col(k) = chain.at();
  }
  return draws;
}

}  // namespace armcal
