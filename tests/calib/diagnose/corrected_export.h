#pragma once

// Robots that a diagnosis corrected, and what files they come out as.

#include <gmock/gmock.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "calib/diagnose/robot_export.h"
#include "model/effects/effects.h"
#include "model/robot_files/robot_formats.h"
#include "model/robot_files/robot_reader.h"
#include "tests/fixtures/corrected_arm.h"
#include "tests/fixtures/temp_file.h"

namespace armcal {

class CorrectedExport : public testing::Test {
 protected:
  CorrectedExport() {
    for (Link& link : arm_.file.links) link.joint.coulomb = 4;
    arm_.scale.torque = arm_.scale.speed = Eigen::VectorXd::Ones(3);
    arm_.scale.load = arm_.scale.acceleration = Eigen::VectorXd::Ones(3);
    arm_.scale.end = 10;
  }
  GapCandidate Found(const std::string& name, int joint, Eigen::VectorXd p) {
    GapCandidate found;
    found.effect = FindEffect(name);
    EXPECT_NE(found.effect, nullptr) << name;
    found.joint = joint;
    found.p = std::move(p);
    return found;
  }
  CorrectedRobot Corrected(const Eigen::VectorXd& x,
                           const std::vector<GapCandidate>& effects) {
    return MakeCorrectedRobot(arm_.Baseline(), x, effects, arm_.scale);
  }
  RobotExport Of(const CorrectedRobot& corrected,
                 const std::string& path = "") {
    return ExportCorrectedRobot(corrected, arm_.file, path, "", AllFormats());
  }
  RobotExport Of(const Eigen::VectorXd& x,
                 const std::vector<GapCandidate>& effects,
                 const std::string& path = "") {
    return Of(Corrected(x, effects), path);
  }
  static std::map<std::string, RobotFile> ByFormat(const RobotExport& out) {
    std::map<std::string, RobotFile> files;
    for (const RobotFile& file : out.files) files[file.format->name] = file;
    return files;
  }
  static std::vector<const RobotFormat*> AllFormats() {
    std::vector<const RobotFormat*> formats;
    for (const RobotFormat& format : RobotFormats()) formats.push_back(&format);
    return formats;
  }
  Eigen::VectorXd Nothing() {
    return Eigen::VectorXd::Zero(arm_.Baseline().size());
  }
  static Robot Read(const std::string& urdf) {
    return ReadRobot(WriteFile(urdf, "robot.urdf"), {});
  }

  CorrectedArm arm_;
};

}  // namespace armcal
