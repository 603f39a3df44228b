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

/// What a process takes from all its observations beside the values themselves.
struct ProcessKernel {
    std::vector<double> lengths;     ///< over which a value changes, one for each coordinate
    double noise = 0, variance = 1;  ///< that all observations share, and of the process, in units of scale^2
    double mean = 0, scale = 1;      ///< in the unit of the observations
};

/// An observation, and what all others say of one there.
struct LeftOut {
    double observed = 0;
    Belief predicted;  ///< its deviation includes the noise of the observation

    /// How far it is off, in deviations. Of an honest process the squares have a mean of 1.
    double standardised() const { return (observed - predicted.mean) / predicted.deviation; }
};

class GaussianProcess {
  public:
    /// Takes at least two observations, with coordinates in [0, 1]. The covariance is Matern 5/2, with a length for
    /// each coordinate. A noise that all observations share is added to the known errors. Lengths, noise and the
    /// variance of the process are the most probable ones, from the marginal likelihood and weak prior beliefs.
    GaussianProcess(std::vector<std::vector<double>> points, const std::vector<Measured>& observations);

    /// A process through at least one observation whose kernel is known.
    GaussianProcess(std::vector<std::vector<double>> points, const std::vector<Measured>& observations,
                    ProcessKernel kernel);

    Belief at(const std::vector<double>& point) const;

    /// Change of the mean along coordinate `k`, over a tenth of its range about a point of the unit cube, or as much of
    /// it as is inside [unit of the observations for the whole range].
    double slope(std::vector<double> point, std::size_t k) const;

    /// Each observation as all others predict it, with the same kernel. In closed form, from one inverse of the
    /// covariance K: mean y_i - [K^-1 y]_i / [K^-1]_ii, variance 1 / [K^-1]_ii (Sundararajan and Keerthi 2001;
    /// Rasmussen and Williams 2006, section 5.4.2).
    std::vector<LeftOut> leftOut() const;

    const ProcessKernel& kernel() const { return kernel_; }
    const std::vector<double>& lengths() const { return kernel_.lengths; }

  private:
    void take(const std::vector<Measured>& observations);
    Eigen::MatrixXd covariance(const ProcessKernel& kernel) const;
    ProcessKernel kernelOf(const std::vector<double>& logs) const;
    double logPosterior(const std::vector<double>& logs) const;
    std::vector<double> climbed(std::vector<double> logs) const;
    std::vector<double> fitted() const;

    std::vector<std::vector<double>> points_;
    ProcessKernel kernel_;
    Eigen::VectorXd values_;  ///< measured from the kernel's mean, in units of its scale
    Eigen::VectorXd errors_;  ///< in units of its scale
    Eigen::LLT<Eigen::MatrixXd> root_;
    Eigen::VectorXd weights_;
};

}  // namespace vkdose
