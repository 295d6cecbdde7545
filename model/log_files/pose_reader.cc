#include "model/log_files/pose_reader.h"

#include <charconv>
#include <cmath>
#include <map>
#include <sstream>
#include <string_view>

#include "model/log_files/columns/log_columns.h"
#include "model/log_files/columns/named_columns.h"
#include "model/log_files/line_source.h"
#include "model/log_files/log_row.h"
#include "model/log_files/open_lines.h"
#include "model/text/input_error.h"
#include "model/text/input_text.h"

namespace armcal {
namespace {

constexpr double kQuaternionNorm = 0.02;  // rounding to two digits is taken
constexpr std::size_t kMostPoses = 100'000;
// rad: an inclinometer measures the sine, which tells no more there.
constexpr double kMostTilt = 1.4;

// Places of the measured columns among a row's values; -1: not there.
struct Places {
  int q = -1, pose = -1, length = -1, tilt = -1, u95 = -1;
  int point = -1;
  bool planes = false;
  int num_u95 = 0;
  std::vector<int> targets;
};

// The whole number in a field of a row; 0 where there is none.
long WholeNumber(std::string_view line, char separator, int field) {
  for (; field > 0; --field) {
    const std::size_t end = line.find(separator);
    if (end == std::string_view::npos) return 0;
    line.remove_prefix(end + 1);
  }
  const std::string_view text = Trim(line.substr(0, line.find(separator)));
  long number = 0;
  const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), number);
  const bool whole =
      error == std::errc() && end == text.data() + text.size() && number > 0;
  return whole ? number : 0;
}

// Of a camera (board_reader.h).
bool HasPixels(const LogColumns& columns) {
  bool u = false, v = false;
  for (int k = 0; k < columns.size(); ++k) {
    u |= Trim(columns.name(k)) == "u";
    v |= Trim(columns.name(k)) == "v";
  }
  return u && v;
}

Places ChooseColumns(const std::string& path, const LogColumns& columns,
                     LogRow* row) {
  constexpr ColumnUnit kLength = ColumnUnit::kLength;
  Places places;
  places.q = row->Use(columns.Find(Signal::kPosition));
  for (int k = 1;; ++k) {
    const std::string n = std::to_string(k);
    const auto found =
        FindNamed(path, columns, {"x" + n, "y" + n, "z" + n}, kLength);
    if (found.empty()) break;
    places.targets.push_back(row->Use(found));
  }
  auto pose = FindNamed(path, columns, {"x", "y", "z"}, kLength);
  const auto turn =
      FindNamed(path, columns, {"qw", "qx", "qy", "qz"}, ColumnUnit::kNone);
  if (pose.empty() != turn.empty()) {
    throw InputError(path, "row 1", "",
                     std::string("the column ") +
                         (pose.empty() ? "x, y, z" : "qw, qx, qy, qz") +
                         " is missing");
  }
  pose.insert(pose.end(), turn.begin(), turn.end());
  if (!pose.empty()) places.pose = row->Use(pose);
  const auto length = FindNamed(path, columns, {"length1"}, kLength);
  if (!length.empty()) places.length = row->Use(length);
  const auto tilt =
      FindNamed(path, columns, {"tilt_x", "tilt_y"}, ColumnUnit::kAngle);
  if (!tilt.empty()) places.tilt = row->Use(tilt);
  // Where something was measured, a column of that name is anybody's.
  if (places.targets.empty() && pose.empty() && length.empty() &&
      tilt.empty()) {
    for (const char* name : {"point", "plane"}) {
      const auto point = FindNamed(path, columns, {name}, ColumnUnit::kNone);
      if (point.empty()) continue;
      if (places.point >= 0) {
        throw InputError(path, "row 1", "",
                         "expected one of the columns point and plane");
      }
      places.point = row->Use(point);
      places.planes = name == std::string("plane");
    }
  }
  for (int k = 1;; ++k) {
    const auto u95 = FindNamed(path, columns, {"u95_" + std::to_string(k)},
                               places.tilt < 0 ? kLength : ColumnUnit::kAngle);
    if (u95.empty()) break;
    const int place = row->Use(u95);
    if (places.num_u95++ == 0) places.u95 = place;
  }
  const int kinds = (places.targets.empty() ? 0 : 1) + (places.pose >= 0) +
                    (places.length >= 0) + (places.point >= 0) +
                    (places.tilt >= 0);
  if (kinds == 1) return places;
  if (kinds == 0 && HasPixels(columns)) {
    throw InputError(path, "row 1", "u, v",
                     "images of a board, expected the camera's intrinsics "
                     "beside them");
  }
  throw InputError(path, "row 1", "",
                   "expected one kind of measurement: x1 y1 z1 [x2 ..] "
                   "(targets), x y z qw qx qy qz (poses), length1 (a wire), "
                   "point or plane (touched ones), tilt_x tilt_y (an "
                   "inclinometer)");
}

