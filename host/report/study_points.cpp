#include "host/report/study_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/core/csv_lines.h"
#include "host/report/toml_values.h"
#include "host/study/member_result.h"

namespace vkdose::report {

namespace fs = std::filesystem;

namespace {

std::vector<std::string> axisColumns(const Table& members) {
    std::vector<std::string> names;
    bool within = false;
    for (const std::string& name : members.names()) {
        if (name == "status") break;
        if (within) names.push_back(name);
        within = within || name == "seed";
    }
    return names;
}

/// Members that belong together, and what is gathered of them.
struct Gathering {
    StudyPoint result;
    double firstMember = std::numeric_limits<double>::infinity();  ///< its number
    std::map<std::string, std::vector<double>> outputs;
    std::vector<double> betaErrors;
    std::vector<std::vector<double>> doses, cumulative;  ///< [dose][member]
};

struct MemberDoses {
    std::vector<double> mass, cumulative;
};

std::map<int, MemberDoses> readDoses(const fs::path& file) {
    std::map<int, MemberDoses> members;
    if (!fs::exists(file)) return members;
    const Table table = Table::read(file);
    for (std::size_t i = 0; i < table.rows(); ++i) {
        if (table.number(i, "complete") == 0) continue;
        MemberDoses& m = members[static_cast<int>(table.number(i, "member"))];
        m.mass.push_back(table.number(i, "mass_kg"));
        m.cumulative.push_back(table.number(i, "cumulative_mass_kg"));
    }
    return members;
}

void addDoses(const std::vector<double>& values, std::vector<std::vector<double>>& lists) {
    if (lists.size() < values.size()) lists.resize(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) lists[i].push_back(values[i]);
}

class PointReader {
  public:
    PointReader(const fs::path& folder, const StudyHead& head, const Table& members)
        : folder_(folder), head_(head), members_(members), doses_(readDoses(folder / "doses.csv")) {
        for (const char* name : {"base.toml", "study.toml"}) {
            if (!fs::exists(folder / name)) continue;
            const Node root = readTreeAlone(folder / name);
            const Node* set = std::string(name) == "study.toml" ? root.child("set") : &root;
            if (set != nullptr) merge(settingsOf(*set));
        }
    }

    std::vector<StudyPoint> read() {
        for (std::size_t row = 0; row < members_.rows(); ++row) take(row, gatheringOf(row));
        putInOrder();
        std::vector<StudyPoint> points;
        for (Gathering& g : gatherings_) points.push_back(finish(g));
        return points;
    }

  private:
    /// Along each axis by the numbers of its first key. Words stand in the order of the study, behind numbers.
    void putInOrder() {
        std::vector<std::map<std::string, double>> firstWith(head_.axes.size());
        for (const Gathering& g : gatherings_)
            for (std::size_t axis = 0; axis < firstWith.size(); ++axis) {
                double& first = firstWith[axis].emplace(g.result.point.places[axis].label, g.firstMember).first->second;
                first = std::min(first, g.firstMember);
            }
        const auto placeOf = [&](const Gathering& g) {
            std::vector<std::pair<double, double>> at;
            for (std::size_t axis = 0; axis < firstWith.size(); ++axis) {
                const Point::Place& place = g.result.point.places[axis];
                const double number = g.result.point.keys.at(place.keys.front()).number;
                at.emplace_back(std::isnan(number) ? std::numeric_limits<double>::infinity() : number,
                                firstWith[axis].at(place.label));
            }
            return at;
        };
        std::sort(gatherings_.begin(), gatherings_.end(),
                  [&](const Gathering& a, const Gathering& b) { return placeOf(a) < placeOf(b); });
    }

    void merge(const std::map<std::string, Setting>& settings) {
        for (const auto& [key, value] : settings) common_[key] = value;
    }

    Gathering& gatheringOf(std::size_t row) {
        std::string label;
        std::vector<Point::Place> places;
        for (const std::vector<std::string>& keys : head_.axes) {
            Point::Place place{keys, ""};
            for (const std::string& key : keys)
                place.label += (place.label.empty() ? "" : ", ") + members_.text(row, key);
            label += place.label + "\n";
            places.push_back(place);
        }
        const auto found = byLabel_.find(label);
        if (found != byLabel_.end()) return gatherings_[found->second];
        byLabel_[label] = gatherings_.size();
        Gathering& fresh = gatherings_.emplace_back();
        fresh.result.point.places = places;
        fresh.result.point.keys = keysOf(row);
        return fresh;
    }

    std::map<std::string, Setting> keysOf(std::size_t row) const {
        const fs::path resolved =
            folder_ / "members" / fmt::format("{:04}", static_cast<int>(members_.number(row, "member"))) / "case.toml";
        // The member's case has every key that counts. One of the base that another has replaced is not among them.
        std::map<std::string, Setting> keys = fs::exists(resolved) ? settingsOf(readTreeAlone(resolved)) : common_;
        for (const std::vector<std::string>& axis : head_.axes)
            for (const std::string& key : axis) keys[key] = settingOf(members_.text(row, key));
        return keys;
    }

