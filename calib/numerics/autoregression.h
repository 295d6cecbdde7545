#pragma once

#include <Eigen/Core>
#include <vector>

namespace armcal {

// Stationary noise as an autoregression: x_t = sum_k a_k x_{t-k} + e_t, e_t
// with the standard deviation sigma.
struct Autoregression {
  static constexpr int kOrder = 4;
  Eigen::Matrix<double, kOrder, 1> a = Eigen::Matrix<double, kOrder, 1>::Zero();
  double sigma = 1;

  // e_t / sigma of every column; the first kOrder rows, which lack their past,
  // have none.
  Eigen::MatrixXd Whiten(const Eigen::MatrixXd& x) const;
  double stddev() const;  // of x itself
};

// Of its sum with independent white noise: the autoregression with the sum's
// covariances up to the order.
Autoregression PlusWhite(const Autoregression& noise, double stddev);

// Fits stretches of equally sampled noise by the Yule-Walker equations.
// Robust against what comes and goes and against lines: the spectrum is the
// median over time windows (Welch's, Hann, half overlapping; Allen et al. 2012)
// and over neighbouring frequencies. Each stretch has its mean taken out where
// `remove_mean`. Too few samples (under 40): nothing but the variance.
Autoregression FitAutoregression(const std::vector<Eigen::VectorXd>& stretches,
                                 bool remove_mean);

// The same by the covariances of all samples as they are (Yule and Walker),
// with all that comes and goes in them and the slow part that windows of the
// spectrum do not resolve: for what a model leaves, not for noise alone.
Autoregression FitYuleWalker(const std::vector<Eigen::VectorXd>& stretches);

// How many independent samples a series that is correlated from one to the next
// by r comes to, as of an autoregression of the first order: n (1-r) / (1+r).
double IndependentSamples(const Eigen::VectorXd& x);

// White noise as large as each column of x.
std::vector<Autoregression> WhiteNoise(const Eigen::MatrixXd& x);

}  // namespace armcal
