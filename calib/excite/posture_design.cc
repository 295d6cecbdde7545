#include "calib/excite/posture_design.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "calib/poses/fit.h"
#include "model/robot/kinematics.h"
#include "model/text/uniform_draw.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// A target off every axis of the tool.
const Eigen::Vector3d kTarget(.08, .05, .1);  // m, in T

MatrixXd RandomPostures(const PostureOptions& options, int count,
                        std::uint64_t seed) {
  constexpr int kMostTries = 200;  // for each that is clear
  std::mt19937_64 random(seed);
  MatrixXd q(count, options.lower.size());
  int k = 0;
  for (int tries = 0; k < count && tries < kMostTries * count; ++tries) {
    for (Eigen::Index j = 0; j < q.cols(); ++j) {
      const double share = UniformDraw(&random);
      q(k, j) =
          options.lower[j] + share * (options.upper[j] - options.lower[j]);
    }
    if (options.workspace.Clearance(q.row(k)) >= 0) ++k;
  }
  if (k < count) {
    throw std::invalid_argument(
        "hardly any posture is clear of the floor and obstacles, with the tool "
        "in its box");
  }
  return q;
}

PoseMeasurements Predicted(const Robot& robot, PoseInstrument instrument,
                           const MatrixXd& q) {
  PoseMeasurements measured;
  measured.q = q;
  if (instrument == PoseInstrument::kTarget) {
    measured.targets.assign(1, MatrixXd(q.rows(), 3));
  } else {
    measured.poses.resize(q.rows(), 7);
  }
  for (Eigen::Index k = 0; k < q.rows(); ++k) {
    measured.row.push_back(static_cast<long>(k) + 2);
    const Eigen::Isometry3d X_WT = ToolPose(robot, q.row(k));
    if (instrument == PoseInstrument::kTarget) {
      measured.targets[0].row(k) = X_WT * kTarget;
    } else {
      const Eigen::Quaterniond turn(X_WT.linear());
      measured.poses.row(k) << X_WT.translation().transpose(), turn.w(),
          turn.vec().transpose();
    }
  }
  return measured;
}

// What postures tell of the unknowns.
class Postures {
 public:
  // Unknowns are those that `q`, rich enough, tell apart.
  Postures(const Robot& robot, const PostureOptions& options, const MatrixXd& q)
      : robot_(robot), options_(options) {
    const PoseMeasurements measured = Predicted(robot, options.instrument, q);
    const PoseCalibrationOptions pose_options = Options();
    const PoseFit fit(robot, measured, pose_options);
    const std::vector<bool> free = fit.HoldUnseen(
        fit.Wanted(RefineGeometry::kAll), fit.AllRows(), At(fit), nullptr);
    const std::vector<std::string> names = fit.geometry().Names();
    const std::vector<std::string> units = fit.geometry().Units();
    for (int k = 0; k < fit.geometry().size(); ++k) {
      if (!free[k]) continue;
      if (!ArmGeometry::IsBase(k) && !fit.geometry().IsTool(k)) {
        wanted_.push_back(static_cast<int>(columns_.size()));
        names_.push_back(names[k]);
        units_.push_back(units[k]);
      }
      columns_.push_back(k);
      prior_.push_back(fit.PriorOf(k));
    }
    const int others = PoseUnknowns::NumOther(measured);
    for (int k = 0; k < others; ++k) {
      columns_.push_back(fit.geometry().size() + k);
      prior_.push_back(0);
    }
  }

  // Their equations, in units of the noise.
  std::vector<MatrixXd> Rows(const MatrixXd& q) const {
    const PoseMeasurements measured = Predicted(robot_, options_.instrument, q);
    const PoseCalibrationOptions pose_options = Options();
    const PoseFit fit(robot_, measured, pose_options);
    const MatrixXd J =
        fit.Jacobian(fit.AllRows(), At(fit))(Eigen::all, columns_);
    const int width = fit.Coordinates();
    std::vector<MatrixXd> rows;
    for (Eigen::Index k = 0; k < q.rows(); ++k) {
      rows.emplace_back(J.middleRows(k * width, width));
      // The fit's own idea of the noise gives way to what is asked for.
      rows.back().topRows(3) *= fit.noise().position / options_.noise.position;
      rows.back().bottomRows(width - 3) *=
          fit.noise().rotation / options_.noise.rotation;
    }
    return rows;
  }

