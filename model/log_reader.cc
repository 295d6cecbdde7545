#include "model/log_reader.h"

#include <glog/logging.h>

#include <string_view>

#include "model/decimal_time.h"
#include "model/input_error.h"
#include "model/input_text.h"
#include "model/line_source.h"
#include "model/log_columns.h"
#include "model/log_row.h"
#include "model/torque_columns.h"

namespace armcal {
namespace {

bool IsBlank(std::string_view line) {
  return line.empty() ||
         (line[0] == ' ' && line.find_first_not_of(' ') == line.npos);
}

}  // namespace

struct LogReader::Impl {
  Impl(const std::string& path, const LogReaderOptions& options)
      : path(path),
        joints(static_cast<int>(options.joint_names.size())),
        source(OpenLines(path, {options.joint_names, options.topics,
                                options.torque_kind == TorqueKind::kCurrent})),
        columns(path, Header(), options.joint_names, source->About()),
        time_column(columns.FindTime(&time_decimals)),
        row(path, columns, time_column) {
    CheckTorqueFactors(options);
    q = row.Use(columns.Find(Signal::kPosition));
    if (options.want_velocity && columns.HasAll(Signal::kVelocity)) {
      qd = row.Use(columns.Find(Signal::kVelocity));
    }
    if (options.want_acceleration && columns.HasAll(Signal::kAcceleration)) {
      qdd = row.Use(columns.Find(Signal::kAcceleration));
    }
    if (options.want_reference && columns.HasAll(Signal::kReference)) {
      qref = row.Use(columns.Find(Signal::kReference));
    }
    if (options.want_temperature && columns.HasAll(Signal::kTemperature)) {
      temperature = row.Use(columns.Find(Signal::kTemperature));
    }
    if (!options.need_torque) return;
    const TorqueColumns torque = FindTorqueColumns(path, columns, options);
    torque_source = torque.source;
    tau = row.Use(torque.columns);
  }

  std::string_view Header() {
    std::string_view line;
    if (!source->NextLine(&line)) {
      throw InputError(path, "", "", "the file is empty");
    }
    return line;
  }

  // The next row that is not blank; blank ones may only end the file.
  bool NextRow(std::string_view* line) {
    if (!source->NextLine(line)) return false;
    if (!IsBlank(*line)) return true;
    const long blank = source->row();
    while (source->NextLine(line)) {
      if (IsBlank(*line)) continue;
      throw InputError(path, "row " + std::to_string(blank), "",
                       "the row is empty, and more rows follow");
    }
    return false;
  }

  // Seconds since the first row of the log.
  double ReadTime(std::string_view field) {
    const auto place = [&] {
      return "row " + std::to_string(source->row()) + ", column " +
             columns.name(time_column);
    };
    DecimalTime time;
    if (!ParseDecimalTime(TrimNumber(field), time_decimals, &time)) {
      throw InputError(path, place(), OneLine(Trim(field)),
                       ExpectedNumber(field));
    }
    if (!started) first = last = time;
    if (started && Difference(time, last) < 0) {
      throw InputError(path, place(), OneLine(field),
                       "time runs backwards, the row before has " +
                           OneLine(Trim(last_field)));
    }
    started = true;
    last = time;
    last_field.assign(field);
    return Difference(time, first);
  }

  void AddRow(std::string_view line) {
    const size_t size = values.size();
    values.resize(size + row.width());
    std::string_view field;
    if (!row.Parse(line, values.data() + size, &field)) {
      row.Refuse(line, source->row(), source->cut());
    }
    times.push_back(ReadTime(field));
  }

  bool Read(int max_rows, Log* log) {
    CHECK_GT(max_rows, 0);
    *log = Log();
    values.clear();
    times.clear();
    std::string_view line;
    while (static_cast<int>(times.size()) < max_rows && NextRow(&line)) {
      if (times.empty()) log->first_row = source->row();
      AddRow(line);
    }
    if (!started) {
      throw InputError(path, "", "", "the log has a header and no rows");
    }
    if (times.empty()) return false;
    const int rows = static_cast<int>(times.size());
    log->t = Eigen::Map<const Eigen::VectorXd>(times.data(), rows);
    log->q = Signals(q);
    log->qd = Signals(qd);
    log->qdd = Signals(qdd);
    log->tau = Signals(tau);
    log->qref = Signals(qref);
    log->temperature = Signals(temperature);
    return true;
  }

  Eigen::MatrixXd Signals(int place) const {
    using RowMajor =
        Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    if (place == kUnused) return {};
    return Eigen::Map<const RowMajor>(values.data(), times.size(), row.width())
        .middleCols(place, joints);
  }

  void Rewind() {
    source->Rewind();
    Header();
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
  int temperature = kUnused;
  std::string torque_source;

  std::vector<double> times;   // of the rows of one Read()
  std::vector<double> values;  // row by row
  bool started = false;        // a row was read
  DecimalTime first, last;
  std::string last_field;
};

LogReader::LogReader(const std::string& path, const LogReaderOptions& options) {
  CHECK(!options.joint_names.empty());
  impl_ = std::make_unique<Impl>(path, options);
}
LogReader::~LogReader() = default;
LogReader::LogReader(LogReader&&) noexcept = default;
LogReader& LogReader::operator=(LogReader&&) noexcept = default;

bool LogReader::has_velocity() const {
  return impl_->columns.HasAll(Signal::kVelocity);
}

bool LogReader::has_acceleration() const {
  return impl_->columns.HasAll(Signal::kAcceleration);
}

const std::string& LogReader::torque_source() const {
  return impl_->torque_source;
}

bool LogReader::Read(int max_rows, Log* log) {
  return impl_->Read(max_rows, log);
}

void LogReader::Rewind() { impl_->Rewind(); }

Log ReadWholeLog(const std::string& path, const LogReaderOptions& options) {
  constexpr int kMostRows = 1 << 20;
  LogReader reader(path, options);
  Log log, more;
  reader.Read(kMostRows, &log);
  if (reader.Read(1, &more)) {
    throw InputError(path, "row " + std::to_string(more.first_row), "",
                     "expected a log of at most " + std::to_string(kMostRows) +
                         " rows, which all are kept in memory");
  }
  return log;
}

}  // namespace armcal
