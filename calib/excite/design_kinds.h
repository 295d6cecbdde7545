#pragma once

namespace armcal {

// What a motion is designed to tell.
enum class DesignTarget {
  kModel,     // the model parameters
  kPhysical,  // the links' inertial parameters and joint terms, with a prior
  kGeometry   // the lengths, with inertias that are no better known
};

// What will be measured at each posture.
enum class PoseInstrument {
  kTarget,  // the position of a target on the tool, by a tracker
  kPose     // the pose of the tool
};

}  // namespace armcal
