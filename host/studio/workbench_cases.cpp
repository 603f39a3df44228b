// Cases and studies of the folder: read, checked, changed and written.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <iterator>

#include "geometry/mesh.h"
#include "geometry/mesh_file.h"
#include "host/core/error.h"
#include "host/core/file.h"
#include "host/core/json.h"
#include "host/core/printable.h"
#include "host/studio/edit.h"
#include "host/studio/workbench.h"

namespace vkdose::studio {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

namespace {

constexpr milliseconds kCheckLimit{20000}, kNewLimit{120000};

// What `vkdose new` has ready, and what it asks of a canister with a coil.
constexpr const char* kDevices[] = {"screw", "twin-screw", "tray", "wheel", "dosator"};
constexpr const char* kStudies[] = {"sweep", "calibrate", "design"};
constexpr const char* kAnswers[] = {"canister", "coil", "fill",  "powder", "bulk-density",
                                    "sizes",    "flow", "speed", "dose"};

/// The keys that a text states, with their lines; none of a text that is not TOML, which the errors tell.
Json statedJson(const std::string& text) {
    Json stated = Json::array();
    try {
        for (const Stated& s : statedIn(text)) stated.push_back({{"key", s.key}, {"line", s.line}, {"text", s.text}});
    } catch (const CaseError&) {
    }
    return stated;
}

/// A file beside a case for the time of a check, so that paths in the text mean what they will mean.
class Draft {
  public:
    Draft(const fs::path& beside, const std::string& text) {
        static std::atomic<int> count{0};
        file_ = beside.parent_path() / fmt::format(".{}-{}-{}.toml", beside.stem().string(), ::getpid(), ++count);
        replaceFile(file_, text);
    }
    ~Draft() {
        std::error_code ignored;
        fs::remove(file_, ignored);
    }
    Draft(const Draft&) = delete;
    Draft& operator=(const Draft&) = delete;
    const fs::path& file() const { return file_; }

