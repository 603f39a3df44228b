#pragma once
// Interpolation with an uncertainty: a Gaussian process over a few dozen noisy observations.
// Source: Rasmussen & Williams, Gaussian Processes for Machine Learning (2006), chapters 2, 4.2 and 5.4.

#include <Eigen/Dense>
#include <vector>

namespace vkdose {

/// The value at a point as the process estimates it.
struct Belief {
    double mean = 0;
    double deviation = 0;  ///< of the underlying value, without the noise of another observation
};

/// A value that was measured, and its standard error. An error of 0 means that it is not known.
struct Measured {
    double value = 0;
    double error = 0;
};

class GaussianProcess {
  public:
    /// Takes at least two observations, with coordinates in [0, 1]. The covariance is Matern 5/2, with a length for
    /// each coordinate. A noise that all observations share is added to the known errors. Lengths, noise and the
    /// variance of the process are the most probable ones, from the marginal likelihood and weak prior beliefs.
    GaussianProcess(std::vector<std::vector<double>> points, const std::vector<Measured>& observations);

    Belief at(const std::vector<double>& point) const;

    const std::vector<double>& lengths() const { return lengths_; }

  private:
    Eigen::MatrixXd covariance(const std::vector<double>& logs) const;
    double logPosterior(const std::vector<double>& logs) const;
    std::vector<double> climbed(std::vector<double> logs) const;
    std::vector<double> fitted() const;

    std::vector<std::vector<double>> points_;
    double mean_ = 0, scale_ = 1;  ///< the values below are measured from the mean, in units of the scale
    Eigen::VectorXd values_;
    Eigen::VectorXd errors_;
    std::vector<double> lengths_;
    double variance_ = 0;  ///< of the process
    Eigen::LLT<Eigen::MatrixXd> root_;
    Eigen::VectorXd weights_;
};

}  // namespace vkdose
