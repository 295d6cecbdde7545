#include "model/log_files/hdf5_datasets.h"

#include <hdf5/serial/hdf5.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "model/text/inflated_bytes.h"
#include "model/text/input_error.h"

namespace armcal {
namespace {

// Of a file, an object or a property list.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  hid_t id() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

// The numbers of a dataset, and of each of its chunks, by dimension.
struct Shape {
  explicit Shape(hid_t dataset, hid_t stored) {
    const Handle space(H5Dget_space(dataset), &H5Sclose);
    const Handle type(H5Dget_type(dataset), &H5Tclose);
    rank = H5Sget_simple_extent_dims(space.id(), size.data(), nullptr);
    bytes_of_one = static_cast<double>(H5Tget_size(type.id()));
    is_chunked = H5Pget_layout(stored) == H5D_CHUNKED;
    if (is_chunked) {
      fits = H5Pget_chunk(stored, H5S_MAX_RANK, chunk.data()) == rank;
    }
  }

  static double Product(const std::array<hsize_t, H5S_MAX_RANK>& x, int count) {
    double product = 1;
    for (int k = 0; k < count; ++k) product *= static_cast<double>(x[k]);
    return product;
  }
  double Bytes() const { return bytes_of_one * Product(size, rank); }
  double ChunkBytes() const { return bytes_of_one * Product(chunk, rank); }
  // Infinite where they are not of the dataset's shape.
  double NumChunks() const {
    if (!is_chunked) return 0;
    return fits ? Product(size, rank) / Product(chunk, rank)
                : std::numeric_limits<double>::infinity();
  }

  int rank = 0;
  double bytes_of_one = 0;
  bool is_chunked = false, fits = true;
  std::array<hsize_t, H5S_MAX_RANK> size{}, chunk{};
};

// Those that a chunk has gone through, in their order.
std::vector<H5Z_filter_t> FiltersBut(unsigned skipped, hid_t stored) {
  std::vector<H5Z_filter_t> filters;
  for (int k = 0; k < H5Pget_nfilters(stored); ++k) {
    if ((skipped >> k & 1) != 0) continue;
    unsigned flags = 0;
    size_t values = 0;
    filters.push_back(H5Pget_filter2(stored, k, &flags, &values, nullptr, 0,
                                     nullptr, nullptr));
  }
  return filters;
}

// Whether a chunk, once read, is as long as its numbers: HDF5 1.10 copies them
// without having looked.
bool ChunkIsWhole(hid_t dataset, hid_t stored, const hsize_t* offset,
                  double needed, hsize_t file_size) {
  constexpr double kChecksum = 4;
  unsigned skipped = 0;
  haddr_t address = 0;
  hsize_t size = 0;
  if (H5Dget_chunk_info_by_coord(dataset, offset, &skipped, &address, &size) <
      0) {
    return false;
  }
  if (size == 0) return true;  // never written
  if (size > file_size) return false;
  std::string bytes(size, '\0');
  if (H5Dread_chunk(dataset, H5P_DEFAULT, offset, &skipped, bytes.data()) < 0) {
    return false;
  }
  const std::vector<H5Z_filter_t> filters = FiltersBut(skipped, stored);
  auto length = static_cast<double>(size);
  for (auto filter = filters.rbegin(); filter != filters.rend(); ++filter) {
    if (*filter == H5Z_FILTER_SHUFFLE) continue;
    if (*filter == H5Z_FILTER_FLETCHER32) {
      length -= kChecksum;
    } else if (*filter == H5Z_FILTER_DEFLATE && !bytes.empty()) {
      if (length < 0) return false;
      bytes.resize(static_cast<size_t>(length));
      length = needed + kChecksum * static_cast<double>(
                                        std::count(filter + 1, filters.rend(),
                                                   H5Z_FILTER_FLETCHER32));
      InflatedBytes inflated([&] { return std::exchange(bytes, {}); });
      if (!inflated.Read(nullptr, static_cast<std::uint64_t>(length))) {
        return false;
      }
    } else {  // nobody's MAT-file
      return false;
    }
  }
  return length >= needed;
}

bool ChunksAreWhole(hid_t dataset, hid_t stored, const Shape& shape) {
  std::array<hsize_t, H5S_MAX_RANK> offset{};
  if (shape.Bytes() == 0) return true;
  const Handle file(H5Iget_file_id(dataset), &H5Fclose);
  hsize_t file_size = 0;
  if (H5Fget_filesize(file.id(), &file_size) < 0) return false;
  for (int k = 0; k < shape.rank;) {
    if (k == 0 && !ChunkIsWhole(dataset, stored, offset.data(),
                                shape.ChunkBytes(), file_size)) {
      return false;
    }
    // The next one, as an odometer counts.
    offset[k] += shape.chunk[k];
    if (offset[k] < shape.size[k]) {
      k = 0;
    } else {
      offset[k++] = 0;
    }
  }
  return true;
}

constexpr char kElsewhere[] =
    "lies in another file: expected numbers that are in this one";
constexpr char kPieces[] =
    "is damaged: expected no more pieces than it has bytes";

constexpr char kShort[] =
    "is damaged: expected as many bytes as its size takes";

// What speaks against reading a dataset; null where nothing does.
const char* FaultOf(hid_t group, const char* name) {
  const Handle object(H5Oopen(group, name, H5P_DEFAULT), &H5Oclose);
  if (H5Iget_type(object.id()) != H5I_DATASET) return nullptr;
  const Handle stored(H5Dget_create_plist(object.id()), &H5Pclose);
  if (H5Pget_external_count(stored.id()) > 0 ||
      H5Pget_layout(stored.id()) == H5D_VIRTUAL) {
    return kElsewhere;
  }
  const Shape shape(object.id(), stored.id());
  const auto bytes = static_cast<double>(H5Dget_storage_size(object.id()));
  // HDF5 1.10 lists all that a read touches, some 150 bytes for each.
  if (shape.NumChunks() > bytes) return kPieces;
  const bool whole =
      shape.is_chunked ? ChunksAreWhole(object.id(), stored.id(), shape)
      : H5Pget_layout(stored.id()) == H5D_COMPACT ? bytes >= shape.Bytes()
                                                  : true;
  return whole ? nullptr : kShort;
}

struct Found {
  std::string name;
  const char* fault;
};

// Ends the visit by 1 where it has found something.
herr_t Visit(hid_t group, const char* name, const H5L_info_t* link,
             void* found) {
  // Soft ones are paths within the file.
  if (link->type == H5L_TYPE_SOFT) return 0;
  const char* const fault =
      link->type == H5L_TYPE_HARD ? FaultOf(group, name) : kElsewhere;
  if (fault == nullptr) return 0;
  *static_cast<Found*>(found) = {name, fault};
  return 1;
}

}  // namespace

void CheckHdf5Datasets(const std::string& path) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // else it prints
  H5PLset_loading_state(0);  // a file does not choose a plugin to be run
  const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT),
                    &H5Fclose);
  if (file.id() < 0) return;
  Found found;
  const herr_t end =
      H5Lvisit(file.id(), H5_INDEX_NAME, H5_ITER_NATIVE, &Visit, &found);
  if (end > 0) {
    throw InputError(path, "variable " + found.name, "", found.fault);
  }
  // What comes after the damage would not have been looked at.
  if (end < 0) {
    throw InputError(path, "", "", "is a damaged MAT-file, or cut off");
  }
}

}  // namespace armcal
