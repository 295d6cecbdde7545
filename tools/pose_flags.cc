#include "tools/pose_flags.h"

#include <gflags/gflags.h>

#include <algorithm>
#include <string>

#include "calib/poses/cameras/image_poses.h"
#include "model/camera/camera_file.h"
#include "model/log_files/board_reader.h"
#include "tools/flag_choices.h"
#include "tools/input_flags.h"

DEFINE_string(poses, "",
              "`FILE` CSV of measured poses, wire lengths, touches, images");
DEFINE_string(camera, "",
              "`FILES` of --poses with images: camera_info YAML of ROS; or "
              "estimate");
DEFINE_string(camera_on, "tool",
              "where the camera is: tool (the board stands), world (the "
              "board is on the tool)");

namespace armcal {
namespace {

const FlagChoices<CameraPlace> kCameraPlaces(
    "camera_on",
    {{"tool", CameraPlace::kOnTool}, {"world", CameraPlace::kStanding}});

constexpr char kEstimate[] = "estimate";

bool EstimatesLens(const std::string& camera) {
  return camera == kEstimate ||
         camera.rfind(std::string(kEstimate) + ":", 0) == 0;
}

CameraOptions CamerasFromFlags(const FlagValues& flags) {
  CameraOptions options;
  options.place = kCameraPlaces.Parse(flags.Text("camera_on"));
  options.estimate_lens = EstimatesLens(flags.Text("camera"));
  for (const std::string& file : CameraFiles(flags)) {
    options.cameras.push_back(ReadCamera(file));
  }
  return options;
}

}  // namespace

std::vector<std::string> CameraFiles(const FlagValues& flags) {
  std::string files = flags.Text("camera");
  if (EstimatesLens(files)) {
    files.erase(0, std::min(files.size(), std::string(kEstimate).size() + 1));
    if (files.empty()) return {};
  }
  return files.empty() ? std::vector<std::string>()
                       : FileNames("camera", files);
}

PoseMeasurements PosesFromFlags(const FlagValues& flags, const Robot& robot) {
  return PosesFromFile(flags, robot, flags.Text("poses"));
}

PoseMeasurements PosesFromFile(const FlagValues& flags, const Robot& robot,
                               const std::string& file) {
  if (flags.Text("camera").empty()) return ReadPoses(file, robot.JointNames());
  return MeasurePoses(file, ReadBoardImages(file, robot.JointNames()), robot,
                      CamerasFromFlags(flags));
}

}  // namespace armcal
