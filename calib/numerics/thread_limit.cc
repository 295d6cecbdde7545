#include "calib/numerics/thread_limit.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>

namespace armcal {
namespace {

using Control = tbb::global_control;

// Of the innermost WithThreads() that this thread is in; 0: none.
thread_local int own_limit = 0;

class OwnLimit {
 public:
  explicit OwnLimit(int threads) : before_(own_limit) { own_limit = threads; }
  ~OwnLimit() { own_limit = before_; }
  OwnLimit(const OwnLimit&) = delete;
  OwnLimit& operator=(const OwnLimit&) = delete;

 private:
  int before_;
};

}  // namespace

ThreadLimit::ThreadLimit(int threads)
    : control_(threads == 0
                   ? nullptr
                   : new Control(Control::max_allowed_parallelism, threads)) {}

ThreadLimit::~ThreadLimit() { delete static_cast<Control*>(control_); }

int ThreadLimit::Active() {
  if (own_limit > 0) return own_limit;
  return static_cast<int>(
      Control::active_value(Control::max_allowed_parallelism));
}

// An arena has a place for the thread that makes it: execute() does the work in
// this thread and never hands it to another.
void WithThreads(int threads, const std::function<void()>& work) {
  // TBB has no more workers than this, and says so on stderr.
  const int all =
      static_cast<int>(Control::active_value(Control::max_allowed_parallelism));
  const int limit = threads == 0 ? all : std::min(threads, all);
  tbb::task_arena arena(limit);
  arena.execute([&] {
    const OwnLimit own(limit);
    work();
  });
}

}  // namespace armcal
