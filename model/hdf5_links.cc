#include "model/hdf5_links.h"

#include <hdf5/serial/hdf5.h>

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

bool IsStoredElsewhere(hid_t group, const char* name) {
  const Handle object(H5Oopen(group, name, H5P_DEFAULT), &H5Oclose);
  if (H5Iget_type(object.id()) != H5I_DATASET) return false;
  const Handle stored(H5Dget_create_plist(object.id()), &H5Pclose);
  return H5Pget_external_count(stored.id()) > 0 ||
         H5Pget_layout(stored.id()) == H5D_VIRTUAL;
}

// Ends the visit by 1 where a link leads out of the file, whose name it then
// puts at `found`.
herr_t Visit(hid_t group, const char* name, const H5L_info_t* link,
             void* found) {
  // Soft ones are paths within the file.
  if (link->type == H5L_TYPE_SOFT) return 0;
  if (link->type == H5L_TYPE_HARD && !IsStoredElsewhere(group, name)) return 0;
  *static_cast<std::string*>(found) = name;
  return 1;
}

}  // namespace

void CheckHdf5Links(const std::string& path) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // else it prints
  H5PLset_loading_state(0);  // a file does not choose a plugin to be run
  const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT),
                    &H5Fclose);
  std::string name;
  if (file.id() >= 0 &&
      H5Lvisit(file.id(), H5_INDEX_NAME, H5_ITER_NATIVE, &Visit, &name) > 0) {
    throw InputError(path, "variable " + name, "",
                     "lies in another file: expected numbers that are in this "
                     "one");
  }
}

}  // namespace armcal
