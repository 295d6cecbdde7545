#include "tests/blind/isolated_process.h"

#include <fcntl.h>
#include <glog/logging.h>
#include <grp.h>
#include <pwd.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>

namespace armcal {
namespace {

using Clock = std::chrono::steady_clock;

struct User {
  uid_t uid = 65534;  // Debian's nobody and nogroup
  gid_t gid = 65534;
};

// Looked up once, before there are threads.
const User& Nobody() {
  static const User user = [] {
    User nobody;
    if (const passwd* entry = getpwnam("nobody")) {
      nobody.uid = entry->pw_uid;
      nobody.gid = entry->pw_gid;
    }
    return nobody;
  }();
  return user;
}

// In the child, between fork and exec: calls that are safe there only. The
// process group is its own, so that it can be killed as a whole.
[[noreturn]] void Become(const char* folder, const char* output,
                         char* const* arguments, bool drop, const User& user) {
  constexpr int kNotStarted = 127;
  setsid();
  const bool ready =
      (!drop || (setgroups(0, nullptr) == 0 && setgid(user.gid) == 0 &&
                 setuid(user.uid) == 0)) &&
      chdir(folder) == 0;
  if (!ready) _exit(kNotStarted);
  const int in = open("/dev/null", O_RDONLY);
  const int out = open(output, O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (in < 0 || out < 0) _exit(kNotStarted);
  dup2(in, 0);
  dup2(out, 1);
  dup2(out, 2);
  for (int file = 3; file < 256; ++file) close(file);
  execv(arguments[0], arguments);
  _exit(kNotStarted);
}

double Seconds(const timeval& t) { return t.tv_sec + 1e-6 * t.tv_usec; }

ProcessEnd WaitFor(pid_t child, double timeout_s) {
  const auto begin = Clock::now();
  const auto elapsed = [begin] {
    return std::chrono::duration<double>(Clock::now() - begin).count();
  };
  ProcessEnd end;
  int status = 0;
  rusage usage = {};
  while (wait4(child, &status, WNOHANG, &usage) == 0) {
    if (!end.timed_out && elapsed() > timeout_s) {
      end.timed_out = true;
      kill(-child, SIGKILL);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  kill(-child, SIGKILL);  // whatever it left running
  end.seconds = elapsed();
  end.cpu_seconds = Seconds(usage.ru_utime) + Seconds(usage.ru_stime);
  if (WIFEXITED(status)) end.exit_code = WEXITSTATUS(status);
  return end;
}

}  // namespace

bool CanIsolate() { return geteuid() == 0; }

ProcessEnd RunIsolated(const std::vector<std::string>& command,
                       const std::string& folder, const std::string& output,
                       double timeout_s) {
  CHECK(!command.empty());
  std::vector<char*> arguments;
  for (const std::string& word : command) {
    arguments.push_back(const_cast<char*>(word.c_str()));
  }
  arguments.push_back(nullptr);
  const bool drop = CanIsolate();
  const User& user = Nobody();
  const pid_t child = fork();
  PCHECK(child >= 0) << "fork";
  if (child == 0) {
    Become(folder.c_str(), output.c_str(), arguments.data(), drop, user);
  }
  return WaitFor(child, timeout_s);
}

void GiveAway(const std::string& path) {
  if (!CanIsolate()) return;
  PCHECK(chown(path.c_str(), Nobody().uid, Nobody().gid) == 0) << path;
}

}  // namespace armcal
