#include "host/model/contact_pairs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/core/closest_word.h"
#include "host/core/printable.h"

namespace vkdose {
namespace {

const std::string& nameOf(const World& world, int material) {
    return world.materials.at(static_cast<std::size_t>(material)).name;
}

/// Index of the material of that name, if there is one.
std::optional<int> materialNamed(const World& world, std::string_view name) {
    for (std::size_t m = 0; m < world.materials.size(); ++m)
        if (world.materials[m].name == name) return static_cast<int>(m);
    return {};
}

/// The tables that have a name of their own.
const char* ownName(MaterialPair p) {
    if (p.a != kFirstPowder && p.b != kFirstPowder) return nullptr;
    const int other = p.a + p.b;
    return other == kFirstPowder ? "" : other == kWallMaterial ? "wall" : other == kCoilMaterial ? "coil" : nullptr;
}

void checkPairTable(CaseReader& reader, Section& contact, const World& world, const std::string& key) {
    const std::size_t hyphen = key.find('-');
    const std::string names[] = {key.substr(0, hyphen), key.substr(hyphen + 1)};
    const std::string path = "contact." + key;
    std::vector<std::string> known;
    for (const Material& m : world.materials) known.push_back(m.name);
    int index[2] = {0, 0};
    for (int side = 0; side < 2; ++side) {
        const std::optional<int> found = materialNamed(world, names[side]);
        if (!found) {
            const std::string meant = closestWord(names[side], known);
            std::string all;
            for (const std::string& k : known) all += (all.empty() ? "" : ", ") + k;
            return reader.fault(path, fmt::format("there is no material \"{}\"", printable(names[side])),
                                meant.empty() ? "known: " + all : fmt::format("did you mean \"{}\"?", meant));
        }
        index[side] = *found;
    }
    const MaterialPair pair{index[0], index[1]};
    const auto isPowder = [&](int m) { return world.materials[static_cast<std::size_t>(m)].powder; };
    if (!isPowder(pair.a) && !isPowder(pair.b))
        return reader.fault(path, "is of two things that no powder is made of, which have no contact", "remove it");
    if (const char* own = ownName(pair))
        return reader.fault(path, "is a pair with a table of its own",
                            fmt::format("write [contact{}{}]", *own == '\0' ? "" : ".", own));
    if (names[0] != names[1] && contact.has(names[1] + "-" + names[0]) && names[0] > names[1])
        reader.fault(path, fmt::format("is there as {}-{} too, and the order of the names is free", names[1], names[0]),
                     "join the two tables");
}

}  // namespace

std::vector<StatedPair> pairsToState(const World& world) {
    const MaterialPair first{kFirstPowder, kFirstPowder};
    std::vector<StatedPair> pairs{{first}};
    std::vector<int> further, walls;
    for (int m = 1; m < int(world.materials.size()); ++m)
        (world.materials[std::size_t(m)].powder ? further : walls).push_back(m);
    for (const int wall : walls) {
        const MaterialPair parent = wall == kWallMaterial ? first : MaterialPair{kFirstPowder, kWallMaterial};
        pairs.push_back({{kFirstPowder, wall}, PairSource::Parent, parent});
    }
    for (const int powder : further) pairs.push_back({{powder, powder}, PairSource::Parent, first});
    for (const int powder : further)
        for (const int wall : walls) pairs.push_back({{powder, wall}, PairSource::Parent, {kFirstPowder, wall}});
    for (std::size_t k = 0; k < further.size(); ++k) {
        pairs.push_back({{kFirstPowder, further[k]}, PairSource::Mixture});
        for (std::size_t j = 0; j < k; ++j) pairs.push_back({{further[j], further[k]}, PairSource::Mixture});
    }
    return pairs;
}

std::vector<MaterialPair> statedPairs(const World& world) {
    std::vector<MaterialPair> pairs;
    for (const StatedPair& p : pairsToState(world)) pairs.push_back(p.pair);
    return pairs;
}

std::string contactKey(CaseReader& reader, const World& world, MaterialPair pair) {
    if (const char* own = ownName(pair)) return own;
    std::string other = nameOf(world, pair.b) + "-" + nameOf(world, pair.a);
    if (reader.root().table("contact").has(other)) return other;
    return nameOf(world, pair.a) + "-" + nameOf(world, pair.b);
}

std::string contactPath(CaseReader& reader, const World& world, MaterialPair pair) {
    const std::string key = contactKey(reader, world, pair);
    return key.empty() ? "contact" : "contact." + key;
}

void checkPairTables(CaseReader& reader, Section& contact, const World& world) {
    const Node* node = reader.root().node("contact");
    if (node == nullptr || node->kind != Node::Kind::Table) return;
    for (const Node& child : node->children) {
        if (child.kind != Node::Kind::Table || child.key.find('-') == std::string::npos) continue;
        contact.know(child.key);
        checkPairTable(reader, contact, world, child.key);
    }
}

double harmonicMean(double a, double b) {
    if (a == b) return a;
    return 2 * a * b / (a + b);
}

double geometricMean(double a, double b) {
    return a == b ? a : std::sqrt(a * b);
}

}  // namespace vkdose
