#include "calib/diagnose/candidates/refinement.h"

#include <ceres/ceres.h>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

#include "calib/diagnose/candidates/bounded_covariance.h"
#include "calib/diagnose/candidates/coordinates.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMostIterations = 12;
// Springs that are followed together: doubles in the widest register.
constexpr size_t kLanes = 8;

// What effects leave of the torque, and forward differences of it as Ceres
// takes them, of several parameters at a time. Whatever was evaluated once is
// kept: solvers ask again for what they have accepted.
class ProjectedResidual : public ceres::CostFunction {
 public:
  ProjectedResidual(const GapScreen& screen, const GapBaseline& baseline,
                    const MotionScale& scale, std::vector<GapCandidate> effects,
                    std::vector<Coordinate> coordinates, const GapData& data)
      : screen_(screen),
        baseline_(baseline),
        scale_(scale),
        effects_(std::move(effects)),
        coordinates_(std::move(coordinates)),
        data_(data),
        costs_as_much_together_(
            coordinates_.size() < kLanes &&
            std::any_of(effects_.begin(), effects_.end(),
                        [](const GapCandidate& effect) {
                          return !effect.effect->larger_sizes.empty();
                        })),
        torques_(data.torques()) {
    mutable_parameter_block_sizes()->push_back(
        static_cast<int>(coordinates_.size()));
    set_num_residuals(static_cast<int>(
        screen.ResidualGiven(JointRows(screen.num_joints())).size()));
  }

  std::vector<GapCandidate> At(const VectorXd& u) const {
    std::vector<GapCandidate> effects = effects_;
    for (size_t k = 0; k < coordinates_.size(); ++k) {
      const Coordinate& c = coordinates_[k];
      effects[c.effect].p[c.parameter] = c.Value(u[k]);
    }
    return effects;
  }

  // The lowest of a grid around what a search found. What rings has a minimum
  // wherever its oscillation is in phase with the residual for a while, and
  // only one where it stays so; a solver ends in the one that it starts in. The
  // grid is of each linear size, from half to twice of it, by the low end of
  // each shape that is refined.
  VectorXd LowestAround(const VectorXd& u) const {
    std::vector<VectorXd> points = {u};
    for (const Coordinate& shape : coordinates_) {
      if (ParameterOf(shape).search != EffectParameter::Search::kRefined) {
        continue;
      }
      for (const Coordinate& size : coordinates_) {
        if (size.effect == shape.effect &&
            ParameterOf(size).search == EffectParameter::Search::kLinear) {
          AddAround(size, shape, &points);
        }
      }
    }
    double lowest = std::numeric_limits<double>::infinity();
    VectorXd best = u;
    if (points.size() == 1) return best;
    const std::vector<JointRows> torques = Torques(points);
    for (size_t k = 0; k < points.size(); ++k) {
      const double left = screen_.ResidualGiven(torques[k]).squaredNorm();
      if (!(left < lowest)) continue;
      lowest = left;
      best = points[k];
    }
    return best;
  }