// A number as people write it.
std::string TextOf(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

// In the order in which their numbers, whole ones, rise.
std::vector<int> TouchedPoints(const std::string& path,
                               const std::string& column,
                               const std::vector<long>& row,
                               const Eigen::VectorXd& numbers) {
  std::map<long, int> points;
  for (Eigen::Index k = 0; k < numbers.size(); ++k) {
    const bool whole = numbers[k] >= 1 && numbers[k] <= kMostPoses &&
                       numbers[k] == std::floor(numbers[k]);
    if (!whole) {
      throw InputError(
          path, "row " + std::to_string(row[k]) + ", column " + column,
          TextOf(numbers[k]),
          "expected the number of the touched " + column + ", from 1");
    }
    points[std::lround(numbers[k])] = 0;
  }
  int count = 0;
  for (auto& [number, index] : points) index = count++;
  std::vector<int> touched;
  for (const double number : numbers) {
    touched.push_back(points[std::lround(number)]);
  }
  return touched;
}

// Finite numbers that no instrument can have measured.
void CheckValues(const std::string& path, const PoseMeasurements& measured) {
  const auto refuse = [&](int k, const std::string& column,
                          const std::string& found, const char* expected) {
    throw InputError(
        path, "row " + std::to_string(measured.row[k]) + ", column " + column,
        found, expected);
  };
  for (Eigen::Index k = 0; k < measured.lengths.size(); ++k) {
    const double length = measured.lengths[k];
    if (length > 0) continue;
    refuse(k, "length1", TextOf(length), "expected a length above 0");
  }
  for (Eigen::Index k = 0; k < measured.tilts.rows(); ++k) {
    for (const int axis : {0, 1}) {
      const double tilt = measured.tilts(k, axis);
      if (std::abs(tilt) < kMostTilt) continue;
      refuse(k, axis == 0 ? "tilt_x" : "tilt_y", TextOf(tilt),
             "expected an angle to the horizontal below 80 degrees (in rad, "
             "unless the column's name ends with [deg])");
    }
  }
  for (Eigen::Index k = 0; k < measured.u95.rows(); ++k) {
    for (Eigen::Index c = 0; c < measured.u95.cols(); ++c) {
      if (measured.u95(k, c) >= 0) continue;
      refuse(k, "u95_" + std::to_string(c + 1), TextOf(measured.u95(k, c)),
             "expected an uncertainty of at least 0 (0: not stated)");
    }
  }
  for (Eigen::Index k = 0; k < measured.poses.rows(); ++k) {
    const Eigen::Vector4d q = measured.poses.row(k).tail<4>();
    if (std::abs(q.norm() - 1) < kQuaternionNorm) continue;
    refuse(k, "qw",
           TextOf(q[0]) + " " + TextOf(q[1]) + " " + TextOf(q[2]) + " " +
               TextOf(q[3]),
           "expected a unit quaternion");
  }
}

}  // namespace

PoseMeasurements ReadPoses(const std::string& path,
                           const std::vector<std::string>& joint_names) {
  const std::unique_ptr<LineSource> source =
      OpenLines(path, {joint_names, {}, Signal::kEffort});
  std::string_view line;
  if (!source->NextLine(&line)) {
    throw InputError(path, "", "", "the file is empty");
  }
  const LogColumns columns(path, line, joint_names, "",
                           LogColumns::Bare::kPosition);
  LogRow row(path, columns, -1);
  const Places places = ChooseColumns(path, columns, &row);
  int numbers = -1;
  for (int k = 0; k < columns.size(); ++k) {
    if (Trim(columns.name(k)) == "pose") numbers = k;
  }
  std::vector<double> values;
  std::string_view no_time;
  PoseMeasurements result;
  while (source->NextLine(&line)) {
    if (Trim(line).empty()) continue;
    if (result.row.size() == kMostPoses) {
      throw InputError(path, "row " + std::to_string(source->row()), "",
                       "expected at most " + std::to_string(kMostPoses) +
                           " poses, which all are kept in memory");
    }
    values.resize(values.size() + row.width());
    double* const last = values.data() + values.size() - row.width();
    if (!row.Parse(line, last, &no_time)) {
      row.Refuse(line, source->row(), source->cut());
    }
    result.row.push_back(source->row());
    if (numbers < 0) continue;
    const long number = WholeNumber(line, columns.separator(), numbers);
    if (number == 0) numbers = -1;
    result.number.push_back(number);
  }
  if (numbers < 0) result.number.clear();
  if (result.row.empty()) {
    throw InputError(path, "", "", "the file has a header and no rows");
  }
  const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic,
                                       Eigen::RowMajor>>
      table(values.data(), result.row.size(), row.width());
  result.q = table.middleCols(places.q, joint_names.size());
  for (const int place : places.targets) {
    result.targets.push_back(table.middleCols(place, 3));
  }
  if (places.pose >= 0) result.poses = table.middleCols(places.pose, 7);
  if (places.length >= 0) result.lengths = table.col(places.length);
  if (places.tilt >= 0) result.tilts = table.middleCols(places.tilt, 2);
  if (places.num_u95 > 0) {
    result.u95 = table.middleCols(places.u95, places.num_u95);
  }
  if (places.point >= 0) {
    result.planes = places.planes;
    result.touched = TouchedPoints(path, places.planes ? "plane" : "point",
                                   result.row, table.col(places.point));
  }
  CheckValues(path, result);
  return result;
}

}  // namespace armcal
