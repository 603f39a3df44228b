// What a run leaves for others: reports, comparisons, pictures, films and tables.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "host/core/file.h"
#include "host/core/printable.h"
#include "host/studio/workbench.h"

namespace vkdose::studio {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

namespace {

constexpr milliseconds kReportLimit{120000}, kPictureLimit{120000}, kFilmLimit{1200000};
constexpr std::size_t kMostCompared = 8;
constexpr const char* kComparison = "out/comparison.html";

struct Kind {
    const char* name;  ///< of the file
    const char* type;
    bool shown;  ///< in a tab; else the browser keeps it
};
constexpr std::array kFiles{
    Kind{"report.html", "text/html; charset=utf-8", true},
    Kind{"picture.png", "image/png", true},
    Kind{"film.mp4", "video/mp4", false},
    Kind{"doses.csv", "text/csv; charset=utf-8", false},
    Kind{"timeseries.csv", "text/csv; charset=utf-8", false},
    Kind{"particles.csv", "text/csv; charset=utf-8", false},
    Kind{"members.csv", "text/csv; charset=utf-8", false},
    Kind{"figures.csv", "text/csv; charset=utf-8", false},
    Kind{"calibrated.toml", "text/plain; charset=utf-8", false},
    Kind{"summary.json", "application/json", false},
    Kind{"case.toml", "text/plain; charset=utf-8", false},
    Kind{"comparison.html", "text/html; charset=utf-8", true},
};

}  // namespace

Json Workbench::report(const std::string& run) const {
    (void)done({"report", fileOf(run).string()}, kReportLimit);
    return {{"run", run}, {"name", "report.html"}};
}

Json Workbench::compare(const Json& body) const {
    if (!body.contains("runs") || !body["runs"].is_array()) throw Refused(400, "runs is missing");
    const Json& runs = body["runs"];
    if (runs.size() < 2 || runs.size() > kMostCompared)
        throw Refused(400, fmt::format("two to {} runs are shown beside each other", kMostCompared));
    std::vector<std::string> words{"report"};
    for (const Json& run : runs) {
        if (!run.is_string()) throw Refused(400, "runs are names");
        words.push_back(fileOf(run.get<std::string>()).string());
    }
    words.insert(words.end(), {"--out", fileOf(kComparison).string()});
    (void)done(words, kReportLimit);
    return {{"run", "out"}, {"name", "comparison.html"}};
}

Json Workbench::picture(const std::string& run, bool film) const {
    const fs::path folder = fileOf(run);
    if (film)
        (void)done({"render", folder.string(), "--movie", (folder / "film.mp4").string()}, kFilmLimit);
    else
        (void)done({"render", folder.string()}, kPictureLimit);
    return {{"run", run}, {"name", film ? "film.mp4" : "picture.png"}};
}

void Workbench::file(const std::string& run, const std::string& name, httplib::Response& response) const {
    const auto kind = std::find_if(kFiles.begin(), kFiles.end(), [&](const Kind& k) { return name == k.name; });
    if (kind == kFiles.end()) throw Refused(403, fmt::format("{} is none of a run's files", printable(name)));
    const auto content = fileContent(fileOf(run) / name);
    if (!content) throw Refused(404, fmt::format("{} has no {} yet", printable(run), name));
    if (!kind->shown) response.set_header("Content-Disposition", fmt::format("attachment; filename=\"{}\"", name));
    response.set_header("Cache-Control", "no-store");
    answerWith(response, *content, kind->type);
}

}  // namespace vkdose::studio
