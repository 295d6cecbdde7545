#include "model/log_files/board_reader.h"

#include <cmath>
#include <memory>

#include "model/log_files/columns/log_columns.h"
#include "model/log_files/columns/named_columns.h"
#include "model/log_files/line_source.h"
#include "model/log_files/log_row.h"
#include "model/log_files/open_lines.h"
#include "model/text/format.h"
#include "model/text/input_error.h"
#include "model/text/input_text.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

constexpr std::size_t kMostPoints = 5'000'000;
constexpr int kFewestPoints = 4;       // of an image: a pose has six unknowns
constexpr double kSamePosture = 1e-6;  // rad or m

// A table with its header read.
struct Table {
  Table(const std::string& path, const std::vector<std::string>& joint_names)
      : source(OpenLines(path, {joint_names, {}, Signal::kEffort})) {
    if (!source->NextLine(&header)) {
      throw InputError(path, "", "", "the file is empty");
    }
  }
  std::unique_ptr<LineSource> source;
  std::string_view header;
};

// Places of what a row holds.
struct BoardPlaces {
  BoardPlaces(const std::string& path, const LogColumns& columns, LogRow* row) {
    const auto use = [&](const std::vector<std::string>& names,
                         ColumnUnit unit) {
      const auto found = FindNamed(path, columns, names, unit);
      return found.empty() ? -1 : row->Use(found);
    };
    q = row->Use(columns.Find(Signal::kPosition));
    image = use({"image"}, ColumnUnit::kNone);
    camera = use({"camera"}, ColumnUnit::kNone);
    point = use({"bx", "by"}, ColumnUnit::kLength);
    height = use({"bz"}, ColumnUnit::kLength);
    pixel = use({"u", "v"}, ColumnUnit::kNone);
    const char* missing = image < 0   ? "image"
                          : point < 0 ? "bx, by"
                          : pixel < 0 ? "u, v"
                                      : nullptr;
    if (missing == nullptr) return;
    throw InputError(path, "row 1", "",
                     std::string("the column ") + missing + " is missing");
  }
  int q, image, camera, point, height, pixel;
};

// The image that a row is of; images are whole and come one after the other.
long ImageNumber(const std::string& path, long row, double number) {
  if (number >= 0 && number <= 1e9 && number == std::floor(number)) {
    return std::lround(number);
  }
  throw InputError(path, "row " + std::to_string(row) + ", column image",
                   std::to_string(number), "expected a whole number");
}

int CameraNumber(const std::string& path, long row, double number) {
  constexpr int kMostCameras = 16;
  if (number >= 1 && number <= kMostCameras && number == std::floor(number)) {
    return static_cast<int>(number);
  }
  throw InputError(
      path, "row " + std::to_string(row) + ", column camera",
      Format("%g", number),
      "expected the number of a camera, 1 to " + std::to_string(kMostCameras));
}

// Rows as they come, put together to images.
class BoardRows {
 public:
  BoardRows(const std::string& path, int joints)
      : path_(path), joints_(joints) {}

  void Add(long row, const BoardPlaces& places, const double* values) {
    const long number = ImageNumber(path_, row, values[places.image]);
    const int camera =
        places.camera < 0 ? 0
                          : CameraNumber(path_, row, values[places.camera]) - 1;
    const Eigen::Map<const VectorXd> q(values + places.q, joints_);
    if (images_.number.empty() || number != images_.number.back() ||
        camera != images_.camera.back()) {
      CheckLast();
      images_.number.push_back(number);
      images_.camera.push_back(camera);
      images_.row.push_back(row);
      postures_.push_back(q);
      points_.clear();
      pixels_.clear();
    } else if ((q - postures_.back()).cwiseAbs().maxCoeff() > kSamePosture) {
      throw InputError(
          path_, "row " + std::to_string(row), "",
          "expected the joint positions of the image's other rows");
    }
    points_.emplace_back(values[places.point], values[places.point + 1],
                         places.height < 0 ? 0 : values[places.height]);
    pixels_.emplace_back(values[places.pixel], values[places.pixel + 1]);
  }
  BoardImages Result() {
    CheckLast();
    images_.q.resize(static_cast<Eigen::Index>(postures_.size()), joints_);
    for (size_t k = 0; k < postures_.size(); ++k) {
      images_.q.row(static_cast<Eigen::Index>(k)) = postures_[k].transpose();
    }
    return std::move(images_);
  }

 private:
  // Closes the last image.
  void CheckLast() {
    if (images_.number.empty()) return;
    if (points_.size() < kFewestPoints) {
      throw InputError(path_, "row " + std::to_string(images_.row.back()),
                       std::to_string(points_.size()),
                       "expected four points of an image or more");
    }
    const auto count = static_cast<Eigen::Index>(points_.size());
    Eigen::Matrix3Xd points(3, count);
    Eigen::Matrix2Xd pixels(2, count);
    for (Eigen::Index k = 0; k < count; ++k) {
      points.col(k) = points_[static_cast<size_t>(k)];
      pixels.col(k) = pixels_[static_cast<size_t>(k)];
    }
    images_.points.push_back(points);
    images_.pixels.push_back(pixels);
  }

  const std::string& path_;
  int joints_;
  BoardImages images_;
  std::vector<VectorXd> postures_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<Eigen::Vector2d> pixels_;
};

}  // namespace

BoardImages ReadBoardImages(const std::string& path,
                            const std::vector<std::string>& joint_names) {
  const Table table(path, joint_names);
  const LogColumns columns(path, table.header, joint_names, "",
                           LogColumns::Bare::kPosition);
  LogRow row(path, columns, -1);
  const BoardPlaces places(path, columns, &row);
  BoardRows rows(path, static_cast<int>(joint_names.size()));
  std::vector<double> values(row.width());
  std::string_view line, no_time;
  std::size_t count = 0;
  while (table.source->NextLine(&line)) {
    if (Trim(line).empty()) continue;
    if (++count > kMostPoints) {
      throw InputError(path, "row " + std::to_string(table.source->row()), "",
                       "expected at most " + std::to_string(kMostPoints) +
                           " points, which all are kept in memory");
    }
    if (!row.Parse(line, values.data(), &no_time)) {
      row.Refuse(line, table.source->row(), table.source->cut());
    }
    rows.Add(table.source->row(), places, values.data());
  }
  if (count == 0) {
    throw InputError(path, "", "", "the file has a header and no rows");
  }
  return rows.Result();
}

}  // namespace armcal
