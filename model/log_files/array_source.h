#pragma once

#include <string>
#include <vector>

#include "model/log_files/line_source.h"
#include "model/log_files/log_array.h"

namespace armcal {

// Arrays as a table: of one column a column of its name; of several, a row per
// time, columns with their numbers after the name (q1, q2 ...), or, where there
// is an array of as many texts called `joint_names`, `names` or `name`,
// joint/name. Signals may have the names of sensor_msgs/JointState (position,
// velocity, effort) or of PACE's logs (dof_pos, des_dof_pos). Arrays that are
// not as long as the time (without one: the positions) are left alone unless
// they are signals. Held in memory as a whole. Throws InputError.
class ArraySource : public LineSource {
 public:
  ArraySource(const std::string& path, std::vector<LogArray> arrays);

  bool NextLine(std::string_view* line) override;
  long row() const override { return row_; }
  bool cut() const override { return false; }
  // Arrays that no column is made of, and why.
  std::string About() const override { return about_; }
  void Rewind() override { row_ = 0; }

 private:
  void Add(LogArray array);
  void NoteUnused(const LogArray& array, const std::string& why);
  void AddToHeader(const LogArray& array);

  std::string path_, header_, line_, about_;
  std::vector<std::string> joints_;
  std::vector<LogArray> arrays_;  // that are columns
  long rows_ = 0;
  long row_ = 0;
};

}  // namespace armcal
