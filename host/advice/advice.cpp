#include "host/advice/advice.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "host/advice/rules.h"
#include "host/core/key.h"
#include "host/core/printable.h"

namespace vkdose {
namespace {

struct Rule {
    const char* name;
    Found (*find)(const Subject&);
};

/// The rules in the order in which a case is read: powder, device, schedule.
constexpr std::array kRules{
    Rule{"density", lightOrHeavyPowder},
    Rule{"bulk-density", strangeBulkDensity},
    Rule{"gravity", strangeGravity},
    Rule{"few-spheres", fewSpheres},
    Rule{"size-ratio", wideSizes},
    Rule{"sieve-cumulative", cumulativeSieves},
    Rule{"unused-material", unusedMaterial},
    Rule{"law-rounding", roundedLaw},
    Rule{"friction", strangeFriction},
    Rule{"overdamped", overdampedContacts},
    Rule{"restitution", strangeRestitution},
    Rule{"overlap-weight", deepUnderWeight},
    Rule{"overlap-fall", deepOfFall},
    Rule{"canister-size", hugeCanister},
    Rule{"coil-gap", narrowTurns},
    Rule{"pinch", pinchedSpheres},
    Rule{"coil-end", shortCoil},
    Rule{"coil-start", lateCoil},
    Rule{"coil-rear", coilThroughRear},
    Rule{"coil-rest", coilAtRest},
    Rule{"coil-speed", coilTooFast},
    Rule{"outlet", narrowOutlet},
    Rule{"throat", openThroat},
    Rule{"throat-empty", emptyThroat},
    Rule{"fill-low", bareCoil},
    Rule{"domain", tightDomain},
    Rule{"region", unreachableRegion},
    Rule{"no-outlet", noOutlet},
    Rule{"no-floor", openBelow},
    Rule{"body-backwards", bodyBackwards},
    Rule{"body-wall", bodyInWall},
    Rule{"body-cross", bodiesCross},
    Rule{"body-seam", bodySeam},
    Rule{"body-end", shortBody},
    Rule{"body-mended", mendedMesh},
    Rule{"body-size", bodyOutOfScale},
    Rule{"body-place", bodyOutside},
    Rule{"body-phases", bodyPhases},
    Rule{"body-inside", sphereInBody},
    Rule{"body-thin", thinBody},
    Rule{"body-speed", bodyTooFast},
    Rule{"settle-time", shortSettling},
    Rule{"dose-length", longDose},
    Rule{"dose-time", shortLongestTime},
    Rule{"dose-spheres", smallDose},
    Rule{"stop-threshold", earlyStop},
    Rule{"refill", lateRefill},
    Rule{"frames", fewFrames},
    Rule{"sensors", fewSensors},
    Rule{"sensors-alias", aliasedSensors},
    Rule{"rate-window", longWindow},
    Rule{"time-step", shortStep},
    Rule{"resolution", coarseNumbers},
    Rule{"run-length", longRun},
    Rule{"accepted", unknownAcceptance},
};

}  // namespace

const Node* Subject::node(const std::string& key) const {
    const Node* node = &tree;
    for (std::size_t start = 0; node != nullptr && start <= key.size();) {
        const std::size_t end = std::min(key.find('.', start), key.size());
        node = node->child(key.substr(start, end - start));
        start = end + 1;
    }
    return node;
}

std::string Subject::value(const std::string& key) const {
    const Node* found = node(key);
    return found == nullptr || found->kind == Node::Kind::Table ? "" : valueText(*found);
}

std::string Subject::shown(const std::string& key) const {
    const std::string last = key.substr(key.rfind('.') + 1), text = value(key);
    const bool soft = c.softened > 1 && (last == "k" || last == "damping" || last == "plasticity_depth");
    return soft && !text.empty() ? fmt::format("{} (softened {:.6g} times)", text, c.softened) : text;
}

std::vector<std::string> Subject::accepted() const {
    const Node* found = node("accepted_warnings");
    return found == nullptr ? std::vector<std::string>() : wordsOf(found->string);
}

std::string Warning::line() const {
    return fmt::format("{}{}: {}; {} ({})", key, value.empty() ? "" : " = " + printable(value), printable(text),
                       printable(cure), name);
}

std::vector<Warning> warningsOf(const Case& c, const Insertion& filled) {
    if (filled.particles.size() == 0) return {};
    const Subject subject{c, filled, derive(c, filled), figuresOf(c, filled), readTreeText(c.resolved, "case.toml")};
    const std::vector<std::string> accepted = subject.accepted();
    std::vector<Warning> all;
    for (const Rule& rule : kRules) {
        const Found found = rule.find(subject);
        if (!found) continue;
        all.push_back({rule.name, found->key, subject.shown(found->key), found->text, found->cure,
                       std::find(accepted.begin(), accepted.end(), rule.name) != accepted.end()});
    }
    return all;
}

std::vector<std::string> warningNames() {
    std::vector<std::string> names;
    for (const Rule& rule : kRules) names.emplace_back(rule.name);
    return names;
}

}  // namespace vkdose
