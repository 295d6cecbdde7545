#include "calib/diagnose/judge/corrected_draws.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "calib/diagnose/candidates/coordinates.h"
#include "calib/diagnose/candidates/law_share.h"
#include "calib/refine/possible_links.h"
#include "calib/refine/possible_range.h"
#include "model/robot/inertial_parameters.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

bool IsBody(const Vector10d& link) {
  return Eigen::LLT<Eigen::Matrix4d>(PseudoInertia(link)).info() ==
         Eigen::Success;
}

// What the named effects add to a term of joint j.
double AddedTo(JointTerm term, int j,
               const std::vector<GapCandidate>& effects) {
  double added = 0;
  for (const GapCandidate& effect : effects) {
    const bool is_of_joint = effect.joint == j && effect.p.size() == 1;
    if (is_of_joint && effect.effect->joint_term == term) added += effect.p[0];
  }
  return added;
}

// Values of what is open of a posterior at which a robot can exist. Links are
// linear in these, and so are the numbers that are not negative.
class PossibleCorrections {
 public:
  PossibleCorrections(const GapFit& fit, const CorrectedPosterior& posterior)
      : fit_(fit), posterior_(posterior) {
    AddLinks();
    const VectorXd at = Numbers(posterior.mean);
    slope_.resize(at.size(), posterior.mean.size());
    for (Eigen::Index k = 0; k < slope_.cols(); ++k) {
      VectorXd values = posterior.mean;
      values[k] += 1;
      slope_.col(k) = Numbers(values) - at;
    }
    constant_ = at - slope_ * posterior.mean;
    AddBounds();
  }

  // The part of a line on which a robot can exist.
  LineRange operator()(const VectorXd& at, const VectorXd& along) const {
    PossibleRange range;
    const VectorXd numbers = constant_ + slope_ * at, change = slope_ * along;
    for (Eigen::Index i = 0; i < numbers.size(); ++i) {
      range.KeepPositive(std::max(0., numbers[i]), change[i]);
    }
    for (const LinkOf& link : links_) {
      range.KeepPossible(link.At(at), link.Change(along));
    }
    return range.range();
  }

  // A point of the set, next to the mean; nothing where none is found.
  std::optional<VectorXd> Start(const Robot& file) const;

 private:
  struct LinkOf {
    int link;
    Vector10d nominal;
    std::vector<int> open;  // places of its columns, by inertial parameter
    Vector10d spread;
    Vector10d Change(const VectorXd& along) const {
      return spread.cwiseProduct(Vector10d(along(open)));
    }
    Vector10d At(const VectorXd& at) const { return nominal + Change(at); }
  };

  const BaselineColumn& ColumnAt(size_t k) const {
    return fit_.baseline().columns()[posterior_.columns[k]];
  }
  void AddLinks();
  void AddBounds();
  VectorXd Numbers(const VectorXd& values) const;
  void MakeLinksPossible(const Robot& file, VectorXd* values) const;
  bool MakePositive(VectorXd* values) const;
  bool HaveBodies(const VectorXd& values) const {
    return std::all_of(links_.begin(), links_.end(), [&](const LinkOf& link) {
      return IsBody(link.At(values));
    });
  }

  const GapFit& fit_;
  const CorrectedPosterior& posterior_;
  std::vector<LinkOf> links_;
  // Of the numbers that are not negative: constant + slope * values.
  MatrixXd slope_;
  VectorXd constant_;
};

void PossibleCorrections::AddLinks() {
  for (size_t k = 0; k < posterior_.columns.size(); ++k) {
    const BaselineColumn& column = ColumnAt(k);
    if (column.kind != BaselineColumn::Kind::kInertial) continue;
    if (links_.empty() || links_.back().link != column.joint) {
      LinkOf& link = links_.emplace_back();
      link.link = column.joint;
      link.nominal =
          fit_.baseline().robot().links[column.joint].inertial.ToVector();
    }
    LinkOf& link = links_.back();
    link.spread[static_cast<Eigen::Index>(link.open.size())] = column.spread;
    link.open.push_back(static_cast<int>(k));
  }
}

// Per joint viscous friction, armature, and dry friction at speeds about the
// widths of its mixture and far beyond them: a mixture of widths, some of which
// take away, is not to push in between.
VectorXd PossibleCorrections::Numbers(const VectorXd& values) const {
  constexpr double kSpeeds[] = {.1, .25, .5, 1, 2, 4, 8, 1000};  // widths
  const VectorXd x = posterior_.ModelAt(values);
  const std::vector<GapCandidate> effects = posterior_.EffectsAt(values);
  const Robot robot = fit_.baseline().With(x);
  std::vector<double> numbers;
  for (int j = 0; j < robot.num_joints(); ++j) {
    for (const JointTerm term : {JointTerm::kViscous, JointTerm::kArmature}) {
      numbers.push_back(TermOf(term, robot.links[j].joint) +
                        AddedTo(term, j, effects));
    }
    std::vector<CoulombPart> parts = fit_.baseline().CoulombAt(j, x);
    parts.push_back(
        {AddedTo(JointTerm::kCoulomb, j, effects),
         {CoulombTransition::Law::kVelocity, fit_.scale().width[j]}});
    for (const double times : kSpeeds) {
      double friction = 0;
      for (const CoulombPart& part : parts) {
        friction += part.force * std::tanh(times * parts[0].transition.width /
                                           part.transition.width);
      }
      numbers.push_back(friction);
    }
  }
  return Eigen::Map<const VectorXd>(numbers.data(),
                                    static_cast<Eigen::Index>(numbers.size()));
}

