#pragma once

namespace armcal {

// What is known of the lengths between the joint axes; their directions always
// are. kDeclared: all but those the robot file lists as unknown.
enum class GeometryKnowledge {
  kKnown,
  kDeclaredLengths,
  kNonzeroLengths,
  kAllLengths
};

}  // namespace armcal
