#include "host/model/particle_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <string>

#include "host/core/csv_lines.h"
#include "host/core/file.h"
#include "host/model/case_reader.h"

namespace vkdose {
namespace {

constexpr std::size_t kMaxFaults = 20;
const std::vector<std::string> kColumns{"x", "y", "z", "r", "vx", "vy", "vz", "wx", "wy", "wz"};
/// The names of the columns in the particles.csv of a run. They are read too, so that the end state of a run can be the
/// start of another case.
const std::vector<std::string> kRunColumns{"x_m",    "y_m",    "z_m",      "radius_m", "vx_m_s",
                                           "vy_m_s", "vz_m_s", "wx_rad_s", "wy_rad_s", "wz_rad_s"};
constexpr std::size_t kAbsent = std::numeric_limits<std::size_t>::max();

class ListReader {
  public:
    ListReader(std::string file, std::vector<Diagnostic>& faults, const std::vector<ListedPowder>& powders,
               const std::vector<std::string>& properties)
        : file_(std::move(file)), faults_(faults), powders_(powders), properties_(properties) {
        place_.fill(kAbsent);
        property_.fill(kAbsent);
    }

    Particles read(std::istream& stream) {
        for (CsvLines lines(stream); lines.next();) {
            line_ = lines.number();
            if (lines.text().starts_with('#')) continue;  // a comment
            const std::optional<Row> fields = lines.fields();
            if (!fields) {
                fault("", lines.text(), "is not CSV", "separate plain numbers by commas");
                if (columns_ == 0) return {};
            } else if (columns_ == 0) {
                if (!readHeader(*fields)) return {};
            } else {
                readRow(*fields);
            }
        }
        line_ = 0;
        if (columns_ == 0) fault("", "", "is empty", "begin with the header x,y,z,r");
        if (columns_ != 0 && rows_ == 0 && count_ == 0)
            fault("", "", "lists no particles", "add a line for each particle");
        if (count_ > kMaxFaults)
            faults_.push_back({file_, 0, "", "", fmt::format("{} more faults", count_ - kMaxFaults), ""});
        return std::move(particles_);
    }

  private:
    void fault(const std::string& key, const std::string& value, std::string problem, std::string remedy) {
        if (++count_ <= kMaxFaults)
            faults_.push_back({file_, line_, key, value, std::move(problem), std::move(remedy)});
    }

    bool readHeader(const std::vector<std::string>& names) {
        const std::size_t before = count_;
        if (names.size() == 1 && names[0].find(';') != std::string::npos) {
            fault("", "", fmt::format("has semicolons between its columns: {}", names[0]),
                  "separate columns by commas, and write decimals with a point");
            return false;
        }
        columns_ = names.size();
        for (std::size_t i = 0; i < names.size(); ++i) {
            if (names[i] == "id") continue;  // the place in the list is the identity
            if (names[i] == "status") {
                status_ = i;
                continue;
            }
            if (names[i] == "powder") {
                powder_ = i;
                continue;
            }
            const auto property = std::find(properties_.begin(), properties_.end(), names[i]);
            if (property != properties_.end()) {
                std::size_t& place = property_.at(std::size_t(property - properties_.begin()));
                if (place != kAbsent) fault(names[i], "", "stands twice in the header", "name each column once");
                place = i;
                continue;
            }
            const std::size_t column = columnOf(names[i]);
            if (column == kAbsent) {
                const std::string meant = closestColumn(names[i]);
                fault(
                    names[i], "", "unknown column",
                    meant.empty() ? "known: x,y,z,r,vx,vy,vz,wx,wy,wz,powder" : fmt::format("did you mean {}?", meant));
                continue;
            }
            std::size_t& place = place_[column];
            if (place != kAbsent) fault(names[i], "", "stands twice in the header", "name each column once");
            place = i;
        }
        for (std::size_t i = 0; i < 4; ++i)
            if (place_[i] == kAbsent) fault(kColumns[i], "", "is missing in the header", "begin with x,y,z,r");
        if (powders_.size() > 1 && powder_ == kAbsent)
            fault("powder", "", "is missing in the header", "name the powder of each particle: the case has several");
        for (const std::size_t first : {std::size_t{4}, std::size_t{7}}) {
            const auto missing = std::count(place_.begin() + first, place_.begin() + first + 3, kAbsent);
            if (missing == 1 || missing == 2)
                fault(kColumns[first].substr(0, 1), "", "has only some of its components in the header",
                      fmt::format("give {},{},{} or none", kColumns[first], kColumns[first + 1], kColumns[first + 2]));
        }
        return count_ == before;
    }

    static std::size_t columnOf(const std::string& name) {
        for (std::size_t i = 0; i < kColumns.size(); ++i)
            if (name == kColumns[i] || name == kRunColumns[i]) return i;
        return kAbsent;
    }

