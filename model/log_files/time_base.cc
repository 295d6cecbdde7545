#include "model/log_files/time_base.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "model/log_files/motion_frequency.h"
#include "model/text/input_error.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

constexpr double kEven = 1e-3;  // of a step, beside which stamps are even

// Steps in bins of 0.1 %, so that a median needs no memory of the log's size.
class StepHistogram {
 public:
  void Add(double step) {
    const int bin = Bin(step);
    ++count_[bin];
    sum_[bin] += step;
    ++total_;
  }
  double Median() const {
    long seen = 0;
    for (size_t b = 0; b < count_.size(); ++b) {
      seen += count_[b];
      if (2 * seen >= total_) return sum_[b] / count_[b];
    }
    return 0;
  }
  double MeanBelow(double limit) const {
    double sum = 0;
    long count = 0;
    for (int b = 0; b <= Bin(limit); ++b) {
      sum += sum_[b];
      count += count_[b];
    }
    return count > 0 ? sum / count : 0;
  }

 private:
  static constexpr int kBins = 30000;
  static int Bin(double step) {  // from 1e-9 s
    const double b = std::log(std::max(step, 1e-9) * 1e9) / std::log(1.001);
    return std::clamp(static_cast<int>(b), 0, kBins - 1);
  }
  std::vector<long> count_ = std::vector<long>(kBins, 0);
  std::vector<double> sum_ = std::vector<double>(kBins, 0);
  long total_ = 0;
};

// Counts the steps that a sampler with equal ones would have made.
class TickCounter {
 public:
  // The next stamps, all different; `step`: the usual one, s.
  void Add(const std::vector<double>& stamps, double step) {
    for (const double stamp : stamps) {
      if (!means_.empty()) {
        ticks_ += std::max(1., std::round((stamp - last_) / step));
      }
      last_ = stamp;
      if (means_.empty() || stamp - begin_ >= kMeanTime) {
        means_.emplace_back();
        begin_ = stamp;
      }
      Mean& mean = means_.back();
      mean.stamp += stamp;
      mean.ticks += ticks_;
      ++mean.count;
    }
  }
  // Beside the line through them all.
  std::vector<StampError> Errors() const {
    const Eigen::Index size = static_cast<Eigen::Index>(means_.size());
    Eigen::MatrixXd line(size, 2);
    Eigen::VectorXd stamps(size);
    for (Eigen::Index k = 0; k < size; ++k) {
      const Mean& mean = means_[k];
      line.row(k) << 1, mean.ticks / mean.count;
      stamps[k] = mean.stamp / mean.count;
    }
    const Eigen::VectorXd error =
        stamps - line * line.colPivHouseholderQr().solve(stamps);
    std::vector<StampError> errors;
    for (Eigen::Index k = 0; k < size; ++k) {
      errors.push_back({stamps[k], error[k]});
    }
    return errors;
  }

 private:
  static constexpr double kMeanTime = 1;  // s
  struct Mean {
    double stamp = 0, ticks = 0;
    long count = 0;
  };
  std::vector<Mean> means_;
  double begin_ = 0, last_ = 0, ticks_ = 0;
};

// Everything the audit gathers from consecutive samples.
struct Audit {
  TimeBase base;
  StepHistogram steps;
  MotionFrequency motion;
  double last = 0;

  // False where the time is that of the row before.
  bool Add(double t, const Eigen::MatrixXd& positions, int row) {
    if (base.samples > 0) {
      const double step = t - last;
      if (step == 0) {
        ++base.duplicates;
        return false;
      }
      steps.Add(step);
      base.min_step = base.samples == 1 ? step : std::min(base.min_step, step);
      base.max_step = std::max(base.max_step, step);
    } else {
      base.range.begin = t;
    }
    base.range.end = last = t;
    motion.Add(t, positions, row);
    ++base.samples;
    return true;
  }
};

}  // namespace

TimeBase AuditTimeBase(const TimeRange& crop, KeptLog* log) {
  Audit audit;
  TickCounter ticks;
  std::vector<double> stamps;
  while (const Log* block = log->Next()) {
    stamps.clear();
    for (int k = 0; k < block->size(); ++k) {
      const double t = block->t[k];
      if (crop.Contains(t) && audit.Add(t, block->q, k)) stamps.push_back(t);
    }
    ticks.Add(stamps, audit.steps.Median());
  }
  TimeBase& base = audit.base;
  if (base.samples < 3) {
    throw InputError(
        log->source().name, "", std::to_string(base.samples) + " samples",
        "expected at least 3 samples with different times in the log (" +
            OptionName("crop") + " keeps a part of it)");
  }
  base.median_step = audit.steps.Median();
  base.dt = audit.steps.MeanBelow(3 * base.median_step);
  base.uniform = base.max_step - base.min_step < kEven * base.dt;
  if (base.uniform) {
    base.dt = (base.range.end - base.range.begin) /
              static_cast<double>(base.samples - 1);
  }
  base.stamp_errors = ticks.Errors();
  // Even stamps of which some were lost have what rounding leaves.
  if (std::all_of(base.stamp_errors.begin(), base.stamp_errors.end(),
                  [&](const StampError& error) {
                    return std::abs(error.error) < kEven * base.dt;
                  })) {
    base.stamp_errors.clear();
  }
  base.motion_hz = audit.motion.Hz();
  log->Rewind();
  if (base.max_step <= 3 * base.median_step) return base;
  double last = base.range.begin;
  while (const Log* block = log->Next()) {
    for (const double t : block->t) {
      if (!crop.Contains(t)) continue;
      if (t - last > 3 * base.median_step) base.gaps.push_back({last, t});
      last = t;
    }
  }
  log->Rewind();
  return base;
}

std::string TimeBase::Describe() const {
  char text[256];
  std::snprintf(text, sizeof(text), "%ld samples in %.4g s, %.4g Hz", samples,
                range.end - range.begin, 1 / dt);
  std::string result = text;
  if (!uniform) {
    std::snprintf(text, sizeof(text), ", steps %.3g-%.3g ms (resampled)",
                  1e3 * min_step, 1e3 * max_step);
    result += text;
  }
  if (!gaps.empty()) {
    result += ", " + std::to_string(gaps.size()) +
              (gaps.size() == 1 ? " gap" : " gaps") + " over 3 steps";
  }
  if (duplicates > 0) {
    result += ", " + std::to_string(duplicates) + " duplicate times dropped";
  }
  return result;
}

}  // namespace armcal
