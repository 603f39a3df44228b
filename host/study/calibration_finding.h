#pragma once
// The finding of a calibration, as people see it: `vkdose calibrate` prints it, the folder of the study keeps it
// (calibration_file.h), and the report of the study shows it.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/study/leave_one_out.h"
#include "host/study/posterior.h"
#include "host/study/study.h"
#include "host/study/surrogate.h"

namespace vkdose {

struct CalibrationFinding {
    /// A target and what is believed of its figure at the chosen point, all in `unit`.
    struct Target {
        std::string name;  ///< the figure, with its case where targets of several cases have the same figure
        std::string unit;  ///< empty where the name of the figure tells it
        std::string base;  ///< name of the case file whose run gives the figure
        double value = 0, uncertainty = 0;
        double weight = 1;  ///< of its square in the misfit [-]
        double believed = 0, deviation = 0;
        LeaveOneOut leaveOneOut = {};  ///< of its surrogate; without points of a grid
    };
    /// A free parameter, in the unit of its key.
    struct Parameter {
        std::string key;
        double low = 0, high = 0, chosen = 0;
        /// For each target its change from bound to bound, by the slope at the chosen point, in uncertainties of the
        /// target.
        std::vector<double> change;
        std::size_t mostlyBy = 0;  ///< the target whose change is greatest
        Interval fits = {};        ///< its values that fit, see Posterior

        /// Whether the interval is clearly shorter than the bounds, of which a parameter that is known by nothing but
        /// them would fill 95 %.
        bool constrained() const { return fits.high - fits.low < 0.8 * (high - low); }
    };
    struct Point {
        Parameters at;
        std::vector<Measured> values;  ///< of each target; NaN where there is none
    };
    /// How the parameters that fit belong together, and how they were sampled; see Posterior.
    struct Fit {
        std::vector<std::vector<double>> correlation;
        std::vector<Belief> figures;    ///< of each target over the draws, in its unit
        std::vector<Parameters> draws;  ///< as powder-draws.csv has them
        std::size_t sampled = 0;
        int steps = 0;
        double acceptance = 0, rHat = 1, effective = 0;
    };
    /// What the runs with new seeds gave at a point, a figure for each target in its unit.
    struct Confirmation {
        std::string at;  ///< "contact.friction 0.3, contact.kc_over_k 0.25"
        std::vector<Confirmed> figures;
        bool met = false;
    };
    std::vector<Target> targets;
    std::vector<Parameter> parameters;  ///< of a search; none of a grid
    std::vector<Point> points;          ///< of a search all that were tried, in order; none of a grid
    std::size_t best = 0;               ///< index of the chosen point
    double misfit = 0;       ///< there, by the belief: sum over the targets of weight (distance / uncertainty)^2
    std::optional<Fit> fit;  ///< of a search
    std::vector<std::uint64_t> confirmingSeeds;
    std::vector<Confirmation> confirmations;  ///< in order
    bool met = false;                         ///< the last confirmation says so
};

/// Two parameters whose values that fit depend on each other so much that an interval of one alone says little.
struct Compensation {
    std::size_t first = 0, second = 0;  ///< of the finding's parameters
    double correlation = 0;             ///< above 0.7 by amount
};
std::vector<Compensation> compensations(const CalibrationFinding& finding);

/// Whether the surrogates find values that give this target: their figure over the draws is off by no more than two
/// standard errors, the target's and the figure's together. If not, it is out of reach or contradicts another one.
bool isReached(const CalibrationFinding& finding, std::size_t target);

/// "honest", "overconfident", "cautious", "blind".
std::string verdictText(LeaveOneOut::Verdict verdict);

/// The values of the free parameters at a point of the search.
std::vector<Setting> settingsAt(const Study& study, const Parameters& point);

/// "contact.friction 0.3, contact.kc_over_k 0.25"
std::string placeText(const std::vector<Setting>& point);

/// The finding of the search of a study; its mass per dose is in g.
CalibrationFinding findingOf(const Study& study, const SearchResult& result, const Posterior& posterior,
                             const std::vector<std::uint64_t>& confirmingSeeds);

/// The finding of a grid whose chosen point is `point`. There the interpolated mass per dose is `believed` [kg], and
/// the confirming runs gave `confirmed` [kg].
CalibrationFinding findingOf(const Study& study, const std::vector<Setting>& point, double believed,
                             const Confirmed& confirmed, const std::vector<std::uint64_t>& confirmingSeeds);

}  // namespace vkdose