  const std::vector<int>& wanted() const { return wanted_; }
  const std::vector<std::string>& names() const { return names_; }
  const std::vector<std::string>& units() const { return units_; }
  // Of the priors; what has none gets one that says next to nothing.
  MatrixXd Prior() const {
    VectorXd diagonal(prior_.size());
    for (size_t k = 0; k < prior_.size(); ++k) {
      const double stddev = prior_[k] > 0 ? prior_[k] : 10;
      diagonal[static_cast<Eigen::Index>(k)] = 1 / (stddev * stddev);
    }
    return diagonal.asDiagonal();
  }
  // By which standard deviations are measured.
  VectorXd Scale() const {
    VectorXd scale(wanted_.size());
    for (size_t k = 0; k < wanted_.size(); ++k) {
      scale[static_cast<Eigen::Index>(k)] = prior_[wanted_[k]];
    }
    return scale;
  }

 private:
  PoseCalibrationOptions Options() const {
    PoseCalibrationOptions options;
    options.prior_length = options_.prior_length;
    options.prior_angle = options_.prior_angle;
    return options;
  }
  PoseUnknowns At(const PoseFit& fit) const {
    PoseUnknowns at{fit.geometry().Values(), VectorXd(0)};
    if (options_.instrument == PoseInstrument::kTarget) at.other = kTarget;
    return at;
  }

  const Robot& robot_;
  const PostureOptions& options_;
  std::vector<int> columns_, wanted_;
  std::vector<double> prior_;
  std::vector<std::string> names_, units_;
};

// A set of postures and the covariance that it leaves.
class Choice {
 public:
  Choice(const Postures& postures, ExcitationCriterion criterion)
      : postures_(postures),
        criterion_(criterion),
        scale_(postures.Scale()),
        information_(postures.Prior()) {
    Invert();
  }

  void Add(const MatrixXd& rows) { Change(rows, 1); }
  void Remove(const MatrixXd& rows) { Change(rows, -1); }
  // The criterion with a posture added; as D, only its part that changes.
  double With(const MatrixXd& rows) const {
    const MatrixXd reach = covariance_ * rows.transpose();
    const MatrixXd middle =
        MatrixXd::Identity(rows.rows(), rows.rows()) + rows * reach;
    const Eigen::LLT<MatrixXd> factor(middle);
    if (criterion_ == ExcitationCriterion::kD) {
      return -factor.matrixLLT().diagonal().array().log().sum();
    }
    const MatrixXd drop = factor.matrixL().solve(reach.transpose());
    return OfVariances(covariance_.diagonal() -
                       drop.colwise().squaredNorm().transpose());
  }
  double Value() const {
    if (criterion_ == ExcitationCriterion::kD) {
      return -.5 * Eigen::LLT<MatrixXd>(information_)
                       .matrixLLT()
                       .diagonal()
                       .array()
                       .square()
                       .log()
                       .sum();
    }
    return OfVariances(covariance_.diagonal());
  }
  VectorXd Stddev() const {
    VectorXd stddev(postures_.wanted().size());
    for (size_t k = 0; k < postures_.wanted().size(); ++k) {
      const int w = postures_.wanted()[k];
      stddev[k] = std::sqrt(covariance_(w, w));
    }
    return stddev;
  }

 private:
  void Change(const MatrixXd& rows, double sign) {
    information_ += sign * rows.transpose() * rows;
    Invert();
  }
  void Invert() {
    covariance_ = information_.llt().solve(
        MatrixXd::Identity(information_.rows(), information_.cols()));
  }
  double OfVariances(const VectorXd& variances) const {
    VectorXd relative(scale_.size());
    for (Eigen::Index k = 0; k < scale_.size(); ++k) {
      relative[k] = variances[postures_.wanted()[k]] / (scale_[k] * scale_[k]);
    }
    return .5 * std::log(criterion_ == ExcitationCriterion::kA
                             ? relative.mean()
                             : relative.maxCoeff());
  }

