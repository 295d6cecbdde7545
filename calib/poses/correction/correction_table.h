#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/poses/correction/actual_arm.h"

namespace armcal {

// Joint corrections on a grid of joint positions, for controllers that take a
// table: between its nodes they are interpolated linearly along each joint.
struct CorrectionTable {
  std::vector<Eigen::VectorXd> nodes;  // joint by joint, rising; one: constant
  // Rows in the order of the nodes, the last joint's change fastest.
  Eigen::MatrixXd forward, command;  // rad or m

  long size() const { return forward.rows(); }
  // Positions of a row's joints.
  Eigen::VectorXd At(long row) const;
  // Of `forward` or `command` at q; outside of the grid as on its edge.
  Eigen::VectorXd Interpolate(const Eigen::MatrixXd& values,
                              const Eigen::VectorXd& q) const;
};

// Over `range` (rows: joints; least and greatest position), with as many nodes
// for each joint as make the whole error least with `most_rows` of them.
CorrectionTable MakeCorrectionTable(const ActualArm& arm,
                                    const Eigen::MatrixX2d& range,
                                    long most_rows);

// How far the tool is from where it should be, m, at random postures.
struct CorrectionError {
  double median = 0, p95 = 0, most = 0;
};
struct CorrectionErrors {
  // By the robot file, but for a motion of its base frame, which those who
  // teach frames with the arm do not see.
  CorrectionError before;
  CorrectionError command;        // with the commands corrected, exactly
  CorrectionError by_table;       // by the table's commands
  CorrectionError forward_table;  // the file's kinematics at its positions
};
CorrectionErrors MeasureCorrection(const ActualArm& arm,
                                   const CorrectionTable& table,
                                   const Eigen::MatrixX2d& range);

// A header, and a row per node: positions of the joints and both corrections.
std::string CorrectionCsv(const ActualArm& arm, const CorrectionTable& table);

}  // namespace armcal
