#include "calib/poses/repeated_poses.h"

#include <algorithm>
#include <map>

namespace armcal {
namespace {

// rad or m. Encoders of arms resolve 1e-5 to 1e-6 and their drives hold a
// standstill to some steps of that; arms are commanded apart by more.
constexpr double kSamePose = 1e-4;

// The joint that moves most, by whose position rows are looked up.
Eigen::Index WidestJoint(const Eigen::MatrixXd& q) {
  Eigen::Index widest = 0;
  (q.colwise().maxCoeff() - q.colwise().minCoeff()).maxCoeff(&widest);
  return widest;
}

}  // namespace

// A row is compared with the first row of each pose, of which only those can be
// near that are near in one joint. So a million pairs need not be looked at,
// and a slow drift does not chain different poses to one.
std::vector<int> RepeatedPoses(const Eigen::MatrixXd& q) {
  if (q.rows() == 0) return {};
  const Eigen::Index joint = WidestJoint(q);
  std::multimap<double, std::pair<Eigen::Index, int>> firsts;
  std::vector<int> poses;
  int count = 0;
  for (Eigen::Index k = 0; k < q.rows(); ++k) {
    const auto end = firsts.upper_bound(q(k, joint) + kSamePose);
    auto first = firsts.lower_bound(q(k, joint) - kSamePose);
    const auto is_same = [&](const auto& other) {
      return (q.row(other.second.first) - q.row(k)).cwiseAbs().maxCoeff() <
             kSamePose;
    };
    first = std::find_if(first, end, is_same);
    if (first != end) {
      poses.push_back(first->second.second);
      continue;
    }
    firsts.emplace(q(k, joint), std::make_pair(k, count));
    poses.push_back(count++);
  }
  return poses;
}

int CountPoses(const std::vector<int>& pose_of_row) {
  if (pose_of_row.empty()) return 0;
  return 1 + *std::max_element(pose_of_row.begin(), pose_of_row.end());
}

Eigen::MatrixXd MeansByPose(const Eigen::MatrixXd& by_row,
                            const std::vector<int>& pose_of_row) {
  const int poses = CountPoses(pose_of_row);
  Eigen::MatrixXd means = Eigen::MatrixXd::Zero(by_row.rows(), poses);
  Eigen::RowVectorXd readings = Eigen::RowVectorXd::Zero(poses);
  for (size_t k = 0; k < pose_of_row.size(); ++k) {
    means.col(pose_of_row[k]) += by_row.col(static_cast<Eigen::Index>(k));
    readings[pose_of_row[k]] += 1;
  }
  return means.array().rowwise() / readings.array();
}

std::vector<int> InterleavedFolds(const std::vector<int>& pose_of_row,
                                  int folds) {
  std::vector<int> of_row;
  for (const int pose : pose_of_row) of_row.push_back(pose % folds);
  return of_row;
}

std::vector<int> ContiguousFolds(const std::vector<int>& pose_of_row,
                                 int folds) {
  const long poses = CountPoses(pose_of_row);
  std::vector<int> of_row;
  for (const int pose : pose_of_row) {
    of_row.push_back(static_cast<int>(folds * pose / poses));
  }
  return of_row;
}

}  // namespace armcal
