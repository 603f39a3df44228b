#include "host/app/from.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <optional>

#include "host/core/error.h"
#include "host/core/file.h"
#include "host/core/printable.h"
#include "host/model/case_tree.h"
#include "host/output/frames.h"
#include "host/sim/state_facts.h"

namespace vkdose {

namespace fs = std::filesystem;

namespace {

/// A state that a folder may hold; in the order in which they are looked for.
struct Stored {
    const char* name;  ///< as --at has it
    fs::path file;
    std::string words;  ///< "... of FOLDER"
};
const std::array<Stored, 3> kStored{{{"settled", kSettledName, "the settled bed"},
                                     {"checkpoint", kCheckpointName, "the checkpoint"},
                                     {"end", kEndName, "the end"}}};

/// The time that --at names, if it is one [s].
std::optional<double> timeIn(const std::string& at) {
    double time = 0;
    const auto [end, fault] = std::from_chars(at.data(), at.data() + at.size(), time);
    return fault == std::errc() && end == at.data() + at.size() ? std::optional(time) : std::nullopt;
}

/// The state at the frame nearest to `time` [s].
Stored frameAt(const fs::path& folder, double time) {
    const fs::path frames = folder / kFramesFolder;
    std::vector<FrameEntry> entries;
    if (const auto text = fileContent(frames / kFramesIndex)) entries = framesListed(*text, frames / kFramesIndex);
    std::erase_if(entries, [&](const FrameEntry& e) { return !fs::exists(frames / frameStateFile(e.number)); });
    if (entries.empty())
        throw UsageError(
            fmt::format("{} holds no states at frames: they are kept with frames.states = true and frames.interval_s; "
                        "or begin with "
                        "--at settled or --at end",
                        folder.string()));
    const FrameEntry& nearest = entries[nearestOf(entries, time)];
    return {"", fs::path(kFramesFolder) / frameStateFile(nearest.number), fmt::format("frame {}", nearest.number)};
}

Stored storedIn(const StartOptions& start) {
    if (const std::optional<double> time = timeIn(start.at)) return frameAt(start.folder, *time);
    const bool known = std::any_of(kStored.begin(), kStored.end(), [&](const Stored& s) { return start.at == s.name; });
    if (!start.at.empty() && !known)
        throw UsageError(fmt::format(
            "--at {} is no state: give settled, checkpoint, end, or a time in seconds for the frame nearest to it",
            printable(start.at)));
    const auto there = [&](const Stored& s) { return fs::exists(start.folder / s.file); };
    const auto found = std::find_if(kStored.begin(), kStored.end(),
                                    [&](const Stored& s) { return start.at.empty() ? there(s) : start.at == s.name; });
    if (found != kStored.end() && there(*found)) return *found;
    std::string has;
    for (const Stored& s : kStored)
        if (there(s)) has += (has.empty() ? "--at " : ", --at ") + std::string(s.name);
    if (!has.empty())
        throw UsageError(fmt::format("{} is not there; the run has {}", (start.folder / found->file).string(), has));
    const bool run = fs::exists(start.folder / "timeseries.csv");
    throw UsageError(
        fmt::format("{} {}", start.folder.string(),
                    run ? "holds no state to begin with: a run keeps one when its powder has settled and one at its "
                          "end, a member of a study keeps none; run its case.toml once more"
                        : "holds no run of vkdose; give the output folder of one with --from"));
}

/// Every value of a resolved case as text, by its key: "coil.turns", "body[0].shape".
using Values = std::map<std::string, std::string>;

void gather(const Node& node, const std::string& path, Values& values) {
    const bool tables =
        node.kind == Node::Kind::Array && !node.children.empty() && node.children.front().kind == Node::Kind::Table;
    if (node.kind != Node::Kind::Table && !tables) {
        values[path] = valueText(node);
        return;
    }
    for (std::size_t i = 0; i < node.children.size(); ++i) {
        const Node& child = node.children[i];
        gather(child,
               tables         ? fmt::format("{}[{}]", path, i)
               : path.empty() ? child.key
                              : path + "." + child.key,
               values);
    }
}

Values valuesOf(const Case& c) {
    Values values;
    gather(readTreeText(c.resolved, "case.toml"), "", values);
    return values;
}

bool under(const std::string& key, std::initializer_list<const char*> tables) {
    return std::any_of(tables.begin(), tables.end(), [&](const std::string& table) {
        return key == table || key.starts_with(table + ".") || key.starts_with(table + "[");
    });
}

/// The space around the powder, and what its state cannot do without. The speed and the surface of the coil may change.
bool isSpace(const std::string& key) {
    if (key == "coil.speed_rpm" || key == "coil.surface_velocity" || key == "coil.wire_curvature") return false;
    if (under(key, {"powder", "material"}) && key.ends_with(".density")) return true;
    return under(key, {"boundaries", "canister", "coil", "plane", "cylinder", "body", "region", "particles.density",
                       "particles.material", "sensors.energy"});
}

/// What the particles follow from.
bool isPowder(const std::string& key) {
    return under(key, {"seed", "particles", "powder", "refill"});
}

template <class Fits>
void compare(const Values& before, const Values& now, const fs::path& folder, const Fits& asks,
             std::vector<Diagnostic>& faults) {
    static const std::string kNone = "not there";
    Values all = before;
    all.insert(now.begin(), now.end());
    for (const auto& [key, unused] : all) {
        if (!asks(key)) continue;
        const auto a = before.find(key), b = now.find(key);
        const std::string& was = a == before.end() ? kNone : a->second;
        const std::string& is = b == now.end() ? kNone : b->second;
        if (was == is) continue;
        faults.push_back({"case", 0, key, is,
                          fmt::format("is {} in the run of {}, whose powder it is", was, folder.string()),
                          "leave it as it is there, or let powder settle for this case in a run without --from"});
    }
}

/// Throws CaseError if the powder of the other run does not fit the case.
void requireFit(const Case& source, const Checkpoint& state, const ReadyRun& run, const fs::path& folder) {
    std::vector<Diagnostic> faults;
    const Values before = valuesOf(source), now = valuesOf(run.c);
    compare(before, now, folder, isSpace, faults);
    // What a contact remembers means something else under another law.
    const auto lawOf = [](const Case& c) { return c.dosingLaw.of(ContactClass::ParticleParticle).law; };
    if (lawOf(source) != lawOf(run.c))
        compare(
            before, now, folder, [](const auto& key) { return key == "contact.law"; }, faults);
    const StateFacts facts = factsOf(state.run.run);
    if (facts.radii != run.filled.allParticles().radius) {
        const std::size_t known = faults.size();
        compare(before, now, folder, isPowder, faults);
        if (faults.size() == known)
            faults.push_back({"case", 0, "particles", "",
                              fmt::format("are not those of the run of {}", folder.string()),
                              "give its list of particles as it was, or the vkdose that made it"});
    }
    if (const auto over = endIsOver("case", run.c, state.time)) faults.push_back(*over);
    if (!faults.empty()) throw CaseError(faults);
    if (facts.active == 0)
        throw UsageError(fmt::format("the canister in {} is empty: there is nothing to begin with", folder.string()));
}

}  // namespace

ReadyRun readyFrom(const CaseOptions& input, const StartOptions& start) {
    const Stored stored = storedIn(start);
    const fs::path file = start.folder / stored.file;
    ReadyRun run;
    run.state = readCheckpoint(file);
    const fs::path text = start.folder / "case.toml";
    run.c = input.file.empty() ? loadResolvedCase(run.state->given, text, input.overrides)
                               : loadCase(input.file, input.overrides);
    (void)Timeline(run.c);
    run.filled = insertParticles(run.c);
    try {
        requireFit(loadResolvedCase(run.state->caseText, text), *run.state, run, start.folder);
    } catch (const RecordError& e) {
        throw CheckpointError(fmt::format("{} cannot be used: {}", file.string(), e.what()));
    }
    run.role.origin = fmt::format("{} of {}, at t = {:.6g} s", stored.words, start.folder.string(), run.state->time);
    return run;
}

}  // namespace vkdose
