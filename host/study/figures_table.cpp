#include "host/study/figures_table.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "host/core/columns.h"
#include "host/core/file.h"
#include "host/model/case.h"
#include "host/study/trials.h"

namespace vkdose {

namespace {

constexpr int kDigits = 9;  // as in members.csv

struct FiguresOf {
    const Member* member;
    std::vector<double> values;  ///< of each name; NaN where there is none
};

}  // namespace

void writeFigures(const SweepFolder& folder, const Study& study, const std::vector<Member>& members) {
    const std::vector<std::string> names = figureNames(loadResolvedCase(members.front().caseText, "case.toml"));
    std::vector<FiguresOf> all;
    for (const Member& m : members) {
        if (folder.status(m.number) != MemberStatus::Ok) continue;
        FiguresOf& of = all.emplace_back(FiguresOf{&m, {}});
        const RunFigures run(folder.memberFolder(m.number));
        for (const std::string& name : names) of.values.push_back(run.at(name).value);
    }
    std::vector<std::size_t> told;
    for (std::size_t k = 0; k < names.size(); ++k)
        if (std::any_of(all.begin(), all.end(), [&](const FiguresOf& of) { return std::isfinite(of.values[k]); }))
            told.push_back(k);

    Row head{"member", "seed"};
    for (const std::string& key : study.keys()) head.push_back(key);
    for (const std::size_t k : told) head.push_back(names[k]);
    std::string text = csvLine(head) + "\n";
    for (const FiguresOf& of : all) {
        Row row{std::to_string(of.member->number), std::to_string(of.member->seed)};
        row.insert(row.end(), of.member->values.begin(), of.member->values.end());
        for (const std::size_t k : told)
            row.push_back(std::isfinite(of.values[k]) ? cellText(of.values[k], kDigits) : "");
        text += csvLine(row) + "\n";
    }
    replaceFile(folder.path() / kFiguresName, text);
}

}  // namespace vkdose
