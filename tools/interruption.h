#pragma once

namespace armcal {

// From now on Ctrl-C, SIGTERM and SIGHUP clear the terminal's progress line and
// end armcal by that signal (exit code 130, 143, 129 in a shell). Those that
// are ignored, as under nohup, stay so. Stdin, stdout and stderr that were
// closed are opened such that their use fails, so that no result file takes
// their place. A file that grows beyond what is allowed (ulimit -f) is an error
// of its writing instead of the end.
void PrepareProcess();

// While one of these lives, results are being written: a signal ends armcal
// only after it, when they are whole or gone.
class Uninterrupted {
 public:
  Uninterrupted();
  ~Uninterrupted();
  Uninterrupted(const Uninterrupted&) = delete;
  Uninterrupted& operator=(const Uninterrupted&) = delete;

  // A signal waits: what takes long should be given up.
  static bool IsAwaited();
};

// While one of these lives, the first signal does not end armcal but asks what
// runs for its result; a second one ends it.
class AskedToEnd {
 public:
  AskedToEnd();
  ~AskedToEnd();
  AskedToEnd(const AskedToEnd&) = delete;
  AskedToEnd& operator=(const AskedToEnd&) = delete;

  static bool Asked();
};

}  // namespace armcal
