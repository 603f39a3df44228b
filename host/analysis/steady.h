#pragma once
// Figures of values that follow one another: their mean and scatter, and the part of them that is steady.

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>

namespace vkdose {

/// In the unit of the values; NaN where there are too few.
struct SeriesFigures {
    double mean = std::numeric_limits<double>::quiet_NaN();      ///< NaN without a value
    double error = std::numeric_limits<double>::quiet_NaN();     ///< standard error of the mean
    double relative = std::numeric_limits<double>::quiet_NaN();  ///< their deviation over the mean; NaN if that is 0
};

/// Fewer values have no error and no RSD.
inline constexpr std::size_t kFewestWindows = 5;
/// In fewer values no steady part is sought: half of them must have an error.
inline constexpr std::size_t kFewestForSteady = 2 * kFewestWindows;

/// The error is that of the means of at most ten blocks of values in a row, which differ by one value at most
/// (batch means; Schmeiser 1982, Oper. Res. 30, 556: more than ten to thirty batches gain little).
SeriesFigures seriesFigures(std::span<const double> values);

/// The first value of the steady part by MSER-5 (White 1997, Simulation 69, 323; White, Cobb and Spratt 2000, Winter
/// Simulation Conference): the truncation d, at most half of the n batches of five observations, for which the sum of
/// squares of the rest about its mean, over (n - d)^2, is least. A value is a batch: it is the mean of its fifths. None
/// with fewer than kFewestForSteady values, if their mean is not positive, or if the least is at half: then they still
/// change.
std::optional<std::size_t> steadyFrom(std::span<const double> values);

/// "RSD 0.52 %", "RSD 173 %", of one that is known.
std::string rsdText(const SeriesFigures& figures);

/// Both, and the figures of the steady part.
struct SteadySeries {
    SeriesFigures all;
    std::optional<std::size_t> steady;  ///< the first value of the steady part
    SeriesFigures steadyPart;
};
SteadySeries steadySeries(std::span<const double> values);

/// A figure of a kind of series as files name it, with the unit in the name.
template <class Of>
struct NamedFigure {
    const char* name = "";
    double (*of)(const Of&) = nullptr;  ///< NaN where there is none
    const char* error = nullptr;        ///< the name of its standard error, if it has one
};
/// The one that a target names by the kind and itself, as "rate.steady_kg_s"; null for other targets.
template <class Of>
const NamedFigure<Of>* figureNamed(std::span<const NamedFigure<Of>> figures, const char* kind,
                                   const std::string& target) {
    for (const NamedFigure<Of>& f : figures)
        if (target == std::string(kind) + "." + f.name) return &f;
    return nullptr;
}

}  // namespace vkdose
