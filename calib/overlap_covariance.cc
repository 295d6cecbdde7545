#include "calib/overlap_covariance.h"

#include <algorithm>
#include <cmath>

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

double InformingSlope(const LossAt& loss) { return std::max(loss.slope, .01); }

OverlapCovariance::OverlapCovariance(int num_joints, int num_parameters,
                                     int rows_per_window)
    : lags_(rows_per_window),
      distances_(2 * lags_ - 1),
      rows_(VectorXd::Zero(num_joints)),
      products_(MatrixXd::Zero(num_joints, lags_)) {
  const MatrixXd zero = MatrixXd::Zero(num_parameters, num_parameters);
  squares_.assign(num_joints * distances_, {zero, zero, zero});
}

void OverlapCovariance::Break() { recent_.clear(); }

void OverlapCovariance::Add(const FittedRow& row) {
  recent_.emplace_front(row);
  if (static_cast<int>(recent_.size()) > distances_) recent_.pop_back();
  const Recent& now = recent_.front();
  for (int i = 0; i < row.r.size(); ++i) {
    if (!row.used[i]) continue;
    rows_[i] += 1;
    for (int d = 0; d < static_cast<int>(recent_.size()); ++d) {
      const Recent& other = recent_[d];
      const double mean = .5 * (now.slope[i] + other.slope[i]);
      const double both = now.slope[i] * other.slope[i];
      const bool overlaps = d < lags_;
      if (overlaps) products_(i, d) += now.r[i] * other.r[i];
      AddSquare(now.equations[i], other.equations[i], mean, both, overlaps,
                &squares_[i * distances_ + d]);
    }
  }
}

OverlapCovariance::Recent::Recent(const FittedRow& row)
    : r(row.r), slope(row.slope) {
  for (Eigen::Index i = 0; i < row.U.rows(); ++i) {
    VectorXd u = row.U.row(i);
    Eigen::Index begin = 0, end = u.size();
    while (begin < end && u[begin] == 0) ++begin;
    while (begin < end && u[end - 1] == 0) --end;
    equations.push_back({begin, u.segment(begin, end - begin)});
  }
}

// Adds u' v, times what it is to be; all three in one go.
void OverlapCovariance::AddSquare(const Equation& u, const Equation& v,
                                  double mean, double both, bool overlaps,
                                  Squares* squares) {
  const Eigen::Index size = u.u.size();
  const double* const from = u.u.data();
  for (Eigen::Index c = 0; c < v.u.size(); ++c) {
    const auto column = [&](MatrixXd& square) {
      return square.col(v.begin + c).data() + u.begin;
    };
    const double factor = v.u[c];
    double* const to_mean = column(squares->mean);
    if (!overlaps) {
      for (Eigen::Index k = 0; k < size; ++k) {
        to_mean[k] += mean * (from[k] * factor);
      }
      continue;
    }
    double* const to_all = column(squares->all);
    double* const to_both = column(squares->both);
    for (Eigen::Index k = 0; k < size; ++k) {
      const double square = from[k] * factor;
      to_mean[k] += mean * square;
      to_all[k] += square;
      to_both[k] += both * square;
    }
  }
}

// How much smaller products_ are for the fit. With the hat matrix H, whose
// rows the loss's slopes scale, and the errors' covariance W, residuals have
// (I - H) W (I - H)'.
MatrixXd OverlapCovariance::Taken(const MatrixXd& gain, const VectorXd& scale,
                                  const MatrixXd& c,
                                  const MatrixXd& covariance) const {
  MatrixXd taken = MatrixXd::Zero(c.rows(), lags_);
  for (int i = 0; i < scale.size(); ++i) {
    if (rows_[i] == 0) continue;
    const double square = scale[i] * scale[i];
    VectorXd hat(distances_);
    for (int d = 0; d < distances_; ++d) {
      hat[d] = square * gain.cwiseProduct(Square(i, d).mean).sum();
    }
    for (int l = 0; l < lags_; ++l) {
      for (int k = 1 - lags_; k < lags_; ++k) {
        taken(i, l) += 2 * c(i, std::abs(k)) * hat[std::abs(l + k)];
      }
      taken(i, l) -= square * covariance.cwiseProduct(Square(i, l).both).sum();
    }
  }
  return taken;
}

MatrixXd OverlapCovariance::Value(const MatrixXd& gain,
                                  const VectorXd& scale) const {
  const auto count = rows_.cwiseMax(1).cwiseInverse().asDiagonal();
  MatrixXd c = count * products_, covariance;
  for (int iteration = 0; iteration < 10; ++iteration) {
    MatrixXd sum = MatrixXd::Zero(gain.rows(), gain.cols());
    for (int i = 0; i < scale.size(); ++i) {
      const double square = scale[i] * scale[i];
      sum += square * c(i, 0) * Square(i, 0).all;
      for (int l = 1; l < lags_; ++l) {
        const MatrixXd& all = Square(i, l).all;
        sum += square * c(i, l) * (all + all.transpose());
      }
    }
    covariance = gain * sum * gain.transpose();
    c = count * (products_ + Taken(gain, scale, c, covariance));
    // Where parameters take most of a joint's rows nothing can be given back.
    for (int i = 0; i < scale.size(); ++i) {
      const double most = 4 * products_(i, 0) / std::max(1., rows_[i]);
      if (c(i, 0) > most) c.row(i) *= most / c(i, 0);
    }
  }
  return covariance;
}

MatrixXd RaiseTo(const VectorXd& least, const MatrixXd& covariance) {
  VectorXd factor(covariance.rows());
  for (Eigen::Index k = 0; k < factor.size(); ++k) {
    const double ratio = least[k] / covariance(k, k);
    factor[k] = covariance(k, k) > 0 ? std::sqrt(std::max(1.0, ratio)) : 1;
  }
  return factor.asDiagonal() * covariance * factor.asDiagonal();
}

}  // namespace armcal
