#include "model/text/confined_process.h"

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <new>
#include <vector>

#include "model/text/input_error.h"
#include "model/text/write_all.h"

namespace armcal {
namespace {

constexpr int kPipe = 3;  // of the child, its only file but the standard ones
constexpr char kMade = 'M', kRefused = 'R', kNoMemory = 'N';

#if defined(__x86_64__)
constexpr unsigned kArchitecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr unsigned kArchitecture = AUDIT_ARCH_AARCH64;
#endif

// What reading and computing take, and pipes, by which sanitizers ask whether
// memory is there; all else fails with EPERM.
std::vector<unsigned> AllowedCalls() {
  return {
#ifdef __NR_stat
      __NR_stat,           __NR_lstat,
      __NR_access,         __NR_readlink,
      __NR_pipe,
#endif
      __NR_read,           __NR_pread64,
      __NR_readv,          __NR_pipe2,
      __NR_lseek,          __NR_fstat,
      __NR_newfstatat,     __NR_statx,
      __NR_faccessat,      __NR_readlinkat,
      __NR_close,          __NR_mmap,
      __NR_munmap,         __NR_mremap,
      __NR_mprotect,       __NR_brk,
      __NR_madvise,        __NR_write,
      __NR_exit,           __NR_exit_group,
      __NR_futex,          __NR_sched_yield,
      __NR_getpid,         __NR_gettid,
      __NR_clock_gettime,  __NR_gettimeofday,
      __NR_getrandom,      __NR_fcntl,
      __NR_flock,          __NR_rt_sigaction,
      __NR_rt_sigprocmask, __NR_rt_sigreturn,
      __NR_sigaltstack,    __NR_getcwd,
      __NR_sysinfo,        __NR_uname,
  };
}

// False where the kernel has no such filter; then the process is only apart.
bool Confine() {
  std::vector<sock_filter> filter;
  const auto load = [&](size_t at) {
    filter.push_back(
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<unsigned>(at)));
  };
  const auto result = [&](unsigned action) {
    filter.push_back(BPF_STMT(BPF_RET | BPF_K, action));
  };
  // The next `count` instructions are for this call alone.
  const auto for_call = [&](unsigned call, unsigned char count) {
    filter.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, call, 0, count));
  };
  load(offsetof(seccomp_data, arch));
  filter.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, kArchitecture, 1, 0));
  result(SECCOMP_RET_ERRNO | EPERM);
  load(offsetof(seccomp_data, nr));
  for (const unsigned call : AllowedCalls()) {
    for_call(call, 1);
    result(SECCOMP_RET_ALLOW);
  }
  // Files are opened for reading alone: openat's flags, and open's.
  const auto open_to_read = [&](unsigned call, int argument) {
    constexpr unsigned kWrites =
        O_WRONLY | O_RDWR | O_CREAT | O_TRUNC | O_APPEND;
    for_call(call, 4);
    load(offsetof(seccomp_data, args) + argument * sizeof(std::uint64_t));
    filter.push_back(BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, kWrites, 0, 1));
    result(SECCOMP_RET_ERRNO | EPERM);
    result(SECCOMP_RET_ALLOW);
  };
#ifdef __NR_open
  open_to_read(__NR_open, 1);
#endif
  open_to_read(__NR_openat, 2);
  result(SECCOMP_RET_ERRNO | EPERM);
  const sock_fprog program = {static_cast<unsigned short>(filter.size()),
                              filter.data()};
  return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

bool Send(char kind, const std::string& text) {
  const std::uint64_t size = text.size();
  return WriteAll(kPipe, &kind, 1) &&
         WriteAll(kPipe, reinterpret_cast<const char*>(&size), sizeof size) &&
         WriteAll(kPipe, text.data(), text.size());
}

// What this process has written to, or may; bytes.
std::uint64_t DataSize() {
  std::ifstream file("/proc/self/statm");
  std::uint64_t pages = 0;
  for (int field = 0; field < 6; ++field) file >> pages;
  return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

// Of the child, which has no other thread.
[[noreturn]] void Run(std::uint64_t memory,
                      const std::function<std::string()>& make, int pipe) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGSEGV, SIGBUS,
                           SIGABRT, SIGFPE, SIGILL}) {
    std::signal(signal, SIG_DFL);
  }
  const rlimit none = {0, 0};
  setrlimit(RLIMIT_CORE, &none);
  const std::uint64_t most = DataSize() + memory;
  const rlimit data = {most, most};
  setrlimit(RLIMIT_DATA, &data);
  const int nothing = open("/dev/null", O_RDWR);
  for (int file = 0; file < kPipe; ++file) dup2(nothing, file);
  if (pipe != kPipe) dup2(pipe, kPipe);
  syscall(__NR_close_range, kPipe + 1U, ~0U, 0U);
  Confine();
  bool sent = false;
  try {
    sent = Send(kMade, make());
  } catch (const InputError& error) {
    sent = Send(kRefused, error.what());
  } catch (const std::bad_alloc&) {
    sent = Send(kNoMemory, "");
  }
  _exit(sent ? 0 : 1);
}

// To the end.
std::string ReadAll(int file) {
  std::string all;
  char buffer[1 << 16];
  for (;;) {
    const ssize_t size = read(file, buffer, sizeof buffer);
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) return all;
    all.append(buffer, size);
  }
}

}  // namespace

std::optional<Confined> MakeConfined(std::uint64_t memory,
                                     const std::function<std::string()>& make) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return std::nullopt;
  const pid_t child = fork();
  if (child == 0) Run(memory, make, ends[1]);
  close(ends[1]);
  std::string sent = child > 0 ? ReadAll(ends[0]) : "";
  close(ends[0]);
  while (child > 0 && waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
  }
  std::uint64_t size = 0;
  constexpr size_t kHead = 1 + sizeof size;
  if (sent.size() < kHead) return std::nullopt;
  std::memcpy(&size, sent.data() + 1, sizeof size);
  if (sent.size() != kHead + size) return std::nullopt;
  if (sent[0] == kNoMemory) {
    // Its own limit is the file's fault, one on this process is not.
    rlimit addresses{};
    getrlimit(RLIMIT_AS, &addresses);
    if (addresses.rlim_cur != RLIM_INFINITY) throw std::bad_alloc();
    return std::nullopt;
  }
  const char kind = sent[0];
  sent.erase(0, kHead);
  return kind == kRefused ? Confined{"", sent} : Confined{sent, ""};
}

}  // namespace armcal
