#pragma once

#include <string>
#include <vector>

#include "calib/poses/cameras/image_view.h"
#include "model/log_files/board_reader.h"
#include "model/log_files/pose_reader.h"
#include "model/robot/robot.h"

namespace armcal {

struct CameraOptions {
  // The lens of each camera; none: of all by the images alone.
  std::vector<PinholeCamera> cameras;
  // Whether lenses are estimated, too, beginning with those.
  bool estimate_lens = false;
  CameraPlace place = CameraPlace::kOnTool;  // of all of them
};

// Each image's pose of the tool, with its covariance (camera_poses.h). T is the
// first camera's frame and W the board's, or T the board's and W the first
// camera's.
//
// What the images leave open of a lens moves all poses alike. So does where a
// further camera is, of which a start is found by hand-eye calibration
// (hand_eye.h) of each camera for itself. Both are unknowns of the poses that
// are returned, to be estimated with the arm: which is as exact as one estimate
// from all pixels, but for second orders of these unknowns, since an image's
// normal equations hold all that its pixels say of its pose and the lens.
//
// `file` is for messages. Throws InputError where images do not tell a pose or
// a lens, or a further camera not where it is.
PoseMeasurements MeasurePoses(const std::string& file,
                              const BoardImages& images, const Robot& robot,
                              const CameraOptions& options);

}  // namespace armcal
