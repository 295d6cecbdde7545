// libFuzzer's entry for one of the readers, FUZZED_READER. What a reader throws
// but InputError, and what sanitizers find, ends the process.

#include <glog/logging.h>
#include <stdlib.h>

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

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  static const armcal::FuzzedReader& reader = Reader();
  static const std::string folder = Folder();
  armcal::ReadsAs(reader, folder, reinterpret_cast<const char*>(data), size);
  return 0;
}
