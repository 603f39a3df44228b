// The names that tables of a case give to things, and the keys that refer to them.
#include <fmt/format.h>

#include <algorithm>

#include "host/core/closest_word.h"
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

std::optional<std::size_t> placeOf(CaseReader& reader, const std::string& path, const std::string& name,
                                   const std::vector<std::string>& known, const char* kind) {
    const auto found = std::find(known.begin(), known.end(), name);
    if (found != known.end()) return static_cast<std::size_t>(found - known.begin());
    const std::string meant = closestWord(name, known);
    reader.fault(
        path, fmt::format("there is no {} \"{}\"", kind, name),
        meant.empty() ? fmt::format("give the name of a [[{}]]", kind) : fmt::format("did you mean \"{}\"?", meant));
    return std::nullopt;
}

std::optional<std::size_t> placeOfBody(CaseReader& reader, const std::string& path, const std::string& name,
                                       const Case& c) {
    std::vector<std::string> known;
    for (const RigidBody& body : c.world.bodies) known.push_back(body.name);
    return placeOf(reader, path, name, known, "body");
}

std::size_t readRegionName(CaseReader& reader, Section& s, const Case& c) {
    std::vector<std::string> known;
    for (const CountRegion& region : c.world.regions) known.push_back(region.name);
    const std::string name = s.string("region");
    if (!s.isString("region")) return 0;
    return placeOf(reader, s.path("region"), name, known, "region").value_or(0);
}

}  // namespace vkdose
