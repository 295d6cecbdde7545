#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <string>
#include <vector>

#include "model/camera/pinhole_camera.h"

namespace armcal {

using Matrix6d = Eigen::Matrix<double, 6, 6>;

// Unknowns of an instrument that move the poses that it measured: a camera's
// lens, where a second camera is. They are small, from a start that is known.
struct InstrumentUnknowns {
  // Standard deviation of what was known of each before, about 0; 0: nothing.
  Eigen::VectorXd prior;
  // Of each pose, 6 x unknowns: by how much a unit of each displaces (m) and
  // turns (rad) what was measured, both in the instrument's frame.
  std::vector<Eigen::MatrixXd> moves;
  // What they stand for: values = start + by_unknowns * unknowns.
  std::vector<std::string> names, units;
  Eigen::VectorXd start;
  Eigen::MatrixXd by_unknowns;

  int size() const { return static_cast<int>(prior.size()); }
};

// A camera whose lens is among the unknowns, as the images alone tell it.
struct EstimatedCamera {
  std::string name;  // with which the names of its parameters begin
  PinholeCamera camera;
  int first;  // of its parameters in the instrument's `names`
};

// What was measured of the arm's geometry at a number of standstill positions.
// Poses in rows.
struct PoseMeasurements {
  enum class Kind { kTargets, kPoses, kWire, kTilts, kPoints, kPlanes };
  Kind kind() const {
    if (lengths.size() > 0) return Kind::kWire;
    if (poses.size() > 0) return Kind::kPoses;
    if (tilts.size() > 0) return Kind::kTilts;
    if (touched.empty()) return Kind::kTargets;
    return planes ? Kind::kPlanes : Kind::kPoints;
  }

  Eigen::MatrixXd q;      // rad or m, poses x joints
  std::vector<long> row;  // line of the file, header = 1
  // What the file's column `pose` calls each; empty where it has none, or no
  // whole numbers in it.
  std::vector<long> number;
  // Positions (m) of targets on the tool in the frame of the instrument, a
  // matrix of poses x 3 per target.
  std::vector<Eigen::MatrixXd> targets;
  // Tool poses in the frame of the instrument: x y z (m) qw qx qy qz.
  Eigen::MatrixXd poses;
  // Of each pose the covariance of the instrument's errors of position (m) and
  // rotation (rad, both in its frame); the arm's own come on top of that.
  // Empty: not known.
  std::vector<Matrix6d> covariance;
  // Of whole poses; of size 0 where the instrument is known.
  InstrumentUnknowns instrument;
  // Those whose lens is estimated.
  std::vector<EstimatedCamera> cameras;
  // px, standard deviation of a coordinate in the images that poses were made
  // of; 0: of none.
  double pixel_stddev = 0;
  // Length (m) of a wire drawn from a fixed anchor to the tool.
  Eigen::VectorXd lengths;
  // Of an inclinometer on the tool: by how much its axes x and y rise above the
  // horizontal, rad, poses x 2.
  Eigen::MatrixXd tilts;
  // Which of several points, counted from 0, the tool's tip touches; where they
  // are is not known.
  std::vector<int> touched;
  bool planes = false;  // these are planes instead of points
  // Per target (or one): half-width of the instrument's 95 % interval of a
  // coordinate or a length, m, 0 where it is not stated; poses x columns, empty
  // where the file has none.
  Eigen::MatrixXd u95;

  int size() const { return static_cast<int>(q.rows()); }
  int num_points() const {
    return touched.empty()
               ? 0
               : 1 + *std::max_element(touched.begin(), touched.end());
  }
};

// Reads a table of poses, CSV or another format (line_source.h): joint
// positions like a log's (q1.. or shoulder/position, with units) or by the
// names of joints alone, and x1 y1 z1 [x2 y2 z2 ...] for targets, or x y z qw
// qx qy qz, or length1, or point, the number (from 1) of the point that is
// touched, or plane, that of a plane, or tilt_x tilt_y (rad or [deg]), of an
// inclinometer; optional u95_1 [u95_2 ...] and pose, a number. Lengths in m
// unless a suffix [mm] says otherwise. Throws InputError.
PoseMeasurements ReadPoses(const std::string& path,
                           const std::vector<std::string>& joint_names);

}  // namespace armcal
