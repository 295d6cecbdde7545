#include "calib/poses/identifiability.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "model/signals/column_basis.h"
#include "problems/poses/plane_residual.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kLeastColumn = 1e-5;  // of a column that would count

// The columns of a Jacobian, asked one by one whether they are independent of
// those taken before (and of all that are none of the `geometry` first): a
// column counts if more than kLeastColumn of a frame's column is left of it, so
// that the decision does not hang on its own length. Taking them in order,
// unlike a pivoted QR, keeps what users know (frames, joint zeros) and holds
// the rest.
class SeenColumns {
 public:
  SeenColumns(MatrixXd J, int geometry)
      : J_(std::move(J)), basis_(static_cast<int>(J_.rows())) {
    scale_ = J_.leftCols(6).norm() / std::sqrt(6.0);
    for (Eigen::Index c = geometry; c < J_.cols(); ++c) {
      basis_.Add(J_.col(c), scale_, 1e-7);
    }
  }
  bool Add(int k) { return basis_.Add(J_.col(k), scale_, kLeastColumn); }
  bool IsNone(int k) const { return J_.col(k).norm() < kLeastColumn * scale_; }

 private:
  MatrixXd J_;
  ColumnBasis basis_;
  double scale_;
};

// As if the tip were where the point is, or on the plane. Then what no touch
// can tell, a turn of the whole arm or other lengths of all of it, is the same
// as other points to the last digit; beside the errors of a start it only is
// about that.
MatrixXd TouchingJacobian(const PoseFit& fit, const std::vector<int>& rows,
                          const PoseUnknowns& at) {
  const PoseMeasurements& measured = fit.measured();
  const ArmGeometry& geometry = fit.geometry();
  const int g = geometry.size();
  MatrixXd J =
      MatrixXd::Zero(static_cast<Eigen::Index>(fit.Width() * rows.size()),
                     g + at.other.size());
  std::vector<ParameterTwist> twists;
  const std::vector<TouchedPlane> planes =
      measured.planes ? TouchedPlanes(geometry, measured, nullptr)
                      : std::vector<TouchedPlane>{};
  for (size_t k = 0; k < rows.size(); ++k) {
    auto own =
        J.middleRows(static_cast<Eigen::Index>(fit.Width() * k), fit.Width());
    const int point = 3 * measured.touched[rows[k]];
    const Eigen::Vector3d tip =
        geometry.ToolPose(measured.q.row(rows[k]), at.geometry.data(), &twists)
            .translation();
    if (measured.planes) {
      const TouchedPlane& plane = planes[point / 3];
      const double* const abc = at.other.data() + point;
      const Eigen::Vector3d n = plane.Normal(abc);
      const Eigen::Vector3d on = tip - plane.Distance(abc, tip) * n;
      for (int c = 0; c < g; ++c) own(0, c) = n.dot(twists[c].At(on));
      own.middleCols<3>(g + point) = plane.Derivative(abc, on);
      continue;
    }
    for (int c = 0; c < g; ++c) {
      own.col(c) = twists[c].At(at.other.segment<3>(point));
    }
    own.middleCols<3>(g + point) = -Eigen::Matrix3d::Identity();
  }
  return J / fit.noise().position;
}

}  // namespace

int ScaleLength(const PoseFit& fit, const std::vector<bool>& wanted) {
  const ArmGeometry& geometry = fit.geometry();
  const VectorXd nominal = geometry.Values();
  if (fit.measured().touched.empty()) return -1;
  const std::vector<std::string> units = geometry.Units();
  int longest = -1;
  for (int k = 0; k < geometry.size(); ++k) {
    if (!wanted[k] || fit.PriorOf(k) == 0 || units[k] != "m") continue;
    if (longest < 0 || std::abs(nominal[k]) > std::abs(nominal[longest])) {
      longest = k;
    }
  }
  return longest;
}

// A parameter is free only if all Jacobians tell it: that at the start and, of
// touches, that at tips which touch exactly.
std::vector<bool> HoldUnseen(const PoseFit& fit,
                             const std::vector<bool>& wanted,
                             const std::vector<int>& rows,
                             const PoseUnknowns& at,
                             std::vector<std::string>* held) {
  const ArmGeometry& geometry = fit.geometry();
  const std::vector<std::string> names = geometry.Names();
  const int g = geometry.size();
  const int scale = ScaleLength(fit, wanted);
  std::vector<SeenColumns> seen = {
      {fit.WithOtherPriors(fit.Jacobian(rows, at)), g}};
  if (!fit.measured().touched.empty()) {
    seen.emplace_back(TouchingJacobian(fit, rows, at), g);
  }
  if (held != nullptr && fit.measured().tilts.size() > 0) {
    held->push_back("all lengths: an inclinometer sees directions alone");
  }
  std::vector<int> order(g);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    const auto rank = [&](int k) {
      if (ArmGeometry::IsBase(k) || geometry.IsTool(k)) return 0;
      return names[k].rfind(".theta") != std::string::npos ? 1 : 2;
    };
    return rank(a) < rank(b);
  });
  std::vector<bool> free(g, false);
  for (const int k : order) {
    if (!wanted[k]) continue;
    if (k == scale) {
      if (held == nullptr) continue;
      held->push_back(
          names[k] +
          " only with the file's other lengths: touches tell no scale");
      continue;
    }
    // All of them, also where another has not taken it.
    int tells = 0;
    for (SeenColumns& columns : seen) tells += columns.Add(k);
    free[k] = tells == static_cast<int>(seen.size());
    if (free[k] || held == nullptr) continue;
    held->push_back(names[k] +
                    (seen[0].IsNone(k)
                         ? " is not seen by these poses"
                         : " cannot be told from the parameters before it"));
  }
  return free;
}

}  // namespace armcal