// Effects' parameters stay within the bounds that they were searched in.
void PossibleCorrections::AddBounds() {
  const auto add = [this](Eigen::Index k, double sign, double bound) {
    if (!std::isfinite(bound)) return;
    const Eigen::Index i = slope_.rows();
    slope_.conservativeResize(i + 1, Eigen::NoChange);
    slope_.row(i).setZero();
    slope_(i, k) = sign;
    constant_.conservativeResize(i + 1);
    constant_[i] = -sign * bound;
  };
  for (const Coordinate& c :
       ListCoordinates(fit_.baseline(), fit_.scale(), posterior_.effects, -1)) {
    for (size_t k = 0; k < posterior_.parameters.size(); ++k) {
      const auto& [effect, index] = posterior_.parameters[k];
      if (c.effect != effect || c.parameter != index) continue;
      const size_t at = posterior_.columns.size() + k;
      add(static_cast<Eigen::Index>(at), 1, c.low);
      add(static_cast<Eigen::Index>(at), -1, c.high);
    }
  }
}

// The nearest bodies to the fitted links, which need not be any; where there
// are none, the file's.
void PossibleCorrections::MakeLinksPossible(const Robot& file,
                                            VectorXd* values) const {
  const Robot fitted = fit_.baseline().With(posterior_.ModelAt(*values));
  const std::vector<bool> held(fitted.num_joints(), false);
  const auto near = FindPossibleLinks(fitted, file, fit_.scale(), held);
  const auto put = [&](const Robot& robot) {
    for (const LinkOf& link : links_) {
      (*values)(link.open) =
          (robot.links[link.link].inertial.ToVector() - link.nominal)
              .cwiseQuotient(link.spread);
    }
  };
  if (near) put(near->robot);
  if (!HaveBodies(*values)) put(file);
}

// Mixtures of widths are left out where they push; then the joint's own term
// that a negative number grows with the most is raised until it is positive, by
// a little of what the term is known to. Whether that did it.
bool PossibleCorrections::MakePositive(VectorXd* values) const {
  constexpr double kLittle = 1e-3;
  if (((constant_ + slope_ * *values).array() >= 0).all()) return true;
  std::vector<Eigen::Index> terms;
  for (size_t k = 0; k < posterior_.columns.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(k);
    const BaselineColumn& column = ColumnAt(k);
    if (column.kind == BaselineColumn::Kind::kZeroVelocity) (*values)[at] = 0;
    if (column.kind == BaselineColumn::Kind::kTerm) terms.push_back(at);
  }
  for (Eigen::Index i = 0; i < constant_.size(); ++i) {
    const double number = constant_[i] + slope_.row(i).dot(*values);
    if (number >= 0 || terms.empty()) continue;
    Eigen::Index most = 0;
    slope_.row(i)(terms).maxCoeff(&most);
    const Eigen::Index raised = terms[most];
    if (slope_(i, raised) <= 0) continue;
    (*values)[raised] += kLittle - number / slope_(i, raised);
  }
  return ((constant_ + slope_ * *values).array() >= 0).all();
}

std::optional<VectorXd> PossibleCorrections::Start(const Robot& file) const {
  VectorXd values = posterior_.mean;
  if (!HaveBodies(values)) MakeLinksPossible(file, &values);
  if (!HaveBodies(values) || !MakePositive(&values)) return std::nullopt;
  return values;
}

// Whether the whole of it can exist: a body that was taken off is not more than
// there was, and effects are of a real arm.
bool IsPossible(const CorrectedRobot& robot) {
  const std::vector<Link>& links = robot.plant.robot.links;
  return std::all_of(links.begin(), links.end(),
                     [](const Link& link) {
                       return link.inertial.ToVector().isZero(0) ||
                              WhyUnphysical(link.inertial).empty();
                     }) &&
         std::all_of(robot.effects.begin(), robot.effects.end(),
                     [&](const CarriedEffect& carried) {
                       const auto& plausible = carried.found.effect->plausible;
                       const EffectSite site = {&robot.plant.robot,
                                                carried.found.joint,
                                                &robot.scale};
                       return !plausible || plausible(site, carried.estimates);
                     });
}

}  // namespace

// By DrawWithin in the part that is convex. What is not, how effects and links
// go together, is left to rejection, which hardly ever happens: an effect that
// is claimed is far from 0.
CorrectedDraws DrawCorrected(const GapFit& fit,
                             const CorrectedPosterior& posterior,
                             const Robot& file, int count) {
  constexpr uint64_t kSeed = 1;
  constexpr int kMostTries = 4;  // of each robot
  CorrectedDraws result;
  const PossibleCorrections possible(fit, posterior);
  const std::optional<VectorXd> start = possible.Start(file);
  if (!start) {
    result.refusal = "no robot that can exist is near the one that was fitted";
    return result;
  }
  for (int tries = 1; tries <= kMostTries; tries *= 2) {
    const MatrixXd draws = DrawWithin(posterior.mean, posterior.covariance,
                                      possible, tries * count, kSeed, *start);
    result.robots.clear();
    for (const VectorXd values : draws.colwise()) {
      CorrectedRobot robot =
          MakeCorrectedRobot(fit.baseline(), posterior.ModelAt(values),
                             posterior.EffectsAt(values), fit.scale());
      if (!IsPossible(robot)) continue;
      SetLawShares(fit.baseline(), fit.data(), &robot);
      result.robots.push_back(std::move(robot));
      if (static_cast<int>(result.robots.size()) == count) return result;
    }
  }
  result.robots.clear();
  result.refusal =
      "most robots that the data allow cannot exist with the effects found";
  return result;
}

}  // namespace armcal
