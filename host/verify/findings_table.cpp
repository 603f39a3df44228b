#include "host/verify/findings_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/core/json.h"

namespace vkdose::verify {

namespace {

const char* verdict(const Check& check) {
    if (!check.passes()) return "FAIL";
    return check.kind == Kind::Known ? "pass" : "plausible";
}

struct Count {
    std::size_t all = 0, passed = 0;
};

Count countOf(const std::vector<Check>& checks, Kind kind) {
    Count count;
    for (const Check& check : checks) {
        if (check.kind != kind) continue;
        ++count.all;
        if (check.passes()) ++count.passed;
    }
    return count;
}

/// A vertical bar would end the cell.
std::string cell(std::string text) {
    for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.insert(at, "\\");
    return text;
}

}  // namespace

std::string headLine() {
    return fmt::format("{:<27} {:<50} {:>13} {:>13} {:<7} {:>8} {:>8}  {:<9}  {}", "case", "quantity", "expected",
                       "got", "unit", "error", "allowed", "", "why so much is allowed");
}

std::string tableLine(const Check& c) {
    return fmt::format("{:<27} {:<50} {:>13.6g} {:>13.6g} {:<7} {:>8.1e} {:>8.1e}  {:<9}  {}", c.where, c.quantity,
                       c.expected, c.got, c.unit, c.error(), c.tolerance.share, verdict(c), c.tolerance.reason);
}

std::string markdownTable(const std::vector<Check>& checks, const Setting& setting) {
    std::string text =
        fmt::format("# Verification\n\n{} on {}, in {:.0f} s.\n\n", tally(checks), setting.backend, setting.seconds);
    text +=
        "`error` and `allowed` are in units of the expected value, or of the scale that the last column names.\n\n"
        "| case | quantity | expected | got | unit | error | allowed | | why so much is allowed |\n"
        "| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n";
    for (const Check& c : checks)
        text +=
            fmt::format("| {} | {} | {:.6g} | {:.6g} | {} | {:.1e} | {:.1e} | {} | {} |\n", c.where, cell(c.quantity),
                        c.expected, c.got, c.unit, c.error(), c.tolerance.share, verdict(c), cell(c.tolerance.reason));
    return text;
}

std::string jsonTable(const std::vector<Check>& checks, const Setting& setting) {
    nlohmann::ordered_json j;
    j["backend"] = setting.backend;
    j["wall_time_s"] = jsonNumber(setting.seconds);
    j["checks"] = checks.size();
    j["known_answers"] = countOf(checks, Kind::Known).all;
    j["plausible_figures"] = countOf(checks, Kind::Plausible).all;
    j["failures"] = failures(checks);
    j["results"] = nlohmann::ordered_json::array();
    for (const Check& c : checks)
        j["results"].push_back({{"case", c.where},
                                {"quantity", c.quantity},
                                {"unit", c.unit},
                                {"kind", c.kind == Kind::Known ? "known answer" : "plausible"},
                                {"expected", jsonNumber(c.expected)},
                                {"got", jsonNumber(c.got)},
                                {"error", jsonNumber(c.error())},
                                {"tolerance", jsonNumber(c.tolerance.share)},
                                {"reason", c.tolerance.reason},
                                {"passes", c.passes()}});
    return j.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::size_t failures(const std::vector<Check>& checks) {
    return static_cast<std::size_t>(
        std::count_if(checks.begin(), checks.end(), [](const Check& c) { return !c.passes(); }));
}

std::string tally(const std::vector<Check>& checks) {
    const Count known = countOf(checks, Kind::Known), others = countOf(checks, Kind::Plausible);
    std::string text = fmt::format("{} of {} known answers met", known.passed, known.all);
    if (others.all > 0) text += fmt::format(", {} of {} other figures plausible", others.passed, others.all);
    return text;
}

}  // namespace vkdose::verify
