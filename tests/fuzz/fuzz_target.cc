// libFuzzer's entry for one of the readers, FUZZED_READER. What a reader throws
// but InputError, and what sanitizers find, ends the process.

#include <glog/logging.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/time.h>

#include <cstdint>
#include <cstring>
#include <string>

#include "tests/fuzz/fuzzed_readers.h"

namespace {

const armcal::FuzzedReader& Reader() {
  for (const armcal::FuzzedReader& reader : armcal::FuzzedReaders()) {
    if (std::strcmp(reader.name, FUZZED_READER) == 0) return reader;
  }
  LOG(FATAL) << "no reader " FUZZED_READER;
}

// In memory, since every input is a file.
std::string Folder() {
  char name[] = "/dev/shm/armcal_fuzz_XXXXXX";
  PCHECK(mkdtemp(name) != nullptr);
  return name;
}

// Asks libFuzzer to end, which then says what it has done.
void End(int) { raise(SIGUSR1); }

}  // namespace

// FUZZ_CPU_SECONDS: after how much of the processor's time to end. libFuzzer's
// own limit is one of the clock, of which others take their share.
extern "C" int LLVMFuzzerInitialize(int*, char***) {
  const char* seconds = getenv("FUZZ_CPU_SECONDS");
  if (seconds == nullptr) return 0;
  itimerval timer = {};
  timer.it_value.tv_sec = atol(seconds);
  signal(SIGPROF, End);
  PCHECK(setitimer(ITIMER_PROF, &timer, nullptr) == 0);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  static const armcal::FuzzedReader& reader = Reader();
  static const std::string folder = Folder();
  armcal::ReadsAs(reader, folder, reinterpret_cast<const char*>(data), size);
  return 0;
}
