#include "host/study/scale_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "host/analysis/beta.h"
#include "host/core/error.h"
#include "host/core/json.h"
#include "host/model/powders.h"
#include "host/model/size_distribution.h"
#include "host/study/finding_file.h"
#include "host/study/seed_scatter.h"
#include "host/study/trials.h"

namespace vkdose {

namespace {

/// A key that grows with the spheres, and its value in the case.
struct GrowingKey {
    std::string key;
    double value = 0;
};

/// The bounds of quantiles and sieves are sizes of spheres; all other sizes are those of grains.
std::vector<GrowingKey> growingKeys(const Case& c) {
    using Kind = SizeDistribution::Kind;
    std::vector<GrowingKey> keys;
    for (const PowderOf& powder : powdersOf(c)) {
        const SizeDistribution& size = powder.filling.size;
        const std::string table =
            powder.material == kFirstPowder ? "particles.size." : fmt::format("powder.{}.size.", powder.name);
        keys.push_back({table + "scale_up", size.scaleUp});
        if (size.kind != Kind::Quantiles && size.kind != Kind::Sieve) continue;
        if (size.radiusMin > finestRadius(size)) keys.push_back({table + "radius_min_mm", size.radiusMin * 1e3});
        if (size.radiusMax < coarsestRadius(size)) keys.push_back({table + "radius_max_mm", size.radiusMax * 1e3});
    }
    return keys;
}

/// The study as a file would state it, for the record.
std::string studyText(const Study& study, const ScaleAim& aim) {
    std::string text =
        fmt::format("# Written by `vkdose scale`.\nbase = \"{}\"\nseeds = [", study.base.filename().string());
    for (std::size_t k = 0; k < study.seeds.size(); ++k) text += fmt::format("{}{}", k > 0 ? ", " : "", study.seeds[k]);
    text += "]\n[set]\n";
    for (const Setting& s : study.set) text += fmt::format("\"{}\" = {}\n", s.key, valueText(s.value));
    text += "[[axis]]\nkeys = [";
    for (const std::string& key : study.axes[0].keys)
        text += fmt::format("{}\"{}\"", &key == study.axes[0].keys.data() ? "" : ", ", key);
    text += "]\nvalues = [";
    for (std::size_t p = 0; p < aim.factors.size(); ++p) {
        text += p > 0 ? ", [" : "[";
        for (const Node& value : study.axes[0].points[p])
            text += fmt::format("{}{}", &value == study.axes[0].points[p].data() ? "" : ", ", value.text);
        text += "]";
    }
    return text + "]\n";
}

double meanDiameter(const Case& c) {
    return 2 * meanRadius(c.filling.size);
}

/// Of each size the values of the seeds. The members of a seed follow each other, size by size.
std::vector<std::vector<double>> valuesOf(const SweepFolder& folder, const std::string& figure, std::size_t sizes,
                                          std::size_t members) {
    std::vector<std::vector<double>> values(sizes);
    for (std::size_t m = 0; m < members; ++m) {
        if (folder.status(int(m)) != MemberStatus::Ok) continue;
        const double value = RunFigures(folder.memberFolder(int(m))).at(figure).value;
        if (std::isfinite(value)) values[m % sizes].push_back(value);
    }
    return values;
}

ScaleFinding::Figure figureOf(const std::string& name, const std::vector<std::vector<double>>& values, double within) {
    ScaleFinding::Figure figure{name, {}, {}, 0};
    const SeedScatter scatter = scatterOfSeeds(values);
    for (const std::vector<double>& seeds : values) {
        const Estimate mean = estimateOf(seeds);
        constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
        figure.at.push_back(seeds.empty() ? Measured{kNone, kNone}
                                          : Measured{mean.mean, scatter.errorOfMean(int(seeds.size()))});
    }
    const Measured& first = figure.at.front();
    for (const Measured& m : figure.at)
        figure.verdicts.push_back(&m == &first
                                      ? ScaleFinding::Verdict::Holds
                                      : judgeScale(m.value, first.value, std::hypot(m.error, first.error), within));
    while (figure.holds + 1 < values.size() && figure.verdicts[figure.holds + 1] == ScaleFinding::Verdict::Holds)
        ++figure.holds;
    return figure;
}

}  // namespace

Study scaleStudy(const std::filesystem::path& file, const std::vector<std::string>& overrides, const ScaleAim& aim) {
    const Case c = loadCase(file, overrides);
    if (c.filling.list)
        throw CaseError({{file.string(), 0, "particles.list", "", "has the sizes of its particles, which do not grow",
                          "give particles.mass_g and particles.size in its place"}});
    Study study;
    study.file = file;
    study.base = file;
    study.name = file.stem().string() + "-scale";
    study.reason = fmt::format("Which figures of {} depend on the size of its spheres?", file.filename().string());
    for (int k = 0; k < aim.seeds; ++k) study.seeds.push_back(c.seed + std::uint64_t(k));
    Axis axis;
    for (const GrowingKey& key : growingKeys(c)) axis.keys.push_back(key.key);
    for (const double factor : aim.factors) {
        std::vector<Node> point;
        for (const GrowingKey& key : growingKeys(c))
            point.push_back(settingOf(study, key.key, key.value * factor).value);
        axis.points.push_back(std::move(point));
    }
    study.axes.push_back(std::move(axis));
    std::vector<std::string> all = overrides;
    const auto states = [](const std::string& text) { return text.starts_with("contact.scaling="); };
    if (std::none_of(all.begin(), all.end(), states)) all.emplace_back("contact.scaling=stress");
    applyOverrides(study, all);
    study.overrides = overrides;
    study.text = studyText(study, aim);
    return study;
}

ScaleFinding::Verdict judgeScale(double value, double reference, double error, double within) {
    const double off = std::abs(value - reference), allowed = within * std::abs(reference);
    if (off <= allowed && error <= allowed) return ScaleFinding::Verdict::Holds;
    if (off > allowed && off > 2 * error) return ScaleFinding::Verdict::Differs;
    return ScaleFinding::Verdict::Open;
}

ScaleFinding scaleFinding(const Study& study, const ScaleAim& aim, const std::vector<Member>& members,
                          const SweepFolder& folder, std::vector<ScaleFinding::Gap> gaps) {
    ScaleFinding finding{aim.within, std::move(gaps), {}, {}};
    const std::size_t sizes = aim.factors.size();
    std::vector<std::string> names;
    for (std::size_t k = 0; k < sizes; ++k) {
        const Case c = loadResolvedCase(members[k].caseText, study.base);
        if (k == 0) names = figureNames(c);
        ScaleFinding::Size size{aim.factors[k],   meanDiameter(c),         members[k].particles,
                                c.world.timeStep, members[k].expectedWork, {}};
        for (const ScaleFinding::Gap& gap : finding.gaps) size.widths.push_back(gap.width / size.diameter);
        finding.sizes.push_back(std::move(size));
    }
    for (const std::string& name : names) {
        const auto values = valuesOf(folder, name, sizes, members.size());
        if (!values.front().empty()) finding.figures.push_back(figureOf(name, values, aim.within));
    }
    return finding;
}

const char* verdictText(ScaleFinding::Verdict verdict) {
    switch (verdict) {
        case ScaleFinding::Verdict::Holds:
            return "holds";
        case ScaleFinding::Verdict::Differs:
            return "differs";
        case ScaleFinding::Verdict::Open:
            break;
    }
    return "open";
}

nlohmann::ordered_json scaleJson(const ScaleFinding& finding) {
    using Json = nlohmann::ordered_json;
    Json j{{"within", finding.within}, {"sizes", Json::array()}, {"figures", Json::array()}};
    for (const ScaleFinding::Size& size : finding.sizes) {
        Json widths;
        for (std::size_t g = 0; g < finding.gaps.size(); ++g) widths[finding.gaps[g].name] = jsonNumber(size.widths[g]);
        j["sizes"].push_back({{"factor", size.factor},
                              {"mean_diameter_m", jsonNumber(size.diameter)},
                              {"particles", size.particles},
                              {"time_step_s", size.timeStep},
                              {"particle_steps", jsonNumber(size.work)},
                              {"widths_in_diameters", widths}});
    }
    for (const ScaleFinding::Figure& figure : finding.figures) {
        Json at = Json::array();
        for (std::size_t k = 0; k < figure.at.size(); ++k)
            at.push_back({{"mean", jsonNumber(figure.at[k].value)},
                          {"error", jsonNumber(figure.at[k].error)},
                          {"verdict", verdictText(figure.verdicts[k])}});
        j["figures"].push_back(
            {{"name", figure.name}, {"at", at}, {"holds_to_factor", finding.sizes[figure.holds].factor}});
    }
    return j;
}

nlohmann::ordered_json readScale(const std::filesystem::path& folder) {
    const auto isWhole = [](const nlohmann::ordered_json& j) {
        const auto &sizes = j.at("sizes"), &figures = j.at("figures");
        return !sizes.empty() && std::all_of(sizes.begin(), sizes.end(), [](const auto& size) {
            return size.at("factor").is_number() && size.at("widths_in_diameters").is_object();
        }) && std::all_of(figures.begin(), figures.end(), [&](const auto& f) {
            return f.at("name").is_string() && f.at("at").size() == sizes.size() && f.at("holds_to_factor").is_number();
        });
    };
    return readFindingFile(folder / kScaleName, isWhole, "the finding of a study of sizes", "vkdose scale");
}

}  // namespace vkdose
