#include "host/model/user_law_trial.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "host/core/memory_limit.h"
#include "host/law/law.h"
#include "host/law/law_checks.h"
#include "host/model/law_in_doubles.h"
#include "host/model/stability.h"

namespace vkdose {
namespace {

LawTrial& trialOfProcess() {
    static LawTrial trial;
    return trial;
}

/// A loading, and of whom.
struct Probe {
    MaterialPair pair;
    double SizeRange::*size;  ///< of the spheres
    LawLoading loading;
};

std::vector<Probe> probesOf(const Case& c, const PowderSizes& sizes) {
    constexpr double kSpeeds[] = {0, 0.01, 0.1, 1};  // [m/s]
    std::vector<Probe> probes;
    for (const MaterialPair& pair : occurringPairs(c.world)) {
        if (!haveSpheres(c.world, pair, sizes)) continue;
        for (const auto size : {&SizeRange::smallest, &SizeRange::mean, &SizeRange::largest})
            for (const double speed : kSpeeds) {
                const double a = sizes[std::size_t(pair.a)].*size, b = otherSide(c.world, pair, sizes, size);
                probes.push_back({pair,
                                  size,
                                  {c.dosingLaw.of(pair).own,
                                   reducedSize(a, b) / 2,
                                   reducedMass(c.world, pair, a, b),
                                   c.world.maxOverlapRatio * std::min(a, b),
                                   speed,
                                   {c.world.materials[std::size_t(pair.a)].properties,
                                    c.world.materials[std::size_t(pair.b)].properties}}});
            }
    }
    return probes;
}

/// What is wrong with an answer, if it will not do.
std::optional<std::string> wrongIn(const LawPoint& p, const UserLaw& law) {
    const auto answers = [](const char* function, double value) {
        return fmt::format("{} answers {:.6g}", function, value);
    };
    if (!std::isfinite(p.force)) return answers("force", p.force);
    if (!(std::isfinite(p.stiffness) && p.stiffness > 0))
        return answers("stiffness", p.stiffness) + ", which is not > 0";
    if (!(std::isfinite(p.damping) && p.damping >= 0)) return answers("damping", p.damping) + ", which is not >= 0";
    if (!(std::isfinite(p.pull) && p.pull >= 0)) return answers("pull", p.pull) + ", which is not >= 0";
    if (!std::isfinite(p.energy)) return answers("energy", p.energy);
    if (!(std::isfinite(p.reach) && p.reach >= 0)) return answers("reach", p.reach) + ", which is not >= 0";
    for (std::size_t k = 0; k < law.properties.size(); ++k)
        if (!std::isfinite(p.flows[k])) return answers((std::string(kLawFlow) + law.properties[k]).c_str(), p.flows[k]);
    return {};
}

/// Nothing if double precision cannot follow the law.
std::optional<LawInDoubles> inDoubles(const UserLaw& law) {
    try {
        return std::optional<LawInDoubles>(std::in_place, law);
    } catch (const LawRefused&) {
        return std::nullopt;
    }
}

}  // namespace

void setLawTrial(LawTrial trial) {
    trialOfProcess() = std::move(trial);
}

void tryUserLaw(CaseReader& reader, Case& c, const PowderSizes& sizes) {
    if (!c.dosingLaw.user) return;
    const UserLaw& law = *c.dosingLaw.user;
    const auto refuse = [&](int line, const std::string& problem, const std::string& remedy) {
        reader.add({law.file, line, "", "", problem, remedy});
    };
    if (!trialOfProcess()) {
        reader.fault("contact.law", "is a law of its own, which this program cannot try", "use the program vkdose");
        return;
    }
    const std::vector<Probe> probes = probesOf(c, sizes);
    std::vector<LawLoading> loadings;
    for (const Probe& probe : probes) loadings.push_back(probe.loading);
    std::vector<std::vector<LawPoint>> answers;
    std::optional<LawInDoubles> doubles;  // made once the compiler has taken the text
    try {
        answers = trialOfProcess()(law, loadings);
        doubles = inDoubles(law);
    } catch (const LawError& error) {
        for (const LawFault& fault : error.faults) refuse(fault.line, fault.problem, fault.remedy);
        return;
    } catch (const DeviceError& error) {
        const std::string why = fmt::format("could not be tried on a device: {}{}", error.what(), memoryLimitText());
        doubles = inDoubles(law);
        if (!doubles) {
            reader.fault("contact.law", why, "or take a law of the program's own, which needs no trial");
            return;
        }
        // The reference runs it without one. A run on a device will fail by itself.
        c.derivations.push_back(fmt::format("contact.law: tried in double precision, because it {}", why));
        for (const LawLoading& loading : loadings) answers.push_back(doubles->tried(loading));
        doubles.reset();
    }
    for (ContactParameters& p : c.dosingLaw.pairs) p.k1 = p.k2Max = p.gamma = p.kMost = 0;
    for (std::size_t k = 0; k < probes.size(); ++k) {
        const Probe& probe = probes[k];
        ContactParameters& p = c.dosingLaw.of(probe.pair);
        std::size_t contacts = 0;  // of the points
        for (std::size_t n = 0; n < answers[k].size(); ++n, ++contacts) {
            const LawPoint& point = answers[k][n];
            const bool pressed = 3 * n < 2 * answers[k].size();  // the last third is beyond touch
            if (!pressed && point.reach == 0) break;             // touch itself is no contact
            if (pressed && !(point.overlap > 0)) {
                refuse(lineOfFunction(law.text, "force"),
                       fmt::format("the device did not answer when {} was tried on it", law.name),
                       "make its loops shorter; if that does not help, take another device");
                return;
            }
            if (point.reach > overall(sizes).smallest) {
                refuse(lineOfFunction(law.text, "reach"),
                       fmt::format("reach answers {:.4g} m, more than the smallest radius", point.reach),
                       "let contacts break nearer by");
                return;
            }
            if (const auto wrong = wrongIn(point, law)) {
                refuse(lineOfFunction(law.text, wrong->substr(0, wrong->find(' '))),
                       fmt::format(
                           "{} ({}, overlap {:.4g} m, approach {:.4g} m/s, reduced radius {:.4g} m and mass {:.4g} kg)",
                           *wrong, nameOf(c.world, probe.pair), point.overlap, point.speed, probe.loading.radius,
                           probe.loading.mass),
                       "answer finite numbers up to contact.max_overlap_ratio");
                return;
            }
            p.reach = std::max(p.reach, point.reach);
            p.kMost = std::max(p.kMost, point.stiffness);
            if (probe.size == &SizeRange::mean) p.k1 = std::max(p.k1, point.stiffness);
            if (probe.size == &SizeRange::smallest) {
                p.k2Max = std::max(p.k2Max, point.stiffness);
                p.gamma = std::max(p.gamma, point.damping);
            }
        }
        if (doubles)
            doubles->compare(nameOf(c.world, probe.pair), probe.loading, std::span(answers[k]).first(contacts));
    }
    if (doubles) c.lawRounding = doubles->worst();
    c.settlingLaw = c.dosingLaw;
}

}  // namespace vkdose
