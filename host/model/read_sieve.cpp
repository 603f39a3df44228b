// The table of a sieve analysis in [particles.size], and the number distribution that it makes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/core/csv_table.h"
#include "host/model/case_sections.h"
#include "host/model/named_file.h"
#include "host/model/size_distribution.h"

namespace vkdose {
namespace {

constexpr std::size_t kMostSieves = 100;

/// A sieve analysis as it was written: what passed, or what lay on each sieve, from fine to coarse or the other way.
struct SieveTable {
    std::vector<double> openings;  ///< [um]
    std::vector<double> amounts;   ///< passing: percent; retained: masses in any unit
    bool passing = true;
    std::string openingsPath, amountsPath;  ///< the keys to blame
};

/// The numbers of an array; nothing after a fault, which is told.
std::optional<std::vector<double>> numbersOf(CaseReader& reader, Section& section, const char* key) {
    const Node* node = section.node(key);
    const auto refuse = [&](const std::string& problem) {
        reader.fault(section.path(key), problem, "give a list of numbers: [45, 63, 90]");
        return std::nullopt;
    };
    if (node == nullptr) return refuse("is missing");
    if (node->kind != Node::Kind::Array) return refuse("is not a list of numbers");
    if (node->children.size() > kMostSieves) return refuse(fmt::format("has more than {} entries", kMostSieves));
    std::vector<double> numbers;
    for (const Node& item : node->children) {
        const std::string text = item.text.empty() ? "an entry" : item.text;
        if (!item.isNumber()) return refuse(fmt::format("{} is not a number", text));
        if (!std::isfinite(item.number) || std::abs(item.number) > kLargestNumber)
            return refuse(fmt::format("{} is larger than anything in a sieve, or no number", text));
        if (item.number < 0) return refuse(fmt::format("{} is negative", text));
        numbers.push_back(item.number);
    }
    return numbers;
}

std::optional<SieveTable> inlineTable(CaseReader& reader, Section& section) {
    SieveTable table;
    table.passing = !section.has("retained");
    if (section.has("retained") && section.has("passing_percent"))
        reader.fault(section.path("retained"), "stands beside passing_percent, which says the same otherwise",
                     "give passing_percent or retained, not both");
    const auto openings = numbersOf(reader, section, "openings_um");
    const char* key = table.passing ? "passing_percent" : "retained";
    section.know(table.passing ? "retained" : "passing_percent");
    const auto amounts = numbersOf(reader, section, key);
    table.openingsPath = section.path("openings_um");
    table.amountsPath = section.path(key);
    if (!openings || !amounts) return {};
    table.openings = *openings;
    table.amounts = *amounts;
    return table;
}

std::optional<SieveTable> tableOfFile(CaseReader& reader, Section& section, std::vector<std::filesystem::path>& files) {
    const std::string path = section.string("sieves");
    section.forget("sieves");  // the resolved case has the table itself
    for (const char* key : {"openings_um", "passing_percent", "retained"}) {
        section.know(key);
        if (section.has(key))
            reader.fault(section.path(key), "stands beside sieves, whose file has it",
                         fmt::format("give sieves or {}, not both", key));
    }
    if (!section.isString("sieves")) return {};  // already told
    const std::filesystem::path file = reader.folderOf(section.path("sieves")) / path;
    if (!requireFile(reader, section.path("sieves"), file, "give the path of a CSV, relative to the case file"))
        return {};
    files.push_back(file);
    SieveTable table;
    table.openingsPath = table.amountsPath = section.path("sieves");
    try {
        const Table csv = Table::read(file, LastLine::Whole);
        table.passing = !csv.has("retained");
        if (!table.passing && csv.has("passing_percent")) {
            reader.fault(section.path("sieves"), "has both columns, passing_percent and retained", "leave out one");
            return {};
        }
        if (csv.rows() > kMostSieves) {
            reader.fault(section.path("sieves"), fmt::format("has more than {} lines", kMostSieves), "give the sieves");
            return {};
        }
        const char* amount = table.passing ? "passing_percent" : "retained";
        for (std::size_t row = 0; row < csv.rows(); ++row) {
            for (const char* name : {"opening_um", amount}) {
                const double value = csv.number(row, name);
                if (!std::isfinite(value) || value < 0 || value > kLargestNumber)
                    csv.refuse(row, name, "is no size and no amount", "give a number >= 0");
                (name == amount ? table.amounts : table.openings).push_back(value);
            }
        }
    } catch (const CaseError& error) {
        for (const Diagnostic& fault : error.faults()) reader.add(fault);
        return {};
    }
    return table;
}

/// Puts the finest sieve first. Returns false after a fault of the openings.
bool orderOpenings(CaseReader& reader, SieveTable& table) {
    const auto refuse = [&](const std::string& path, const std::string& problem, const std::string& remedy) {
        reader.fault(path, problem, remedy);
        return false;
    };
    std::vector<double>& d = table.openings;
    if (d.size() != table.amounts.size())
        return refuse(table.amountsPath, fmt::format("has {} entries for {} openings", table.amounts.size(), d.size()),
                      "give one for each sieve");
    if (d.size() < 2) return refuse(table.openingsPath, "is no table", "give two openings at least");
    if (d.front() > d.back()) {
        std::reverse(d.begin(), d.end());
        std::reverse(table.amounts.begin(), table.amounts.end());
    }
    if (std::adjacent_find(d.begin(), d.end(), std::greater_equal<>()) != d.end())
        return refuse(table.openingsPath, "does not go from fine to coarse", "give each opening once, in their order");
    if (!(d.front() * 1e-6 >= kSmallestNumber))
        return refuse(table.openingsPath, "begins at zero: how fine the grains in the pan are is not known",
                      fmt::format("give the diameter of the finest grains there, such as {:.4g}", 0.5 * d[1]));
    return true;
}

/// The fraction of the volume that is finer than each opening, from 0 to 1. Empty after a fault.
std::vector<double> fractionsOf(CaseReader& reader, const SieveTable& table) {
    const std::vector<double>&d = table.openings, &a = table.amounts;
    const auto refuse = [&](const std::string& problem, const std::string& remedy) {
        reader.fault(table.amountsPath, problem, remedy);
        return std::vector<double>();
    };
    const std::string coarser =
        fmt::format("end the table with an opening that all of it passes, such as {:.4g}", 2 * d.back());
    std::vector<double> finer;
    if (table.passing) {
        if (!std::is_sorted(a.begin(), a.end()))
            return refuse("a coarser sieve lets less pass than a finer one", "give what passes, or name it retained");
        if (a.back() > 100.0001) return refuse("more than 100 % passes", "give percent");
        if (a.front() > 0)
            return refuse(fmt::format("{:.4g} % passes the finest sieve, {:.4g} um: how fine it is is not known",
                                      a.front(), d.front()),
                          fmt::format("begin the table with the diameter of the finest grains and 0 %, such as {:.4g}",
                                      0.5 * d.front()));
        if (a.back() < 99.9999)
            return refuse(a.back() <= 1
                              ? "is a fraction, not percent"
                              : fmt::format("{:.4g} % does not pass the coarsest sieve, {:.4g} um: how coarse it "
                                            "is is not known",
                                            100 - a.back(), d.back()),
                          a.back() <= 1 ? "give percent, up to 100" : coarser);
        for (const double percent : a) finer.push_back(std::min(percent / a.back(), 1.0));
        return finer;
    }
    double all = 0, below = 0;
    for (const double mass : a) all += mass;
    if (!(all > 0)) return refuse("nothing lies on the sieves", "give the mass that lies on each");
    if (a.back() > 0)
        return refuse(fmt::format("{:.4g} % lies on the coarsest sieve, {:.4g} um: how coarse it is is not known",
                                  100 * a.back() / all, d.back()),
                      coarser + " (retained 0)");
    for (const double mass : a) {
        finer.push_back(std::min(below / all, 1.0));
        below += mass;
    }
    finer.back() = 1;
    return finer;
}

}  // namespace

void readSieve(CaseReader& reader, Section& section, SizeDistribution& size,
               std::vector<std::filesystem::path>& files) {
    const bool inFile = section.has("sieves");
    if (!inFile) section.know("sieves");
    std::optional<SieveTable> table = inFile ? tableOfFile(reader, section, files) : inlineTable(reader, section);
    if (!table || !orderOpenings(reader, *table)) return;
    const std::vector<double> finer = fractionsOf(reader, *table);
    if (finer.empty()) return;
    section.record("openings_um", table->openings);
    section.record(table->passing ? "passing_percent" : "retained", table->amounts);
    for (std::size_t i = 0; i < finer.size(); ++i) {
        if (i + 1 < finer.size() && finer[i + 1] == 0) continue;  // sieves finer than all of the powder
        size.sieve.push_back({0.5e-6 * size.scaleUp * table->openings[i], finer[i]});
        if (finer[i] == 1) break;
    }
}

std::string sieveDerivation(const SizeDistribution& size) {
    std::string text = "drawn by number:";
    for (const NumberClass& part : numberClasses(size))
        text +=
            fmt::format(" {:.4g} % of radii {:.4g} to {:.4g} mm,", 100 * part.share, part.low * 1e3, part.high * 1e3);
    text += fmt::format(" mean radius {:.4g} mm", meanRadius(size) * 1e3);
    const double cut = finerVolume(size, size.radiusMin) + 1 - finerVolume(size, size.radiusMax);
    return cut > 1e-9 ? fmt::format("{}; {:.4g} % of the mass is beyond the bounds and left out", text, 100 * cut)
                      : text;
}

}  // namespace vkdose
