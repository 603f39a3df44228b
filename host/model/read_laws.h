#pragma once
// What the readers of the laws of contacts share: read_contact.cpp, read_luding.cpp, read_elastic.cpp.

#include <fmt/format.h>

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "host/law/law.h"
#include "host/model/case_sections.h"
#include "host/model/contact_pairs.h"

namespace vkdose {

/// A pair of materials with the table that states its contacts, or would.
struct PairSection {
    StatedPair stated;
    Section* section = nullptr;
    bool given = false;  ///< the file has the table

    std::size_t index() const { return PairTable::index(stated.pair); }
    std::size_t parent() const { return PairTable::index(stated.parent); }
    /// It is named by two materials, [contact.A-B], not by [contact], [contact.wall] or [contact.coil].
    bool isNamed() const { return section->path().find('-') != std::string::npos; }
};

/// The tables of the contacts of a case, in the order of pairsToState.
struct LawTables {
    CaseReader& reader;
    std::vector<PairSection> pairs;
    Section& settle;
    const MaterialTables& materials;
    Case& c;
    double scale = 1;  ///< size of the spheres over that of the grains that the parameters are of

    Section& contact() const { return *pairs.front().section; }
    /// Room for something of each pair, by PairTable::index.
    std::size_t size() const { return PairTable::index({int(c.world.materials.size()), 0}); }
};

/// Tells of keys that belong to another law than the case's.
void refuseKeys(CaseReader& reader, Section& section, std::initializer_list<std::string_view> keys,
                std::string_view law);

/// Puts words of how a pair came to its values into the resolved case, and among what is told. A resolved case that has
/// such words keeps them.
void tell(const LawTables& in, const PairSection& pair, std::string words);
/// What there is to tell of a pair that takes all from another one.
std::string inheritanceOf(const LawTables& in, const PairSection& pair);
/// "geometric means of cocoa-cocoa and sugar-sugar"
std::string meansOf(const LawTables& in, const PairSection& pair, const char* kind);

/// A key of a pair that two powders mix, and its member of T.
template <class T>
struct MixedKey {
    std::string_view name;
    double T::*member;
};

/// The keys of a pair whose values are parameters as they stand: those that all laws have, then those of the law.
std::vector<MixedKey<ContactParameters>> parametersOf(const Law& law);

/// Those keys that the table of the pair does not give, with their values: "friction = 0.3, kr_over_k = 0.286".
template <class T, class Keys>
std::string mixedWords(const PairSection& pair, const T& values, const Keys& keys) {
    std::string text;
    for (const MixedKey<T>& key : keys)
        if (!pair.section->has(key.name))
            text += fmt::format("{}{} = {:.6g}", text.empty() ? "" : ", ", key.name, values.*key.member);
    return text;
}

void readLuding(const LawTables& in);
/// The laws of spheres whose materials have moduli.
void readElastic(const LawTables& in, const Law& law);

}  // namespace vkdose
