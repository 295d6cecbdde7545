#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/closed_loop/values.h"
#include "model/dynamics/joint_term.h"
#include "model/robot/robot.h"

namespace armcal {

// How far the truth may reasonably be from the files: standard deviations of
// the prior. 0: exact, hence held.
struct LoopTrust {
  // Relative, in every direction of the links' pseudo-inertias.
  double inertia = .5;
  double gains = 0;    // relative, of the controller's
  double delay = .02;  // s
  // Of friction, offset and armature, whose torque at 1 rad/s and 1 rad/s^2 is
  // this many times what the controller gives.
  double joint_terms = 10;
  double width = 1;  // relative, of the speed in which friction changes sign
};

// What is unknown of an arm in a position loop, in LoopOrder: names, units,
// what the files say and how far they are trusted.
class LoopUnknowns {
 public:
  // `nominal`: of the files. `torque_rms`: per joint, N m or N.
  LoopUnknowns(const LoopValues& nominal, DriveKind kind,
               const LoopTrust& trust,
               const std::vector<JointTerm>& joint_terms,
               const Eigen::VectorXd& torque_rms);

  int size() const { return static_cast<int>(names_.size()); }
  int num_links() const { return n_; }
  int links_size() const { return 10 * n_; }
  const std::string& name(int k) const { return names_[k]; }
  const std::string& unit(int k) const { return units_[k]; }
  // Standard deviation of the normal prior about the files' value; 0: held.
  // Links have InertialPrior.
  double prior(int k) const { return prior_[k]; }
  bool is_free(int k) const { return free_[k]; }
  const std::vector<bool>& free() const { return free_; }
  // Whether there is such a thing: drives of one kind have not all gains.
  bool exists(int k) const { return !names_[k].empty(); }
  bool is_positive(int k) const { return least_[k] >= 0; }
  double least(int k) const { return least_[k]; }  // -1: any value
  // Whether a value is at its bound, which an interior point comes near and
  // does not reach: within 1e-5 of the prior's deviation.
  bool IsAtBound(int k, const Eigen::VectorXd& x) const {
    return is_free(k) && is_positive(k) && x[k] < least(k) + 1e-5 * prior(k);
  }
  // Values that are, exactly: no delay is none, and not 20 ns.
  Eigen::VectorXd ToBounds(Eigen::VectorXd x) const {
    for (int k = 0; k < size(); ++k) {
      if (IsAtBound(k, x)) x[k] = least(k);
    }
    return x;
  }
  const Eigen::VectorXd& nominal() const { return nominal_; }
  std::vector<int> FreeIndices() const;

  Eigen::VectorXd Stack(const LoopValues& values) const;
  LoopValues At(const Eigen::VectorXd& x) const;

 private:
  void Add(const std::string& name, const std::string& unit, double prior,
           double least);

  void AddGains(DriveKind kind, double trust);

  int n_;
  LoopValues files_;
  std::vector<std::string> names_, units_;
  std::vector<double> prior_, least_;
  std::vector<bool> free_;
  Eigen::VectorXd nominal_;
};

}  // namespace armcal
