#include "host/report/expected.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "host/core/error.h"
#include "host/report/toml_values.h"
#include "host/study/member_result.h"

namespace vkdose::report {

namespace {

struct KindName {
    const char* name;
    Kind kind;
};
constexpr KindName kKinds[] = {{"value", Kind::Value},         {"at most", Kind::AtMost},
                               {"falls", Kind::Falls},         {"rises", Kind::Rises},
                               {"linear", Kind::Linear},       {"independent", Kind::Independent},
                               {"not judged", Kind::NotJudged}};

class ExpectedReader {
  public:
    explicit ExpectedReader(std::string file) : file_(std::move(file)) {}

    std::vector<Expected> read(const Node& root) {
        const Node* list = root.child("expected");
        if (list == nullptr || list->kind != Node::Kind::Array || root.children.size() != 1) {
            fault(root, "expected", "", "give tables [[expected]] and nothing else");
        } else {
            for (const Node& row : list->children) {
                if (row.kind == Node::Kind::Table)
                    rows_.push_back(readRow(row));
                else
                    fault(row, "expected", "is no table", "write [[expected]]");
            }
        }
        if (!faults_.empty()) throw CaseError(faults_);
        return std::move(rows_);
    }

  private:
    void fault(const Node& at, const std::string& key, const std::string& problem, const std::string& remedy) {
        faults_.push_back({file_, at.line, key, at.kind == Node::Kind::Table ? "" : valueText(at),
                           problem.empty() ? "is not what a table of results holds" : problem, remedy});
    }

    Expected readRow(const Node& row) {
        static const std::vector<std::string> known{"id",   "what",  "section", "source",  "kind", "quantity",
                                                    "dose", "value", "along",   "matches", "near", "where"};
        for (const Node& value : row.children)
            if (std::find(known.begin(), known.end(), value.key) == known.end())
                fault(value, value.key, "is not known", "known: " + fmt::format("{}", fmt::join(known, ", ")));
        Expected e;
        e.id = text(row, "id", true);
        e.what = text(row, "what", true);
        e.section = text(row, "section", true);
        e.source = text(row, "source", false);
        e.quantity = text(row, "quantity", false);
        e.along = text(row, "along", false);
        e.dose = static_cast<int>(number(row, "dose", 0));
        e.value = number(row, "value", 0);
        e.matches = number(row, "matches", e.matches);
        e.near = number(row, "near", e.near);
        e.kind = kind(row);
        if (const Node* where = row.child("where")) readWhere(*where, e);
        requireWhole(row, e);
        return e;
    }

    void readWhere(const Node& where, Expected& e) {
        if (where.kind != Node::Kind::Table)
            return fault(where, "where", "is no table", "write where = { KEY = VALUE }");
        refuseLists(where, "where.");
        e.where = settingsOf(where);
    }

    void refuseLists(const Node& conditions, const std::string& path) {
        for (const Node& condition : conditions.children) {
            if (condition.kind == Node::Kind::Table) refuseLists(condition, path + condition.key + ".");
            if (condition.kind == Node::Kind::Array)
                fault(condition, path + condition.key, "is a list, which is compared with nothing",
                      "give keys of one value");
        }
    }

    Kind kind(const Node& row) {
        const std::string name = text(row, "kind", true);
        for (const KindName& k : kKinds)
            if (name == k.name) return k.kind;
        if (!name.empty()) {
            std::string all;
            for (const KindName& k : kKinds) all += (all.empty() ? "" : ", ") + std::string(k.name);
            fault(*row.child("kind"), "kind", "is not known", "known: " + all);
        }
        return Kind::NotJudged;
    }

    void requireWhole(const Node& row, const Expected& e) {
        if (e.kind == Kind::NotJudged) return;
        const auto& columns = kOutputColumns;
        if (e.quantity.empty())
            fault(row, "quantity", "is missing", "name a column of members.csv");
        else if (e.quantity != "cumulative_mass_kg" &&
                 std::find(columns.begin(), columns.end(), e.quantity) == columns.end())
            fault(*row.child("quantity"), "quantity", "is no column of members.csv that a run fills",
                  fmt::format("known: {}, cumulative_mass_kg", fmt::join(columns, ", ")));
        const bool figure = e.kind == Kind::Value || e.kind == Kind::AtMost;
        if (figure && row.child("value") == nullptr) fault(row, "value", "is missing", "give the published figure");
        if (const Node* value = row.child("value"); figure && value != nullptr && e.value == 0)
            fault(*value, "value", "is zero", "differences are relative to it");
        if (!figure && e.along.empty()) fault(row, "along", "is missing", "name the key that varies");
        if (e.quantity == "cumulative_mass_kg" && e.dose < 1) fault(row, "dose", "is missing", "say after which dose");
    }

