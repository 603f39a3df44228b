// The tables [[refill]]: powder that is added while the run goes on.
#include <fmt/format.h>

#include <set>

#include "host/model/case_sections.h"

namespace vkdose {
namespace {

/// What says when a refill comes: at most one of three keys.
void readOccasion(CaseReader& reader, Section& s, const Schedule& schedule, Refill& refill) {
    if (s.has("time_s")) refill.time = s.number("time_s");
    if (s.has("before_dose")) refill.beforeDose = static_cast<int>(s.integer("before_dose"));
    if (s.has("below_g")) refill.below = s.number("below_g");
    std::string first;
    for (const char* key : {"time_s", "before_dose", "below_g"}) {
        s.know(key);
        if (!s.has(key)) continue;
        if (first.empty())
            first = key;
        else
            reader.fault(s.path(key), first + " is given too", "give one of the two");
    }
    if (refill.beforeDose && schedule.rotateTime == 0)
        reader.fault(s.path("before_dose"), "there are no doses", "give time_s, or dose.rotate_s");
}

/// The region that a mark is for.
void readWatched(CaseReader& reader, Section& s, const std::vector<CountRegion>& regions, Refill& refill) {
    s.know("region");
    if (!s.has("region")) return;
    refill.watched = readRegionName(reader, s, regions);
    if (!refill.below)
        reader.fault(s.path("region"), "is watched for below_g, which is missing", "give below_g too");
    else if (*refill.watched < regions.size() && regions[*refill.watched].deletes)
        reader.fault(s.path("region"), "names one that takes the powder away, so that its content never falls",
                     "name a region that counts");
}

/// Adds the refill as often as its table says.
void addTimes(CaseReader& reader, Section& s, const Refill& refill, std::set<std::string>& names,
              std::vector<Refill>& refills) {
    for (const char* key : {"every_s", "times"}) s.know(key);
    const double every = s.has("every_s") ? s.number("every_s") : 0;
    const std::int64_t times = s.has("times") ? s.integer("times") : 1;
    if (every > 0 && !refill.time)
        reader.fault(s.path("every_s"), "counts from time_s, which is missing", "give time_s too");
    if (every > 0 && !s.has("times")) reader.fault(s.path("every_s"), "does not say how often", "give times too");
    if (times > 1 && !refill.below && !(refill.time && every > 0))
        reader.fault(s.path("times"), "does not say when the others come", "give below_g, or time_s and every_s");
    for (std::int64_t i = 0; i < times; ++i) {
        Refill& one = refills.emplace_back(refill);
        one.again = i > 0;
        if (one.time) *one.time += static_cast<double>(i) * every;
        if (times == 1) continue;
        one.name = fmt::format("{}-{}", refill.name, i + 1);
        if (!names.insert(one.name).second)
            reader.fault(s.path("name"), fmt::format("gives a refill \"{}\", and another has that name", one.name),
                         "give each refill a name of its own");
    }
}

}  // namespace

std::vector<Refill> readRefills(CaseReader& reader, Section& root, const PowdersRead& powders,
                                const std::vector<CountRegion>& regions, const Schedule& schedule) {
    std::vector<Refill> refills;
    std::set<std::string> names;
    std::size_t table = 0;
    for (Section* section : root.tables("refill")) {
        Section& s = *section;
        Refill refill;
        refill.name = readName(reader, s, "refill", names);
        refill.table = table++;
        refill.material = readPowderName(reader, s, powders.named()).value_or(kFirstPowder);
        refill.mass = s.number("mass_g");
        readOccasion(reader, s, schedule, refill);
        readWatched(reader, s, regions, refill);
        if (powders.filling.list)
            reader.fault(s.path("name"), "the powder is a list, and a refill is drawn from the sizes of its powder",
                         "give particles.mass_g and particles.size in place of particles.list");
        addTimes(reader, s, refill, names, refills);
    }
    return refills;
}

}  // namespace vkdose
