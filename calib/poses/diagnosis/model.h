#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "calib/poses/diagnosis/robust_fit.h"
#include "calib/poses/effects/effect.h"

namespace armcal {

struct PlacedPoseEffect {
  const PoseEffect* effect;
  PosePlace place;
  bool operator==(const PlacedPoseEffect& o) const {
    return effect == o.effect && place == o.place;
  }
};

// What a search for effects is made on.
struct PoseStudy {
  KnownArm arm;
  const PoseMeasurements& measured;
  PoseEquations equations;
  double nu;                              // of the errors (student.h)
  std::vector<std::string> without = {};  // effects that are not considered
};

// rad or m: what depends on the posture is taken anew where joints turn out to
// stand elsewhere.
inline constexpr double kStandsElsewhere = .02;

// The geometry with some effects, and how it fits.
struct PoseModel {
  std::vector<PlacedPoseEffect> effects;
  std::vector<PoseTerm> terms;  // of all effects, one after the other
  std::vector<int> begin;       // of each effect's terms, and their end
  PoseCampaign campaign;        // what its terms were made from
  PoseEstimate estimate;

  std::string Name() const;  // of its effects, joined by " + "
};

// Fits the geometry with `effects`, from the state of `from` where it has the
// same effects first; new amounts begin at `amounts`.
PoseModel FitPoseModel(const PoseStudy& study,
                       const std::vector<PlacedPoseEffect>& effects,
                       const PoseModel& from, const Eigen::VectorXd& amounts);
// The same without effect `out`.
PoseModel FitWithout(const PoseStudy& study, const PoseModel& model,
                     size_t out);
// Without effects, from the instrument's frame alone.
PoseModel FitGeometryAlone(const PoseStudy& study, const PoseState& start);

// Whether each effect's amount is one that it can have.
bool IsPossible(const PoseModel& model);

// How many equations count as one, at least 1: errors of one pose's targets or
// repeated readings, and of successive poses that are alike tell less than as
// many independent ones (the design effect of Kish 1965, of an AR(1) process
// over the order).
double DesignEffect(const PoseStudy& study, const PoseModel& model);

// Correlation of successive columns.
double OrderCorrelation(const Eigen::MatrixXd& by_pose);

// -2 log of a model's evidence but for a constant: Laplace's approximation over
// the geometry, Schwarz's (1978) over the amounts of effects, and the prior
// odds of the effects and of their places. `design_effect` is common to the
// models that are compared.
double EvidenceOf(const PoseStudy& study, const PoseModel& model,
                  double design_effect);
// The part of it that an effect pays for being there and for its place.
double PriorPenalty(const PoseCampaign& campaign, const PoseEffect& effect);
// Information on the amounts with the geometry unknown, 1 / unit^2.
Eigen::MatrixXd AmountsInformation(const PoseStudy& study,
                                   const PoseModel& model);

}  // namespace armcal
