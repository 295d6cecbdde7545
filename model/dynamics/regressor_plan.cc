#include "model/dynamics/regressor_plan.h"

#include <algorithm>
#include <numeric>

namespace armcal {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using simd::LinkConstants;
using simd::LinkMoment;

void CopyOut(const Matrix3d& m, double* to) {  // by rows
  for (int k = 0; k < 9; ++k) to[k] = m(k / 3, k % 3);
}
void CopyOut(const Vector3d& v, double* to) {
  for (int k = 0; k < 3; ++k) to[k] = v[k];
}

// X_PF: of the joint's fixed frame in the link before; X_ML: of the link in the
// moved frame.
LinkConstants MakeLink(JointType type, Isometry3d X_PF, Isometry3d X_ML) {
  LinkConstants link{};
  link.rotational = IsRotational(type);
  if (link.rotational) {  // F may be anywhere along the axis: where Mo is Lo
    X_PF = X_PF * Eigen::Translation3d(0, 0, X_ML.translation().z());
    X_ML.translation().z() = 0;
  }
  const Matrix3d R_FP = X_PF.linear().transpose();
  const Matrix3d R_LM = X_ML.linear().transpose();
  // Rz(q)' leaves z, and turns x and y by -q.
  const Matrix3d R = R_LM * R_FP;
  const Matrix3d along = R_LM.col(2) * R_FP.row(2);
  const Matrix3d across = R_LM.col(0) * R_FP.row(1) - R_LM.col(1) * R_FP.row(0);
  CopyOut(link.rotational ? along : R, link.R0);
  if (link.rotational) {
    CopyOut(Matrix3d(R - along), link.Rc);
    CopyOut(across, link.Rs);
  }
  const Vector3d axis = R_LM.col(2), p_ML = R_LM * X_ML.translation();
  CopyOut(Vector3d(X_PF.translation()), link.p_PF);
  CopyOut(p_ML, link.p_ML);
  CopyOut(axis, link.axis);
  CopyOut(axis, link.rotational ? link.angular : link.linear);
  link.has_offset = !link.rotational || !p_ML.isZero(0);
  link.axis_index = -1;
  for (int k = 0; k < 3 && !link.has_offset; ++k) {
    const double sign = axis[k] < 0 ? -1 : 1;
    if ((axis - sign * Vector3d::Unit(k)).norm() > 1e-15) continue;
    link.axis_index = k;
    link.axis_sign = sign;
  }
  return link;
}

LinkMoment MomentOf(Moment moment, bool rotational) {
  switch (moment) {
    case Moment::kM:
      return simd::kSlidingMass;
    case Moment::kHx:
      return rotational ? simd::kHx : simd::kSlidingHx;
    case Moment::kHy:
      return rotational ? simd::kHy : simd::kSlidingHy;
    case Moment::kHz:
      return simd::kSlidingHz;
    case Moment::kIxxMinusIyy:
      return simd::kIxxMinusIyy;
    case Moment::kIxy:
      return simd::kIxy;
    case Moment::kIxz:
      return simd::kIxz;
    case Moment::kIyz:
      return simd::kIyz;
    case Moment::kIzz:
      break;
  }
  return simd::kIzzOfJoint;
}

// Numbers of row i's columns, ascending; those that are places themselves: all.
std::vector<int> RowColumns(const RegressorColumns& columns, int i,
                            RegressorPlan::Places places) {
  std::vector<int> row;
  if (places == RegressorPlan::Places::kNumbers) {
    row.resize(columns.size());
    std::iota(row.begin(), row.end(), 0);
    return row;
  }
  for (size_t c = 0; c < columns.moments.size(); ++c) {
    if (columns.moments[c].block >= i) row.push_back(columns.moment_index[c]);
  }
  for (size_t c = 0; c < columns.terms.size(); ++c) {
    if (columns.terms[c].joint == i) row.push_back(columns.term_index[c]);
  }
  std::sort(row.begin(), row.end());
  return row;
}

int PlaceIn(const std::vector<int>& row, int column) {
  return std::lower_bound(row.begin(), row.end(), column) - row.begin();
}

// Ten inertial parameters in the order of their bits.
constexpr int kMomentOrder[] = {4, 5, 6, 7, 8, 9, 0, 1, 2, 3};

}  // namespace

RegressorPlan::RegressorPlan(const ProximalChain& chain,
                             const std::vector<Length>& unknown,
                             const RegressorColumns& columns, Places places) {
  Isometry3d X_PF = Isometry3d::Identity();  // of G_i in J_{i-1}
  for (const ProximalJoint& joint : chain.joints) {
    const Isometry3d X_MJ(Eigen::AngleAxisd(joint.theta, Vector3d::UnitZ()));
    links_.push_back(MakeLink(joint.type, X_PF, X_MJ));
    links_.back().regrouped = true;
    X_PF.linear() = joint.R;
    X_PF.translation() = joint.p;
  }
  for (const Length& length : unknown) {
    lengths_.push_back({length.joint, length.component});
    links_[length.joint + 1].p_PF[length.component] = 0;
  }
  AddColumns(columns, places);
  Connect(chain.gravity);
}

