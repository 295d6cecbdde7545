#pragma once

namespace armcal {

// As long as it lives, work that is shared between threads is done by so many
// at most; 0: as many as there are cores. Results do not depend on it.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

  static int Active();

 private:
  void* control_;  // TBB's
};

}  // namespace armcal
