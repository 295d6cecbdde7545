#include "model/log_files/log_reader.h"

#include <glog/logging.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <string_view>

#include "model/log_files/columns/log_columns.h"
#include "model/log_files/columns/wrench_columns.h"
#include "model/log_files/line_source.h"
#include "model/log_files/log_row.h"
#include "model/log_files/open_lines.h"
#include "model/log_files/torque_columns.h"
#include "model/text/decimal_time.h"
#include "model/text/input_error.h"
#include "model/text/input_text.h"

namespace armcal {
namespace {

// The unit in which a time counts from 1970; empty where that may be seconds,
// which reach 1e11 in the year 5138.
std::string UnitOfEpoch(const DecimalTime& time) {
  const double seconds = Difference(time, DecimalTime());
  return seconds < 1e11   ? ""
         : seconds < 1e14 ? "ms"
         : seconds < 1e17 ? "us"
                          : "ns";
}

bool IsBlank(std::string_view line) {
  return line.empty() ||
         (line[0] == ' ' && line.find_first_not_of(' ') == line.npos);
}

}  // namespace

struct LogReader::Impl {
  Impl(const LogSource& log, const LogReaderOptions& options)
      : path(log.name),
        joints(static_cast<int>(options.joint_names.size())),
        source(OpenLines(log, {options.joint_names, options.topics,
                               EffortIn(options.torque_kind)})),
        columns(path, Header(), options.joint_names, source->About()),
        time_column(columns.FindTime(&time_decimals)),
        row(path, columns, time_column) {
    CheckTorqueFactors(options);
    const auto timed = options.sample_times.find(path);
    if (timed != options.sample_times.end()) sample_times = timed->second;
    left_out = options.LeftOutOf(path);
    const auto wrapped = options.position_turns.find(path);
    if (wrapped != options.position_turns.end()) turns = wrapped->second;
    q = row.Use(columns.Find(Signal::kPosition));
    if (options.want_velocity && columns.HasAll(Signal::kVelocity)) {
      qd = row.Use(columns.Find(Signal::kVelocity));
    }
    if (options.want_acceleration && columns.HasAll(Signal::kAcceleration)) {
      qdd = row.Use(columns.Find(Signal::kAcceleration));
    }
    if ((options.want_reference || options.commands_do) &&
        columns.HasAll(Signal::kReference)) {
      qref = row.Use(columns.Find(Signal::kReference));
    }
    if (options.want_temperature && columns.HasAll(Signal::kTemperature)) {
      temperature = row.Use(columns.Find(Signal::kTemperature));
    }
    if (options.want_wrench) {
      const std::vector<LogColumn> six = FindWrench(path, columns);
      if (!six.empty()) wrench = row.Use(six);
    }
    if (options.want_current && HasJointTorques(columns, options)) {
      UseCurrents();
    }
    if (!options.need_torque) return;
    const auto found = options.reconstructed_torque.find(path);
    if (found != options.reconstructed_torque.end()) {
      reconstructed = found->second;
      torque_source = reconstructed->source;
      KnowScale(kTorqueScaleStddev, options);
      return;
    }
    unscaled = FindUnscaledDrives(columns, options);
    const bool commands_do = options.commands_do && qref != kUnused;
    if (commands_do && LacksTorque(columns, options)) return;
    if (options.currents_do && !unscaled.columns.empty()) return;
    const TorqueColumns torque = FindTorqueColumns(path, columns, options);
    torque_source = torque.source;
    KnowScale(torque.scale_stddev, options);
    tau = row.Use(torque.columns);
  }

  // Nothing hangs on them: those in unknown units are as good as none.
  void UseCurrents() {
    if (!columns.HasAll(Signal::kCurrent)) return;
    try {
      current = row.Use(columns.Find(Signal::kCurrent));
    } catch (const InputError&) {
    }
  }

  // `usual`: that of this kind of torque.
  void KnowScale(double usual, const LogReaderOptions& options) {
    torque_constants_stddev = options.torque_constants_stddev.value_or(
        columns.simulated() ? 0 : usual);
  }

  std::string_view Header() {
    std::string_view line;
    if (!source->NextLine(&line)) {
      throw InputError(path, "", "", "the file is empty");
    }
    return line;
  }

  // A row on its way into `values` and `times`.
  struct Row {
    std::string_view line, time_field;
    DecimalTime time;
    bool whole = false, has_time = false;
  };

