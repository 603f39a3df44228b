#pragma once
// What a comparison with the literature comes to: figures with their verdicts, and curves to look at.

#include <array>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace vkdose::validate {

enum class Verdict {
    Agrees,        ///< the figure is in the range
    Undecided,     ///< it is outside, by no more than two standard errors
    Differs,       ///< it is outside by more, or is not a number
    NotComparable  ///< the two stand beside each other, and the remark says why no more can be said
};

/// A figure of the simulation beside what the literature says of it.
struct Finding {
    std::string figure = {};
    std::string unit = {};
    double got = std::numeric_limits<double>::quiet_NaN();
    double error = 0;          ///< standard error of `got`; 0: none is known
    double low = 0, high = 0;  ///< the range in which it must be
    std::string source = {};   ///< where the range comes from
    std::string remark = {};   ///< what the figure is, why the range is so wide, or why the two cannot be compared
    bool comparable = true;

    Verdict verdict() const;
};

const char* wordOf(Verdict verdict);

/// Holds a figure against those of other programs that ran the same inputs, by name. The range is theirs, wider on both
/// sides by `share` of each and by `spread` [unit of the figure]. Without others it cannot be compared, the remark
/// says so, and the source stays.
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
