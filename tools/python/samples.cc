#include "tools/python/samples.h"

namespace armcal {
namespace {

namespace py = pybind11;

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

[[noreturn]] void RefuseShape(const char* name, const py::array& array,
                              const std::string& expected) {
  throw py::value_error(std::string(name) + ": found shape " +
                        ShapeText(array) + ", expected " + expected);
}

Numbers ReadNumbers(const char* name, const py::object& given) {
  const Numbers numbers = Numbers::ensure(given);
  if (numbers) return numbers;
  PyErr_Clear();
  throw py::value_error(std::string(name) + ": expected an array of numbers");
}

}  // namespace

std::string ShapeText(const py::array& array) {
  return py::str(py::tuple(array.attr("shape")));
}

Samples ReadSamples(const char* name, const py::object& given, int n) {
  const Numbers numbers = ReadNumbers(name, given);
  const py::ssize_t axes = numbers.ndim();
  if (axes < 1 || axes > 2 || numbers.shape(axes - 1) != n) {
    RefuseShape(
        name, numbers,
        "(N, " + std::to_string(n) + ") or (" + std::to_string(n) + ",)");
  }
  Samples samples;
  samples.single = axes == 1;
  samples.values = Eigen::Map<const decltype(samples.values)>(
      numbers.data(), samples.single ? 1 : numbers.shape(0), n);
  return samples;
}

Samples ReadSamples(const char* name, const py::object& given, int n,
                    const Samples& like) {
  const Samples samples = ReadSamples(name, given, n);
  if (samples.single == like.single && samples.size() == like.size()) {
    return samples;
  }
  const std::string columns = std::to_string(n);
  RefuseShape(name, ReadNumbers(name, given),
              like.single ? "(" + columns + ",) as q has"
                          : "(" + std::to_string(like.size()) + ", " + columns +
                                ") as q has");
}

Eigen::VectorXd ReadVector(const char* name, const py::object& given, int n) {
  const Samples values = ReadSamples(name, given, n);
  if (!values.single) {
    RefuseShape(name, ReadNumbers(name, given), "(" + std::to_string(n) + ",)");
  }
  if (!values.values.allFinite()) {
    throw py::value_error(std::string(name) + ": expected finite numbers");
  }
  return values.at(0);
}

void CheckSignals() {
  const py::gil_scoped_acquire acquire;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

}  // namespace armcal