  // Gets at most `most` rows that follow each other; none at the end. Blank
  // ones may only end the file.
  void NextRows(size_t most) {
    rows.clear();
    if (next_line == lines.size()) {
      source->NextLines(most, &lines);
      next_line = 0;
    }
    for (; next_line < lines.size() && rows.size() < most; ++next_line) {
      if (IsBlank(lines[next_line])) break;
      rows.emplace_back().line = lines[next_line];
    }
    if (rows.empty() && !lines.empty()) RefuseMoreRows();
  }

  // Number of the row `k` lines into `lines`.
  long RowNumber(size_t k) const {
    return source->row() - static_cast<long>(lines.size() - k) + 1;
  }

  // After the blank row that is next.
  void RefuseMoreRows() {
    const long blank = RowNumber(next_line);
    while (!lines.empty()) {
      for (; next_line < lines.size(); ++next_line) {
        if (IsBlank(lines[next_line])) continue;
        throw InputError(path, "row " + std::to_string(blank), "",
                         "the row is empty, and more rows follow");
      }
      source->NextLines(1, &lines);
      next_line = 0;
    }
  }

  // Seconds since the first row of the log.
  double Seconds(const Row& parsed, long number) {
    const auto place = [&] {
      return "row " + std::to_string(number) + ", column " +
             columns.name(time_column);
    };
    const std::string_view field = parsed.time_field;
    if (!parsed.has_time) {
      throw InputError(path, place(), OneLine(Trim(field)),
                       ExpectedNumber(field));
    }
    if (!started) {
      first = last = parsed.time;
      const std::string unit = UnitOfEpoch(parsed.time);
      if (!unit.empty()) {
        throw InputError(path, place(), OneLine(Trim(field)),
                         "expected seconds; if these are " + unit +
                             ", call the column '" + columns.name(time_column) +
                             " [" + unit + "]'");
      }
    }
    if (started && Difference(parsed.time, last) < 0) {
      throw InputError(path, place(), OneLine(field),
                       "time runs backwards, the row before has " +
                           OneLine(Trim(last_field)));
    }
    started = true;
    last = parsed.time;
    last_field = field;
    return Difference(parsed.time, first);
  }

  // Numbers of `rows` to the end of `values`, by several threads; what is wrong
  // with the first bad one is said afterwards.
  void ParseRows() {
    const size_t width = row.width(), size = values.size();
    values.resize(size + rows.size() * width);
    const auto parse = [&](const tbb::blocked_range<size_t>& range) {
      for (size_t k = range.begin(); k < range.end(); ++k) {
        Row& r = rows[k];
        r.whole =
            row.Parse(r.line, values.data() + size + k * width, &r.time_field);
        r.has_time = r.whole && ParseDecimalTime(TrimNumber(r.time_field),
                                                 time_decimals, &r.time);
      }
    };
    constexpr size_t kTogether = 256;
    const tbb::blocked_range<size_t> all(0, rows.size(), kTogether);
    if (all.is_divisible()) {
      tbb::parallel_for(all, parse);
    } else {
      parse(all);
    }
    const size_t first_line = next_line - rows.size();
    for (size_t k = 0; k < rows.size(); ++k) {
      const long number = RowNumber(first_line + k);
      if (!rows[k].whole) row.Refuse(rows[k].line, number, source->cut());
      times.push_back(Seconds(rows[k], number));
    }
    last_time.assign(last_field);  // lines live until more are read
    last_field = last_time;
  }

  // Rows that follow each other, but for those that are left out.
  bool Read(int max_rows, Log* log) {
    while (ReadRows(max_rows, log)) {
      TakeTurns(turns, next_row, log);
      next_row += log->size();
      if (left_out.empty()) return true;
      *log = WithoutRows(*log, left_out, next_row - log->size());
      if (log->size() > 0) return true;
    }
    return false;
  }

  bool ReadRows(int max_rows, Log* log) {
    CHECK_GT(max_rows, 0);
    *log = Log();
    log->simulated = columns.simulated();
    values.clear();
    times.clear();
    while (static_cast<int>(times.size()) < max_rows) {
      NextRows(max_rows - times.size());
      if (rows.empty()) break;
      if (times.empty()) log->first_row = RowNumber(next_line - rows.size());
      ParseRows();
    }
    if (!started) {
      throw InputError(path, "", "", "the log has a header and no rows");
    }
    if (times.empty()) return false;
    const int rows = static_cast<int>(times.size());
    log->t = sample_times != nullptr
                 ? SampleTimes(rows)
                 : Eigen::Map<const Eigen::VectorXd>(times.data(), rows);
    log->q = Signals(q);
    log->qd = Signals(qd);
    log->qdd = Signals(qdd);
    log->tau =
        reconstructed != nullptr ? ReconstructedTorques(rows) : Signals(tau);
    log->qref = Signals(qref);
    log->temperature = Signals(temperature);
    log->wrench = Values(wrench, kWrenchColumns);
    log->current = Signals(current);
    return true;
  }

