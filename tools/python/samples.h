#pragma once

#include <pybind11/numpy.h>

#include <Eigen/Core>
#include <string>
#include <vector>

namespace armcal {

// What Python gave for a signal of n joints: N x n, or n for a single sample.
struct Samples {
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> values;
  bool single = false;

  long size() const { return values.rows(); }
  Eigen::VectorXd at(long k) const { return values.row(k).transpose(); }
};

// Copied, from any memory order and type of number. ValueError names `name`,
// the shape found and the one expected.
Samples ReadSamples(const char* name, const pybind11::object& given, int n);
// The same, as many as `like` has.
Samples ReadSamples(const char* name, const pybind11::object& given, int n,
                    const Samples& like);

// n finite numbers.
Eigen::VectorXd ReadVector(const char* name, const pybind11::object& given,
                           int n);

// "(100, 5)".
std::string ShapeText(const pybind11::array& array);

// Raises what a signal handler raised, such as KeyboardInterrupt. The GIL may
// be released.
void CheckSignals();

// An array of f(k, values) for all samples: of `shape` each, row by row.
// Without the first axis where a single one was given. f runs without the GIL.
template <class F>
pybind11::array_t<double> ForSamples(const Samples& samples,
                                     std::vector<pybind11::ssize_t> shape,
                                     const F& f) {
  constexpr long kSignalsEvery = 4096;
  pybind11::ssize_t size = 1;
  for (const pybind11::ssize_t extent : shape) size *= extent;
  if (!samples.single) shape.insert(shape.begin(), samples.size());
  pybind11::array_t<double> result(shape);
  double* const values = result.mutable_data();
  const pybind11::gil_scoped_release release;
  for (long k = 0; k < samples.size(); ++k) {
    if (k % kSignalsEvery == 0) CheckSignals();
    f(k, values + k * size);
  }
  return result;
}

}  // namespace armcal
