#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <vector>

namespace armcal {

// A surface of triangles, in m or whatever the file counts in; corners go
// counter-clockwise as seen from outside.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 3>> triangles;  // indices of points
};

// The most that a file may have, so that reading it takes a moment.
inline constexpr long kMostMeshBytes = 64L << 20;

// Reads binary STL, OBJ (points and faces alone) or MuJoCo's MSH, by the ending
// of the name. Throws InputError.
TriangleMesh ReadMeshFile(const std::filesystem::path& path);

}  // namespace armcal