    static std::string closestColumn(const std::string& name) {
        std::string lower = name;
        std::transform(lower.begin(), lower.end(), lower.begin(),
                       [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
        if (std::find(kColumns.begin(), kColumns.end(), lower) != kColumns.end()) return lower;
        if (lower == "radius" || lower == "radius_m") return "r";
        const std::string head = lower.substr(0, lower.find('_'));
        return std::find(kColumns.begin(), kColumns.end(), head) != kColumns.end() ? head : "";
    }

    void readRow(const std::vector<std::string>& fields) {
        if (fields.size() != columns_) {
            fault("", "", fmt::format("has {} fields, the header {}", fields.size(), columns_),
                  "give one number for each column");
            return;
        }
        if (status_ != kAbsent && fields[status_] != "active") {  // the others do not go on
            if (fields[status_] != "dosed" && fields[status_] != "lost" && fields[status_] != "waiting")
                fault("status", fields[status_], "is not known", "give active, dosed, lost or waiting");
            return;
        }
        std::array<double, 10> value{};
        const std::size_t before = count_;
        for (std::size_t i = 0; i < value.size(); ++i)
            if (place_[i] != kAbsent) value[i] = number(fields[place_[i]], kColumns[i]);
        if (count_ == before && value[3] <= 0)
            fault("r", fields[place_[3]], "is not positive", "give a radius > 0 [m]");
        else if (count_ == before && value[3] < kSmallestNumber)
            fault("r", fields[place_[3]], "is smaller than anything in a canister", "give a radius in m");
        const int material = powder_ == kAbsent ? kFirstPowder : powderOf(fields[powder_]);
        LawProperties own;
        own.fill(kNaN);
        for (std::size_t k = 0; k < properties_.size(); ++k)
            if (property_[k] != kAbsent) own[k] = number(fields[property_[k]], properties_[k]);
        if (count_ == before && !properties_.empty()) particles_.properties.push_back(own);
        if (count_ == before)
            particles_.add({value[0], value[1], value[2]}, value[3], {value[4], value[5], value[6]},
                           {value[7], value[8], value[9]}, material);
        ++rows_;
    }

    /// The material of a powder by its name. A list that is read without a case may hold any name.
    int powderOf(const std::string& name) {
        std::string known;
        for (const ListedPowder& p : powders_) {
            if (p.name == name) return p.material;
            known += (known.empty() ? "" : ", ") + p.name;
        }
        if (!powders_.empty()) fault("powder", name, "is no powder of the case", "known: " + known);
        return kFirstPowder;
    }

    double number(const std::string& text, const std::string& column) {
        std::size_t start = text.find_first_not_of(" \t");
        const std::size_t end = text.find_last_not_of(" \t") + 1;
        double value = 0;
        if (start == std::string::npos) {
            fault(column, "", "is empty", "give a number");
            return 0;
        }
        // from_chars accepts no plus sign, so it is skipped. A minus must not follow it.
        if (text[start] == '+' && text.find('-', start) != start + 1) ++start;
        const auto [stop, code] = std::from_chars(text.data() + start, text.data() + end, value);
        if (code == std::errc::result_out_of_range)
            fault(column, text, "is beyond what a number can be", "give a plain decimal number in SI units");
        else if (code != std::errc() || stop != text.data() + end)
            fault(column, text, "is not a number", "give a plain decimal number in SI units");
        else if (!std::isfinite(value))
            fault(column, text, "is not a finite number", "give a finite number");
        else if (std::abs(value) > kLargestNumber)
            fault(column, text, "is larger than anything in a canister", "give it in SI units");
        return value;
    }

    std::string file_;
    std::vector<Diagnostic>& faults_;
    const std::vector<ListedPowder>& powders_;
    const std::vector<std::string>& properties_;
    std::array<std::size_t, 10> place_{};
    std::array<std::size_t, kMostLawProperties> property_{};
    std::size_t status_ = kAbsent;
    std::size_t powder_ = kAbsent;
    std::size_t columns_ = 0;
    std::size_t rows_ = 0;
    std::size_t count_ = 0;
    int line_ = 0;
    Particles particles_;
};

}  // namespace

Particles readParticleList(const std::filesystem::path& file, std::vector<Diagnostic>& faults,
                           const std::vector<ListedPowder>& powders, const std::vector<std::string>& properties) {
    std::optional<std::string> content = fileContent(file);
    if (!content) {
        faults.push_back(
            {file.string(), 0, "", "", readFault(file), "give the path of a CSV, relative to the case file"});
        return {};
    }
    std::istringstream stream(*std::move(content));
    return ListReader(file.string(), faults, powders, properties).read(stream);
}

}  // namespace vkdose