  VectorXd BaselineAt(const VectorXd& u) const {
    return screen_.BaselineGiven(Find(u).torque);
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const auto size = static_cast<Eigen::Index>(coordinates_.size());
    Point& point = Find(Eigen::Map<const VectorXd>(parameters[0], size));
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

  const EffectParameter& ParameterOf(const Coordinate& c) const {
    return effects_[c.effect].effect->parameters[c.parameter];
  }

  // From half of a size to twice of it, for values of a shape.
  void AddAround(const Coordinate& size, const Coordinate& shape,
                 std::vector<VectorXd>* points) const {
    constexpr int kSteps = 12;  // to either side
    const VectorXd u = points->front();
    for (const double share : {0., .01, .03, .1, .3}) {
      for (int k = -kSteps; k <= kSteps; ++k) {
        VectorXd at = u;
        at[&size - coordinates_.data()] = size.Inverse(
            size.centre * std::pow(2, k / static_cast<double>(kSteps)));
        at[&shape - coordinates_.data()] =
            shape.Inverse(shape.low + share * (shape.high - shape.low));
        points->push_back(at);
      }
    }
  }

  // At several points, whitened. As many at a time as springs have lanes, on
  // all threads.
  std::vector<JointRows> Torques(const std::vector<VectorXd>& points) const {
    std::vector<JointRows> torques(points.size());
    tbb::parallel_for(
        tbb::blocked_range<size_t>(0, points.size(), kLanes),
        [&](const tbb::blocked_range<size_t>& range) {
          std::vector<std::vector<GapCandidate>> sets;
          for (size_t k = range.begin(); k < range.end(); ++k) {
            sets.push_back(At(points[k]));
          }
          const std::vector<JointRows> some = EffectTorques(
              baseline_, scale_, sets, data_.rows(), &torques_.local());
          for (size_t k = range.begin(); k < range.end(); ++k) {
            torques[k] = WhitenEach(data_.rows(), some[k - range.begin()]);
          }
        },
        tbb::simple_partitioner());
    return torques;
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
  const GapBaseline& baseline_;
  const MotionScale& scale_;
  std::vector<GapCandidate> effects_;
  std::vector<Coordinate> coordinates_;
  const GapData& data_;
  // Whether a point takes about as long as with its neighbours, in lanes.
  bool costs_as_much_together_;
  mutable tbb::enumerable_thread_specific<std::vector<RecordedTorque>> torques_;
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

// What effects with these parameters add to the torque of these logs.
JointRows EffectTorque(const GapBaseline& baseline, const MotionScale& scale,
                       const std::vector<GapCandidate>& effects,
                       GapData* data) {
  return EffectTorques(baseline, scale, {effects}, data->rows(),
                       data->mutable_torques())[0];
}

// The torque of several sets of effects along the same recorded motion,
// evaluated together (RecordedTorque::Changes). What happened once is in its
// own log only.
std::vector<JointRows> EffectTorques(
    const GapBaseline& baseline, const MotionScale& scale,
    const std::vector<std::vector<GapCandidate>>& sets, const GapRows& rows,
    std::vector<RecordedTorque>* torques) {
  std::vector<JointRows> thin(sets.size(), JointRows(rows.num_joints()));
  std::vector<JointRows*> to;
  for (JointRows& one : thin) to.push_back(&one);
  for (size_t i = 0; i < rows.segments().size(); ++i) {
    const int s = static_cast<int>(i), log = rows.segments()[i].log;
    std::vector<SimulatedRobot> changed(sets.size());
    for (size_t k = 0; k < sets.size(); ++k) {
      changed[k].robot = baseline.robot();
      for (const GapCandidate& effect : sets[k]) {
        if (!effect.IsIn(log)) continue;
        effect.effect->apply({&baseline.robot(), effect.joint, &scale},
                             effect.p, &changed[k]);
      }
    }
    AddThinned(rows, s, (*torques)[i].Changes(changed), to);
  }
  return thin;
}

JointRows WhitenEach(const GapRows& rows, const JointRows& thin) {
  JointRows white(thin.size());
  for (size_t j = 0; j < thin.size(); ++j) {
    if (thin[j].size() == 0) continue;
    white[j] = rows.Whiten(static_cast<int>(j), thin[j]);
  }
  return white;
}

// All parameters of the effects together, linear or not, by least squares of
// what they leave once the baseline has taken what it can (ResidualGiven):
// variable projection (Golub and Pereyra 1973), whose baseline is eliminated at
// every point and whose jacobian is of the projected residual. Parameters are
// held within their bounds by the solver. delta_chi2 is chi squared without the
// effects less twice Ceres' final cost.
RefinedEffects RefineEffects(const GapScreen& screen,
                             const GapBaseline& baseline,
                             const MotionScale& scale,
                             const std::vector<GapCandidate>& effects, int only,
                             GapData* data) {
  RefinedEffects refined;
  refined.effects = effects;
  const std::vector<Coordinate> coordinates =
      ListCoordinates(baseline, scale, effects, only);
  const int size = static_cast<int>(coordinates.size());
  auto* cost = new ProjectedResidual(screen, baseline, scale, effects,
                                     coordinates, *data);
  VectorXd u = cost->LowestAround(VectorXd::Ones(size));
  ceres::Problem problem;
  problem.AddResidualBlock(cost, nullptr, u.data());
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
  refined.effects = cost->At(u);
  refined.covariance =
      Spread(effects, coordinates,
             BoundedCovariance(cost->SlopesAt(u), cost->ResidualAt(u),
                               coordinates, u));
  refined.baseline = cost->BaselineAt(u);
  refined.delta_chi2 =
      screen.ResidualGiven(JointRows(screen.num_joints())).squaredNorm() -
      2 * summary.final_cost;
  return refined;
}

}  // namespace armcal
