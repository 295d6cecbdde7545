#include "calib/refine/robot_draws.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <limits>
#include <map>

#include "calib/numerics/convex_draws.h"
#include "calib/refine/robot_parameters.h"
#include "model/robot/inertial_parameters.h"
#include "model/text/format.h"

namespace armcal {
namespace {

using Eigen::Matrix4d;
using Eigen::VectorXd;

// Narrows `range` to where numbers at + t * along are positive.
void KeepPositive(double at, double along, LineRange* range) {
  if (along < 0) range->most = std::min(range->most, at / -along);
  if (along > 0) range->least = std::max(range->least, -at / along);
}

// Values of parameters at which a robot can exist.
class PossibleRobots {
 public:
  // `drawn`: which of `all` change. Of each link it is noted which of these its
  // ten parameters are; the others are held at the estimate.
  PossibleRobots(const Robot& robot, const std::vector<PhysicalParameter>& all,
                 const std::vector<int>& drawn) {
    std::map<std::string, int> places;
    for (size_t k = 0; k < drawn.size(); ++k) {
      const std::string& name = all[drawn[k]].name;
      places[name] = static_cast<int>(k);
      if (IsNeverNegative(name)) positive_.push_back(static_cast<int>(k));
    }
    std::map<std::string, double> values;
    for (const PhysicalParameter& p : all) values[p.name] = p.value;
    for (const Link& link : robot.links) {
      LinkPlaces& places_of = links_.emplace_back();
      for (int k = 0; k < 10; ++k) {
        const std::string name = link.name + "." + InertialName(k);
        places_of.held[k] = values.at(name);
        const auto place = places.find(name);
        places_of.at[k] = place == places.end() ? -1 : place->second;
      }
    }
  }

  // The part of a line at + t along on which a robot can exist. A link's
  // pseudo-inertia is C (1 + t D) C' with C C' the one at `at` and D = C^-1
  // P(along) C^-T, positive as long as 1 + t lambda > 0 for all eigenvalues
  // lambda of D (docs/theory.md, 3). The set is convex, so that there is one
  // range.
  LineRange OnLine(const VectorXd& at, const VectorXd& along) const {
    constexpr double kInside = 1 - 1e-9;  // of rounding at the ends
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    LineRange range = {-kInfinity, kInfinity};
    for (const int k : positive_) KeepPositive(at[k], along[k], &range);
    for (const LinkPlaces& link : links_) {
      const Vector10d change = link.Of(along, Vector10d::Zero());
      if (change.isZero(0)) continue;
      const Eigen::LLT<Matrix4d> factor(PseudoInertia(link.Of(at, link.held)));
      const Matrix4d half =
          factor.matrixL().solve(PseudoInertia(change)).transpose();
      const Eigen::SelfAdjointEigenSolver<Matrix4d> relative(
          Matrix4d(factor.matrixL().solve(half)), Eigen::EigenvaluesOnly);
      for (const double lambda : relative.eigenvalues()) {
        KeepPositive(1, lambda, &range);
      }
    }
    return {kInside * range.least, kInside * range.most};
  }

 private:
  struct LinkPlaces {
    std::array<int, 10> at;  // -1: held
    Vector10d held;
    Vector10d Of(const VectorXd& drawn, const Vector10d& others) const {
      Vector10d V = others;
      for (int k = 0; k < 10; ++k) {
        if (at[k] >= 0) V[k] = drawn[at[k]];
      }
      return V;
    }
  };

  std::vector<LinkPlaces> links_;
  std::vector<int> positive_;
};

}  // namespace

// Hit-and-run (Smith 1984; Belisle, Romeijn & Smith 1993) by DrawWithin.
// Rejection, drawing Gaussians and dropping impossible ones, would hardly ever
// hit where a link that only the file tells is thin.
RobotDraws DrawRobots(const NonlinearCalibration& calibrated, int count) {
  constexpr uint64_t kSeed = 1;
  const std::vector<PhysicalParameter>& all = calibrated.parameters;
  std::vector<int> drawn;
  VectorXd estimate(all.size());
  for (size_t k = 0; k < all.size(); ++k) {
    estimate[static_cast<Eigen::Index>(k)] = all[k].value;
    if (calibrated.covariance(k, k) > 0) drawn.push_back(static_cast<int>(k));
  }
  const PossibleRobots possible(calibrated.nominal, all, drawn);
  const Eigen::MatrixXd draws = DrawWithin(
      estimate(drawn), calibrated.covariance(drawn, drawn),
      [&possible](const VectorXd& at, const VectorXd& along) {
        return possible.OnLine(at, along);
      },
      count, kSeed);
  RobotDraws result;
  for (const PhysicalParameter& p : all) result.names.push_back(p.name);
  result.values = estimate.replicate(1, count);
  result.values(drawn, Eigen::all) = draws;
  for (int r = 0; r < count; ++r) {
    RobotParameters robot(calibrated.nominal);
    for (size_t k = 0; k < all.size(); ++k) {
      if (robot.Has(all[k].name)) {
        robot.Set(all[k].name, result.values(static_cast<Eigen::Index>(k), r));
      }
    }
    result.robots.push_back(robot.Apply());
  }
  return result;
}

std::string RobotDrawsCsv(const RobotDraws& draws) {
  std::string text;
  for (const std::string& name : draws.names) {
    text += (text.empty() ? "\"" : ",\"") + name + "\"";
  }
  text += "\n";
  for (const VectorXd& values : draws.values.colwise()) {
    for (Eigen::Index k = 0; k < values.size(); ++k) {
      text += Format(k > 0 ? ",%.17g" : "%.17g", values[k]);
    }
    text += "\n";
  }
  return text;
}

}  // namespace armcal
