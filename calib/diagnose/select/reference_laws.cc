#include "calib/diagnose/select/reference_laws.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <utility>

#include "calib/diagnose/candidates/candidate_torques.h"
#include "calib/diagnose/candidates/candidates.h"
#include "calib/diagnose/data/motion_scale.h"
#include "calib/diagnose/data/noise.h"
#include "calib/diagnose/data/screen.h"
#include "calib/diagnose/data/thresholds.h"
#include "calib/diagnose/select/chosen.h"
#include "calib/diagnose/select/reference_fit.h"
#include "calib/diagnose/select/reference_folds.h"
#include "calib/diagnose/select/selection.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kChoices = 3;  // each with the noise that the last leaves
constexpr int kMostKnown = 10;

// Not what a log says of itself or of its day; nor what the baseline varies
// anyway; nor a law that a linear model cannot have.
bool CanBeInReference(const Effect& effect) {
  return effect.nature == Effect::Nature::kLaw && effect.proportional;
}

// Of which no size is per speed.
bool IsDryFriction(const Effect& law) {
  using Search = EffectParameter::Search;
  return IsCoulombInFiles(law) &&
         std::all_of(law.parameters.begin(), law.parameters.end(),
                     [](const EffectParameter& parameter) {
                       return parameter.search != Search::kLinear ||
                              parameter.unit == "E" || parameter.unit == "1";
                     });
}

// Laws that explain what the baseline leaves, on the shapes of their grids, of
// logs that they were not fitted to as well; what they leave is the noise.
class LawSearch {
 public:
  LawSearch(const GapBaseline& baseline,
            const std::vector<GapSegment>& segments, GapData* data)
      : baseline_(baseline), segments_(segments), data_(*data) {
    const MatrixXd left = data_.ResidualWith(FitWithNoise(&data_));
    scale_ = ScaleOf(baseline, data_.rows(), data_.torques());
    for (GapCandidate& candidate :
         ListCandidates(baseline, data_.rows(), scale_, left, {}, false)) {
      if (CanBeInReference(*candidate.effect)) {
        candidates_.push_back(std::move(candidate));
      }
    }
    EvaluateCandidates(baseline, data_.rows(), scale_, data_.torques(),
                       &candidates_);
  }

  // Effects are chosen with the noise that the last choice leaves, three times:
  // the first noise holds all of the laws that are to be found, and only their
  // residual shows smaller ones. What is kept in the end has to help where it
  // was not fitted, since a reference that is short, or of one motion, has
  // structure by chance. The sizes that stay are those of a last fit to all of
  // it.
  KnownEffects Run() {
    std::vector<int> chosen;
    GapScreen::Fit fit;
    for (int round = 0; round < kChoices; ++round) {
      const GapScreen screen = ScreenOf(data_);
      SelectionOptions options;
      options.most_effects = kMostKnown;
      chosen = SelectEffects(screen, candidates_, options).chosen;
      fit = screen.Solve(ColumnsOf(candidates_, chosen));
      noise_ = ResidualNoise(data_.rows(), Left(screen, chosen, fit)).joints;
      data_.SetNoise(noise_);
    }
    std::vector<GapCandidate> laws;
    for (const int c : chosen) laws.push_back(std::move(candidates_[c]));
    candidates_ = std::move(laws);
    std::iota(chosen.begin(), chosen.end(), 0);
    KeepWhatIsSeenAgain(&chosen);
    GapScreen screen = ScreenOf(data_);
    fit = screen.Solve(ColumnsOf(candidates_, chosen));
    const std::vector<int> dry = ToldDryFriction(chosen, fit);
    const GapScreen::Fit of_dry = screen.Solve(ColumnsOf(candidates_, dry));
    const Robot beside = baseline_.With(screen.Baseline(of_dry));
    DryFriction friction{{}, Known(dry, of_dry)};
    for (const Link& link : beside.links) {
      friction.coulomb.push_back(link.joint.coulomb);
    }
    return {baseline_.robot(), Known(chosen, fit), scale_, friction};
  }

