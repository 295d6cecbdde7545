#include "calib/refine/arm_fit.h"

#include <ceres/manifold.h>
#include <ceres/normal_prior.h>
#include <ceres/problem.h>

#include <algorithm>
#include <cmath>

#include "calib/refine/link_start.h"
#include "problems/dense_solver.h"
#include "problems/inertial_coordinates.h"
#include "problems/inertial_manifold.h"
#include "problems/inertial_prior.h"
#include "problems/torque_factor_residual.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// The parameter blocks of a Ceres problem. Links that are no bodies have none:
// they stay as they are, at 0.
struct Blocks {
  Blocks(const std::vector<int>& of, const ArmValues& values)
      : value(values), bodies(of) {
    for (const int i : bodies) {
      links.push_back(
          LogCholeskyFromInertial(values.links.segment<10>(10 * i), 0, 0));
    }
  }
  ArmValues Values() {
    for (size_t b = 0; b < bodies.size(); ++b) {
      InertialFromLogCholesky(links[b].data(),
                              value.links.data() + 10 * bodies[b]);
    }
    return value;
  }
  // False where a link is too near the boundary for doubles.
  bool AreFinite() const {
    return std::all_of(links.begin(), links.end(),
                       [](const Vector10d& c) { return c.allFinite(); });
  }
  ArmValues value;  // links: only as they were
  const std::vector<int>& bodies;
  std::vector<Vector10d> links;  // of each body
};

// The columns of R up to `end`, a number of unknown, without those of links
// that are no bodies: they act on zeros.
MatrixXd ColumnsOfBodies(const ArmUnknowns& unknowns, const MatrixXd& R,
                         int end) {
  std::vector<int> columns;
  for (const int i : unknowns.bodies()) {
    for (int k = 0; k < 10; ++k) columns.push_back(10 * i + k);
  }
  for (int k = unknowns.terms_begin(); k < end; ++k) columns.push_back(k);
  return R(Eigen::all, columns);
}

// Keeps the entries of a block that are not free. A block without free entries
// is constant, as a manifold needs at least one direction.
void Hold(const ArmUnknowns& unknowns, int begin, int size, double* block,
          ceres::Problem* problem) {
  std::vector<int> held;
  for (int k = 0; k < size; ++k) {
    if (!unknowns.is_free(begin + k)) held.push_back(k);
  }
  if (static_cast<int>(held.size()) == size) {
    problem->SetParameterBlockConstant(block);
  } else if (!held.empty()) {
    problem->SetManifold(block, new ceres::SubsetManifold(size, held));
  }
}

// Adds (x - mean) / prior for every entry of a block that has a prior.
void AddNormalPrior(const ArmUnknowns& unknowns, const ArmTrust& trust,
                    int begin, const VectorXd& mean, double* block,
                    ceres::Problem* problem) {
  MatrixXd weight = MatrixXd::Zero(mean.size(), mean.size());
  for (int k = 0; k < mean.size(); ++k) {
    const double prior = unknowns.NormalPrior(begin + k, trust);
    if (prior > 0) weight(k, k) = 1 / prior;
  }
  problem->AddResidualBlock(new ceres::NormalPrior(weight, mean), nullptr,
                            block);
}

// Adds the prior on terms to the torque equations, as rows (term - nominal) /
// prior: it is linear, and both the start and the fit then have it.
LinkEquations WithTermPrior(const ArmUnknowns& unknowns, const ArmTrust& trust,
                            const LinkEquations& equations) {
  const Eigen::Index rows = equations.R.rows();
  const VectorXd& nominal = unknowns.nominal().terms;
  LinkEquations all = equations;
  all.R.conservativeResize(rows + nominal.size(), Eigen::NoChange);
  all.R.bottomRows(nominal.size()).setZero();
  all.z.conservativeResize(rows + nominal.size());
  for (int t = 0; t < nominal.size(); ++t) {
    const int k = unknowns.terms_begin() + t;
    const double weight = 1 / unknowns.NormalPrior(k, trust);
    all.R(rows + t, k) = weight;
    all.z[rows + t] = weight * nominal[t];
  }
  return all;
}

// Adds one residual for all torques, R x - z (TorqueFactorResidual). Robust
// weights are in R already, since they are of rows, which R no longer has.
void AddTorques(const ArmUnknowns& unknowns, const LinkEquations& equations,
                Blocks* blocks, ceres::Problem* problem) {
  ArmValues& v = blocks->value;
  std::vector<double*> all;
  for (Vector10d& c : blocks->links) all.push_back(c.data());
  all.insert(all.end(),
             {v.terms.data(), v.tilt.data(), v.poses.geometry.data()});
  problem->AddResidualBlock(
      new TorqueFactorResidual(
          ColumnsOfBodies(unknowns, equations.R, unknowns.other_begin()),
          equations.z, static_cast<int>(blocks->links.size()),
          {static_cast<int>(v.terms.size()), 2,
           static_cast<int>(v.poses.geometry.size())}),
      nullptr, all);
}

// Adds what the file says: the divergence of pseudo-inertias for each link
// (Lee, Wensing & Park 2020), which also keeps links off the boundary, and
// normal priors of tilt and geometry. Steps of links go by InertialManifold, in
// which the torques are linear as they are in the inertial parameters.
void AddPriors(const ArmUnknowns& unknowns, const ArmTrust& trust,
               Blocks* blocks, ceres::Problem* problem) {
  const ArmValues& nominal = unknowns.nominal();
  for (size_t b = 0; b < blocks->bodies.size(); ++b) {
    double* const c = blocks->links[b].data();
    problem->AddResidualBlock(
        new InertialPrior(nominal.links.segment<10>(10 * blocks->bodies[b]),
                          trust.inertia),
        nullptr, c);
    problem->SetManifold(c, new InertialManifold);
  }
  AddNormalPrior(unknowns, trust, unknowns.tilt_begin(), nominal.tilt,
                 blocks->value.tilt.data(), problem);
  AddNormalPrior(unknowns, trust, unknowns.geometry_begin(),
                 nominal.poses.geometry, blocks->value.poses.geometry.data(),
                 problem);
}

