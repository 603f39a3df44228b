#include "host/validate/tables.h"

#include <fmt/format.h>

#include <cmath>

#include "host/core/json.h"

namespace vkdose::validate {

namespace {

using Json = nlohmann::ordered_json;

std::string rangeOf(const Finding& f) {
    return f.low == f.high ? fmt::format("{:.4g}", f.low) : fmt::format("{:.4g} to {:.4g}", f.low, f.high);
}

/// What the figure must be. Nothing is expected of one without a partner.
std::string expectedText(const Finding& f) {
    if (f.wanted != Wanted::Range) return f.wanted == Wanted::Positive ? "> 0" : "< 0";
    if (!f.comparable && f.low == 0 && f.high == 0) return "";
    return rangeOf(f);
}

std::string gotText(const Finding& f) {
    if (!std::isfinite(f.got)) return "none";
    return f.error > 0 ? fmt::format("{:.4g} ± {:.2g}", f.got, f.error) : fmt::format("{:.4g}", f.got);
}

/// A vertical bar would end the cell.
std::string cell(std::string text) {
    for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.insert(at, "\\");
    return text;
}

std::size_t count(const std::vector<Result>& results, Verdict verdict) {
    std::size_t n = 0;
    for (const Result& r : results)
        for (const Finding& f : r.evaluation.findings) n += f.verdict() == verdict ? 1 : 0;
    return n;
}

Json findingJson(const Finding& f) {
    return {{"figure", f.figure},          {"unit", f.unit},
            {"got", jsonNumber(f.got)},    {"error", jsonNumber(f.error)},
            {"low", jsonNumber(f.low)},    {"high", jsonNumber(f.high)},
            {"expected", expectedText(f)}, {"verdict", wordOf(f.verdict())},
            {"source", f.source},          {"remark", f.remark}};
}

Json chartJson(const Chart& chart) {
    Json curves = Json::array();
    for (const Curve& c : chart.curves) {
        Json points = Json::array();
        for (const auto& [x, y, error] : c.points) points.push_back({jsonNumber(x), jsonNumber(y), jsonNumber(error)});
        curves.push_back({{"name", c.name}, {"line", c.line}, {"dots", c.dots}, {"points", points}});
    }
    return {{"title", chart.title}, {"note", chart.note}, {"x", chart.x}, {"y", chart.y}, {"curves", curves}};
}

Json resultJson(const Result& r) {
    Json findings = Json::array(), charts = Json::array();
    for (const Finding& f : r.evaluation.findings) findings.push_back(findingJson(f));
    for (const Chart& c : r.evaluation.charts) charts.push_back(chartJson(c));
    return {{"name", r.name},       {"what", r.what},       {"source", r.source},   {"cost", r.cost},
            {"backend", r.backend}, {"missing", r.missing}, {"findings", findings}, {"charts", charts}};
}

}  // namespace

std::string headLine() {
    return fmt::format("{:<44} {:>18} {:>17} {:<5} {:<15} {}", "figure", "expected", "got", "unit", "verdict",
                       "source");
}

std::string tableLine(const Finding& f) {
    return fmt::format("{:<44} {:>18} {:>17} {:<5} {:<15} {}", f.figure, expectedText(f), gotText(f), f.unit,
                       wordOf(f.verdict()), f.source);
}

std::string tally(const std::vector<Result>& results) {
    std::string text;
    for (const Verdict v : {Verdict::Agrees, Verdict::Undecided, Verdict::Differs, Verdict::NotComparable}) {
        const std::size_t n = count(results, v);
        if (n > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", n, wordOf(v));
    }
    return text.empty() ? "no figures" : "verdicts: " + text;
}

std::size_t differing(const std::vector<Result>& results) {
    return count(results, Verdict::Differs);
}

std::string markdownTable(const std::vector<Result>& results) {
    std::string text = fmt::format("# Validation\n\n{}.\n", tally(results));
    for (const Result& r : results) {
        text += fmt::format("\n## {}\n\n{}. Source: {}.", r.name, r.what, r.source.empty() ? "none" : r.source);
        if (!r.missing.empty()) {
            text += fmt::format(" Not made: {}.\n", r.missing);
            continue;
        }
        text += fmt::format(
            " {}, on {}.\n\n| figure | expected | got | unit | verdict | source | remark |\n"
            "| --- | --- | --- | --- | --- | --- | --- |\n",
            r.cost, r.backend);
        for (const Finding& f : r.evaluation.findings)
            text += fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", cell(f.figure), expectedText(f), gotText(f),
                                f.unit, wordOf(f.verdict()), cell(f.source), cell(f.remark));
    }
    return text;
}

std::string jsonTable(const std::vector<Result>& results) {
    Json j;
    for (const Verdict v : {Verdict::Agrees, Verdict::Undecided, Verdict::Differs, Verdict::NotComparable})
        j["tally"][wordOf(v)] = count(results, v);
    j["comparisons"] = pageData(results)["comparisons"];
    return j.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json pageData(const std::vector<Result>& results) {
    Json j;
    j["kind"] = "validation";
    j["name"] = "Validation";
    j["reason"] = tally(results) + ".";
    j["comparisons"] = Json::array();
    for (const Result& r : results) j["comparisons"].push_back(resultJson(r));
    return j;
}

std::string curvesCsv(const Evaluation& evaluation) {
    std::string text = "chart,curve,x,y,error\n";
    for (const Chart& chart : evaluation.charts)
        for (const Curve& c : chart.curves)
            for (const auto& [x, y, error] : c.points)
                text += fmt::format("\"{}\",\"{}\",{:.6g},{:.6g},{:.3g}\n", chart.title, c.name, x, y, error);
    return text;
}

}  // namespace vkdose::validate
