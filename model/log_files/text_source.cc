#include "model/log_files/text_source.h"

#include <sys/stat.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <vector>

#include "model/text/input_error.h"

namespace armcal {
namespace {

// gzread() reports a truncated file like the end of one and skips what follows
// the stream, so the stream is inflated here.
class GzipStream {
 public:
  GzipStream() {
    constexpr int kGzipOnly = 16;
    valid_ = inflateInit2(&stream_, MAX_WBITS + kGzipOnly) == Z_OK;
  }
  ~GzipStream() { inflateEnd(&stream_); }
  GzipStream(const GzipStream&) = delete;
  GzipStream& operator=(const GzipStream&) = delete;

  void Restart() {
    inflateReset(&stream_);
    streams_ = 0;
    ended_ = false;
    hungry_ = true;
  }

  // Whether Inflate() can make no more without input.
  bool hungry() const { return hungry_; }
  void Feed(const unsigned char* data, size_t size) {
    stream_.next_in = const_cast<unsigned char*>(data);
    stream_.avail_in = static_cast<unsigned>(size);
  }

  // Fills `out`; false where the stream is damaged. A file may hold several
  // streams in a row, as `cat a.gz b.gz` makes.
  bool Inflate(char* out, size_t size, size_t* made) {
    if (!valid_) return false;
    if (ended_) inflateReset(&stream_);
    stream_.next_out = reinterpret_cast<unsigned char*>(out);
    stream_.avail_out = static_cast<unsigned>(size);
    const int code = inflate(&stream_, Z_NO_FLUSH);
    *made = size - stream_.avail_out;
    ended_ = code == Z_STREAM_END;
    streams_ += ended_;
    hungry_ = stream_.avail_in == 0 && (ended_ || stream_.avail_out > 0);
    return ended_ || code == Z_OK || code == Z_BUF_ERROR;
  }

  // Whether the input may end here: after a whole stream, never inside one.
  bool ended() const { return ended_; }

  // Why the stream cannot be read on, where the input has ended or not.
  const char* Problem(bool input_ended) const {
    if (streams_ > 0 && stream_.total_out == 0) {
      return "bytes that are not gzip follow the gzip stream; cut them off or "
             "unpack the file";
    }
    if (input_ended) {
      return "the gzip stream ends early, the file is truncated; copy or "
             "record it again";
    }
    return "the gzip stream is damaged; copy or record the file again";
  }

 private:
  z_stream stream_ = {};
  bool valid_ = false;
  bool ended_ = false;
  bool hungry_ = true;
  long streams_ = 0;
};

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

bool StartsWith(const std::vector<unsigned char>& data, size_t size,
                std::string_view start) {
  return size >= start.size() &&
         std::memcmp(data.data(), start.data(), start.size()) == 0;
}

}  // namespace

struct TextSource::Impl {
  Impl(const std::string& path, const std::string& name, int block_bytes)
      : name(name),
        file(std::fopen(path.c_str(), "rb"), std::fclose),
        block(block_bytes) {
    if (!file) {
      throw InputError(name, "", "",
                       std::string("cannot be opened: ") + strerror(errno));
    }
    bytes = Bytes();
    Start();
  }

  // Of a file; -1 of a pipe, which has no size.
  long Bytes() const {
    struct stat now;
    const bool known =
        fstat(fileno(file.get()), &now) == 0 && S_ISREG(now.st_mode);
    return known ? now.st_size : -1;
  }

  // Reads the first bytes and tells from them what the file is.
  void Start() {
    begin = end = scanned = row = 0;
    at_end = false;
    raw_size = ReadFile(raw.data(), raw.size());
    raw_begin = 0;
    is_gzip = StartsWith(raw, raw_size, "\x1f\x8b");
    if (is_gzip) gzip.Restart();
    if (StartsWith(raw, raw_size, "\xff\xfe") ||
        StartsWith(raw, raw_size, "\xfe\xff")) {
      throw InputError(name, "", "", "the text is UTF-16; save it as UTF-8");
    }
  }

  size_t ReadFile(void* to, size_t size) {
    const size_t read = std::fread(to, 1, size, file.get());
    if (std::ferror(file.get())) {
      throw InputError(name, "", "",
                       std::string("cannot be read: ") + strerror(errno));
    }
    if (read < size && Bytes() != bytes) {  // at the end
      throw ChangedFile(
          name, "", "",
          "has changed while it was read: " + std::to_string(bytes) +
              " bytes at first, " + std::to_string(Bytes()) +
              " now; read it when its recording has ended");
    }
    return read;
  }

  [[noreturn]] void Refuse(long at, const std::string& expected) const {
    throw InputError(name, "row " + std::to_string(at), "", expected);
  }

