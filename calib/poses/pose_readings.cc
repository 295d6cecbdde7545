#include "calib/poses/pose_readings.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "calib/logs/encoder_noise.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;

constexpr double kDegree = M_PI / 180;
constexpr double kInch = .0254;  // m

using Readings = std::vector<PoseReading>;

// What numbers are times those that were read.
struct ReadUnits {
  double angles, lengths;
};

const char* LengthColumn(const PoseMeasurements& measured) {
  if (measured.lengths.size() > 0) return "length1";
  return measured.targets.empty() ? "x" : "x1";
}

// "joint positions are degrees: expected [deg] in their names, as in q1 [deg]"
std::string UnitsMeant(const PoseMeasurements& measured,
                       const ReadUnits& units) {
  std::string text;
  if (units.angles != 1) {
    const bool degrees = units.angles < 1;
    text += std::string("joint positions are ") +
            (degrees ? "degrees that were read as radians: expected names that "
                       "end with [deg], as in 'q1 [deg]'"
                     : "radians that were read as degrees: expected names "
                       "without [deg]");
  }
  if (units.lengths == 1) return text;
  const std::string column = LengthColumn(measured);
  text += text.empty() ? "" : "; ";
  if (units.lengths == kInch) {
    text += "lengths are inches that were read as metres: expected metres";
  } else if (units.lengths < 1) {
    text +=
        "lengths are millimetres that were read as metres: expected names that "
        "end with [mm], as in '" +
        column + " [mm]'";
  } else {
    text +=
        "lengths are metres that were read as millimetres: expected names "
        "without [mm]";
  }
  return text;
}

void AddUnits(const Robot& robot, const PoseMeasurements& measured,
              Readings* readings) {
  std::vector<int> turning;
  for (int i = 0; i < robot.num_joints(); ++i) {
    if (IsRotational(robot.links[i].joint.type)) turning.push_back(i);
  }
  // Of images lengths are in the board's unit, in which covariances are, too.
  const bool scales = measured.covariance.empty();
  for (const double angles : {1., kDegree, 1 / kDegree}) {
    for (const double lengths : {1., 1e-3, 1e3, kInch}) {
      if (angles == 1 && lengths == 1) continue;
      if (!scales && lengths != 1) continue;
      const auto apply = [=](PoseMeasurements* m) {
        for (const int i : turning) m->q.col(i) *= angles;
        for (MatrixXd& target : m->targets) target *= lengths;
        if (m->poses.size() > 0) m->poses.leftCols(3) *= lengths;
        m->lengths *= lengths;
      };
      readings->push_back({UnitsMeant(measured, {angles, lengths}), apply, {}});
    }
  }
}

// One axis negated. Of targets any axis will do, and two that are exchanged are
// the same, since the instrument's frame is turned as it fits.
void MirrorTargets(PoseMeasurements* m) {
  for (MatrixXd& target : m->targets) target.col(1) *= -1;
}

using ChangedPose =
    std::function<Eigen::Isometry3d(const Eigen::Isometry3d& X)>;

std::function<void(PoseMeasurements*)> EachPose(const ChangedPose& change) {
  return [change](PoseMeasurements* m) {
    for (Eigen::Index k = 0; k < m->poses.rows(); ++k) {
      auto row = m->poses.row(k);
      Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
      X.linear() = Eigen::Quaterniond(row[3], row[4], row[5], row[6]).matrix();
      X.translation() = row.head<3>();
      X = change(X);
      const Eigen::Quaterniond turn(X.linear());
      row << X.translation().transpose(), turn.w(), turn.vec().transpose();
    }
  };
}

// Reflections: three axes negated, three pairs exchanged.
std::vector<std::pair<std::string, Eigen::Matrix3d>> Reflections() {
  std::vector<std::pair<std::string, Eigen::Matrix3d>> all;
  for (int axis = 0; axis < 3; ++axis) {
    const std::string name(1, "xyz"[axis]), next(1, "xyz"[(axis + 1) % 3]);
    Eigen::Matrix3d negated = Eigen::Matrix3d::Identity();
    negated(axis, axis) = -1;
    all.emplace_back("column " + name + " negated", negated);
    Eigen::Matrix3d exchanged = Eigen::Matrix3d::Identity();
    exchanged.col(axis).swap(exchanged.col((axis + 1) % 3));
    all.emplace_back("columns " + name + " and " + next + " exchanged",
                     exchanged);
  }
  return all;
}

constexpr char kLeftHanded[] = "positions are in a left-handed frame";

