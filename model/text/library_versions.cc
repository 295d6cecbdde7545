#include "model/text/library_versions.h"

#include <hdf5/serial/H5public.h>
#include <lz4.h>
#include <matio.h>
#include <oneapi/tbb/version.h>
#include <sqlite3.h>
#include <zlib.h>
#include <zstd.h>

#include <cstddef>
#include <cstdlib>
#include <new>

namespace armcal {
namespace {

// The numbers of "1.10.8"; what follows them does not count.
std::vector<long> Numbers(const std::string& version) {
  std::vector<long> numbers;
  const char* text = version.c_str();
  while (*text >= '0' && *text <= '9') {
    char* end;
    numbers.push_back(std::strtol(text, &end, 10));
    text = *end == '.' ? end + 1 : end;
  }
  return numbers;
}

template <class Integer>
std::string Dotted(Integer major, Integer minor, Integer release) {
  return std::to_string(major) + "." + std::to_string(minor) + "." +
         std::to_string(release);
}

LibraryVersion Matio() {
  int version[3];
  Mat_GetLibraryVersion(&version[0], &version[1], &version[2]);
  return {"matio", MATIO_VERSION_STR,
          Dotted(version[0], version[1], version[2])};
}

// HDF5 prepares itself at its first call, and crashes where it has no memory
// for that: as much as it takes is asked for first. Throws std::bad_alloc.
LibraryVersion Hdf5() {
  constexpr std::size_t kPrepared = 8 << 20;  // bytes
  ::operator delete(::operator new(kPrepared));
  unsigned version[3] = {};
  H5get_libversion(&version[0], &version[1], &version[2]);
  return {"HDF5", Dotted(H5_VERS_MAJOR, H5_VERS_MINOR, H5_VERS_RELEASE),
          Dotted(version[0], version[1], version[2])};
}

}  // namespace

bool LibraryVersion::fits() const {
  const std::vector<long> ours = Numbers(built), found = Numbers(loaded);
  return !ours.empty() && !found.empty() && found[0] == ours[0] &&
         found >= ours;
}

std::vector<LibraryVersion> LoadedLibraries() {
  return {{"zlib", ZLIB_VERSION, zlibVersion()},
          {"zstd", ZSTD_VERSION_STRING, ZSTD_versionString()},
          {"LZ4", LZ4_VERSION_STRING, LZ4_versionString()},
          {"SQLite", SQLITE_VERSION, sqlite3_libversion()},
          Matio(),
          Hdf5(),
          {"oneTBB", TBB_VERSION_STRING, TBB_runtime_version()}};
}

}  // namespace armcal