  Eigen::MatrixXd Signals(int place) const { return Values(place, joints); }

  // The `count` values of each row that stand together from `place` on.
  Eigen::MatrixXd Values(int place, int count) const {
    using RowMajor =
        Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    if (place == kUnused) return {};
    return Eigen::Map<const RowMajor>(values.data(), times.size(), row.width())
        .middleCols(place, count);
  }

  // Both of the next `count` rows.
  Eigen::MatrixXd ReconstructedTorques(int count) {
    RefuseGrowth(next_reconstructed + count > reconstructed->tau.rows());
    next_reconstructed += count;
    return reconstructed->tau.middleRows(next_reconstructed - count, count);
  }
  Eigen::VectorXd SampleTimes(int count) {
    RefuseGrowth(next_sample + count > sample_times->size());
    next_sample += count;
    return sample_times->segment(next_sample - count, count);
  }
  void RefuseGrowth(bool grown) const {
    if (!grown) return;
    throw InputError(path, "", "",
                     "expected a log that does not grow while it is read");
  }

  void Rewind() {
    next_row = next_reconstructed = next_sample = 0;
    source->Rewind();
    Header();
    lines.clear();
    next_line = 0;
    started = false;
  }

  static constexpr int kUnused = -1;

  std::string path;
  int joints;
  std::unique_ptr<LineSource> source;
  LogColumns columns;
  int time_decimals = 0;
  int time_column;
  LogRow row;
  int q = kUnused, qd = kUnused, qdd = kUnused, tau = kUnused;  // in a row
  int qref = kUnused;
  int temperature = kUnused, wrench = kUnused, current = kUnused;
  std::string torque_source;
  UnscaledDrives unscaled;
  double torque_constants_stddev = 0;
  std::shared_ptr<const ReconstructedTorque> reconstructed;
  std::shared_ptr<const Eigen::VectorXd> sample_times;  // null: the stamps
  long next_reconstructed = 0, next_sample = 0;         // rows of both
  std::vector<RowRange> left_out;
  std::vector<PositionTurn> turns;
  long next_row = 0;  // that is read, of all rows

  std::vector<std::string_view> lines;  // that the source has given
  size_t next_line = 0;
  std::vector<Row> rows;
  std::vector<double> times;   // of the rows of one Read()
  std::vector<double> values;  // row by row
  bool started = false;        // a row was read
  DecimalTime first, last;
  std::string_view last_field;  // the last row's time
  std::string last_time;
};

LogReader::LogReader(const LogSource& log, const LogReaderOptions& options) {
  CHECK(!options.joint_names.empty());
  impl_ = std::make_unique<Impl>(log, options);
}
LogReader::~LogReader() = default;
LogReader::LogReader(LogReader&&) noexcept = default;
LogReader& LogReader::operator=(LogReader&&) noexcept = default;

bool LogReader::has_velocity() const {
  return impl_->columns.HasAll(Signal::kVelocity);
}

bool LogReader::has_torque() const {
  return impl_->tau != Impl::kUnused || impl_->reconstructed != nullptr;
}

bool LogReader::has_wrench() const { return impl_->wrench != Impl::kUnused; }
bool LogReader::has_current() const { return impl_->current != Impl::kUnused; }

bool LogReader::has_acceleration() const {
  return impl_->columns.HasAll(Signal::kAcceleration);
}

std::string LogReader::spelling() const { return impl_->columns.Spelling(); }

const std::string& LogReader::torque_source() const {
  return impl_->torque_source;
}

const UnscaledDrives& LogReader::unscaled_drives() const {
  return impl_->unscaled;
}

double LogReader::torque_constants_stddev() const {
  return impl_->torque_constants_stddev;
}

bool LogReader::Read(int max_rows, Log* log) {
  return impl_->Read(max_rows, log);
}

void LogReader::Rewind() { impl_->Rewind(); }

Log ReadWholeLog(const LogSource& source, const LogReaderOptions& options) {
  constexpr int kMostRows = 1 << 20;
  LogReader reader(source, options);
  Log log, more;
  reader.Read(kMostRows, &log);
  if (reader.Read(1, &more)) {
    throw InputError(source.name, "row " + std::to_string(more.first_row), "",
                     "expected a log of at most " + std::to_string(kMostRows) +
                         " rows, which all are kept in memory");
  }
  return log;
}

}  // namespace armcal