 private:
  // Those of dry friction of which a parameter is more than chance.
  std::vector<int> ToldDryFriction(const std::vector<int>& chosen,
                                   const GapScreen::Fit& fit) const {
    std::vector<int> dry;
    Eigen::Index at = 0;
    for (const int c : chosen) {
      bool is_told = false;
      for (size_t k = 0; k < candidates_[c].linear.size(); ++k, ++at) {
        is_told |= std::abs(fit.coefficients[at]) >
                   Limits().by_chance * std::sqrt(fit.covariance(at, at));
      }
      if (is_told && IsDryFriction(*candidates_[c].effect)) dry.push_back(c);
    }
    return dry;
  }

  GapScreen ScreenOf(const GapData& data) {
    GapScreen screen = data.Screen();
    AddCandidates(data.rows(), &candidates_, &screen);
    screen.Factor();
    return screen;
  }

  // Cross-validation (Stone 1974) over logs or thirds of one: of each law it is
  // asked whether fits to the other parts leave less of the part that they have
  // not seen with it than without. The worst goes first, as long as leaving one
  // out helps; the parts' screens are made once, since only the columns that
  // are solved for change.
  void KeepWhatIsSeenAgain(std::vector<int>* chosen) {
    if (chosen->empty()) return;
    std::vector<Unseen> parts;
    for (const ReferenceFold& fold : FoldsOf(segments_)) {
      auto others = std::make_unique<GapData>(data_, LogPart());
      std::vector<int> left_out = LeaveOut(segments_, fold, others.get());
      others->SetNoise(noise_);
      parts.push_back({ScreenOf(*others), std::move(left_out)});
    }
    while (!chosen->empty()) {
      const double all = LeftUnseen(parts, *chosen);
      int worst = -1;
      double least = all;
      for (int k = 0; k < static_cast<int>(chosen->size()); ++k) {
        const double left = LeftUnseen(parts, Without(*chosen, k));
        if (left < least) least = left, worst = k;
      }
      if (worst < 0) return;
      *chosen = Without(*chosen, worst);
    }
  }

  // A fit to all but some samples, and these.
  struct Unseen {
    GapScreen screen;
    std::vector<int> left_out;
  };
  // Sum of squares over the noise's variance that such fits leave.
  double LeftUnseen(const std::vector<Unseen>& parts,
                    const std::vector<int>& chosen) const {
    double sum = 0;
    for (const Unseen& part : parts) {
      const GapScreen::Fit fit =
          part.screen.Solve(ColumnsOf(candidates_, chosen));
      const MatrixXd left =
          Moving(data_.rows(), Left(part.screen, chosen, fit));
      for (int j = 0; j < left.cols(); ++j) {
        const double stddev = data_.rows().noise(j).stddev();
        sum += left(part.left_out, j).squaredNorm() / (stddev * stddev);
      }
    }
    return sum;
  }

  // Thinned samples x n, N m or N.
  MatrixXd Left(const GapScreen& screen, const std::vector<int>& chosen,
                const GapScreen::Fit& fit) const {
    MatrixXd left = data_.ResidualWith(screen.Baseline(fit));
    int at = 0;
    for (const int c : chosen) {
      for (const JointRows& torque : candidates_[c].torque) {
        const double size = fit.coefficients[at++];
        for (int j = 0; j < left.cols(); ++j) {
          if (torque[j].size() > 0) left.col(j) -= size * torque[j];
        }
      }
    }
    return left;
  }

  std::vector<KnownEffect> Known(const std::vector<int>& chosen,
                                 const GapScreen::Fit& fit) const {
    std::vector<KnownEffect> known;
    int at = 0;
    for (const int c : chosen) {
      const GapCandidate& law = candidates_[c];
      known.push_back({law.effect, law.joint, law.p});
      for (size_t k = 0; k < law.linear.size(); ++k) {
        known.back().p[law.linear[k]] = fit.coefficients[at++] * law.size[k];
      }
    }
    return known;
  }

  const GapBaseline& baseline_;
  const std::vector<GapSegment>& segments_;
  GapData& data_;
  std::vector<Autoregression> noise_;
  MotionScale scale_;
  std::vector<GapCandidate> candidates_;
};

}  // namespace

KnownEffects FindReferenceLaws(const GapBaseline& baseline,
                               const std::vector<GapSegment>& segments,
                               GapData* data) {
  return LawSearch(baseline, segments, data).Run();
}

}  // namespace armcal
