#pragma once

#include <string>
#include <vector>

#include "model/line_source.h"
#include "model/npy_array.h"

namespace armcal {

// An archive of NumPy arrays (numpy.savez, savez_compressed) as a table: of one
// dimension a column of its name; of two, a row per time, columns with their
// numbers after the name (q1, q2 ...), or, where the archive has an array of
// texts `joint_names`, `names` or `name` of as many, joint/name. Signals may
// have the names of sensor_msgs/JointState (position, velocity, effort). Arrays
// that are not as long as the time are left alone unless they are signals. Held
// in memory as a whole. Throws InputError.
class NpzSource : public LineSource {
 public:
  explicit NpzSource(const std::string& path);

  bool NextLine(std::string_view* line) override;
  long row() const override { return row_; }
  bool cut() const override { return false; }
  void Rewind() override { row_ = 0; }

 private:
  struct Array {
    std::string name;
    NpyArray values;
  };
  void AddToHeader(const Array& array, const std::vector<std::string>& joints);

  std::string path_, header_, line_;
  std::vector<Array> arrays_;  // that are columns
  long rows_ = 0;
  long row_ = 0;
};

}  // namespace armcal
