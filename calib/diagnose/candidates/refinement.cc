#include "calib/diagnose/candidates/refinement.h"

#include <ceres/ceres.h>
#include <glog/logging.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <memory>

#include "calib/diagnose/candidates/block_covariance.h"
#include "calib/diagnose/candidates/bounded_covariance.h"
#include "calib/diagnose/candidates/joint_scatter.h"
#include "calib/diagnose/candidates/varied_effects.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMostIterations = 12;

// What effects leave of the torque, and forward differences of it as Ceres
// takes them, of several parameters at a time. Whatever was evaluated once is
// kept: solvers ask again for what they have accepted.
class ProjectedResidual : public ceres::CostFunction {
 public:
  ProjectedResidual(const GapScreen& screen, const VariedEffects& effects,
                    const GapRows& rows)
      : screen_(screen),
        effects_(effects),
        coordinates_(effects.coordinates()),
        rows_(rows) {
    const std::vector<GapCandidate> some = effects.At(VectorXd::Ones(size()));
    costs_as_much_together_ =
        coordinates_.size() < VariedEffects::kLanes &&
        std::any_of(some.begin(), some.end(), [](const GapCandidate& effect) {
          return !effect.effect->proportional &&
                 !effect.effect->larger_sizes.empty();
        });
    mutable_parameter_block_sizes()->push_back(size());
    set_num_residuals(static_cast<int>(
        screen.ResidualGiven(JointRows(screen.num_joints())).size()));
  }

  // The lowest of where a solver may start, whose torques may be there already.
  // Of those that are as low but for what ranking them rounds, it is the first
  // that is lowest.
  VectorXd Lowest(const std::vector<VectorXd>& starts,
                  const std::vector<JointRows>* around) const {
    constexpr double kRounding = 1e-6;
    if (starts.size() == 1) return starts[0];
    std::vector<JointRows> torques =
        around != nullptr ? *around : effects_.Torques(starts);
    CHECK_EQ(torques.size(), starts.size());
    Whiten(&torques);
    const VectorXd chi2 = screen_.Chi2Given(torques);
    double lowest = std::numeric_limits<double>::infinity();
    for (const double one : chi2) lowest = std::min(lowest, one);
    size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (size_t k = 0; k < starts.size(); ++k) {
      if (!(chi2[k] <= lowest + kRounding * std::abs(lowest))) continue;
      const double left = screen_.ResidualGiven(torques[k]).squaredNorm();
      if (!(left < least)) continue;
      least = left;
      best = k;
    }
    return starts[best];
  }

  VectorXd BaselineAt(const VectorXd& u) const {
    return screen_.BaselineGiven(Find(u).torque);
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    Point& point = Find(Eigen::Map<const VectorXd>(parameters[0], size()));
    if (!point.residual.allFinite()) return false;
    Eigen::Map<VectorXd>(residuals, num_residuals()) = point.residual;
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    if (point.jacobian.size() == 0) Differentiate(&point);
    if (!point.jacobian.allFinite()) return false;
    HoldAtBounds(point, jacobians[0]);
    return true;
  }

  // The residual and its slopes at a point, as if there were no bounds.
  const VectorXd& ResidualAt(const VectorXd& u) const {
    return Find(u).residual;
  }
  const RowMajorMatrix& SlopesAt(const VectorXd& u) const {
    Point& point = Find(u);
    if (point.jacobian.size() == 0) Differentiate(&point);
    return point.jacobian;
  }

 private:
  struct Point {
    VectorXd u;
    JointRows torque;  // whitened
    VectorXd residual;
    RowMajorMatrix jacobian;        // empty: not asked for yet
    std::vector<JointRows> around;  // torques of its neighbours, likewise
  };

  int size() const { return static_cast<int>(coordinates_.size()); }

  // At several points, whitened.
  std::vector<JointRows> Torques(const std::vector<VectorXd>& points) const {
    std::vector<JointRows> torques = effects_.Torques(points);
    Whiten(&torques);
    return torques;
  }
  void Whiten(std::vector<JointRows>* torques) const {
    tbb::parallel_for(size_t{0}, torques->size(), [&](size_t k) {
      (*torques)[k] = WhitenEach(rows_, (*torques)[k]);
    });
  }

