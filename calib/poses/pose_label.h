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

}  // namespace armcal
