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
std::vector<int> RowColumns(const RegressorColumns& columns,
                            const LinkParents& parents, int i,
                            RegressorPlan::Places places) {
  std::vector<int> row;
  if (places == RegressorPlan::Places::kNumbers) {
    row.resize(columns.size());
    std::iota(row.begin(), row.end(), 0);
    return row;
  }
  for (size_t c = 0; c < columns.moments.size(); ++c) {
    if (Moves(parents, i, columns.moments[c].block)) {
      row.push_back(columns.moment_index[c]);
    }
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

void RegressorPlan::AddPaths(const LinkParents& parents, int n) {
  parents_ = parents;
  for (const LinkPath& links : PathsOf(parents, n)) {
    paths_.push_back({links, {}});
    PathData data;
    data.length_columns.resize(links.links.size());
    data.places.resize(links.links.size());
    data_.push_back(data);
  }
}

RegressorPlan::RegressorPlan(const ProximalChain& chain,
                             const std::vector<Length>& unknown,
                             const RegressorColumns& columns, Places places) {
  AddPaths(chain.parents, static_cast<int>(chain.joints.size()));
  length_of_.resize(paths_.size());
  for (size_t p = 0; p < paths_.size(); ++p) {
    for (const int i : paths_[p].links.links) {
      const ProximalJoint& joint = chain.joints[i];
      const Isometry3d X_MJ(Eigen::AngleAxisd(joint.theta, Vector3d::UnitZ()));
      // Gravity is given in the first joint's G.
      const Isometry3d X_PF =
          data_[p].links.empty() ? Isometry3d::Identity() : joint.X_JG;
      data_[p].links.push_back(MakeLink(joint.type, X_PF, X_MJ));
      data_[p].links.back().regrouped = true;
    }
    AddLengths(unknown, static_cast<int>(p));
  }
  AddColumns(columns, places);
  for (size_t p = 0; p < paths_.size(); ++p) {
    const ProximalJoint& first = chain.joints[paths_[p].links.links[0]];
    Connect(static_cast<int>(p),
            first.X_JG.linear().transpose() * chain.gravity);
  }
}

// Those that lie between joints of the path.
void RegressorPlan::AddLengths(const std::vector<Length>& unknown, int path) {
  const std::vector<int>& links = paths_[path].links.links;
  PathData& data = data_[path];
  for (const Length& length : unknown) {
    const auto next = std::find(links.begin(), links.end(), length.next);
    length_of_[path].push_back(-1);
    if (next == links.end()) continue;
    const auto at = static_cast<int>(next - links.begin());
    length_of_[path].back() = static_cast<int>(data.lengths.size());
    data.lengths.push_back({at - 1, length.component});
    data.links[at].p_PF[length.component] = 0;
  }
}

// Columns of the model of link i of a path, if it is the path's own: returns
// their numbers in the order of LinkConstants::places.
std::vector<int> RegressorPlan::AddLink(const RegressorColumns& columns,
                                        int path, int i) {
  PathData& data = data_[path];
  LinkConstants& link = data.links[i];
  const unsigned all =
      link.rotational ? simd::kMomentsOfJoint : simd::kSlidingMoments;
  link.num_moments = __builtin_popcount(all);
  std::vector<int> numbers(link.num_moments, -1);
  if (i < paths_[path].links.first_own) return numbers;
  for (size_t c = 0; c < columns.moments.size(); ++c) {
    const MomentColumn& column = columns.moments[c];
    if (column.block != paths_[path].links.links[i]) continue;
    const LinkMoment moment = MomentOf(column.moment, link.rotational);
    if (column.length < 0) {
      link.moments = all;
      numbers[__builtin_popcount(all & (moment - 1))] = columns.moment_index[c];
    } else {
      data.length_columns[i].push_back(
          {moment, length_of_[path][column.length]});
      numbers.push_back(columns.moment_index[c]);
    }
  }
  return numbers;
}

// Where each column goes in each row: its rank among those that may be nonzero
// there. -1 is of a moment that is not wanted, which kernels compute along with
// the others and leave out.
void RegressorPlan::AddColumns(const RegressorColumns& columns, Places places) {
  int n = 0;
  for (const Path& path : paths_) n = std::max(n, path.links.links.back() + 1);
  std::vector<std::vector<int>> rows;
  for (int i = 0; i < n; ++i) {
    rows.push_back(RowColumns(columns, parents_, i, places));
    row_sizes_.push_back(static_cast<int>(rows[i].size()));
  }
  for (size_t p = 0; p < paths_.size(); ++p) {
    const std::vector<int>& links = paths_[p].links.links;
    for (size_t i = 0; i < links.size(); ++i) {
      const std::vector<int> numbers =
          AddLink(columns, static_cast<int>(p), static_cast<int>(i));
      for (size_t k = 0; k <= i; ++k) {
        for (const int number : numbers) {
          data_[p].places[i].push_back(
              number < 0 ? -1 : PlaceIn(rows[links[k]], number));
        }
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

template <class Place>
void RegressorPlan::AddInertials(const Place& place) {
  for (size_t p = 0; p < paths_.size(); ++p) {
    const LinkPath& path = paths_[p].links;
    for (size_t i = path.first_own; i < path.links.size(); ++i) {
      data_[p].links[i].moments = simd::kMomentsOfLink;
      data_[p].links[i].all_moments = true;
      for (size_t k = 0; k <= i; ++k) {
        for (const int c : kMomentOrder) {
          const int to = place(path.links[i], path.links[k], c);
          data_[p].links[i].all_moments &= to >= 0;
          data_[p].places[i].push_back(to);
        }
      }
    }
  }
}

RegressorPlan::RegressorPlan(const Robot& robot, Places places) {
  AddLinks(robot);
  const int n = robot.num_joints();
  for (int i = 0; i < n; ++i) {
    const int first_row = places == Places::kRanks ? i : 0;
    row_sizes_.push_back(places == Places::kNone ? 1 : 10 * (n - first_row));
  }
  if (places != Places::kNone) {
    AddInertials([places](int i, int row, int c) {
      const int first = places == Places::kRanks ? row : 0;  // link of the row
      return 10 * (i - first) + c;
    });
  }
  for (size_t p = 0; p < paths_.size(); ++p) {
    Connect(static_cast<int>(p), robot.gravity);
  }
}

RegressorPlan::RegressorPlan(const Robot& robot,
                             const std::vector<int>& columns) {
  AddLinks(robot);
  const auto size = static_cast<int>(columns.size());
  for (int i = 0; i < robot.num_joints(); ++i) {
    row_sizes_.push_back(size - PlaceIn(columns, 10 * i));
  }
  AddInertials([&](int i, int row, int c) {
    const int place = PlaceIn(columns, 10 * i + c);
    const bool wanted = place < size && columns[place] == 10 * i + c;
    return wanted ? place - PlaceIn(columns, 10 * row) : -1;
  });
  for (size_t p = 0; p < paths_.size(); ++p) {
    Connect(static_cast<int>(p), robot.gravity);
  }
}

void RegressorPlan::AddLinks(const Robot& robot) {
  AddPaths(robot.parents, robot.num_joints());
  for (size_t p = 0; p < paths_.size(); ++p) {
    for (const int i : paths_[p].links.links) {
      const Link& link = robot.links[i];
      data_[p].links.push_back(MakeLink(link.joint.type, link.X_PF, link.X_ML));
      data_[p].links.back().num_moments = 10;
    }
  }
}

// The constants' pointers, once nothing moves any more; gravity in the frame
// before the path's first joint.
void RegressorPlan::Connect(int path, const Vector3d& gravity) {
  PathData& data = data_[path];
  for (size_t i = 0; i < data.links.size(); ++i) {
    LinkConstants& link = data.links[i];
    link.num_length_columns = static_cast<int>(data.length_columns[i].size());
    link.length_columns = data.length_columns[i].data();
    link.places = data.places[i].data();
    data.row_sizes.push_back(row_sizes_[paths_[path].links.links[i]]);
  }
  simd::ChainConstants& chain = paths_[path].chain;
  chain.num_links = static_cast<int>(data.links.size());
  chain.links = data.links.data();
  chain.num_lengths = static_cast<int>(data.lengths.size());
  chain.lengths = data.lengths.data();
  chain.row_sizes = data.row_sizes.data();
  CopyOut(gravity, chain.gravity);
}

}  // namespace armcal
