#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace armcal {

// A table as lines of text, the first with the names of its columns, whatever
// the format of the file.
class LineSource {
 public:
  virtual ~LineSource() = default;

  // The next line; false at the end. *line lives until the next call.
  virtual bool NextLine(std::string_view* line) = 0;
  // The 1-based number of the last line read, as an editor counts; 0 before.
  virtual long row() const = 0;
  // Whether the file ended inside the last line read.
  virtual bool cut() const = 0;
  // Starts again at the first line. Throws InputError for a pipe.
  virtual void Rewind() = 0;
};

// By the file's first bytes, never by its name: NumPy's .npz (npz_source.h),
// else text, plain or gzipped (text_source.h). Throws InputError.
std::unique_ptr<LineSource> OpenLines(const std::string& path);

}  // namespace armcal
