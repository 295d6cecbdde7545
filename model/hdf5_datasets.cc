#include "model/hdf5_datasets.h"

#include <hdf5/serial/hdf5.h>

#include <array>
#include <limits>

#include "model/input_error.h"

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

// Chunks of a dataset; 0 where it has none, infinite where they are not of its
// shape.
double NumChunks(hid_t dataset, hid_t stored) {
  if (H5Pget_layout(stored) != H5D_CHUNKED) return 0;
  const Handle space(H5Dget_space(dataset), &H5Sclose);
  std::array<hsize_t, H5S_MAX_RANK> size{}, chunk{};
  const int rank = H5Sget_simple_extent_dims(space.id(), size.data(), nullptr);
  if (H5Pget_chunk(stored, H5S_MAX_RANK, chunk.data()) != rank) {
    return std::numeric_limits<double>::infinity();
  }
  double count = 1;
  for (int k = 0; k < rank; ++k) {
    count *= static_cast<double>(size[k]) / static_cast<double>(chunk[k]);
  }
  return count;
}

constexpr char kElsewhere[] =
    "lies in another file: expected numbers that are in this one";
constexpr char kPieces[] =
    "is damaged: expected no more pieces than it has bytes";

// What speaks against reading a dataset; null where nothing does.
const char* FaultOf(hid_t group, const char* name) {
  const Handle object(H5Oopen(group, name, H5P_DEFAULT), &H5Oclose);
  if (H5Iget_type(object.id()) != H5I_DATASET) return nullptr;
  const Handle stored(H5Dget_create_plist(object.id()), &H5Pclose);
  if (H5Pget_external_count(stored.id()) > 0 ||
      H5Pget_layout(stored.id()) == H5D_VIRTUAL) {
    return kElsewhere;
  }
  // HDF5 1.10 lists all that a read touches, some 150 bytes for each.
  const auto bytes = static_cast<double>(H5Dget_storage_size(object.id()));
  return NumChunks(object.id(), stored.id()) > bytes ? kPieces : nullptr;
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
