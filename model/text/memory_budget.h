#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <utility>

namespace armcal {

// Gives the system the memory that was freed. Each thread's heap keeps it for
// itself otherwise, while another thread's grows by as much.
void ReturnFreedMemory();

// How many bytes may hold what could be computed again. What does not fit is
// computed again, with the same results.
class MemoryBudget {
 public:
  explicit MemoryBudget(std::size_t bytes) : left_(bytes) {}

  // An eighth of the machine's memory, 0.8 GB at most: there may be several
  // sets of logs.
  static std::size_t DefaultBytes();

  // False, and nothing taken, where fewer are left. One thread may make the
  // next stretch of a log while another keeps what it made of the last.
  bool Take(std::size_t bytes) {
    std::size_t left = left_;
    while (bytes <= left) {
      if (left_.compare_exchange_weak(left, left - bytes)) return true;
    }
    return false;
  }
  void Give(std::size_t bytes) { left_ += bytes; }

 private:
  std::atomic<std::size_t> left_;
};

// What one holder has taken of a budget, and gives back in the end.
class MemoryShare {
 public:
  // Null: of nothing.
  explicit MemoryShare(std::shared_ptr<MemoryBudget> budget)
      : budget_(std::move(budget)) {}
  MemoryShare(MemoryShare&& other) noexcept { *this = std::move(other); }
  MemoryShare& operator=(MemoryShare&& other) noexcept {
    std::swap(budget_, other.budget_);
    std::swap(bytes_, other.bytes_);
    return *this;
  }
  ~MemoryShare() { GiveBack(); }

  bool Take(std::size_t bytes) {
    if (budget_ == nullptr || !budget_->Take(bytes)) return false;
    bytes_ += bytes;
    return true;
  }
  void GiveBack() {
    if (budget_ != nullptr) budget_->Give(std::exchange(bytes_, 0));
  }

 private:
  std::shared_ptr<MemoryBudget> budget_;
  std::size_t bytes_ = 0;
};

}  // namespace armcal