  // Residuals and jacobians of what was evaluated before are kept, by value:
  // solvers ask again for what they have accepted, and a torque is a
  // simulation. Where a point costs about as much alone as with its neighbours,
  // those are evaluated with it.
  Point& Find(const VectorXd& u) const {
    for (Point& point : points_) {
      if (point.u == u) return point;
    }
    std::vector<VectorXd> all = {u};
    if (costs_as_much_together_) {
      for (const Neighbour& next : NeighboursOf(u)) all.push_back(next.u);
    }
    std::vector<JointRows> torques = Torques(all);
    points_.push_back(
        {u, torques[0], screen_.ResidualGiven(torques[0]), {}, {}});
    torques.erase(torques.begin());
    points_.back().around = std::move(torques);
    return points_.back();
  }

  // Where differences are taken, a coordinate each.
  struct Neighbour {
    VectorXd u;
    double step;
  };
  std::vector<Neighbour> NeighboursOf(const VectorXd& u) const {
    constexpr double kRelativeStep = 1e-4;
    const double least =
        std::sqrt(std::numeric_limits<double>::epsilon());  // Ceres'
    std::vector<Neighbour> neighbours;
    for (Eigen::Index k = 0; k < u.size(); ++k) {
      neighbours.push_back(
          {u, std::max(least, kRelativeStep * std::abs(u[k]))});
      neighbours.back().u[k] += neighbours.back().step;
    }
    return neighbours;
  }

  // Forward differences of the residual over the neighbours' steps, like those
  // of Ceres, whose torques may be there already.
  void Differentiate(Point* point) const {
    const std::vector<Neighbour> neighbours = NeighboursOf(point->u);
    if (point->around.empty()) {
      std::vector<VectorXd> all;
      for (const Neighbour& next : neighbours) all.push_back(next.u);
      point->around = Torques(all);
    }
    point->jacobian.resize(num_residuals(), point->u.size());
    for (Eigen::Index k = 0; k < point->u.size(); ++k) {
      point->jacobian.col(k) =
          (screen_.ResidualGiven(point->around[k]) - point->residual) *
          (1 / neighbours[k].step);
    }
  }

  // A parameter at its bound that would lower the cost only beyond it stays
  // there, so that the others' step is as if it were constant: the projected
  // Newton method (Bertsekas 1982). Ceres by itself takes the step of all and
  // moves it into the bounds, which may lead upwards however short it is.
  void HoldAtBounds(const Point& point, double* jacobian) const {
    const RowMajorMatrix& J = point.jacobian;
    Eigen::Map<RowMajorMatrix> held(jacobian, J.rows(), J.cols());
    held = J;
    for (Eigen::Index k = 0; k < J.cols(); ++k) {
      const double slope = J.col(k).dot(point.residual);
      if (coordinates_[k].IsHeld(point.u[k], slope)) held.col(k).setZero();
    }
  }

  const GapScreen& screen_;
  const VariedEffects& effects_;
  const std::vector<Coordinate>& coordinates_;
  const GapRows& rows_;
  // Whether a point takes about as long as with its neighbours, in lanes.
  bool costs_as_much_together_;
  mutable std::deque<Point> points_;
};

void SetBounds(const std::vector<Coordinate>& coordinates, double* u,
               ceres::Problem* problem) {
  for (size_t k = 0; k < coordinates.size(); ++k) {
    const Coordinate& c = coordinates[k];
    const int index = static_cast<int>(k);
    if (std::isfinite(c.low)) {
      u[k] = std::max(u[k], c.Inverse(c.low));
      problem->SetParameterLowerBound(u, index, c.Inverse(c.low));
    }
    if (std::isfinite(c.high)) {
      u[k] = std::min(u[k], c.Inverse(c.high));
      problem->SetParameterUpperBound(u, index, c.Inverse(c.high));
    }
  }
}

