// The tables [contact]: which law, which pairs of materials, and the law of the user's own. read_luding.cpp and
// read_elastic.cpp read the other laws.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "host/law/law_keys.h"
#include "host/model/read_laws.h"
#include "host/model/read_user_law.h"
#include "host/model/scaling.h"

namespace vkdose {
namespace {

/// The parameters of two powders with each other, of those that each has with itself. Those of a law of the user's own
/// are known only where the two agree; the others are NaN.
ContactParameters mixture(const ContactParameters& a, const ContactParameters& b) {
    ContactParameters mixed = a;
    for (const auto& key : parametersOf(normalLaw(NormalLaw::User)))
        mixed.*key.member = geometricMean(a.*key.member, b.*key.member);
    for (std::size_t k = 0; k < mixed.own.size(); ++k)
        if (a.own[k] != b.own[k]) mixed.own[k] = std::numeric_limits<double>::quiet_NaN();
    return mixed;
}

/// The properties of the material that a pair's table is of: a powder with itself, or the first powder with a wall. A
/// wall has none unless it gives them, the coil and further materials have the wall's, further powders the first one's.
void readPropertiesAt(const LawTables& in, const PairSection& p, const UserLaw& law) {
    std::vector<Material>& materials = in.c.world.materials;
    const auto [a, b] = p.stated.pair;
    Material& of = materials[std::size_t(b)];
    if (of.powder ? a != b : a != kFirstPowder) {
        p.section->know("properties");
        const Node* stated = p.section->node("properties");
        if (stated == nullptr) return;
        const auto refuse = [&](const std::string& path) {
            in.reader.fault(path, "is of one material, not of this pair",
                            "give it in the table of the powder with itself, or of the first powder with the material");
        };
        refuse(p.section->path("properties"));
        for (const Node& child : stated->children) refuse(p.section->path("properties." + child.key));
        return;
    }
    const LawProperties none{};
    const LawProperties* usual = b == kFirstPowder    ? nullptr
                                 : b == kWallMaterial ? &none
                                 : of.powder          ? &materials[kFirstPowder].properties
                                                      : &materials[kWallMaterial].properties;
    of.properties = readProperties(in.reader, *p.section, law, usual);
}

/// A law of the user's own: its parameters, and friction and the ratios of the springs to its stiffness.
void readUser(const LawTables& in) {
    CaseReader& reader = in.reader;
    Case& c = in.c;
    refuseKeys(reader, in.settle, {"damping_factor"}, "luding");
    const std::vector<MixedKey<ContactParameters>> keys = parametersOf(normalLaw(NormalLaw::User));
    const std::shared_ptr<const UserLaw> law = readUserLaw(reader, in.contact());
    c.dosingLaw.user = law;
    if (law) c.world.properties = law->properties;
    for (const PairSection& p : in.pairs) {
        const auto [a, b] = p.stated.pair;
        const bool first = p.stated.source == PairSource::None;
        ContactParameters parent;
        if (p.stated.source == PairSource::Parent) parent = c.dosingLaw.of(p.stated.parent);
        if (p.stated.source == PairSource::Mixture)
            parent = mixture(c.dosingLaw.between(a, a), c.dosingLaw.between(b, b));
        ContactParameters& made = c.dosingLaw.of(p.stated.pair);
        made.law = NormalLaw::User;
        for (const auto& key : keys)
            made.*key.member = p.section->number(key.name, first ? std::nullopt : std::optional(parent.*key.member));
        if (law)
            made.own = readOwn(reader, *p.section, *law, first ? nullptr : &parent.own);
        else
            p.section->know("parameters");
        if (law)
            readPropertiesAt(in, p, *law);
        else
            p.section->know("properties");
        std::string words;
        if (p.stated.source == PairSource::Mixture) words = mixedWords(p, made, keys);
        if (!words.empty()) words += ": " + meansOf(in, p, "geometric");
        if (p.stated.source == PairSource::Parent && p.isNamed() && !p.given) words = inheritanceOf(in, p);
        tell(in, p, words);
    }
    c.settlingLaw = c.dosingLaw;
}

/// Tells of keys that are another law's.
void refuseOtherLaws(const LawTables& in, const Law& law) {
    CaseReader& reader = in.reader;
    std::set<std::string_view> known;
    for (const LawKey& own : law.keys()) known.insert(own.key.name);
    // Of the laws that have a key, the one that asks for the fewest others is told.
    std::vector<const Law*> others(laws().begin(), laws().end());
    std::stable_sort(others.begin(), others.end(),
                     [](const Law* a, const Law* b) { return a->keys().size() < b->keys().size(); });
    for (const Law* other : others)
        for (const LawKey& theirs : other->keys())
            if (known.insert(theirs.key.name).second)
                for (const PairSection& p : in.pairs) refuseKeys(reader, *p.section, {theirs.key.name}, other->word());
    const auto refuse = [&](Section& section, std::initializer_list<std::string_view> keys) {
        refuseKeys(reader, section, keys, normalLaw(NormalLaw::Luding).word());
    };
    if (law.kind() != NormalLaw::Luding) {
        for (const PairSection& p : in.pairs)
            p.isNamed() ? refuse(*p.section, {"settling_kc_over_k"}) : refuse(*p.section, {"derived"});
        refuse(in.contact(), {"soften"});
        refuse(in.settle, {"kc_over_k", "wall_kc_over_k", "coil_kc_over_k", "elastic"});
    }
    if (law.fromModuli()) return;
    for (const auto& [material, table] : in.materials)
        refuseKeys(reader, *table, {"youngs_modulus", "poisson_ratio"}, normalLaw(NormalLaw::HertzMindlin).word());
}

/// Whether the case names a file in place of a law of the program's.
bool namesFile(const Section& contact, const Node* law) {
    return contact.isString("law") && law->string.ends_with(".glsl");
}

/// The tables of all pairs, each in its place of the resolved case.
std::vector<PairSection> tablesOf(CaseReader& reader, Section& contact, const World& world) {
    std::vector<PairSection> tables;
    for (const StatedPair& stated : pairsToState(world)) {
        const std::string key = contactKey(reader, world, stated.pair);
        tables.push_back({stated, key.empty() ? &contact : &contact.table(key), key.empty() || contact.has(key)});
    }
    return tables;
}

}  // namespace

void refuseKeys(CaseReader& reader, Section& section, std::initializer_list<std::string_view> keys,
                std::string_view law) {
    for (const std::string_view key : keys) {
        section.know(key);
        if (section.has(key))
            reader.fault(section.path(key), fmt::format("is a key of the law {}", law),
                         fmt::format("remove it, or give contact.law = \"{}\"", law));
    }
}

std::vector<MixedKey<ContactParameters>> parametersOf(const Law& law) {
    std::vector<MixedKey<ContactParameters>> keys{{"friction", &ContactParameters::mu},
                                                  {"rolling_friction", &ContactParameters::muR},
                                                  {"kr_over_k", &ContactParameters::kr},
                                                  {"damping_r_ratio", &ContactParameters::gammaR},
                                                  {"torsion_friction", &ContactParameters::muTo},
                                                  {"kto_over_k", &ContactParameters::kTo},
                                                  {"damping_to_ratio", &ContactParameters::gammaTo}};
    for (const LawKey& own : law.keys())
        if (own.member != nullptr) keys.push_back({own.key.name, own.member});
    return keys;
}

void tell(const LawTables& in, const PairSection& pair, std::string words) {
    const std::string before = pair.section->has("derived") ? pair.section->string("derived") : "";
    pair.section->know("derived");
    if (words.empty()) words = before;
    if (words.empty()) return;
    pair.section->record("derived", words);
    in.c.derivations.push_back(fmt::format("{}: {}", pair.section->path(), words));
}

std::string inheritanceOf(const LawTables& in, const PairSection& pair) {
    return "as " + contactPath(in.reader, in.c.world, pair.stated.parent);
}

std::string meansOf(const LawTables& in, const PairSection& pair, const char* kind) {
    const auto name = [&](int m) { return nameOf(in.c.world, {m, m}); };
    return fmt::format("{} means of {} and {}", kind, name(pair.stated.pair.a), name(pair.stated.pair.b));
}

void placeContact(CaseReader& reader, Section& root, const World& world) {
    Section& contact = root.requiredTable("contact");
    contact.table("wall");
    contact.table("coil");
    if (world.materials.size() > std::size_t(kUsualMaterials)) (void)tablesOf(reader, contact, world);
    root.table("settle");
}

/// The limit of friction of each pair. A pair that states none has that of the pair whose other values it takes, and
/// two powders that mix have that of [contact].
void readFrictionLimits(const LawTables& in) {
    std::vector<std::size_t> limits(in.size());
    for (const PairSection& p : in.pairs) {
        std::optional<std::size_t> inherited;
        if (p.stated.source == PairSource::Parent) inherited = limits[p.parent()];
        if (p.stated.source == PairSource::Mixture) inherited = limits.front();
        const std::size_t limit = p.section->choice("coulomb_limit", inherited).value_or(0);
        limits[p.index()] = limit;
        for (ContactLaw* law : {&in.c.dosingLaw, &in.c.settlingLaw})
            law->of(p.stated.pair).coulombLimit = static_cast<CoulombLimit>(limit);
    }
}

/// From the grains to the spheres.
void scaleContacts(const LawTables& in) {
    if (in.scale == 1) return;
    for (ContactLaw* law : {&in.c.dosingLaw, &in.c.settlingLaw})
        for (ContactParameters& p : law->pairs) normalLaw(p).scaleStress(p, in.scale);
    in.c.derivations.push_back(
        fmt::format("contact: the parameters are those of grains; spheres {0:.6g} times as large have springs and "
                    "surface energies {0:.6g} times, dashpots and pull-off forces {1:.6g} times as large",
                    in.scale, in.scale * in.scale));
}

void readContact(CaseReader& reader, Section& root, const MaterialTables& tables, Case& c) {
    Section& contact = root.requiredTable("contact");
    const bool user = namesFile(contact, contact.node("law"));
    const Law& law = user ? normalLaw(NormalLaw::User) : *laws()[contact.choice("law").value_or(0)];
    c.dosingLaw.rollingLever = static_cast<RollingLever>(contact.choice("rolling_lever").value_or(0));
    c.world.maxOverlapRatio = contact.number("max_overlap_ratio");
    c.dosingLaw.pairs.resize(int(c.world.materials.size()));
    checkPairTables(reader, contact, c.world);
    const double scale = readScaling(reader, contact, law.kind(), c);
    const LawTables in{reader, tablesOf(reader, contact, c.world), root.table("settle"), tables, c, scale};
    std::vector<Section*> sections;
    for (const PairSection& p : in.pairs) sections.push_back(p.section);
    if (!user) refuseUserLaw(reader, sections);
    refuseOtherLaws(in, law);
    if (user)
        readUser(in);
    else if (law.fromModuli())
        readElastic(in, law);
    else
        readLuding(in);
    scaleContacts(in);
    readFrictionLimits(in);
}

}  // namespace vkdose