  // Up to `size` bytes of text; 0 at the end.
  size_t ReadText(char* to, size_t size) {
    if (is_gzip) return ReadGzip(to, size);
    if (raw_begin == raw_size) return ReadFile(to, size);
    const size_t taken = std::min(size, raw_size - raw_begin);
    std::memcpy(to, raw.data() + raw_begin, taken);
    raw_begin += taken;
    return taken;
  }

  // What came before a damage is delivered before it is refused, so that the
  // message names the same row whatever the block size.
  size_t ReadGzip(char* to, size_t size) {
    size_t made = 0;
    while (made == 0) {
      if (gzip.hungry()) {
        if (raw_begin == raw_size) raw_size = ReadFile(raw.data(), raw.size());
        if (raw_size == 0 && gzip.ended()) return 0;
        if (raw_size == 0) Refuse(row + 1, gzip.Problem(true));
        gzip.Feed(raw.data(), raw_size);
        raw_begin = raw_size;
      }
      const bool sound = gzip.Inflate(to, size, &made);
      if (!sound && made == 0) Refuse(row + 1, gzip.Problem(false));
    }
    return made;
  }

  // Moves the unfinished line to the front of the block and reads on; false at
  // the end of the file.
  bool Fill() {
    if (at_end) return false;
    std::memmove(block.data(), block.data() + begin, end - begin);
    end -= begin;
    scanned -= begin;
    begin = 0;
    if (end == block.size()) {
      Refuse(row + 1, "the line is longer than " +
                          std::to_string(block.size()) +
                          " bytes; this is not a log in CSV");
    }
    char* added = block.data() + end;
    const size_t size = ReadText(added, block.size() - end);
    const void* nul = std::memchr(added, 0, size);
    if (nul) {
      const char* stop = static_cast<const char*>(nul);
      Refuse(row + 1 + std::count<const char*>(block.data(), stop, '\n'),
             "a NUL byte: the file is binary or UTF-16, or was being written "
             "when the power went");
    }
    end += size;
    at_end = size == 0;
    return !at_end;
  }

  // Whether the next line is whole in the block.
  bool HasLine() {
    const void* const feed =
        std::memchr(block.data() + scanned, '\n', end - scanned);
    scanned = feed ? static_cast<const char*>(feed) - block.data() : end;
    return feed != nullptr;
  }

  bool NextLine(std::string_view* line) {
    const void* feed = nullptr;
    do {
      feed = std::memchr(block.data() + scanned, '\n', end - scanned);
      if (!feed) scanned = end;
    } while (!feed && Fill());
    cut = !feed;
    if (cut && begin == end) return false;
    const char* start = block.data() + begin;
    const char* stop =
        cut ? block.data() + end : static_cast<const char*>(feed);
    *line = std::string_view(start, stop - start);
    begin = scanned = (stop - block.data()) + (cut ? 0 : 1);
    if (!line->empty() && line->back() == '\r') line->remove_suffix(1);
    if (row++ == 0 && line->substr(0, 3) == "\xef\xbb\xbf") {
      line->remove_prefix(3);
    }
    return true;
  }

  std::string name;
  File file;
  long bytes = -1;
  std::vector<unsigned char> raw = std::vector<unsigned char>(1 << 16);
  size_t raw_begin = 0, raw_size = 0;  // what of `raw` is yet to be used
  bool is_gzip = false;
  GzipStream gzip;
  std::vector<char> block;
  size_t begin = 0, end = 0;  // what of `block` is yet to be used
  size_t scanned = 0;         // no line break in [begin, scanned)
  bool at_end = false;
  bool cut = false;
  long row = 0;
};

TextSource::TextSource(const std::string& path, const std::string& name,
                       int block_bytes)
    : impl_(std::make_unique<Impl>(path, name, block_bytes)) {}
TextSource::~TextSource() = default;
TextSource::TextSource(TextSource&&) noexcept = default;

bool TextSource::NextLine(std::string_view* line) {
  return impl_->NextLine(line);
}

void TextSource::NextLines(std::size_t most,
                           std::vector<std::string_view>* lines) {
  lines->clear();
  std::string_view line;
  while (lines->size() < most && (lines->empty() || impl_->HasLine()) &&
         impl_->NextLine(&line)) {
    lines->push_back(line);
  }
}

long TextSource::row() const { return impl_->row; }

bool TextSource::cut() const { return impl_->cut; }

void TextSource::Rewind() {
  if (std::fseek(impl_->file.get(), 0, SEEK_SET) != 0) {
    throw InputError(impl_->name, "", "",
                     "cannot be read twice; save the pipe to a file");
  }
  impl_->Start();
}

}  // namespace armcal
