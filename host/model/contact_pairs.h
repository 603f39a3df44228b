#pragma once
// The pairs of materials whose contacts a case states, and what stands for a pair that it does not state.

#include <string>
#include <vector>

#include "host/model/case_reader.h"
#include "host/model/contact_targets.h"
#include "host/model/world.h"

namespace vkdose {

/// From where a pair takes what its table does not state.
enum class PairSource {
    None,     ///< the first powder with itself: all must be stated
    Parent,   ///< another pair
    Mixture,  ///< two powders: the means of each of them with itself
};

struct StatedPair {
    MaterialPair pair;
    PairSource source = PairSource::None;
    MaterialPair parent{};
};

/// All pairs of two powders, and of a powder with a wall or a body, in an order in which each comes behind those that
/// it takes from: the first powder with itself, the walls, the coil and further materials; each further powder with
/// itself and with those; two different powders.
std::vector<StatedPair> pairsToState(const World& world);
std::vector<MaterialPair> statedPairs(const World& world);

/// Key of a pair's table in [contact], as the file has it: "cocoa-steel". Empty for [contact] itself.
std::string contactKey(CaseReader& reader, const World& world, MaterialPair pair);
/// Path of that table: "contact.wall".
std::string contactPath(CaseReader& reader, const World& world, MaterialPair pair);

/// Refuses tables of pairs that cannot be: of unknown materials, of two walls, given in both orders, or that have a
/// name of their own.
void checkPairTables(CaseReader& reader, Section& contact, const World& world);

/// What springs or dashpots in series have together, of two halves each twice as stiff: 2 a b/(a + b).
double harmonicMean(double a, double b);
/// sqrt(a b), a if they are equal.
double geometricMean(double a, double b);

}  // namespace vkdose