  private:
    fs::path file_;
};

/// What the user calls the file in place of the draft.
std::string inOwnName(std::string text, const fs::path& draft, const fs::path& file) {
    for (const auto& [from, to] :
         {std::pair(draft.string(), file.filename().string()), std::pair(draft.stem().string(), file.stem().string())})
        for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
            text.replace(at, from.size(), to);
    return text;
}

}  // namespace

Json Workbench::folder() const {
    Json cases = Json::array(), studies = Json::array(), runs = Json::array(), sweeps = Json::array();
    for (const Workspace::Entry& e : workspace_.entries()) {
        Json& list = e.kind == Workspace::Kind::Case    ? cases
                     : e.kind == Workspace::Kind::Study ? studies
                     : e.kind == Workspace::Kind::Run   ? runs
                                                        : sweeps;
        list.push_back(printable(e.name));
    }
    return {{"folder", printable(workspace_.folder().string())},
            {"cases", cases},
            {"studies", studies},
            {"runs", runs},
            {"sweeps", sweeps}};
}

Json Workbench::read(const std::string& name) const {
    const fs::path file = caseOf(name);
    const auto text = fileContent(file);
    if (!text) throw Refused(404, fmt::format("{} cannot be read", printable(name)));
    if (text->size() > kMostText) throw Refused(413, fmt::format("{} is larger than 4 MiB", printable(name)));
    return {{"name", name}, {"text", *text}};
}

Json Workbench::powders() const {
    return asked({"powders", "--json"}, kCheckLimit);
}

/// A powder's name could lead to a file anywhere.
void Workbench::requireKnown(const std::string& powder) const {
    const Json known = powders();
    const auto isIt = [&](const Json& one) { return one.value("name", "") == powder; };
    if (std::none_of(known.begin(), known.end(), isIt))
        throw Refused(400, fmt::format("there is no powder {}", printable(powder)));
}

Json Workbench::make(const Json& body) const {
    const std::string name = textOf(body, "name"), like = textOf(body, "like");
    const fs::path file = caseOf(name);
    if (like == "mini") return save({{"name", name}, {"text", fileContent(first_).value_or("")}});
    const auto isLike = [&](const char* one) { return like == one; };
    std::vector<std::string> words{"new", file.string()};
    if (like == "canister") {
        if (body.contains("powder")) requireKnown(textOf(body, "powder"));
        for (const char* answer : kAnswers)
            if (body.contains(answer)) words.push_back(fmt::format("--{}={}", answer, textOf(body, answer)));
    } else if (std::any_of(std::begin(kStudies), std::end(kStudies), isLike)) {
        const fs::path of = caseOf(textOf(body, "of"));
        requireAllowed(of);
        words.push_back(fmt::format("--{}={}", like, of.string()));
    } else if (std::any_of(std::begin(kDevices), std::end(kDevices), isLike)) {
        words.push_back("--" + like);
    } else {
        throw Refused(400, fmt::format("there is no {} to begin with", printable(like)));
    }
    std::error_code code;
    fs::create_directories(file.parent_path(), code);
    (void)done(words, kNewLimit);
    return {{"name", name}};
}

Json Workbench::keys(bool ofStudies) {
    const std::lock_guard lock(keysLock_);
    Json& keys = ofStudies ? studyKeys_ : caseKeys_;
    std::vector<std::string> words{"manual", "keys", "--schema"};
    if (ofStudies) words.emplace_back("--study");
    if (keys.is_null()) keys = asked(words, kCheckLimit);
    return keys;
}

Json Workbench::check(const std::string& name, const std::string& text) const {
    const fs::path file = caseOf(name);
    std::error_code code;
    if (!fs::is_directory(file.parent_path(), code))
        throw Refused(404, fmt::format("there is no folder for {}", printable(name)));
    const Draft draft(file, text);
    if (const auto law = lawToAskFor(draft.file())) return {{"law", {{"file", law->file}, {"text", law->text}}}};
    if (const char* command = commandOfStudy(text)) return checkStudy(draft.file(), file, text, command);
    Json json = asked({"check", draft.file().string(), "--json", "--assume", "--scene"}, kCheckLimit);
    for (Json& error : json["errors"])
        if (error.value("file", "") == printable(draft.file().string())) error["file"] = "";
    json.erase("file");
    json["values"] = Json::object();
    for (const Json& s : statedJson(json.value("resolved", "")))
        json["values"][s["key"].get<std::string>()] = s["text"];
    json.erase("resolved");
    json["stated"] = statedJson(text);
    return json;
}

Json Workbench::checkStudy(const fs::path& draft, const fs::path& file, const std::string& text,
                           const char* command) const {
    const Said all = said({command, draft.string(), "--dry-run", "--assume"}, kCheckLimit);
    return {{"study", command},
            {"stated", statedJson(text)},
            {"plan", printableLines(inOwnName(all.text, draft, file))},
            {"error", all.ended.code == 0 ? "" : printableLines(inOwnName(all.ended.error, draft, file))}};
}

/// `value` is TOML; null takes the key out.
Json Workbench::edit(const Json& body) {
    const std::string text = textOf(body, "text"), key = textOf(body, "key");
    const bool out = !body.contains("value") || body["value"].is_null();
    try {
        const auto changed = edited(text, key, out ? std::nullopt : std::optional(textOf(body, "value")));
        if (changed) return {{"text", *changed}};
    } catch (const CaseError& e) {
        throw Refused(422, e.faults().empty() ? e.what() : e.faults().front().problem);
    }
    throw Refused(422, fmt::format("{} cannot be changed from here; change it in the text", printable(key)));
}

/// `before` is the text that the page has read; null for a new case. A file that has changed since is not replaced.
Json Workbench::save(const Json& body) const {
    const std::string name = textOf(body, "name"), text = textOf(body, "text");
    const fs::path file = caseOf(name);
    const std::lock_guard lock(writing_);
    const auto there = fileContent(file);
    const bool fresh = !body.contains("before") || body["before"].is_null();
    if (fresh && there) throw Refused(409, fmt::format("{} is there already; choose another name", printable(name)));
    if (!fresh && there && *there != textOf(body, "before") && *there != text)
        throw Refused(409, fmt::format("{} was changed by another program; open it again", printable(name)));
    std::error_code code;
    fs::create_directories(file.parent_path(), code);
    replaceFile(file, text);
    return {{"name", name}};
}

Json Workbench::mesh(const std::string& name, const std::string& content) const {
    const fs::path file = fileOf(name);
    const std::lock_guard lock(writing_);
    const auto there = fileContent(file);
    if (there && *there != content)
        throw Refused(409, fmt::format("another {} is there already; rename yours", printable(name)));
    geometry::MeshFacts facts;
    try {
        facts = geometry::makeMesh(geometry::readMesh(content, file.filename().string(), 1)).facts;
    } catch (const geometry::MeshError& e) {
        throw Refused(422, e.what());
    }
    if (!there) replaceFile(file, content);
    const Vec3 size = facts.high - facts.low;
    return {{"name", name},
            {"size", {jsonNumber(size.x), jsonNumber(size.y), jsonNumber(size.z)}},
            {"triangles", facts.triangles},
            {"closed", facts.closed},
            {"mended", printable(facts.mended)}};
}

}  // namespace vkdose::studio
