#include "model/dynamics/model_parameters.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <random>

#include "model/signals/column_basis.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// The order in which columns are kept: the first of dependent ones.
std::vector<Moment> MomentsOfBlock(JointType type) {
  if (!IsRotational(type)) {
    return {Moment::kM, Moment::kHx, Moment::kHy, Moment::kHz};
  }
  return {Moment::kIzz, Moment::kIxxMinusIyy, Moment::kIxy, Moment::kIxz,
          Moment::kIyz, Moment::kHx,          Moment::kHy};
}

// Whether the moment's functions are affine in the lengths before the block.
bool DependsOnLengths(Moment moment, JointType type) {
  if (!IsRotational(type)) return moment == Moment::kM;
  return moment == Moment::kHx || moment == Moment::kHy;
}

double MomentValue(const InertialParameters& K, Moment moment) {
  const Eigen::Matrix3d& I = K.inertia;
  switch (moment) {
    case Moment::kM:
      return K.mass;
    case Moment::kHx:
    case Moment::kHy:
    case Moment::kHz:
      return K.first_moment[static_cast<int>(moment) -
                            static_cast<int>(Moment::kHx)];
    case Moment::kIxxMinusIyy:
      return 0.5 * (I(0, 0) - I(1, 1));
    case Moment::kIxy:
      return I(0, 1);
    case Moment::kIxz:
      return I(0, 2);
    case Moment::kIyz:
      return I(1, 2);
    case Moment::kIzz:
      return I(2, 2);
  }
  return 0;
}

// Uniform on (-2, 2): joint positions, velocities and accelerations rich enough
// that dependence of columns is never a close decision: singular values
// are above .6 or below 1e-15.
class RandomStates {
 public:
  VectorXd Next(int n) {
    VectorXd v(n);
    for (int i = 0; i < n; ++i) {
      v[i] = static_cast<double>(generator_() >> 11) * 0x1p-51 - 2;
    }
    return v;
  }

 private:
  std::mt19937_64 generator_{20261120};
};

// Friction, which no other column can replace.
bool Dissipates(const JointTermColumn& column) {
  return column.term == JointTerm::kViscous ||
         column.term == JointTerm::kCoulomb;
}

}  // namespace

ModelParameters::ModelParameters(const Robot& robot, const Options& options)
    : chain_(MakeProximalChain(robot)) {
  ChooseUnknownLengths(robot, options.geometry);
  ListColumns(robot, options);
  DropZeroMoments(robot);
  ChooseBasis();
  NameParameters();
  nominal_ = Values(robot);
}

void ModelParameters::ChooseUnknownLengths(const Robot& robot,
                                           GeometryKnowledge geometry) {
  if (geometry == GeometryKnowledge::kKnown) return;
  for (const Length& length : chain_.lengths) {
    bool unknown = geometry == GeometryKnowledge::kAllLengths;
    if (geometry == GeometryKnowledge::kNonzeroLengths) {
      unknown = std::abs(length.value) > 1e-9;
    }
    for (const Link& link : robot.links) {
      if (geometry != GeometryKnowledge::kDeclaredLengths) break;
      for (const std::string& symbol : link.unknown_lengths) {
        unknown |= length.owner_name == link.name + "." + symbol;
      }
    }
    if (unknown) unknown_.push_back(length);
  }
}

// Lists all columns that there may be: of each joint its moments, those that
// are affine in lengths once more for each unknown length before the joint (7 +
// 2 p_i of a turning joint, docs/theory.md, 1), and its terms.
void ModelParameters::ListColumns(const Robot& robot, const Options& options) {
  for (int i = 0; i < num_joints(); ++i) {
    const JointType type = chain_.joints[i].type;
    for (const Moment moment : MomentsOfBlock(type)) {
      moments_.push_back({i, moment, -1});
      if (!DependsOnLengths(moment, type)) continue;
      for (size_t l = 0; l < unknown_.size(); ++l) {
        if (unknown_[l].joint < i &&
            Moves(chain_.parents, unknown_[l].next, i)) {
          moments_.push_back({i, moment, static_cast<int>(l)});
        }
      }
    }
    for (const JointTerm term : options.joint_terms) {
      if (term != JointTerm::kCoulomb) {
        terms_.push_back({i, term, {}});
        continue;
      }
      CHECK_EQ(options.transitions.size(), robot.links.size());
      for (const CoulombTransition& t : options.transitions[i]) {
        terms_.push_back({i, term, t});
      }
    }
  }
}

