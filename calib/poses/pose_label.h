#pragma once

#include "model/log_files/pose_reader.h"

namespace armcal {

// How poses are called in all that is told of them: by the file's column
// `pose` where it has one, else by the file's rows (header: 1). Postures that
// are of no file are counted from 1.
inline const char* PoseWord(const PoseMeasurements& measured) {
  return measured.number.empty() ? "row" : "pose";
}
inline long PoseLabel(const PoseMeasurements& measured, int pose) {
  if (!measured.number.empty()) return measured.number[pose];
  return measured.row.empty() ? pose + 1 : measured.row[pose];
}

// What was measured, as people call it.
inline const char* MeasuredKind(const PoseMeasurements& measured) {
  if (measured.lengths.size() > 0) return "wire lengths";
  if (measured.tilts.size() > 0) return "tilts";
  if (measured.planes) return "touched planes";
  if (!measured.touched.empty()) return "touched points";
  if (measured.pixel_stddev > 0) return "images";
  return measured.targets.empty() ? "tool poses" : "targets";
}

}  // namespace armcal
