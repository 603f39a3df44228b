// The regions where powder is dosed or counted: [[region]].
#include <fmt/format.h>

#include <set>

#include "host/model/case_sections.h"

namespace vkdose {
namespace {

/// The body that carries the region.
void readCarrier(CaseReader& reader, Section& s, const std::vector<RigidBody>& bodies, CountRegion& region) {
    const std::string name = s.string("moves_with");
    if (!s.isString("moves_with")) return;
    region.body = placeOfBody(reader, s.path("moves_with"), name, bodies);
    if (region.body && region.deletes)
        reader.fault(s.path("moves_with"), "stands in a region that deletes, which rests",
                     "add deletes = false, or leave moves_with out");
}

}  // namespace

std::vector<CountRegion> readRegions(CaseReader& reader, Section& root, const std::vector<RigidBody>& bodies) {
    std::vector<CountRegion> regions;
    std::set<std::string> names;
    std::size_t outlets = 0;
    for (Section* section : root.tables("region")) {
        Section& s = *section;
        CountRegion region;
        region.name = readName(reader, s, "region", names);
        const auto kind = s.choice("kind");
        region.deletes = s.boolean("deletes");
        outlets += region.deletes ? 1 : 0;
        if (s.has("moves_with")) readCarrier(reader, s, bodies, region);
        s.know("moves_with");
        if (!kind) {
            s.abandon();
        } else if (*kind == 0) {
            region.point = s.vector("point");
            region.normal = readDirection(reader, s, "normal");
        } else {
            region.kind = CountRegion::Kind::Box;
            region.low = s.vector("low");
            region.high = s.vector("high");
            if (glm::any(glm::lessThanEqual(region.high, region.low)))
                reader.fault(s.path("high"), "is not beyond low on every axis", "exchange low and high, or enlarge it");
        }
        regions.push_back(std::move(region));
    }
    if (regions.size() > kMaxRegions)
        reader.fault("region", fmt::format("there are {}", regions.size()),
                     fmt::format("give at most {}", kMaxRegions));
    if (outlets > kMaxOutlets)
        reader.fault("region", fmt::format("{} of them delete", outlets),
                     fmt::format("let at most {} delete, and count in the others", kMaxOutlets));
    return regions;
}

}  // namespace vkdose
