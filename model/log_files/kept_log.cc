#include "model/log_files/kept_log.h"

#include <utility>

namespace armcal {
namespace {

constexpr int kBlockRows = 4096;

std::size_t BytesOf(const Log& log) {
  const Eigen::Index numbers = log.t.size() + log.q.size() + log.qd.size() +
                               log.qdd.size() + log.tau.size() +
                               log.qref.size() + log.temperature.size() +
                               log.wrench.size() + log.current.size();
  return sizeof(Log) + static_cast<std::size_t>(numbers) * sizeof(double);
}

}  // namespace

KeptLog::KeptLog(const LogSource& source, const LogReaderOptions& options,
                 std::shared_ptr<MemoryBudget> budget)
    : source_(source),
      options_(options),
      reader_(std::in_place, source, options),
      blocks_(std::move(budget)) {
  torque_source_ = reader_->torque_source();
  torque_constants_stddev_ = reader_->torque_constants_stddev();
  has_wrench_ = reader_->has_wrench();
  has_current_ = reader_->has_current();
  blocks_.Begin();
}

const Log* KeptLog::Next() {
  if (blocks_.whole()) {
    const bool more = next_ < blocks_.items().size();
    return more ? &blocks_.items()[next_++] : nullptr;
  }
  if (!reader_) reader_.emplace(source_, options_);
  if (reader_->Read(kBlockRows, &block_)) {
    return blocks_.Add(&block_, BytesOf(block_));
  }
  blocks_.End();
  next_ = blocks_.items().size();
  return nullptr;
}

void KeptLog::Rewind() {
  next_ = 0;
  if (reader_) {
    reader_->Rewind();  // refuses what cannot be read again
    reader_.reset();    // there may be many logs
  }
  if (!blocks_.whole()) blocks_.Begin();
}

}  // namespace armcal
