#pragma once

#include "model/camera/pinhole_camera.h"
#include "model/log_files/board_reader.h"
#include "model/log_files/pose_reader.h"

namespace armcal {

// Where the camera is: on the tool, looking at a board that stands (eye in
// hand), or standing, looking at a board on the tool (eye to hand).
enum class CameraPlace { kOnTool, kStanding };

// Each image's pose of the tool, with its covariance: an image tells a pose as
// well as all its pixels do, since these are many and their errors small.
// Eye in hand: the tool frame T is the camera's, the instrument's frame W the
// board's; eye to hand: T is the board's, W the camera's. A start from the
// points' homography (or, where they are in no plane, from the 12 entries of
// the projection), then the pose that minimises the pixels' errors, by Gauss
// and Newton with Huber's weights. The pixels' standard deviation is that of
// all images together.
// `file` is for messages. Throws InputError where an image's points do not tell
// a pose (on a line, in the camera's plane).
PoseMeasurements MeasurePoses(const std::string& file,
                              const BoardImages& images,
                              const PinholeCamera& camera, CameraPlace place);

}  // namespace armcal