// Removes moments that are zero for every arm with the declared symmetries,
// found with random inertial parameters.
void ModelParameters::DropZeroMoments(const Robot& robot) {
  const bool declared = std::any_of(
      robot.links.begin(), robot.links.end(),
      [](const Link& link) { return !link.zero_inertials.empty(); });
  if (!declared) return;
  RandomStates random;
  ProximalChain chain = chain_;
  for (const Length& length : unknown_) {
    chain.joints[length.next].X_JG.translation()[length.component] =
        random.Next(1)[0];
  }
  Robot sample = robot;
  for (Link& link : sample.links) {
    Vector10d v = random.Next(10);
    for (int k = 0; k < 10; ++k) {
      for (const std::string& name : link.zero_inertials) {
        if (name == InertialName(k)) v[k] = 0;
      }
    }
    link.inertial = InertialParameters::FromVector(v);
  }
  const auto K = CompositeInertials(sample, chain);
  moments_.erase(std::remove_if(moments_.begin(), moments_.end(),
                                [&](const MomentColumn& c) {
                                  return std::abs(MomentValue(
                                             K[c.block], c.moment)) < 1e-13;
                                }),
                 moments_.end());
}

int ModelParameters::BlockOfFull(int c) const {
  const int m = static_cast<int>(moments_.size());
  return c < m ? moments_[c].block : terms_[c - m].joint;
}

// U at random states, one below the other, all columns before regrouping; those
// of friction are 0.
MatrixXd ModelParameters::SampleRegressor() const {
  RegressorColumns columns;
  columns.moments = moments_;
  std::vector<int> places(moments_.size());
  std::iota(places.begin(), places.end(), 0);
  columns.moment_index = places;
  for (size_t t = 0; t < terms_.size(); ++t) {
    if (Dissipates(terms_[t])) continue;
    columns.terms.push_back(terms_[t]);
    columns.term_index.push_back(static_cast<int>(places.size()));
    places.push_back(static_cast<int>(moments_.size() + t));
  }
  Regressor regressor(chain_, unknown_, columns);
  RandomStates random;
  const int n = num_joints();
  const int samples = std::max(60, 3 * columns.size() / n + 30);
  MatrixXd U = MatrixXd::Zero(samples * n, NumFull()), U_sample;
  for (int s = 0; s < samples; ++s) {
    const VectorXd q = random.Next(n), qd = random.Next(n);
    regressor.Differential(q, qd, random.Next(n), VectorXd(), &U_sample);
    U(Eigen::seqN(s * n, n), places) = U_sample;
  }
  return U;
}

// Within a block, as (2.15) asks; across blocks rigid columns are independent
// whenever they are within: in a relation let i be its lowest block and all
// other links be massless, and block i's coefficients vanish.
void ModelParameters::KeepMoments(const MatrixXd& U) {
  const int m = static_cast<int>(moments_.size());
  for (int i = 0; i < num_joints(); ++i) {
    ColumnBasis basis(U.rows());
    std::vector<int> block, kept;
    double scale = 0;
    for (int c = 0; c < m; ++c) {
      if (moments_[c].block != i) continue;
      block.push_back(c);
      scale = std::max(scale, U.col(c).norm());
    }
    for (const int c : block) {
      if (basis.Add(U.col(c), scale)) kept.push_back(c);
    }
    kept_.insert(kept_.end(), kept.begin(), kept.end());
  }
}

