#include "model/log_files/bag_source.h"

#include <algorithm>
#include <list>

#include "model/log_files/bag_log.h"
#include "model/log_files/columns/wrench_columns.h"
#include "model/ros_bags/bag_folder.h"
#include "model/text/exact_digits.h"
#include "model/text/input_error.h"
#include "model/text/input_text.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

// By number: a joint's name may hold what separates columns.
std::string ColumnName(const JointSeries::Channel& channel) {
  if (!channel.signal) return kWrenchNames[channel.index];
  return std::string(NamesOf(*channel.signal).number_prefix) +
         std::to_string(channel.index + 1);
}

}  // namespace

BagSource::BagSource(const std::string& path, const LineOptions& options)
    : path_(path), joint_names_(options.joint_names) {
  BagLog log(path, options);
  for (const std::string& file : BagFiles(path)) log.Read(file);
  const std::vector<JointSeries> series = log.TakeSeries();
  about_ = log.Topics();
  ChooseColumns(series);
  NoteEfforts();
  Join(series);
  header_ = "t [ns]";
  for (const Column& column : columns_) {
    header_ += "," + ColumnName(column.about);
  }
}

void BagSource::ChooseColumns(const std::vector<JointSeries>& series) {
  const int joints = static_cast<int>(joint_names_.size());
  std::vector<std::string> missing;
  for (const Signal signal : kSignals) {
    for (int j = 0; j < joints; ++j) {
      const size_t before = columns_.size();
      ChooseColumn({signal, j}, series);
      if (signal == Signal::kPosition && columns_.size() == before) {
        missing.push_back(joint_names_[j]);
      }
    }
  }
  if (!missing.empty()) {
    throw InputError(path_, "", "",
                     "no message gives the position of " + JoinNames(missing) +
                         "; " + about_);
  }
  for (int k = 0; k < kWrenchColumns; ++k) {
    ChooseColumn({std::nullopt, k}, series);
  }
}

// ros2_control publishes efforts that no one measures as NaN.
void BagSource::NoteEfforts() {
  std::vector<std::string> without = joint_names_;
  for (const Column& column : columns_) {
    const std::optional<Signal> signal = column.about.signal;
    if (signal == Signal::kEffort || signal == Signal::kCurrent ||
        signal == Signal::kVoltage) {
      without[column.about.index].clear();
    }
  }
  without.erase(std::remove(without.begin(), without.end(), ""), without.end());
  if (without.empty()) return;
  about_ += "; the effort of " + JoinNames(without) +
            " is empty or NaN in all messages";
}

// "the effort of joint elbow".
std::string BagSource::WhatIs(const JointSeries::Channel& channel) const {
  if (!channel.signal) return "the force-torque sensor";
  return "the " + std::string(NamesOf(*channel.signal).path_part) +
         " of joint " + joint_names_[channel.index];
}

void BagSource::ChooseColumn(const JointSeries::Channel& wanted,
                             const std::vector<JointSeries>& series) {
  std::vector<Column> found;
  bool chosen = false;
  for (size_t s = 0; s < series.size(); ++s) {
    for (size_t c = 0; c < series[s].channels.size(); ++c) {
      const JointSeries::Channel& channel = series[s].channels[c];
      if (channel.signal != wanted.signal || channel.index != wanted.index)
        continue;
      if (chosen && !series[s].chosen) continue;
      if (series[s].chosen && !chosen) found.clear();
      chosen = series[s].chosen;
      found.push_back({wanted, s, c});
    }
  }
  if (found.empty()) return;
  columns_.push_back(found[0]);
  if (found.size() == 1) return;
  const std::string what = WhatIs(wanted) + " is in ";
  const std::string a = series[found[0].series].topic,
                    b = series[found[1].series].topic;
  throw InputError(path_, "", "",
                   a == b
                       ? what + "messages of different joints of topic " +
                             OneLine(a) + ", expected one kind"
                       : what + OneLine(a) + " and in " + OneLine(b) +
                             ": choose one by " + OptionName("topics") +
                             (wanted.signal ? "=" : "=wrench:") + OneLine(a));
}

void BagSource::Join(const std::vector<JointSeries>& series) {
  const size_t first = columns_[0].series;
  const JointSeries& rows = series[first];
  std::list<JointSeriesAt> others;
  std::vector<JointSeriesAt*> at(series.size(), nullptr);
  for (const Column& column : columns_) {
    if (column.series == first || at[column.series] != nullptr) continue;
    others.emplace_back(path_, series[column.series]);
    at[column.series] = &others.back();
  }
  for (long k = 0; k < rows.size(); ++k) {
    const bool whole =
        std::all_of(others.begin(), others.end(), [&](JointSeriesAt& other) {
          return other.Find(other.series().has_stamps ? rows.times[k]
                                                      : rows.received[k]);
        });
    if (!whole) continue;
    times_.push_back(rows.times[k]);
    for (const Column& column : columns_) {
      values_.push_back(column.series == first
                            ? rows.value(k, column.channel)
                            : at[column.series]->value(column.channel));
    }
  }
  CheckTimes(rows.topic);
}

void BagSource::CheckTimes(const std::string& topic) const {
  if (times_.empty()) {
    throw InputError(path_, "", "",
                     "the messages that are to be joined are of different "
                     "times; " +
                         about_);
  }
  if (times_.size() > 1 && times_.front() == 0 && times_.back() == 0) {
    throw InputError(path_, "topic " + OneLine(topic), "",
                     "the stamps in the headers are all 0: expected times");
  }
}

bool BagSource::NextLine(std::string_view* line) {
  if (row_ > static_cast<long>(times_.size())) return false;
  if (row_ == 0) {
    *line = header_;
  } else {
    line_.clear();
    AppendExactDigits(times_[row_ - 1], &line_);
    for (size_t c = 0; c < columns_.size(); ++c) {
      line_ += ',';
      AppendExactDigits(values_[(row_ - 1) * columns_.size() + c], &line_);
    }
    *line = line_;
  }
  ++row_;
  return true;
}

}  // namespace armcal
