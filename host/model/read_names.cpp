// The names that tables of a case give to things, and the keys that refer to them.
#include <fmt/format.h>

#include <algorithm>

#include "host/core/closest_word.h"
#include "host/core/printable.h"
#include "host/model/case_sections.h"

namespace vkdose {
namespace {

constexpr const char* kNameLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_";

}  // namespace

std::string readName(CaseReader& reader, Section& section, const std::string& kind, std::set<std::string>& names,
                     std::optional<std::string> standard) {
    const bool given = !standard || section.has("name");
    std::string name = section.string("name", std::move(standard));
    if (given && !section.isString("name")) return name;
    const bool fit = !name.empty() && name.size() <= 60 && name.find_first_not_of(kNameLetters) == std::string::npos;
    if (!fit)
        reader.fault(section.path("name"), fmt::format("is no name of a {}", kind), "give letters, digits, - and _");
    else if (!names.insert(name).second)
        reader.fault(section.path("name"),
                     given ? "stands there twice" : fmt::format("\"{}\" stands there twice", name),
                     fmt::format("give each {} a name of its own", kind));
    return name;
}

namespace {

/// The place of the name among those of the tables [[kind]]. A fault of the key at `path` if it is not there.
template <class Things>
std::optional<std::size_t> placeOf(CaseReader& reader, const std::string& path, const std::string& name,
                                   const Things& things, const char* kind) {
    std::vector<std::string> known;
    for (const auto& thing : things) known.push_back(thing.name);
    const auto found = std::find(known.begin(), known.end(), name);
    if (found != known.end()) return static_cast<std::size_t>(found - known.begin());
    const std::string meant = closestWord(name, known);
    reader.fault(
        path, fmt::format("there is no {} \"{}\"", kind, name),
        meant.empty() ? fmt::format("give the name of a [[{}]]", kind) : fmt::format("did you mean \"{}\"?", meant));
    return std::nullopt;
}

}  // namespace

std::optional<std::size_t> placeOfBody(CaseReader& reader, const std::string& path, const std::string& name,
                                       const std::vector<RigidBody>& bodies) {
    return placeOf(reader, path, name, bodies, "body");
}

std::size_t readRegionName(CaseReader& reader, Section& s, const std::vector<CountRegion>& regions) {
    const std::string name = s.string("region");
    if (!s.isString("region")) return 0;
    return placeOf(reader, s.path("region"), name, regions, "region").value_or(0);
}

namespace {

std::string suggestion(const std::string& name, const std::vector<std::string>& known) {
    const std::string meant = closestWord(name, known);
    if (!meant.empty()) return fmt::format("did you mean \"{}\"?", meant);
    std::string all;
    for (const std::string& k : known) all += (all.empty() ? "" : ", ") + k;
    return "known: " + all;
}

}  // namespace

int readMaterialName(CaseReader& reader, Section& section, const std::vector<Material>& materials, int usual) {
    if (!section.has("material")) {
        section.know("material");
        return usual;
    }
    const std::string name = section.string("material");
    if (!section.isString("material")) return usual;
    std::vector<std::string> names;
    for (const Material& m : materials) names.push_back(m.name);
    const auto found = std::find(names.begin(), names.end(), name);
    const auto index = static_cast<std::size_t>(found - names.begin());
    if (found == names.end())
        reader.fault(section.path("material"), fmt::format("there is no material \"{}\"", printable(name)),
                     suggestion(name, names) + "; a further one needs a [[material]]");
    else if (materials[index].powder)
        reader.fault(section.path("material"), "is the material of a powder",
                     "add a [[material]] of another name with the same moduli");
    else
        return static_cast<int>(index);
    return usual;
}

std::optional<int> readPowderName(CaseReader& reader, Section& section, const std::vector<ListedPowder>& powders) {
    if (!section.has("powder")) {
        section.know("powder");
        return {};
    }
    const std::string name = section.string("powder");
    if (!section.isString("powder")) return {};
    std::vector<std::string> names;
    for (const ListedPowder& p : powders) {
        if (p.name == name) return p.material;
        names.push_back(p.name);
    }
    reader.fault(section.path("powder"), fmt::format("there is no powder \"{}\"", printable(name)),
                 suggestion(name, names));
    return {};
}

}  // namespace vkdose
