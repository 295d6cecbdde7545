#include "tools/pose_flags.h"

#include <gflags/gflags.h>

#include <string>

#include "calib/poses/image_poses.h"
#include "model/camera/camera_file.h"
#include "model/log_files/board_reader.h"
#include "tools/flag_choices.h"

DEFINE_string(poses, "",
              "`FILE` CSV of measured poses, wire lengths, touches, images");
DEFINE_string(camera, "",
              "`FILE` of --poses with images: camera_info YAML of ROS");
DEFINE_string(camera_on, "tool",
              "where the camera is: tool (the board stands), world (the "
              "board is on the tool)");

namespace armcal {
namespace {

const FlagChoices<CameraPlace> kCameraPlaces(
    "camera_on",
    {{"tool", CameraPlace::kOnTool}, {"world", CameraPlace::kStanding}});

}  // namespace

PoseMeasurements PosesFromFlags(const FlagValues& flags, const Robot& robot) {
  return PosesFromFile(flags, robot, flags.Text("poses"));
}

PoseMeasurements PosesFromFile(const FlagValues& flags, const Robot& robot,
                               const std::string& file) {
  const std::string camera = flags.Text("camera");
  if (camera.empty()) return ReadPoses(file, robot.JointNames());
  return MeasurePoses(file, ReadBoardImages(file, robot.JointNames()),
                      ReadCamera(camera),
                      kCameraPlaces.Parse(flags.Text("camera_on")));
}

}  // namespace armcal