// A term in the span of the rigid columns and the terms before it is merged.
// Offset and armature can be; friction dissipates and cannot.
void ModelParameters::KeepTerms(const MatrixXd& U) {
  const int m = static_cast<int>(moments_.size());
  ColumnBasis basis(U.rows());
  for (const int c : kept_) basis.Add(U.col(c), U.col(c).norm());
  for (const JointTerm term : {JointTerm::kViscous, JointTerm::kCoulomb,
                               JointTerm::kOffset, JointTerm::kArmature}) {
    for (size_t t = 0; t < terms_.size(); ++t) {
      if (terms_[t].term != term) continue;
      const int c = m + static_cast<int>(t);
      if (Dissipates(terms_[t]) || basis.Add(U.col(c), U.col(c).norm())) {
        kept_.push_back(c);
      }
    }
  }
}

// Keeps columns of U at random states that are independent and expresses the
// others by them: U_all x = U_kept (regrouping x). Base parameters are found so
// numerically (Gautier 1991, J. Robotic Systems 8), since symbols would have to
// be told which symmetries an arm has. A moment may only join its own block, so
// that U stays block triangular.
void ModelParameters::ChooseBasis() {
  const MatrixXd U = SampleRegressor();
  KeepMoments(U);
  KeepTerms(U);
  std::stable_sort(kept_.begin(), kept_.end(), [this](int a, int b) {
    return BlockOfFull(a) < BlockOfFull(b);
  });
  const int num_moments = static_cast<int>(moments_.size());
  regrouping_ = MatrixXd::Zero(kept_.size(), NumFull());
  for (int c = 0; c < NumFull(); ++c) {
    const auto self = std::find(kept_.begin(), kept_.end(), c);
    if (self != kept_.end()) {
      regrouping_(self - kept_.begin(), c) = 1;
      continue;
    }
    const bool moment = c < num_moments;
    std::vector<int> candidates;
    for (const int k : kept_) {
      const bool may =
          moment ? BlockOfFull(k) == BlockOfFull(c)
                 : k < num_moments || !Dissipates(terms_[k - num_moments]);
      if (may) candidates.push_back(k);
    }
    const VectorXd x = ExpressInColumns(U, c, candidates);
    for (size_t k = 0; k < candidates.size(); ++k) {
      const auto row = std::find(kept_.begin(), kept_.end(), candidates[k]);
      regrouping_(row - kept_.begin(), c) = x[k];
    }
  }
  block_begin_.assign(1, 0);
  for (int i = 0; i < num_joints(); ++i) {
    block_begin_.push_back(
        std::count_if(kept_.begin(), kept_.end(),
                      [&](int c) { return BlockOfFull(c) <= i; }));
  }
}

Regressor ModelParameters::MakeRegressor() const {
  RegressorColumns columns;
  const int m = static_cast<int>(moments_.size());
  for (int k = 0; k < size(); ++k) {
    if (kept_[k] < m) {
      columns.moments.push_back(moments_[kept_[k]]);
      columns.moment_index.push_back(k);
    } else {
      columns.terms.push_back(terms_[kept_[k] - m]);
      columns.term_index.push_back(k);
    }
  }
  return Regressor(chain_, unknown_, columns);
}

VectorXd ModelParameters::FullValues(const Robot& robot) const {
  const ProximalChain chain = MakeProximalChain(robot);
  const auto K = CompositeInertials(robot, chain);
  const int m = static_cast<int>(moments_.size());
  VectorXd x(NumFull());
  for (int c = 0; c < m; ++c) {
    x[c] = MomentValue(K[moments_[c].block], moments_[c].moment);
    if (moments_[c].length < 0) continue;
    const Length& l = unknown_[moments_[c].length];
    x[c] *= chain.joints[l.next].X_JG.translation()[l.component];
  }
  for (size_t t = 0; t < terms_.size(); ++t) {
    const Joint& joint = robot.links[terms_[t].joint].joint;
    const double values[] = {joint.viscous, joint.coulomb, joint.offset,
                             joint.armature};
    x[m + t] = values[static_cast<int>(terms_[t].term)];
  }
  return x;
}

VectorXd ModelParameters::Values(const Robot& robot) const {
  CHECK_EQ(robot.num_joints(), num_joints());
  return regrouping_ * FullValues(robot);
}

}  // namespace armcal
