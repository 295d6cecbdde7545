#include "tools/python/log_arrays.h"

#include <utility>
#include <vector>

#include "tools/python/samples.h"

namespace armcal {
namespace {

namespace py = pybind11;

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

// Row by row, as ArraySource reads them.
LogArray ArrayOf(const std::string& name, const py::array& given) {
  const Doubles numbers = Doubles::ensure(given);
  if (!numbers || numbers.ndim() < 1 || numbers.ndim() > 2) {
    PyErr_Clear();
    throw py::value_error(name + ": found shape " + ShapeText(given) +
                          ", expected (N,) or (N, n)");
  }
  LogArray array;
  array.name = name;
  array.kind = 'f';
  array.item = sizeof(double);
  array.rows = static_cast<long>(numbers.shape(0));
  array.columns = numbers.ndim() == 2 ? static_cast<long>(numbers.shape(1)) : 1;
  array.bytes.assign(reinterpret_cast<const char*>(numbers.data()),
                     sizeof(double) * static_cast<size_t>(numbers.size()));
  return array;
}

}  // namespace

std::map<std::string, LogSource> LogSources(const PythonLogs& logs) {
  std::map<std::string, LogSource> sources;
  for (const auto& [log, given] : logs) {
    std::vector<LogArray> arrays;
    for (const auto& [name, array] : given) {
      arrays.push_back(ArrayOf(name, array));
    }
    sources.emplace(log, LogSource(log, std::move(arrays)));
  }
  return sources;
}

}  // namespace armcal
