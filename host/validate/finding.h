#pragma once
// What a comparison with the literature comes to: figures with their verdicts, and curves to look at.

#include <array>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace vkdose::validate {

/// What a figure must be: in a range, or of a sign. A sign is known if the figure is two standard errors from zero.
enum class Wanted { Range, Positive, Negative };

enum class Verdict {
    Agrees,        ///< the figure is in the range, or has the sign
    Undecided,     ///< it is outside of the range by no more than two standard errors, or its sign is not known
    Differs,       ///< it is outside by more, has the other sign, or is not a number
    NotComparable  ///< the two stand beside each other, and the remark says why no more can be said
};

/// A figure of the simulation beside what the literature says of it.
struct Finding {
    std::string figure = {};
    std::string unit = {};
    double got = std::numeric_limits<double>::quiet_NaN();
    double error = 0;          ///< standard error of `got`; 0: none is known
    double low = 0, high = 0;  ///< the range in which it must be; of no account for a sign
    std::string source = {};   ///< where the range comes from
    std::string remark = {};   ///< what the figure is, why the range is so wide, or why the two cannot be compared
    bool comparable = true;
    Wanted wanted = Wanted::Range;

    Verdict verdict() const;
};

const char* wordOf(Verdict verdict);

/// The mean of what several runs gave and its standard error, without a range yet. NaN of none; of one no error is
/// known.
Finding meanOf(const std::string& figure, const std::string& unit, const std::vector<double>& values);

/// The figure cannot be compared, for this reason.
void notComparable(Finding& finding, const std::string& why);

/// Holds a figure against those of other programs that ran the same inputs, by name. The range is theirs, wider on both
/// sides by `share` of each and by `spread` [unit of the figure]. A program whose value is not a number is named in the
/// remark and left out. Without others the figure cannot be compared, the remark says so, and the source stays.
void holdAgainst(Finding& finding, const std::map<std::string, double>& others, double share, double spread);

struct Curve {
    std::string name;
    std::vector<std::array<double, 3>> points;  ///< x, y, standard error of y or 0
    bool line = true;
    bool dots = true;
};

struct Chart {
    std::string title, note;
    std::string x, y;  ///< labels with units
    std::vector<Curve> curves;
};

struct Evaluation {
    std::vector<Finding> findings;
    std::vector<Chart> charts;
};

}  // namespace vkdose::validate
