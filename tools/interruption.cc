#include "tools/interruption.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <csignal>

#include "tools/progress_bar.h"

namespace armcal {
namespace {

// Lock-free, as all that a signal's handler may touch.
std::atomic<int> writing{0};
std::atomic<int> awaited{0};
std::atomic<int> running{0};  // what ends by itself where it is asked to
std::atomic<bool> asked{false};

void EndBy(int signal) {
  EndProgress();
  std::signal(signal, SIG_DFL);
  raise(signal);
}

void Handle(int signal) {
  if (running > 0 && !asked) {
    asked = true;
  } else if (writing > 0) {
    awaited = signal;
  } else {
    EndBy(signal);
  }
}

}  // namespace

void PrepareProcess() {
  for (int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(descriptor, F_GETFD) != -1) continue;
    // The lowest that is free, hence this one.
    if (open("/dev/null", descriptor == 0 ? O_WRONLY : O_RDONLY) < 0) return;
  }
  std::signal(SIGXFSZ, SIG_IGN);
  for (int signal : {SIGINT, SIGTERM, SIGHUP}) {
    if (std::signal(signal, &Handle) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
}

Uninterrupted::Uninterrupted() { ++writing; }

Uninterrupted::~Uninterrupted() {
  --writing;
  if (awaited != 0) EndBy(awaited);
}

bool Uninterrupted::IsAwaited() { return awaited != 0; }

AskedToEnd::AskedToEnd() { ++running; }

AskedToEnd::~AskedToEnd() {
  --running;
  asked = false;
}

bool AskedToEnd::Asked() { return asked; }

}  // namespace armcal