    std::string text(const Node& row, const char* key, bool required) {
        const Node* value = row.child(key);
        if (value != nullptr && value->kind == Node::Kind::String) return value->string;
        if (required || value != nullptr) fault(value ? *value : row, key, "is missing or no text", "give a text");
        return "";
    }

    double number(const Node& row, const char* key, double otherwise) {
        const Node* value = row.child(key);
        if (value == nullptr) return otherwise;
        if (!value->isNumber() || !std::isfinite(value->number)) fault(*value, key, "is not a number", "give a number");
        return value->isNumber() ? value->number : otherwise;
    }

    std::string file_;
    std::vector<Diagnostic> faults_;
    std::vector<Expected> rows_;
};

bool same(const Setting& a, const Setting& b) {
    if (std::isnan(a.number) || std::isnan(b.number)) return a.text == b.text;
    return std::abs(a.number - b.number) <= 0.01 * std::abs(b.number);
}

bool carries(const Point& point, const Expected& e) {
    return std::all_of(e.where.begin(), e.where.end(), [&](const auto& condition) {
        const auto found = point.keys.find(condition.first);
        return found != point.keys.end() && same(found->second, condition.second);
    });
}

std::optional<Point::Output> outputOf(const Point& point, const Expected& e) {
    if (e.quantity == "cumulative_mass_kg") {
        if (static_cast<std::size_t>(e.dose) > point.cumulative.size()) return std::nullopt;
        return Point::Output{point.cumulative[e.dose - 1], std::nan("")};
    }
    const auto found = point.outputs.find(e.quantity);
    if (found == point.outputs.end() || !std::isfinite(found->second.mean)) return std::nullopt;
    return found->second;
}

/// A figure in the unit people use: grams for masses.
std::string shown(const Expected& e, double x, double error) {
    const bool mass = e.quantity.find("_kg") != std::string::npos;
    const double scale = mass ? 1e3 : 1;
    std::string text = fmt::format("{:.3g}", x * scale);
    if (std::isfinite(error)) text += fmt::format(" ± {:.2g}", error * scale);
    return text + (mass ? " g" : "");
}

Verdict judgeValue(const Expected& e, const std::vector<Point::Output>& outputs) {
    double mean = 0, variance = 0;
    for (const Point::Output& o : outputs) {
        mean += o.mean / static_cast<double>(outputs.size());
        variance += o.standardError * o.standardError / static_cast<double>(outputs.size() * outputs.size());
    }
    const double error = std::sqrt(variance), off = std::abs(mean - e.value) / std::abs(e.value);
    const std::string found = shown(e, mean, error);
    if (e.kind == Kind::AtMost && mean <= e.value) return {Verdict::Kind::Matches, "matches", found};
    // An error of unknown size forgives nothing.
    const bool forgiven = std::abs(mean - e.value) <= 2 * error;
    if (forgiven && 2 * error > e.near * std::abs(e.value))
        return {Verdict::Kind::NotJudged,
                fmt::format("known to {:.0f} % only", std::ceil(200 * error / std::abs(e.value))), found};
    if (off <= e.matches || forgiven) return {Verdict::Kind::Matches, "matches", found};
    if (off <= e.near) return {Verdict::Kind::Within, fmt::format("within {:.0f} %", std::ceil(off * 100)), found};
    return {Verdict::Kind::Contradicts, fmt::format("contradicts ({:+.0f} %)", 100 * (mean - e.value) / e.value),
            found};
}

struct Step {
    double x;
    Point::Output y;
};
using Curve = std::vector<Step>;

/// Where a point lies on the axes that `key` does not belong to.
std::string besides(const Point& point, const std::string& key) {
    std::string rest;
    for (const Point::Place& place : point.places)
        if (std::find(place.keys.begin(), place.keys.end(), key) == place.keys.end()) rest += place.label + "\n";
    return rest;
}

/// The curves along a key, and from how many of the points that the result is about.
struct Curves {
    std::vector<Curve> list;
    int points = 0, known = 0;  ///< of these the ones that have the quantity
};

/// One curve along the key for every place on the other axes, sorted along it. What has too few points to tell is no
/// curve.
Curves curvesOf(const Expected& e, const std::vector<Point>& points) {
    Curves all;
    std::map<std::string, Curve> curves;
    for (const Point& p : points) {
        const auto x = p.keys.find(e.along);
        if (!carries(p, e) || x == p.keys.end() || std::isnan(x->second.number)) continue;
        ++all.points;
        const auto y = outputOf(p, e);
        if (!y) continue;
        ++all.known;
        curves[besides(p, e.along)].push_back({x->second.number, *y});
    }
    const std::size_t least = e.kind == Kind::Linear ? 3 : 2;
    for (auto& [rest, curve] : curves) {
        std::sort(curve.begin(), curve.end(), [](const Step& a, const Step& b) { return a.x < b.x; });
        if (curve.size() >= least && curve.front().x < curve.back().x) all.list.push_back(curve);
    }
    return all;
}

/// `sense` +1 for a rise, -1 for a fall.
bool goes(const Curve& curve, double sense) {
    for (std::size_t i = 1; i < curve.size(); ++i) {
        const double error = std::hypot(curve[i].y.standardError, curve[i - 1].y.standardError);
        const double against = sense * (curve[i - 1].y.mean - curve[i].y.mean);
        if (against > (std::isfinite(error) ? 2 * error : 0)) return false;
    }
    return sense * (curve.back().y.mean - curve.front().y.mean) > 0;
}

/// Range of the values over their mean.
double variation(const Curve& curve) {
    double low = curve.front().y.mean, high = low, sum = 0;
    for (const Step& s : curve) {
        low = std::min(low, s.y.mean);
        high = std::max(high, s.y.mean);
        sum += s.y.mean;
    }
    return (high - low) / std::abs(sum / static_cast<double>(curve.size()));
}

/// Largest distance from the least-squares line, over the range of the line.
double crookedness(const Curve& curve) {
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (const Step& s : curve) n += 1, sx += s.x, sy += s.y.mean, sxx += s.x * s.x, sxy += s.x * s.y.mean;
    const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx), start = (sy - slope * sx) / n;
    double worst = 0;
    for (const Step& s : curve) worst = std::max(worst, std::abs(s.y.mean - start - slope * s.x));
    return worst / std::abs(slope * (curve.back().x - curve.front().x));
}

bool holds(const Expected& e, const Curve& curve) {
    switch (e.kind) {
        case Kind::Falls:
            return goes(curve, -1);
        case Kind::Rises:
            return goes(curve, 1);
        case Kind::Independent:
            return variation(curve) <= e.matches;
        case Kind::Linear:
            return crookedness(curve) <= e.matches;
        default:
            return false;
    }
}

Verdict judgeTrend(const Expected& e, const Curves& known) {
    const std::vector<Curve>& curves = known.list;
    constexpr std::size_t kShown = 2;
    int good = 0;
    std::string found;
    for (std::size_t i = 0; i < curves.size(); ++i) {
        const Curve& curve = curves[i];
        good += holds(e, curve) ? 1 : 0;
        if (i >= kShown) continue;
        found += (found.empty() ? "" : "; ") + shown(e, curve.front().y.mean, curve.front().y.standardError) + " to " +
                 shown(e, curve.back().y.mean, curve.back().y.standardError);
    }
    const int all = static_cast<int>(curves.size());
    if (curves.size() > kShown) found += fmt::format("; and {} more", curves.size() - kShown);
    if (known.known < known.points) found += fmt::format(" ({} of {} points have it)", known.known, known.points);
    if (good == all) return {Verdict::Kind::TrendHolds, "trend holds", found};
    return {Verdict::Kind::Contradicts,
            all == 1 ? "contradicts" : fmt::format("contradicts in {} of {}", all - good, all), found};
}

}  // namespace

std::vector<Expected> readExpected(const std::filesystem::path& file) {
    return ExpectedReader(file.string()).read(readTreeAlone(file));
}

Verdict judge(const Expected& e, const std::vector<Point>& points) {
    if (e.kind == Kind::NotJudged) return {Verdict::Kind::NotJudged, "not judged here", ""};
    if (e.kind == Kind::Value || e.kind == Kind::AtMost) {
        std::vector<Point::Output> outputs;
        for (const Point& p : points) {
            const auto output = carries(p, e) ? outputOf(p, e) : std::nullopt;
            if (output) outputs.push_back(*output);
        }
        return outputs.empty() ? Verdict{Verdict::Kind::NotRun, "not run", ""} : judgeValue(e, outputs);
    }
    const Curves curves = curvesOf(e, points);
    return curves.list.empty() ? Verdict{Verdict::Kind::NotRun, "not run", ""} : judgeTrend(e, curves);
}

}  // namespace vkdose::report