    void take(std::size_t row, Gathering& g) {
        const int member = static_cast<int>(members_.number(row, "member"));
        g.firstMember = std::min(g.firstMember, double(member));
        const std::string status = members_.text(row, "status");
        if (status == "failed") {
            ++g.result.failed;
            const std::string error = members_.text(row, "error");
            std::vector<std::string>& errors = g.result.errors;
            if (!error.empty() && std::find(errors.begin(), errors.end(), error) == errors.end())
                errors.push_back(error);
        }
        if (status != "ok") return;
        ++g.result.finished;
        const auto doses = doses_.find(member);
        const MemberDoses none, &own = doses == doses_.end() ? none : doses->second;
        addDoses(own.mass, g.doses);
        addDoses(own.cumulative, g.cumulative);
        for (const std::string& name : kOutputColumns)
            if (members_.has(name)) g.outputs[name].push_back(numberIn(members_.text(row, name)));
        Window window;
        if (members_.has("filled_mass_kg")) window = windowOf(members_.number(row, "filled_mass_kg"));
        const Slope slope = betaOf(own.cumulative, window);
        std::vector<double>& betas = g.outputs["beta_kg_per_dose"];
        if (!members_.has("beta_kg_per_dose")) betas.push_back(slope.beta);
        if (std::isnan(betas.back())) betas.back() = slope.beta;
        const bool known = members_.has("beta_standard_error_kg_per_dose");
        const double error = known ? members_.number(row, "beta_standard_error_kg_per_dose") : std::nan("");
        g.betaErrors.push_back(std::isnan(error) ? slope.standardError : error);
    }

    static StudyPoint finish(Gathering& g) {
        StudyPoint p = std::move(g.result);
        for (const auto& [name, values] : g.outputs) {
            const Estimate e = estimateOf(values);
            p.point.outputs[name] = {e.mean, e.standardError};
        }
        // Were the seeds that never got there left out, a blocked one would make the figure better.
        if (auto emptied = g.outputs.find("doses_to_99_percent"); emptied != g.outputs.end())
            if (estimateOf(emptied->second).count < p.finished) p.point.outputs.erase(emptied->first);
        const Estimate beta = estimateOf(g.outputs["beta_kg_per_dose"]);
        p.beta = beta.mean;
        p.errorOverSeeds = beta.count > 1;
        p.betaError = beta.count == 1 ? estimateOf(g.betaErrors).mean : beta.standardError;
        p.point.outputs["beta_kg_per_dose"] = {p.beta, p.betaError};
        // Nor has a seed that dosed nothing an RSD. Left out, it would make the point pass for a steady one.
        if (auto rsd = g.outputs.find("rsd"); rsd != g.outputs.end())
            if (estimateOf(rsd->second).count < beta.count) p.point.outputs.erase(rsd->first);
        p.closedForm = estimateOf(g.outputs["closed_form_kg_per_dose"]).mean;
        // A mean over fewer members than began would be another curve: that of the seeds that still had powder.
        for (const auto& masses : g.doses)
            if (masses.size() == g.doses.front().size()) p.doses.push_back(estimateOf(masses));
        for (const auto& masses : g.cumulative)
            if (masses.size() == g.cumulative.front().size()) p.point.cumulative.push_back(estimateOf(masses).mean);
        return p;
    }

    const fs::path folder_;
    const StudyHead& head_;
    const Table& members_;
    std::map<int, MemberDoses> doses_;
    std::map<std::string, Setting> common_;
    std::vector<Gathering> gatherings_;
    std::map<std::string, std::size_t> byLabel_;
};

}  // namespace

StudyHead readHead(const fs::path& folder, const Table& members) {
    StudyHead head{folder.filename().string(), "", {}, std::nan(""), false};
    const std::vector<std::string> columns = axisColumns(members);
    std::vector<std::string> left = columns;
    if (fs::exists(folder / "study.toml")) {
        const Node root = readTreeAlone(folder / "study.toml");
        head.name = textIn(root, "name", head.name);
        head.reason = textIn(root, "reason", "");
        const Node* aim = root.child("calibrate");
        const Node* target = aim != nullptr ? aim->child("target_g_per_dose") : nullptr;
        if (target != nullptr && target->isNumber()) head.target = target->number * 1e-3;
        head.searches =
            root.child("design") != nullptr || (aim != nullptr && textIn(*aim, "method", "") == "surrogate");
        head.designs = root.child("design") != nullptr;
        const Node none, *axes = root.child("axis");
        for (const Node& axis : axes != nullptr ? axes->children : none.children) {
            std::vector<std::string> keys;
            if (const std::string key = textIn(axis, "key", ""); !key.empty()) keys.push_back(key);
            if (const Node* several = axis.child("keys"))
                for (const Node& key : several->children) keys.push_back(key.string);
            const auto isColumn = [&](const std::string& key) {
                return std::find(columns.begin(), columns.end(), key) != columns.end();
            };
            if (keys.empty() || !std::all_of(keys.begin(), keys.end(), isColumn)) continue;
            for (const std::string& key : keys) left.erase(std::remove(left.begin(), left.end(), key), left.end());
            head.axes.push_back(keys);
        }
    }
    for (const std::string& key : left) head.axes.push_back({key});
    return head;
}

std::vector<StudyPoint> readPoints(const fs::path& folder, const StudyHead& head, const Table& members) {
    return PointReader(folder, head, members).read();
}

}  // namespace vkdose::report
