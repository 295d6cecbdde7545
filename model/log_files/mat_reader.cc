#include "model/log_files/mat_reader.h"

#include <matio.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <memory>

#include "model/log_files/columns/log_signal.h"
#include "model/log_files/hdf5_datasets.h"
#include "model/log_files/mat_elements.h"
#include "model/log_files/packed_arrays.h"
#include "model/text/confined_process.h"
#include "model/text/input_error.h"
#include "model/text/unpack.h"
#include "model/text/utf8.h"

namespace armcal {
namespace {

struct Close {
  void operator()(mat_t* file) const { Mat_Close(file); }
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using Variable = std::unique_ptr<matvar_t, Close>;

char KindOf(matio_types type) {
  switch (type) {
    case MAT_T_DOUBLE:
    case MAT_T_SINGLE:
      return 'f';
    case MAT_T_INT8:
    case MAT_T_INT16:
    case MAT_T_INT32:
    case MAT_T_INT64:
      return 'i';
    case MAT_T_UINT8:
    case MAT_T_UINT16:
    case MAT_T_UINT32:
    case MAT_T_UINT64:
      return 'u';
    default:
      return 0;
  }
}

bool IsMatrix(const matvar_t* v) { return v != nullptr && v->rank == 2; }

std::uint64_t CountOf(const matvar_t* v) {
  return std::uint64_t{v->dims[0]} * v->dims[1];
}

// A row of a matrix of characters without the blanks that fill it.
std::string TextOf(const matvar_t* v, size_t row) {
  std::string text;
  if (v->class_type != MAT_C_CHAR || !IsMatrix(v) || v->data == nullptr ||
      v->nbytes < CountOf(v) * v->data_size) {
    return text;
  }
  // UTF-8 as it is, where characters may have several bytes.
  if (v->data_size == 1 && v->dims[0] == 1) {
    return std::string(static_cast<const char*>(v->data), v->nbytes);
  }
  for (size_t k = 0; k < v->dims[1]; ++k) {
    std::uint32_t c = 0;
    std::memcpy(&c,
                static_cast<const char*>(v->data) +
                    (k * v->dims[0] + row) * v->data_size,
                std::min<size_t>(v->data_size, sizeof c));
    AppendUtf8(c, &text);
  }
  return text.substr(0, text.find_last_not_of(' ') + 1);
}

LogArray ArrayOf(const std::string& name, const matvar_t* v) {
  LogArray array;
  array.name = name;
  array.why_none = "not of real numbers in rows and columns";
  // A matrix of no columns may claim millions of rows.
  if (!IsMatrix(v) || v->data == nullptr || CountOf(v) == 0) return array;
  if (v->class_type == MAT_C_CELL) {
    const auto* const cells = static_cast<matvar_t* const*>(v->data);
    for (std::uint64_t k = 0; k < CountOf(v); ++k) {
      if (cells[k] == nullptr || cells[k]->class_type != MAT_C_CHAR) break;
      array.texts.push_back(TextOf(cells[k], 0));
    }
  } else if (v->class_type == MAT_C_CHAR) {
    for (size_t row = 0; row < v->dims[0]; ++row) {
      array.texts.push_back(TextOf(v, row));
    }
  } else if (!v->isComplex && !v->isLogical && v->data_size > 0 &&
             CountOf(v) == v->nbytes / v->data_size) {
    array.kind = KindOf(v->data_type);
    array.why_none.clear();
    array.item = v->data_size;
    array.by_column = true;
    array.rows = static_cast<long>(v->dims[0]);
    array.columns = static_cast<long>(v->dims[1]);
    if (array.rows == 1) std::swap(array.rows, array.columns);
    array.bytes.assign(static_cast<const char*>(v->data), v->nbytes);
  }
  return array;
}

std::vector<LogArray> FieldsOf(matvar_t* v) {
  std::vector<LogArray> fields;
  if (!IsMatrix(v) || v->class_type != MAT_C_STRUCT || CountOf(v) != 1) {
    return fields;
  }
  const char* const* names = Mat_VarGetStructFieldnames(v);
  for (unsigned k = 0; k < Mat_VarGetNumberOfFields(v); ++k) {
    fields.push_back(ArrayOf(names[k], Mat_VarGetStructFieldByIndex(v, k, 0)));
  }
  return fields;
}

bool HasTime(const std::vector<LogArray>& arrays) {
  return std::any_of(arrays.begin(), arrays.end(),
                     [](const LogArray& a) { return IsTimeName(a.name); });
}

// Refuses what would take far more memory than the file; takes from `left` what
// the variable does.
void CheckSize(const std::string& path, const matvar_t* v,
               std::uint64_t* left) {
  if (v->rank < 1) return;
  std::uint64_t bytes = 8;  // a number; matio does not know yet of what size
  for (int k = 0; k < v->rank; ++k) {
    if (v->dims[k] != 0 && bytes > *left / v->dims[k]) {
      throw InputError(path, "variable " + std::string(v->name ? v->name : ""),
                       "",
                       "is of more than 64 MiB and 200 times the file's size: "
                       "expected a log, which does not pack that much");
    }
    bytes *= v->dims[k];
  }
  *left -= bytes;
}

LogArray Unreadable(const std::string& name) {
  LogArray array;
  array.name = name;
  array.why_none = "damaged, or of a class that is not read";
  return array;
}

}  // namespace

bool IsMatFile(std::string_view first) {
  if (first.substr(0, 7) == "MATLAB ") return true;
  // v4: five numbers of either byte order. The thousands of the first tell
  // the order, the other digits are at most 0, 5 and 2; the fourth is 0 or 1,
  // the last how long a name is.
  const auto number = [&](int k, bool big) {
    std::uint32_t value = 0;
    for (int b = 0; b < 4; ++b) {
      value = value << 8 |
              static_cast<unsigned char>(first[4 * k + (big ? b : 3 - b)]);
    }
    return value;
  };
  for (const bool big : {false, true}) {
    if (first.size() < 20) return false;
    const std::uint32_t type = number(0, big) - (big ? 1000 : 0);
    if (type <= 52 && type % 10 <= 2 && number(3, big) <= 1 &&
        number(4, big) - 1 < 64) {
      return true;
    }
  }
  return false;
}

namespace {

// By the libraries, as they are.
std::vector<LogArray> ReadVariables(const std::string& path) {
  CheckHdf5Datasets(path);
  const std::unique_ptr<mat_t, Close> file(
      Mat_Open(path.c_str(), MAT_ACC_RDONLY));
  if (!file) {
    throw InputError(path, "", "", "is a damaged MAT-file, or cut off");
  }
  std::error_code error;
  std::uint64_t left = MostUnpacked(std::filesystem::file_size(path, error));
  std::vector<LogArray> variables, fields;
  std::string structure;
  while (const Variable v{Mat_VarReadNextInfo(file.get())}) {
    CheckSize(path, v.get(), &left);
    const std::string name = v->name ? v->name : "";
    if (Mat_VarReadDataAll(file.get(), v.get()) != 0) {
      variables.push_back(Unreadable(name));
      continue;
    }
    variables.push_back(ArrayOf(name, v.get()));
    std::vector<LogArray> inside = FieldsOf(v.get());
    if (!HasTime(inside)) continue;
    if (!structure.empty() && !HasTime(variables)) {
      throw InputError(path, "", structure + ", " + name,
                       "two structures hold a time, expected one");
    }
    structure = name;
    fields = std::move(inside);
  }
  if (variables.empty()) {
    throw InputError(path, "", "",
                     "is a MAT-file in which no variable can be read: it is "
                     "empty, damaged or cut off");
  }
  return HasTime(variables) || fields.empty() ? variables : fields;
}

}  // namespace

std::vector<LogArray> ReadMat(const std::string& path) {
  CheckMatElements(path);
  // HDF5's and matio's own faults are many, and most are not mended in Debian.
  std::error_code error;
  // matio's arrays, ours and those that are sent.
  const std::uint64_t memory =
      4 * MostUnpacked(std::filesystem::file_size(path, error));
  const auto confined =
      MakeConfined(memory, [&] { return PackArrays(ReadVariables(path)); });
  if (confined && !confined->refusal.empty()) {
    const std::string head = path + ": ";
    throw InputError(path, "", "", confined->refusal.substr(head.size()));
  }
  std::vector<LogArray> arrays;
  if (confined) arrays = UnpackArrays(confined->made);
  if (arrays.empty()) {
    throw InputError(path, "", "", "is a damaged MAT-file, or cut off");
  }
  return arrays;
}

}  // namespace armcal
