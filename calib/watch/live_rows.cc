#include "calib/watch/live_rows.h"

#include "model/log_files/columns/log_signal.h"
#include "model/log_files/torque_columns.h"
#include "model/text/format.h"
#include "model/text/input_error.h"

namespace armcal {
namespace {

constexpr long kMostSkipped = 1000;  // together; then it is no log of these

}  // namespace

struct LiveRows::Columns {
  Columns(const std::string& name, std::string_view header,
          const LogReaderOptions& options)
      : columns(name, header, options.joint_names),
        time(columns.FindTime(&time_decimals)),
        row(name, columns, time),
        joints(static_cast<int>(options.joint_names.size())) {
    q = row.Use(columns.Find(Signal::kPosition));
    const TorqueColumns torque = FindTorqueColumns(name, columns, options);
    source = torque.source;
    tau = row.Use(torque.columns);
    values.resize(row.width());
  }

  LogColumns columns;
  int time_decimals = 0;
  int time;
  LogRow row;
  int joints;
  int q = 0, tau = 0;  // places among the values
  std::string source;
  std::vector<double> values;
};

LiveRows::LiveRows(const std::string& path, bool follow, double idle_s,
                   const LogReaderOptions& options, BadRow on_bad)
    : name_(path == "-" ? "standard input" : path),
      text_(path, follow, idle_s),
      options_(options),
      on_bad_(std::move(on_bad)) {
  CheckTorqueFactors(options);
}

void LiveRows::ReadHeader(std::string_view line) {
  columns_ = std::make_shared<Columns>(name_, line, options_);
  torque_source_ = columns_->source;
}

void LiveRows::Skip(const std::string& why) {
  ++skipped_;
  on_bad_(why);
  if (++skipped_together_ < kMostSkipped) return;
  throw InputError(name_, Format("row %ld", text_.row()), "",
                   Format("%ld rows in a row could not be used, the last one "
                          "because: %s",
                          kMostSkipped, why.c_str()));
}

bool LiveRows::Parse(std::string_view line, LiveRow* row) {
  Columns& c = *columns_;
  std::string_view field;
  DecimalTime time;
  if (!c.row.Parse(line, c.values.data(), &field)) {
    try {
      c.row.Refuse(line, text_.row(), false);
    } catch (const InputError& error) {
      Skip(error.what());
    }
    return false;
  }
  if (!ParseDecimalTime(TrimNumber(field), c.time_decimals, &time)) {
    Skip(Format("%s: row %ld: the time is no number", name_.c_str(),
                text_.row()));
    return false;
  }
  if (started_ && Difference(time, last_) < 0) {
    Skip(Format("%s: row %ld: time runs backwards by %.6g s", name_.c_str(),
                text_.row(), -Difference(time, last_)));
    return false;
  }
  if (!started_) first_ = time;
  started_ = true;
  last_ = time;
  row->t = Difference(time, first_);
  row->q = Eigen::Map<const Eigen::VectorXd>(c.values.data() + c.q, c.joints);
  row->tau =
      Eigen::Map<const Eigen::VectorXd>(c.values.data() + c.tau, c.joints);
  skipped_together_ = 0;
  return true;
}

LiveText::Got LiveRows::Next(LiveRow* row) {
  for (;;) {
    std::string_view line;
    const LiveText::Got got = text_.Next(&line);
    if (got == LiveText::Got::kEnd && !columns_) {
      throw InputError(name_, "", "", "the file is empty");
    }
    if (got != LiveText::Got::kLine) return got;
    if (!columns_) {
      ReadHeader(line);
    } else if (!line.empty() && Parse(line, row)) {
      return got;
    }
  }
}

}  // namespace armcal