  const Postures& postures_;
  ExcitationCriterion criterion_;
  VectorXd scale_;
  MatrixXd information_, covariance_;
};

int BestOf(const Choice& choice, const std::vector<MatrixXd>& rows) {
  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (size_t k = 0; k < rows.size(); ++k) {
    const double value = choice.With(rows[k]);
    if (value >= least) continue;
    least = value;
    best = static_cast<int>(k);
  }
  return best;
}

// A posture with one joint elsewhere, each joint everywhere on a grid as far as
// that is clear; the posture itself first.
MatrixXd Variants(const PostureOptions& options, const VectorXd& q) {
  constexpr int kGrid = 16;
  const Eigen::Index n = q.size();
  MatrixXd variants = q.transpose().replicate(1 + n * kGrid, 1);
  for (Eigen::Index j = 0; j < n; ++j) {
    variants.block(1 + j * kGrid, j, kGrid, 1) =
        VectorXd::LinSpaced(kGrid, options.lower[j], options.upper[j]);
  }
  std::vector<Eigen::Index> clear = {0};
  for (Eigen::Index k = 1; k < variants.rows(); ++k) {
    if (options.workspace.Clearance(variants.row(k)) >= 0) clear.push_back(k);
  }
  return variants(clear, Eigen::all);
}

// Moves single joints of single postures while that helps.
void Improve(const Postures& postures, const PostureOptions& options,
             Choice* choice, MatrixXd* q) {
  constexpr int kMostRounds = 12;
  bool changed = true;
  for (int round = 0; round < kMostRounds && changed; ++round) {
    changed = false;
    for (Eigen::Index k = 0; k < q->rows(); ++k) {
      const MatrixXd variants = Variants(options, q->row(k));
      const std::vector<MatrixXd> rows = postures.Rows(variants);
      choice->Remove(rows[0]);
      const int best = BestOf(*choice, rows);
      choice->Add(rows[best]);
      q->row(k) = variants.row(best);
      changed = changed || best != 0;
    }
  }
}

}  // namespace

PostureDesign DesignPostures(const Robot& robot,
                             const PostureOptions& options) {
  const MatrixXd candidates = RandomPostures(
      options, std::max(options.candidates, options.count), options.seed);
  const Postures postures(robot, options, candidates);
  const std::vector<MatrixXd> rows = postures.Rows(candidates);
  Choice choice(postures, options.criterion);
  Choice random(postures, options.criterion);
  PostureDesign design;
  design.q.resize(options.count, candidates.cols());
  for (int k = 0; k < options.count; ++k) {
    const int best = BestOf(choice, rows);
    choice.Add(rows[best]);
    design.q.row(k) = candidates.row(best);
    random.Add(rows[k]);
  }
  Improve(postures, options, &choice, &design.q);
  design.names = postures.names();
  design.units = postures.units();
  design.stddev = choice.Stddev();
  design.random_stddev = random.Stddev();
  design.criterion = choice.Value();
  design.random_criterion = random.Value();
  return design;
}

namespace {

Postures UsualPostures(const Robot& robot, const PostureOptions& options) {
  return {robot, options,
          RandomPostures(options, options.candidates, options.seed)};
}

}  // namespace

std::vector<MatrixXd> PostureEquations(const Robot& robot,
                                       const PostureOptions& options,
                                       const MatrixXd& q) {
  return UsualPostures(robot, options).Rows(q);
}

double PostureCriterion(const Robot& robot, const PostureOptions& options,
                        const MatrixXd& q) {
  const Postures postures = UsualPostures(robot, options);
  Choice choice(postures, options.criterion);
  for (const MatrixXd& rows : postures.Rows(q)) choice.Add(rows);
  return choice.Value();
}

}  // namespace armcal
