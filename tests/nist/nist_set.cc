#include "tests/nist/nist_set.h"

#include <ceres/jet.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

namespace armcal {
namespace {

using Eigen::VectorXd;

constexpr int kMostParameters = 9;
constexpr double kPi = 3.141592653589793238462643383279;
using Jet = ceres::Jet<double, kMostParameters>;
using Model = Jet (*)(const Jet* b, const double* x);

// Numbers as NIST counts: b[1] is the first.
Jet Chwirut(const Jet* b, const double* x) {
  return exp(-b[1] * *x) / (b[2] + b[3] * *x);
}

Jet Gauss(const Jet* b, const double* x) {
  const Jet u = (*x - b[4]) / b[5], v = (*x - b[7]) / b[8];
  return b[1] * exp(-b[2] * *x) + b[3] * exp(-u * u) + b[6] * exp(-v * v);
}

Jet Lanczos(const Jet* b, const double* x) {
  return b[1] * exp(-b[2] * *x) + b[3] * exp(-b[4] * *x) +
         b[5] * exp(-b[6] * *x);
}

Jet Cubics(const Jet* b, const double* p) {
  const double x = *p;
  return (b[1] + x * (b[2] + x * (b[3] + x * b[4]))) /
         (1.0 + x * (b[5] + x * (b[6] + x * b[7])));
}

Jet Wave(const Jet& a, const Jet& b, const Jet& period, double x) {
  const Jet angle = 2 * kPi * x / period;
  return a * cos(angle) + b * sin(angle);
}

const std::map<std::string, Model>& Models() {
  static const std::map<std::string, Model> models = {
      {"Bennett5",
       [](const Jet* b, const double* x) {
         return b[1] * pow(b[2] + *x, -1.0 / b[3]);
       }},
      {"BoxBOD",
       [](const Jet* b, const double* x) {
         return b[1] * (1.0 - exp(-b[2] * *x));
       }},
      {"Chwirut1", Chwirut},
      {"Chwirut2", Chwirut},
      {"DanWood",
       [](const Jet* b, const double* x) { return b[1] * pow(*x, b[2]); }},
      {"ENSO",
       [](const Jet* b, const double* x) {
         return b[1] + Wave(b[2], b[3], Jet(12), *x) +
                Wave(b[5], b[6], b[4], *x) + Wave(b[8], b[9], b[7], *x);
       }},
      {"Eckerle4",
       [](const Jet* b, const double* x) {
         const Jet u = (*x - b[3]) / b[2];
         return b[1] / b[2] * exp(-0.5 * u * u);
       }},
      {"Gauss1", Gauss},
      {"Gauss2", Gauss},
      {"Gauss3", Gauss},
      {"Hahn1", Cubics},
      {"Kirby2",
       [](const Jet* b, const double* x) {
         return (b[1] + *x * (b[2] + *x * b[3])) /
                (1.0 + *x * (b[4] + *x * b[5]));
       }},
      {"Lanczos1", Lanczos},
      {"Lanczos2", Lanczos},
      {"Lanczos3", Lanczos},
      {"MGH09",
       [](const Jet* b, const double* x) {
         return b[1] * (*x * *x + *x * b[2]) / (*x * *x + *x * b[3] + b[4]);
       }},
      {"MGH10", [](const Jet* b,
                   const double* x) { return b[1] * exp(b[2] / (*x + b[3])); }},
      {"MGH17",
       [](const Jet* b, const double* x) {
         return b[1] + b[2] * exp(-*x * b[4]) + b[3] * exp(-*x * b[5]);
       }},
      {"Misra1a",
       [](const Jet* b, const double* x) {
         return b[1] * (1.0 - exp(-b[2] * *x));
       }},
      {"Misra1b",
       [](const Jet* b, const double* x) {
         return b[1] * (1.0 - pow(1.0 + b[2] * *x / 2.0, -2.0));
       }},
      {"Misra1c",
       [](const Jet* b, const double* x) {
         return b[1] * (1.0 - pow(1.0 + 2.0 * b[2] * *x, -0.5));
       }},
      {"Misra1d",
       [](const Jet* b, const double* x) {
         return b[1] * b[2] * *x / (1.0 + b[2] * *x);
       }},
      {"Nelson",  // of log(y)
       [](const Jet* b, const double* x) {
         return b[1] - b[2] * x[0] * exp(-b[3] * x[1]);
       }},
      {"Rat42",
       [](const Jet* b, const double* x) {
         return b[1] / (1.0 + exp(b[2] - b[3] * *x));
       }},
      {"Rat43",
       [](const Jet* b, const double* x) {
         return b[1] / pow(1.0 + exp(b[2] - b[3] * *x), 1.0 / b[4]);
       }},
      {"Roszman1",  // arctan(b3 / (x - b4)) without its jump at x = b4
       [](const Jet* b, const double* x) {
         return b[1] - b[2] * *x - atan2(-b[3], b[4] - *x) / kPi;
       }},
      {"Thurber", Cubics},
  };
  return models;
}

// The numbers of a line after `begin` of its characters.
std::vector<double> Numbers(const std::string& line, size_t begin) {
  std::istringstream stream(line.substr(begin));
  std::vector<double> numbers;
  for (double x; stream >> x;) numbers.push_back(x);
  return numbers;
}

VectorXd AsVector(const std::vector<double>& x) {
  return Eigen::Map<const VectorXd>(x.data(), x.size());
}

}  // namespace

std::vector<std::string> NistNames() {
  std::vector<std::string> names;
  for (const auto& model : Models()) names.push_back(model.first);
  return names;
}

NistSet ReadNistSet(const std::string& folder, const std::string& name) {
  constexpr int kFirstParameter = 41, kFirstObservation = 61;  // lines
  const std::string path = folder + "/" + name + ".dat";
  const auto refuse = [&path](const std::string& why) {
    throw std::runtime_error(path + ": " + why);
  };
  std::ifstream file(path);
  if (!file) refuse("cannot be opened");
  std::vector<double> columns[4], y, x;
  std::string line;
  for (int row = 1; std::getline(file, line); ++row) {
    const size_t equals = line.find('=');
    if (row >= kFirstObservation) {
      const std::vector<double> numbers = Numbers(line, 0);
      if (numbers.size() != (name == "Nelson" ? 3 : 2)) refuse(line);
      y.push_back(numbers[0]);
      x.insert(x.end(), numbers.begin() + 1, numbers.end());
    } else if (row >= kFirstParameter && equals != line.npos) {
      const std::vector<double> numbers = Numbers(line, equals + 1);
      if (numbers.size() != 4) refuse(line);
      for (int c = 0; c < 4; ++c) columns[c].push_back(numbers[c]);
    }
  }
  if (columns[0].empty() || y.empty()) refuse("holds no data");
  NistSet set{name,
              AsVector(y),
              {},
              {AsVector(columns[0]), AsVector(columns[1])},
              AsVector(columns[2]),
              AsVector(columns[3])};
  set.x = AsVector(x).reshaped(x.size() / y.size(), y.size()).transpose();
  if (name == "Nelson") set.y = set.y.array().log();
  return set;
}

NistResidual::NistResidual(const NistSet& set) : set_(set) {
  set_num_residuals(static_cast<int>(set.y.size()));
  mutable_parameter_block_sizes()->push_back(
      static_cast<int>(set.value.size()));
}

bool NistResidual::Evaluate(double const* const* parameters, double* residuals,
                            double** jacobians) const {
  const Eigen::Index n = set_.value.size();
  Jet b[kMostParameters + 1];
  for (int k = 0; k < n; ++k) b[k + 1] = Jet(parameters[0][k], k);
  const Model model = Models().at(set_.name);
  for (Eigen::Index i = 0; i < set_.y.size(); ++i) {
    const VectorXd x = set_.x.row(i);
    const Jet r = model(b, x.data()) - set_.y[i];
    residuals[i] = r.a;
    if (!std::isfinite(r.a)) return false;  // a step too far
    if (jacobians == nullptr || jacobians[0] == nullptr) continue;
    VectorXd::Map(jacobians[0] + i * n, n) = r.v.head(n);
  }
  return true;
}

}  // namespace armcal
