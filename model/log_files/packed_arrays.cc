#include "model/log_files/packed_arrays.h"

#include <cstdint>
#include <cstring>

namespace armcal {
namespace {

class Writer {
 public:
  void Add(std::int64_t number) {
    bytes_.append(reinterpret_cast<const char*>(&number), sizeof number);
  }
  void Add(const std::string& text) {
    Add(static_cast<std::int64_t>(text.size()));
    bytes_ += text;
  }
  std::string bytes_;
};

// Of bytes that a confined process may have made up.
class Reader {
 public:
  explicit Reader(const std::string& bytes) : bytes_(bytes) {}
  bool ok() const { return ok_; }
  bool more() const { return ok_ && at_ < bytes_.size(); }

  std::int64_t Number() {
    std::int64_t number = 0;
    if (!Has(sizeof number)) return 0;
    std::memcpy(&number, bytes_.data() + at_, sizeof number);
    at_ += sizeof number;
    return number;
  }
  std::string Text() {
    const std::int64_t size = Number();
    if (size < 0 || !Has(static_cast<std::uint64_t>(size))) return "";
    at_ += size;
    return bytes_.substr(at_ - size, size);
  }

 private:
  bool Has(std::uint64_t size) {
    ok_ = ok_ && size <= bytes_.size() - at_;
    return ok_;
  }
  const std::string& bytes_;
  size_t at_ = 0;
  bool ok_ = true;
};

bool HoldsItsNumbers(const LogArray& array) {
  if (array.kind == 0) return true;
  const bool is_size =
      array.item == 1 || array.item == 2 || array.item == 4 || array.item == 8;
  if (!is_size || array.rows < 0 || array.columns < 0) return false;
  const auto bytes = static_cast<double>(array.bytes.size());
  return static_cast<double>(array.begin) +
             static_cast<double>(array.rows) *
                 static_cast<double>(array.columns) * array.item <=
         bytes;
}

}  // namespace

std::string PackArrays(const std::vector<LogArray>& arrays) {
  Writer writer;
  for (const LogArray& a : arrays) {
    writer.Add(a.name);
    for (const std::int64_t number :
         {std::int64_t{a.kind}, std::int64_t{a.item}, std::int64_t{a.by_column},
          std::int64_t{a.rows}, std::int64_t{a.columns},
          static_cast<std::int64_t>(a.begin)}) {
      writer.Add(number);
    }
    writer.Add(a.bytes);
    writer.Add(static_cast<std::int64_t>(a.texts.size()));
    for (const std::string& text : a.texts) writer.Add(text);
    writer.Add(a.why_none);
  }
  return writer.bytes_;
}

std::vector<LogArray> UnpackArrays(const std::string& bytes) {
  std::vector<LogArray> arrays;
  Reader reader(bytes);
  while (reader.more()) {
    LogArray a;
    a.name = reader.Text();
    a.kind = static_cast<char>(reader.Number());
    a.item = static_cast<int>(reader.Number());
    a.by_column = reader.Number() != 0;
    a.rows = reader.Number();
    a.columns = reader.Number();
    a.begin = static_cast<size_t>(reader.Number());
    a.bytes = reader.Text();
    const std::int64_t texts = reader.Number();
    for (std::int64_t k = 0; k < texts && reader.ok(); ++k) {
      a.texts.push_back(reader.Text());
    }
    a.why_none = reader.Text();
    if (!reader.ok() || !HoldsItsNumbers(a)) return {};
    arrays.push_back(std::move(a));
  }
  return arrays;
}

}  // namespace armcal