// Keeps what is held, and keeps friction and armature from falling below 0:
// these bounds are by coordinates, which Ceres projects on. Links need none,
// since every value of their coordinates is a body.
void AddLimits(const ArmUnknowns& unknowns, Blocks* blocks,
               ceres::Problem* problem) {
  ArmValues& v = blocks->value;
  const int num_terms = static_cast<int>(v.terms.size());
  Hold(unknowns, unknowns.terms_begin(), num_terms, v.terms.data(), problem);
  for (int t = 0; t < num_terms; ++t) {
    if (!unknowns.is_positive(unknowns.terms_begin() + t)) continue;
    problem->SetParameterLowerBound(v.terms.data(), t, 0);
  }
  Hold(unknowns, unknowns.tilt_begin(), 2, v.tilt.data(), problem);
  Hold(unknowns, unknowns.geometry_begin(),
       static_cast<int>(v.poses.geometry.size()), v.poses.geometry.data(),
       problem);
}

}  // namespace

ArmFit::ArmFit(const ArmUnknowns& unknowns, const ArmTrust& trust,
               const PoseFit* poses)
    : unknowns_(unknowns), trust_(trust), poses_(poses) {}

// For a given geometry the problem is convex in the inertial parameters, but
// not in the coordinates that Solve() works in. StartLinks solves it in the
// former from any start, so that Solve() has only geometry and poses to add.
bool ArmFit::Start(const LinkEquations& torques, ArmValues* values) const {
  const LinkEquations equations = WithTermPrior(unknowns_, trust_, torques);
  const std::vector<int>& bodies = unknowns_.bodies();
  const auto num_bodies = static_cast<Eigen::Index>(bodies.size());
  VectorXd x(10 * num_bodies + values->terms.size());
  for (Eigen::Index b = 0; b < num_bodies; ++b) {  // inside the boundary
    const Vector10d c = LogCholeskyFromInertial(
        unknowns_.nominal().links.segment<10>(10 * bodies[b]), 0.01, 0.01);
    InertialFromLogCholesky(c.data(), x.data() + 10 * b);
  }
  x.tail(values->terms.size()) = values->terms;
  std::vector<TermRange> ranges;
  for (int t = 0; t < values->terms.size(); ++t) {
    ranges.push_back(unknowns_.is_positive(unknowns_.terms_begin() + t)
                         ? TermRange::kPositive
                     : unknowns_.is_free(unknowns_.terms_begin() + t)
                         ? TermRange::kFree
                         : TermRange::kHeld);
  }
  const Eigen::Index others = unknowns_.size() - unknowns_.tilt_begin();
  const auto start = StartLinks(
      ColumnsOfBodies(unknowns_, equations.R, unknowns_.tilt_begin()),
      equations.z -
          equations.R.rightCols(others) * values->Stacked().tail(others),
      trust_.inertia, ranges, x);
  if (!start) return false;
  values->links = unknowns_.nominal().links;
  for (Eigen::Index b = 0; b < num_bodies; ++b) {
    values->links.segment<10>(10 * bodies[b]) = start->segment<10>(10 * b);
  }
  values->terms = start->tail(values->terms.size());
  return true;
}

// The maximum of the posterior: the least of |R x - z|^2, the poses' squares
// and the prior's, over bodies that can exist. The tolerance, 1e-9 of the cost,
// is far below what rounds of the geometry leave.
ArmFit::End ArmFit::Solve(const LinkEquations& torques,
                          ArmValues* values) const {
  const LinkEquations equations = WithTermPrior(unknowns_, trust_, torques);
  Blocks blocks(unknowns_.bodies(), *values);
  if (!blocks.AreFinite()) {
    return {false, "a link is thinner than doubles can tell", 0};
  }
  ceres::Problem problem;
  AddTorques(unknowns_, equations, &blocks, &problem);
  AddPriors(unknowns_, trust_, &blocks, &problem);
  if (poses_ != nullptr) {
    poses_->AddResiduals(poses_->AllRows(), &blocks.value.poses, &problem);
  }
  AddLimits(unknowns_, &blocks, &problem);
  const ceres::Solver::Summary summary = SolveDense(1e-9, &problem);
  const ArmValues result = blocks.Values();
  End end;
  end.reason = ceres::TerminationTypeToString(summary.termination_type);
  end.iterations = static_cast<int>(summary.iterations.size());
  end.usable = summary.IsSolutionUsable() && result.Stacked().allFinite();
  if (end.usable) *values = result;
  return end;
}

// Near the file's values the divergence of a link is |W (V - V_0)|^2, whence
// W'W.
MatrixXd ArmFit::PriorInformation(const ArmTrust& trust) const {
  MatrixXd information = MatrixXd::Zero(unknowns_.size(), unknowns_.size());
  for (const int i : unknowns_.bodies()) {
    const auto W = InertialPrior(unknowns_.nominal().links.segment<10>(10 * i),
                                 trust.inertia)
                       .W();
    information.block<10, 10>(10 * i, 10 * i) = W.transpose() * W;
  }
  for (int k = unknowns_.terms_begin(); k < unknowns_.size(); ++k) {
    const double prior = unknowns_.NormalPrior(k, trust);
    if (prior > 0) information(k, k) = 1 / (prior * prior);
  }
  return information;
}

}  // namespace armcal
