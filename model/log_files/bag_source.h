#pragma once

#include <string>
#include <vector>

#include "model/log_files/joint_series.h"
#include "model/log_files/line_source.h"

namespace armcal {

// A ROS 2 bag, a file or rosbag2's folder of files, as a table with a row per
// message that gives the joints' positions, at its header's stamp. What other
// topics say stands in the row as of its stamp; numbers of topics without
// stamps as of the time when the message was received, as both have that clock.
// Held in memory as a whole: 8 bytes a number of the robot's joints, not the
// rest of the bag. Throws InputError.
class BagSource : public LineSource {
 public:
  BagSource(const std::string& path, const LineOptions& options);

  bool NextLine(std::string_view* line) override;
  long row() const override { return row_; }
  bool cut() const override { return false; }
  void Rewind() override { row_ = 0; }
  std::string About() const override { return about_; }

 private:
  struct Column {
    JointSeries::Channel about;
    size_t series, channel;
  };
  void ChooseColumns(const std::vector<JointSeries>& series);
  void ChooseColumn(const JointSeries::Channel& wanted,
                    const std::vector<JointSeries>& series);
  std::string WhatIs(const JointSeries::Channel& channel) const;
  void NoteEfforts();
  void Join(const std::vector<JointSeries>& series);
  void CheckTimes(const std::string& topic) const;

  std::string path_, about_, header_, line_;
  std::vector<std::string> joint_names_;
  std::vector<Column> columns_;  // the first: where the first joint is
  std::vector<std::int64_t> times_;
  std::vector<double> values_;  // by time
  long row_ = 0;
};

}  // namespace armcal
