#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "model/log_files/log_topic.h"

namespace armcal {

// A table as lines of text, the first with the names of its columns, whatever
// the format of the file.
class LineSource {
 public:
  virtual ~LineSource() = default;

  // The next line; false at the end. *line lives until the next call.
  virtual bool NextLine(std::string_view* line) = 0;
  // Up to `most` lines that follow each other and live until the next call;
  // none at the end. By default one.
  virtual void NextLines(std::size_t most,
                         std::vector<std::string_view>* lines);
  // The 1-based number of the last line read, as an editor counts; 0 before.
  virtual long row() const = 0;
  // Whether the file ended inside the last line read.
  virtual bool cut() const = 0;
  // Starts again at the first line. Throws InputError for a pipe.
  virtual void Rewind() = 0;
  // What else there is to know about the file where a column is missing.
  virtual std::string About() const { return ""; }
};

// What a file needs to be asked for that has more in it than one table.
struct LineOptions {
  std::vector<std::string> joint_names;  // the robot's, base to tip
  std::vector<LogTopic> topics;          // of bags; empty: all of JointState
  // What a JointState's effort is: of UR robots a current.
  Signal effort = Signal::kEffort;
};

}  // namespace armcal
