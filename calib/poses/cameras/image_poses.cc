#include "calib/poses/cameras/image_poses.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>

#include "calib/poses/cameras/camera_poses.h"
#include "calib/poses/cameras/camera_rig.h"
#include "calib/poses/hand_eye.h"
#include "model/robot/arm_geometry.h"
#include "model/text/input_error.h"

namespace armcal {
namespace {

using Eigen::Isometry3d;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kLens = PinholeCamera::kLensSize;

// The images of one camera.
struct OneCamera {
  std::vector<int> image;  // which of all they are
  CameraPoses poses;
  std::optional<CameraRig> rig;  // nothing: the first one
};

int NumCameras(const std::string& file, const BoardImages& images,
               const CameraOptions& options) {
  const int count =
      1 + *std::max_element(images.camera.begin(), images.camera.end());
  const int given = static_cast<int>(options.cameras.size());
  if (options.cameras.empty() || given == count) return count;
  throw InputError(file, "column camera", std::to_string(count) + " cameras",
                   "expected as many as there are files of intrinsics, " +
                       std::to_string(given));
}

OneCamera MeasureOne(const std::string& file, const BoardImages& images,
                     int camera, const CameraOptions& options) {
  OneCamera one;
  ImageSource source = {file, {}};
  std::vector<ImageView> views;
  for (int k = 0; k < images.size(); ++k) {
    if (images.camera[k] != camera) continue;
    one.image.push_back(k);
    source.row.push_back(images.row[k]);
    views.emplace_back(images.points[k], images.pixels[k], options.place);
  }
  if (views.empty()) {
    throw InputError(file, "column camera", "",
                     "expected images of camera " + std::to_string(camera + 1));
  }
  const PinholeCamera* const given =
      options.cameras.empty() ? nullptr : &options.cameras[camera];
  one.poses = given != nullptr && !options.estimate_lens
                  ? PosesOfImages(source, views, *given)
                  : PosesAndLensOfImages(source, views, given);
  return one;
}

void PlaceCameras(const std::string& file, const Robot& robot,
                  const BoardImages& images, CameraPlace place,
                  std::vector<OneCamera>* cameras) {
  if (cameras->size() == 1) return;
  const ArmGeometry geometry(robot);
  std::vector<HandEye> frames;
  for (size_t c = 0; c < cameras->size(); ++c) {
    const OneCamera& camera = (*cameras)[c];
    const auto found =
        SolveHandEye(geometry, geometry.Values(),
                     images.q(camera.image, Eigen::all), camera.poses.X_WT);
    if (!found) {
      throw InputError(
          file, "camera " + std::to_string(c + 1), "",
          "its images do not tell where it is: expected three or more with the "
          "last link turned about two axes");
    }
    frames.push_back(*found);
  }
  for (size_t c = 1; c < cameras->size(); ++c) {
    OneCamera& camera = (*cameras)[c];
    camera.rig.emplace(place, frames[0], frames[c], camera.poses.X_WT);
  }
}

void SetPose(const Isometry3d& X, int row, PoseMeasurements* measured) {
  const Eigen::Quaterniond turn(X.linear());
  measured->poses.row(row) << X.translation().transpose(), turn.w(), turn.x(),
      turn.y(), turn.z();
}

// Poses and covariances in the first camera's frames.
void AddPoses(const OneCamera& camera, PoseMeasurements* measured) {
  for (size_t i = 0; i < camera.image.size(); ++i) {
    const int k = camera.image[i];
    const Isometry3d& seen = camera.poses.X_WT[i];
    const Matrix6d& covariance = camera.poses.covariance[i];
    if (!camera.rig) {
      SetPose(seen, k, measured);
      measured->covariance[k] = covariance;
      continue;
    }
    SetPose(camera.rig->InFirst(seen), k, measured);
    const Matrix6d carry = camera.rig->Carry(seen);
    measured->covariance[k] = carry * covariance * carry.transpose();
  }
}

// Adds unknowns of one kind: their priors and what they stand for.
void AddUnknowns(const VectorXd& prior, const VectorXd& start,
                 const MatrixXd& by_unknowns, InstrumentUnknowns* unknowns) {
  const Eigen::Index u = unknowns->prior.size(), v = unknowns->start.size();
  unknowns->prior.conservativeResize(u + prior.size());
  unknowns->prior.tail(prior.size()) = prior;
  unknowns->start.conservativeResize(v + start.size());
  unknowns->start.tail(start.size()) = start;
  MatrixXd all = MatrixXd::Zero(v + start.size(), u + prior.size());
  all.topLeftCorner(v, u) = unknowns->by_unknowns;
  all.bottomRightCorner(start.size(), prior.size()) = by_unknowns;
  unknowns->by_unknowns = all;
  for (MatrixXd& moves : unknowns->moves) {
    moves.conservativeResize(6, u + prior.size());
    moves.rightCols(prior.size()).setZero();
  }
}

// The lens by its parameters' standardised errors: values = start + L z with
// z of variance 1, L L' the covariance.
void AddLens(const OneCamera& camera, const std::string& name,
             InstrumentUnknowns* unknowns) {
  const MatrixXd L = camera.poses.lens_covariance.llt().matrixL();
  AddUnknowns(VectorXd::Ones(kLens), camera.poses.camera.lens(), L, unknowns);
  for (int k = 0; k < kLens; ++k) {
    unknowns->names.push_back(name + "." + PinholeCamera::LensName(k));
    unknowns->units.push_back(PinholeCamera::LensUnit(k));
  }
  for (size_t i = 0; i < camera.image.size(); ++i) {
    MatrixXd moves = camera.poses.by_lens[i] * L;
    if (camera.rig) moves = camera.rig->Carry(camera.poses.X_WT[i]) * moves;
    unknowns->moves[camera.image[i]].rightCols(kLens) = moves;
  }
}

void AddPlace(const OneCamera& camera, const std::string& name,
              InstrumentUnknowns* unknowns) {
  AddUnknowns(VectorXd::Zero(6), camera.rig->Values(),
              camera.rig->ValuesByMoves(), unknowns);
  for (const char* part : {"x", "y", "z", "yaw", "pitch", "roll"}) {
    unknowns->names.push_back(name + "." + part);
    unknowns->units.push_back(std::string(part).size() == 1 ? "m" : "rad");
  }
  for (size_t i = 0; i < camera.image.size(); ++i) {
    unknowns->moves[camera.image[i]].rightCols(6) =
        camera.rig->Moves(camera.poses.X_WT[i]);
  }
}

}  // namespace

PoseMeasurements MeasurePoses(const std::string& file,
                              const BoardImages& images, const Robot& robot,
                              const CameraOptions& options) {
  const int count = NumCameras(file, images, options);
  std::vector<OneCamera> cameras;
  for (int c = 0; c < count; ++c) {
    cameras.push_back(MeasureOne(file, images, c, options));
  }
  PlaceCameras(file, robot, images, options.place, &cameras);
  PoseMeasurements measured;
  measured.q = images.q;
  measured.row = images.row;
  measured.number = images.number;
  measured.poses.resize(images.size(), 7);
  measured.covariance.resize(images.size());
  InstrumentUnknowns& unknowns = measured.instrument;
  unknowns.moves.assign(images.size(), MatrixXd(6, 0));
  double squares = 0;
  for (int c = 0; c < count; ++c) {
    const std::string name =
        count == 1 ? "camera" : "camera" + std::to_string(c + 1);
    AddPoses(cameras[c], &measured);
    if (cameras[c].rig) AddPlace(cameras[c], name, &unknowns);
    if (!cameras[c].poses.by_lens.empty()) {
      measured.cameras.push_back({name, cameras[c].poses.camera,
                                  static_cast<int>(unknowns.start.size())});
      AddLens(cameras[c], name, &unknowns);
    }
    squares += static_cast<double>(cameras[c].image.size()) *
               std::pow(cameras[c].poses.pixel_stddev, 2);
  }
  measured.pixel_stddev = std::sqrt(squares / images.size());
  return measured;
}

}  // namespace armcal