// Link i's columns of the model: returns their numbers in the order of
// LinkConstants::places.
std::vector<int> RegressorPlan::AddLink(const RegressorColumns& columns,
                                        int i) {
  LinkConstants& link = links_[i];
  const unsigned all =
      link.rotational ? simd::kMomentsOfJoint : simd::kSlidingMoments;
  link.num_moments = __builtin_popcount(all);
  std::vector<int> numbers(link.num_moments, -1);
  for (size_t c = 0; c < columns.moments.size(); ++c) {
    const MomentColumn& column = columns.moments[c];
    if (column.block != i) continue;
    const LinkMoment moment = MomentOf(column.moment, link.rotational);
    if (column.length < 0) {
      link.moments = all;
      numbers[__builtin_popcount(all & (moment - 1))] = columns.moment_index[c];
    } else {
      length_columns_[i].push_back({moment, column.length});
      numbers.push_back(columns.moment_index[c]);
    }
  }
  return numbers;
}

void RegressorPlan::AddColumns(const RegressorColumns& columns, Places places) {
  const int n = num_joints();
  length_columns_.resize(n);
  places_.resize(n);
  std::vector<std::vector<int>> rows;
  for (int i = 0; i < n; ++i) {
    rows.push_back(RowColumns(columns, i, places));
    row_sizes_.push_back(static_cast<int>(rows[i].size()));
    const std::vector<int> numbers = AddLink(columns, i);
    for (int k = 0; k <= i; ++k) {
      for (const int number : numbers) {
        places_[i].push_back(number < 0 ? -1 : PlaceIn(rows[k], number));
      }
    }
  }
  int coulomb = 0;
  for (size_t c = 0; c < columns.terms.size(); ++c) {
    const JointTermColumn& term = columns.terms[c];
    terms_.push_back({term, PlaceIn(rows[term.joint], columns.term_index[c]),
                      term.term == JointTerm::kCoulomb ? coulomb++ : -1});
  }
}

RegressorPlan::RegressorPlan(const Robot& robot, Places places) {
  AddLinks(robot);
  const int n = num_joints();
  for (int i = 0; i < n; ++i) {
    const int first_row = places == Places::kRanks ? i : 0;
    row_sizes_.push_back(places == Places::kNone ? 1 : 10 * (n - first_row));
    if (places == Places::kNone) continue;
    links_[i].moments = simd::kMomentsOfLink;
    links_[i].all_moments = true;
    for (int k = 0; k <= i; ++k) {
      for (const int c : kMomentOrder) {
        const int first = places == Places::kRanks ? k : 0;  // link of the row
        places_[i].push_back(10 * (i - first) + c);
      }
    }
  }
  Connect(robot.gravity);
}

RegressorPlan::RegressorPlan(const Robot& robot,
                             const std::vector<int>& columns) {
  AddLinks(robot);
  const int n = num_joints();
  const auto size = static_cast<int>(columns.size());
  for (int i = 0; i < n; ++i) {
    row_sizes_.push_back(size - PlaceIn(columns, 10 * i));
    links_[i].moments = simd::kMomentsOfLink;
    links_[i].all_moments =
        PlaceIn(columns, 10 * i + 10) - PlaceIn(columns, 10 * i) == 10;
    for (int k = 0; k <= i; ++k) {
      for (const int c : kMomentOrder) {
        const int place = PlaceIn(columns, 10 * i + c);
        const bool wanted = place < size && columns[place] == 10 * i + c;
        places_[i].push_back(wanted ? place - PlaceIn(columns, 10 * k) : -1);
      }
    }
  }
  Connect(robot.gravity);
}

void RegressorPlan::AddLinks(const Robot& robot) {
  for (const Link& link : robot.links) {
    links_.push_back(MakeLink(link.joint.type, link.X_PF, link.X_ML));
    links_.back().num_moments = 10;
  }
  length_columns_.resize(links_.size());
  places_.resize(links_.size());
}

// The constants' pointers, once nothing moves any more.
void RegressorPlan::Connect(const Vector3d& gravity) {
  for (size_t i = 0; i < links_.size(); ++i) {
    LinkConstants& link = links_[i];
    link.num_length_columns = static_cast<int>(length_columns_[i].size());
    link.length_columns = length_columns_[i].data();
    link.places = places_[i].data();
  }
  chain_.num_links = num_joints();
  chain_.links = links_.data();
  chain_.num_lengths = static_cast<int>(lengths_.size());
  chain_.lengths = lengths_.data();
  chain_.row_sizes = row_sizes_.data();
  CopyOut(gravity, chain_.gravity);
}

}  // namespace armcal
