#include "model/robot_tree/mesh_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "model/text/input_error.h"
#include "model/text/input_text.h"

namespace armcal {
namespace {

using Eigen::Vector3d;

// Numbers of a binary file, little-endian as the machines that armcal runs on.
class BinaryReader {
 public:
  BinaryReader(const std::string& path, const std::string& bytes)
      : path_(path), bytes_(bytes) {}

  template <typename T>
  T Next() {
    T value;
    if (bytes_.size() - at_ < sizeof(T)) Refuse("expected more bytes");
    std::memcpy(&value, bytes_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    return value;
  }
  Vector3d NextPoint() {
    Vector3d point;
    for (int i = 0; i < 3; ++i) point[i] = Next<float>();
    if (!point.allFinite()) Refuse("expected finite numbers");
    return point;
  }
  void Skip(size_t count) {
    if (bytes_.size() - at_ < count) Refuse("expected more bytes");
    at_ += count;
  }
  // Whether that many bytes are left, and no others.
  void RequireRest(uint64_t count) {
    if (bytes_.size() - at_ == count) return;
    Refuse("expected " + std::to_string(count) + " bytes behind the counts");
  }
  [[noreturn]] void Refuse(const std::string& expected) const {
    throw InputError(path_, "byte " + std::to_string(at_), "", expected);
  }

 private:
  const std::string& path_;
  const std::string& bytes_;
  size_t at_ = 0;
};

// 80 bytes, the number of triangles, and of each a normal, three corners and
// two bytes.
TriangleMesh ReadStl(const std::string& path, const std::string& bytes) {
  BinaryReader reader(path, bytes);
  reader.Skip(80);
  const uint32_t count = reader.Next<uint32_t>();
  reader.RequireRest(50 * uint64_t{count});
  TriangleMesh mesh;
  for (uint32_t i = 0; i < count; ++i) {
    reader.Skip(12);
    const int first = static_cast<int>(mesh.points.size());
    for (int k = 0; k < 3; ++k) mesh.points.push_back(reader.NextPoint());
    mesh.triangles.push_back({first, first + 1, first + 2});
    reader.Skip(2);
  }
  return mesh;
}

void RequireCorners(const std::string& path, const std::string& place,
                    const TriangleMesh& mesh) {
  const int count = static_cast<int>(mesh.points.size());
  for (const int corner : mesh.triangles.back()) {
    if (corner >= 0 && corner < count) continue;
    throw InputError(
        path, place, std::to_string(corner),
        "expected the number of one of " + std::to_string(count) + " points");
  }
}

// Four counts: points, normals, texture coordinates (of two numbers) and
// triangles; then all of them.
TriangleMesh ReadMsh(const std::string& path, const std::string& bytes) {
  BinaryReader reader(path, bytes);
  uint64_t counts[4];
  for (uint64_t& count : counts) {
    const int32_t value = reader.Next<int32_t>();
    if (value < 0) reader.Refuse("expected counts that are not negative");
    count = static_cast<uint64_t>(value);
  }
  reader.RequireRest(12 * (counts[0] + counts[1] + counts[3]) + 8 * counts[2]);
  TriangleMesh mesh;
  for (uint64_t i = 0; i < counts[0]; ++i) {
    mesh.points.push_back(reader.NextPoint());
  }
  reader.Skip(12 * counts[1] + 8 * counts[2]);
  for (uint64_t i = 0; i < counts[3]; ++i) {
    std::array<int, 3>& corners = mesh.triangles.emplace_back();
    for (int& corner : corners) corner = reader.Next<int32_t>();
    RequireCorners(path, "triangle " + std::to_string(i), mesh);
  }
  return mesh;
}

// A line "f 1/1/1 2/2/2 3/3/3 ...": numbers of points from 1, or from the end
// where negative. A face of more than three corners is a fan of triangles.
void AddFace(const std::string& path, int line,
             const std::vector<std::string_view>& words, TriangleMesh* mesh) {
  const std::string place = "line " + std::to_string(line);
  std::vector<int> corners;
  for (size_t i = 1; i < words.size(); ++i) {
    const auto number = ParseNumber(words[i].substr(0, words[i].find('/')));
    if (!number || std::abs(*number) > 1e9 || *number == 0) {
      throw InputError(path, place, OneLine(words[i]),
                       "expected the number of a point");
    }
    const int given = static_cast<int>(*number);
    corners.push_back(
        given > 0 ? given - 1 : static_cast<int>(mesh->points.size()) + given);
  }
  for (size_t i = 2; i < corners.size(); ++i) {
    mesh->triangles.push_back({corners[0], corners[i - 1], corners[i]});
    RequireCorners(path, place, *mesh);
  }
}

TriangleMesh ReadObj(const std::string& path, const std::string& text) {
  TriangleMesh mesh;
  int line = 0;
  for (size_t at = 0; at < text.size();) {
    const size_t end = std::min(text.find('\n', at), text.size());
    const auto words = SplitWords(std::string_view(text).substr(at, end - at));
    at = end + 1;
    ++line;
    if (words.empty()) continue;
    if (words[0] == "f") AddFace(path, line, words, &mesh);
    if (words[0] != "v") continue;
    Vector3d point;
    for (int i = 0; i < 3; ++i) {
      const auto number =
          words.size() < 4 ? std::nullopt : ParseNumber(words[i + 1]);
      if (!number || !std::isfinite(*number)) {
        throw InputError(path, "line " + std::to_string(line), "",
                         "expected three numbers behind v");
      }
      point[i] = *number;
    }
    mesh.points.push_back(point);
  }
  return mesh;
}

}  // namespace

TriangleMesh ReadMeshFile(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  if (ending != ".stl" && ending != ".obj" && ending != ".msh") {
    throw InputError(path.string(), "", ending,
                     "expected a mesh that ends in .stl, .obj or .msh");
  }
  const std::string bytes = ReadSmallFile(path.string(), kMostMeshBytes);
  return ending == ".stl"   ? ReadStl(path.string(), bytes)
         : ending == ".msh" ? ReadMsh(path.string(), bytes)
                            : ReadObj(path.string(), bytes);
}

}  // namespace armcal
