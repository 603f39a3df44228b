#include "host/output/run_files.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <set>
#include <string_view>
#include <system_error>

#include "host/analysis/cycles.h"
#include "host/core/error.h"
#include "host/core/file.h"
#include "host/model/case_tree.h"
#include "host/output/checkpoint.h"
#include "host/output/field_files.h"
#include "host/output/frames.h"
#include "host/output/series.h"
#include "host/sim/sample.h"

namespace vkdose {

namespace fs = std::filesystem;

namespace {

/// The order is that of removal. If the removal is cut short, the files that remain still tell that a run is there, and
/// which one.
constexpr std::array kFiles{kCheckpointName, kSettledName, kEndName,    "summary.json",  "particles.csv",
                            kCyclesName,     "doses.csv",  "case.toml", "timeseries.csv"};

/// "NAME_000012.hdf"
bool isNumbered(std::string_view file, std::string_view name, std::string_view extension) {
    if (!file.starts_with(std::string(name) + "_") || !file.ends_with(extension)) return false;
    file.remove_prefix(name.size() + 1);
    file.remove_suffix(std::min(file.size(), extension.size()));
    return file.size() >= 6 &&
           std::all_of(file.begin(), file.end(), [](char c) { return std::isdigit(static_cast<unsigned char>(c)); });
}

bool isFrame(const std::string& file) {
    if (file == kFramesIndex || file == kWallsFile || isNumbered(file, kFrameState, kFrameStateExtension)) return true;
    for (const char* kind : {kParticlesFrame, kContactsFrame, kCoilFrame, kBodiesFrame})
        if (isNumbered(file, kind, kFrameExtension) || file == std::string(kind) + kFrameExtension + kSeriesExtension)
            return true;
    return false;
}

bool isField(const std::string& file, const std::set<std::string>& fields) {
    for (const std::string& name : fields)
        if (file == name + ".csv" || file == name + kVolumeExtension + kSeriesExtension ||
            isNumbered(file, name, ".csv") || isNumbered(file, name, kVolumeExtension))
            return true;
    return false;
}

/// Names of the fields in the folder's case. Empty if that cannot be read.
std::set<std::string> fieldsIn(const fs::path& folder) {
    std::set<std::string> names;
    try {
        const Node tree = readTreeText(fileContent(folder / "case.toml").value_or(""), "case.toml");
        const Node* fields = tree.child("field");
        if (fields == nullptr) return names;
        for (const Node& field : fields->children)
            if (const Node* name = field.child("name")) names.insert(name->string);
    } catch (const CaseError&) {  // somebody has changed the case: then its fields are not ours to remove
    }
    return names;
}

}  // namespace

bool holdsRun(const fs::path& folder) {
    const std::string header = csvHeader(kWhenColumns);
    const std::optional<std::string> start = fileStart(folder / "timeseries.csv", header.size());
    return start && (start->empty() || *start == header);  // empty: the run was killed in its first moment
}

std::vector<fs::path> filesOfRun(const fs::path& folder) {
    std::vector<fs::path> files;
    const auto add = [&](const fs::path& file) {
        if (fs::exists(fs::symlink_status(file))) files.push_back(file);
    };
    const std::string page = fileStart(folder / "report.html", 1024).value_or("");
    if (page.find(kReportMark) != std::string::npos) add(folder / "report.html");
    const std::set<std::string> fields = fieldsIn(folder);
    for (const char* name : {kFramesFolder, kFieldsFolder})
        for (const fs::path& entry : entriesOf(folder / name)) {
            std::string file = entry.filename().string();
            if (file.ends_with(".new")) file.resize(file.size() - 4);
            if (std::string_view(name) == kFramesFolder ? isFrame(file) : isField(file, fields)) files.push_back(entry);
        }
    for (const char* name : kFiles) {
        add(folder / (std::string(name) + ".new"));
        add(folder / name);
    }
    return files;
}

void removeRun(const fs::path& folder, const std::vector<fs::path>& files) {
    std::error_code error;
    for (const fs::path& file : files) {
        fs::remove(file, error);
        if (error) throw OutputError("cannot remove " + file.string() + ": " + error.message());
    }
    for (const char* name : {kFramesFolder, kFieldsFolder}) removeEmptyFolder(folder / name);
}

}  // namespace vkdose