// Coordinates of effects of the whole robot.
std::vector<int> OfAllJoints(const std::vector<GapCandidate>& effects,
                             const std::vector<Coordinate>& coordinates) {
  std::vector<int> which;
  for (size_t k = 0; k < coordinates.size(); ++k) {
    const bool is_of_all = effects[coordinates[k].effect].joint < 0;
    if (is_of_all) which.push_back(static_cast<int>(k));
  }
  return which;
}

// From coordinates to all parameters one after the other.
MatrixXd Spread(const std::vector<GapCandidate>& effects,
                const std::vector<Coordinate>& coordinates,
                const MatrixXd& covariance) {
  std::vector<int> begin = {0};
  for (const GapCandidate& effect : effects) {
    begin.push_back(begin.back() + static_cast<int>(effect.p.size()));
  }
  MatrixXd all = MatrixXd::Zero(begin.back(), begin.back());
  for (size_t a = 0; a < coordinates.size(); ++a) {
    for (size_t b = 0; b < coordinates.size(); ++b) {
      all(begin[coordinates[a].effect] + coordinates[a].parameter,
          begin[coordinates[b].effect] + coordinates[b].parameter) =
          covariance(a, b);
    }
  }
  return all;
}

}  // namespace

// All parameters of the effects together, linear or not, by least squares of
// what they leave once the baseline has taken what it can (ResidualGiven):
// variable projection (Golub and Pereyra 1973), whose baseline is eliminated at
// every point and whose jacobian is of the projected residual. Parameters are
// held within their bounds by the solver. delta_chi2 is chi squared without the
// effects less twice Ceres' final cost. Where the torque is not finite at the
// start (friction that heats its joint and grows with its warmth) nothing is
// fitted, and the effects explain less than none.
RefinedEffects RefineEffects(const GapScreen& screen,
                             const GapBaseline& baseline,
                             const MotionScale& scale,
                             const std::vector<GapCandidate>& effects, int only,
                             GapData* data,
                             const std::vector<JointRows>* around) {
  RefinedEffects refined;
  const VariedEffects varied(baseline, scale, effects, only, *data);
  const std::vector<Coordinate>& coordinates = varied.coordinates();
  auto owned =
      std::make_unique<ProjectedResidual>(screen, varied, data->rows());
  ProjectedResidual* const cost = owned.get();
  VectorXd u = cost->Lowest(varied.Starts(), around);
  if (!cost->ResidualAt(u).allFinite()) {
    const auto size = static_cast<Eigen::Index>(coordinates.size());
    refined.effects = effects;
    refined.covariance =
        Spread(effects, coordinates, MatrixXd::Zero(size, size));
    refined.baseline = screen.BaselineGiven(JointRows(screen.num_joints()));
    refined.delta_chi2 = -std::numeric_limits<double>::infinity();
    return refined;
  }
  ceres::Problem problem;
  problem.AddResidualBlock(owned.release(), nullptr, u.data());
  SetBounds(coordinates, u.data(), &problem);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = kMostIterations;
  options.function_tolerance = 1e-5;
  // Where there are bounds Ceres searches along every projected step as well,
  // with a gradient a trial: two thirds of the evaluations, for the same steps.
  options.max_num_line_search_step_size_iterations = 0;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  refined.effects = varied.At(u);
  const RowMajorMatrix& J = cost->SlopesAt(u);
  const VectorXd& left = cost->ResidualAt(u);
  const MatrixXd of_blocks =
      BlockCovariance(J, left, BlocksOfRows(data->rows()));
  refined.covariance =
      Spread(effects, coordinates,
             BoundedCovariance(
                 WidenByJoints(of_blocks, J, left, JointsOfRows(data->rows()),
                               OfAllJoints(effects, coordinates)),
                 J.transpose() * left, coordinates, u));
  refined.baseline = cost->BaselineAt(u);
  refined.delta_chi2 =
      screen.ResidualGiven(JointRows(screen.num_joints())).squaredNorm() -
      2 * summary.final_cost;
  return refined;
}

std::vector<JointRows> TorquesAround(const GapBaseline& baseline,
                                     const MotionScale& scale,
                                     const std::vector<GapCandidate>& effects,
                                     int only, const GapData& data) {
  const VariedEffects varied(baseline, scale, effects, only, data);
  return varied.Torques(varied.Starts());
}

}  // namespace armcal
