#include "calib/excite/posture_design.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "calib/excite/posture_model.h"
#include "model/text/uniform_draw.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

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

// A set of postures and the covariance that it leaves.
class Choice {
 public:
  Choice(const PostureModel& postures, ExcitationCriterion criterion)
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

  const PostureModel& postures_;
  ExcitationCriterion criterion_;
  VectorXd scale_;
  MatrixXd information_, covariance_;
};

// Of effects' amounts alone, D would weigh all that is unknown beside them.
ExcitationCriterion CriterionOf(const PostureOptions& options) {
  const bool all = options.separate.empty();
  return all || options.criterion != ExcitationCriterion::kD
             ? options.criterion
             : ExcitationCriterion::kA;
}

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
void Improve(const PostureModel& postures, const PostureOptions& options,
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
  const PostureModel postures(robot, options, candidates);
  const std::vector<MatrixXd> rows = postures.Rows(candidates);
  const ExcitationCriterion criterion = CriterionOf(options);
  Choice choice(postures, criterion);
  Choice random(postures, criterion);
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

PostureModel UsualPostures(const Robot& robot, const PostureOptions& options) {
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
  const PostureModel postures = UsualPostures(robot, options);
  Choice choice(postures, CriterionOf(options));
  for (const MatrixXd& rows : postures.Rows(q)) choice.Add(rows);
  return choice.Value();
}

}  // namespace armcal