// Where the rotations are mirrored as the positions are, all mirrors are one
// (X -> S X S), since base and tool are turned as they fit; where the rotations
// are right as they are, it matters which axis it is.
void AddMirroredPoses(Readings* readings) {
  readings->push_back(
      {std::string(kLeftHanded) +
           ", and so are orientations: expected a right-handed one, as with y, "
           "qx and qz negated",
       EachPose([](const Eigen::Isometry3d& X) {
         const Vector3d mirror(1, -1, 1);
         Eigen::Isometry3d result = X;
         result.linear() =
             mirror.asDiagonal() * X.linear() * mirror.asDiagonal();
         result.translation() = mirror.asDiagonal() * X.translation();
         return result;
       }),
       {}});
  for (const auto& [what, mirror] : Reflections()) {
    const Eigen::Matrix3d S = mirror;
    readings->push_back(
        {std::string(kLeftHanded) +
             ", orientations are not: expected a right-handed one, as with " +
             what,
         EachPose([S](const Eigen::Isometry3d& X) {
           Eigen::Isometry3d result = X;
           result.translation() = S * X.translation();
           return result;
         }),
         {}});
  }
}

void AddQuaternions(Readings* readings) {
  // Numbers under qw qx qy qz: which of these is which component.
  const auto order = [](int w, int x, int y, int z) {
    return [=](PoseMeasurements* m) {
      for (Eigen::Index k = 0; k < m->poses.rows(); ++k) {
        const Eigen::Vector4d q = m->poses.row(k).tail<4>();
        m->poses.row(k).tail<4>() << q[w], q[x], q[y], q[z];
      }
    };
  };
  readings->push_back(
      {"quaternions are in the order x y z w and were read as w x y z: "
       "expected the columns' names qx, qy, qz, qw in this order",
       order(3, 0, 1, 2),
       {}});
  readings->push_back(
      {"quaternions are in the order w x y z and were read as x y z w: "
       "expected the columns' names qw, qx, qy, qz in this order",
       order(1, 2, 3, 0),
       {}});
  readings->push_back(
      {"orientations are the instrument's frame in the tool's: expected the "
       "tool's in the instrument's, with qx, qy and qz negated",
       EachPose([](const Eigen::Isometry3d& X) {
         Eigen::Isometry3d result = X;
         result.linear() = X.linear().transpose();
         return result;
       }),
       {}});
}

void AddFrames(const PoseMeasurements& measured, Readings* readings) {
  // Armcal itself makes the poses of images.
  if (!measured.covariance.empty()) return;
  if (!measured.targets.empty()) {
    readings->push_back({std::string(kLeftHanded) +
                             ": expected a right-handed one, as with columns "
                             "x1 and y1 exchanged (x2 and y2, ..)",
                         MirrorTargets,
                         {}});
  }
  if (measured.poses.size() == 0) return;
  readings->push_back(
      {"poses are the instrument's frame (or the base) in the tool's: expected "
       "their inverse, the tool in the instrument's frame",
       EachPose([](const Eigen::Isometry3d& X) { return X.inverse(); }),
       {}});
  AddQuaternions(readings);
  AddMirroredPoses(readings);
}

// A joint that stands shows neither its sign nor its place.
void AddJoints(const Robot& robot, const PoseMeasurements& measured,
               Readings* readings) {
  const Eigen::VectorXd travel =
      measured.q.colwise().maxCoeff() - measured.q.colwise().minCoeff();
  const auto name = [&](int i) { return robot.links[i].joint.name; };
  for (int i = 0; i < robot.num_joints(); ++i) {
    const bool turns = IsRotational(robot.links[i].joint.type);
    if (travel[i] >= kLeastTravel) {
      readings->push_back(
          {"joint " + name(i) +
               " counts the other way: expected its positions negated",
           [i](PoseMeasurements* m) { m->q.col(i) *= -1; },
           {i},
           true});
    }
    for (int j = i + 1; j < robot.num_joints(); ++j) {
      if (turns != IsRotational(robot.links[j].joint.type)) continue;
      if (std::max(travel[i], travel[j]) < kLeastTravel) continue;
      readings->push_back(
          {"the columns of joints " + name(i) + " and " + name(j) +
               " are exchanged: expected each other's name above them",
           [i, j](PoseMeasurements* m) { m->q.col(i).swap(m->q.col(j)); },
           {i, j}});
    }
  }
}

}  // namespace

std::vector<PoseReading> PoseReadings(const Robot& robot,
                                      const PoseMeasurements& measured) {
  Readings readings;
  AddUnits(robot, measured, &readings);
  AddFrames(measured, &readings);
  AddJoints(robot, measured, &readings);
  return readings;
}

}  // namespace armcal
