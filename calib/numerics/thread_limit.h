#pragma once

#include <functional>

namespace armcal {

// As long as it lives, work that is shared between threads is done by so many
// at most, in the whole process; 0: as many as there are cores. Results do not
// depend on it.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

  // What holds for the calling thread.
  static int Active();

 private:
  void* control_;  // TBB's
};

// Does `work` in the calling thread, with so many threads at most that share
// it, and no more than cores; 0: as many as there are cores. Unlike a
// ThreadLimit it says nothing to what other threads do at the same time.
void WithThreads(int threads, const std::function<void()>& work);

}  // namespace armcal
