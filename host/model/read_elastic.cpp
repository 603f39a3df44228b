// The contacts of spheres whose materials have moduli: Hertz-Mindlin, EEPA, JKR.
#include "host/model/normal_law.h"
#include "host/model/read_laws.h"

namespace vkdose {
namespace {

/// One pair of materials as its table states it. The ratios of sliding follow from the moduli.
struct StatedContact {
    double restitution = 1;
    ContactParameters rest;  ///< friction, the ratios and what EEPA and JKR have beside
};

constexpr double kSteepest = 10;  ///< largest exponent of EEPA's adhesive branch

/// What EEPA has beside the elastic law.
void checkEepaClass(CaseReader& reader, Section& section, const ContactParameters& p) {
    if (p.plasticityRatio >= 1 && section.has("plasticity_ratio"))
        reader.fault(section.path("plasticity_ratio"), "lets nothing of the overlap spring back",
                     "give a number >= 0 and < 1, 0.5 for unloading twice as stiff as loading");
    if (p.adhesionExponent < 1 && section.has("adhesion_exponent"))
        reader.fault(section.path("adhesion_exponent"), "makes the pull end abruptly where the contact opens",
                     "give a number >= 1, as a rule 1.5");
    if (p.adhesionExponent > kSteepest && section.has("adhesion_exponent"))
        reader.fault(section.path("adhesion_exponent"),
                     "lets the force from which friction is counted grow without measure beyond the pole",
                     fmt::format("give at most {}, as a rule 1.5", kSteepest));
    if (p.surfaceEnergy == 0 || p.plasticityRatio > 0) return;
    const char* remedy = "give a plasticity_ratio > 0, or a surface energy of 0";
    if (section.has("surface_energy"))
        reader.fault(section.path("surface_energy"),
                     "acts on flattened contacts, and with plasticity_ratio = 0 none is", remedy);
    else if (section.has("plasticity_ratio"))
        reader.fault(section.path("plasticity_ratio"),
                     fmt::format("flattens no contact, and its surface_energy = {:.6g} acts on flattened ones alone",
                                 p.surfaceEnergy),
                     remedy);
}

/// Reads the moduli that stand in [contact], [contact.wall] and [contact.coil]: those of the material on the other
/// side.
Elasticity readModuli(CaseReader& reader, Section& section, const Elasticity* parent) {
    Elasticity m;
    m.modulus = section.number("youngs_modulus", parent != nullptr ? std::optional(parent->modulus) : std::nullopt);
    m.poisson = section.number("poisson_ratio", parent != nullptr ? std::optional(parent->poisson) : std::nullopt);
    if (m.poisson > 0.5 && section.has("poisson_ratio"))
        reader.fault(section.path("poisson_ratio"), "is that of no solid", "give 0 to 0.5");
    return m;
}

/// The moduli of each material.
std::vector<Elasticity> allModuli(const LawTables& in) {
    const std::size_t count = in.c.world.materials.size();
    std::vector<Elasticity> moduli(count);
    for (int m = 0; m < kUsualMaterials; ++m)
        for (const PairSection& p : in.pairs)
            if (p.stated.pair.a == kFirstPowder && p.stated.pair.b == m)
                moduli[std::size_t(m)] =
                    readModuli(in.reader, *p.section, m == 0 ? nullptr : &moduli[std::size_t(m - 1)]);
    for (std::size_t m = kUsualMaterials; m < count; ++m)
        if (const auto table = in.materials.find(int(m)); table != in.materials.end())
            moduli[m] = readModuli(in.reader, *table->second, nullptr);
    for (std::size_t k = 0; k < in.c.furtherPowders.size(); ++k) {
        const int material = in.c.furtherPowders[k].material;
        if (in.materials.contains(material)) continue;
        const std::string& name = in.c.world.materials[std::size_t(material)].name;
        in.reader.fault(fmt::format("powder[{}].name", k),
                        fmt::format("is of \"{}\", whose moduli are not known", name),
                        fmt::format("add [[material]] with name = \"{}\", youngs_modulus and poisson_ratio", name));
    }
    return moduli;
}

/// A pair of two names has no moduli of its own.
void refuseModuli(CaseReader& reader, Section& section) {
    for (const char* key : kElasticKeys) {
        section.know(key);
        if (section.has(key))
            reader.fault(section.path(key), "is of a material, not of a pair", "give it in [[material]]");
    }
}

constexpr MixedKey<ContactParameters> kMixed[] = {
    {"friction", &ContactParameters::mu},
    {"rolling_friction", &ContactParameters::muR},
    {"kr_over_k", &ContactParameters::kr},
    {"damping_r_ratio", &ContactParameters::gammaR},
    {"torsion_friction", &ContactParameters::muTo},
    {"kto_over_k", &ContactParameters::kTo},
    {"damping_to_ratio", &ContactParameters::gammaTo},
};
constexpr MixedKey<ContactParameters> kMixedAdhesion[] = {{"surface_energy", &ContactParameters::surfaceEnergy}};
constexpr MixedKey<ContactParameters> kMixedPlastic[] = {
    {"plasticity_ratio", &ContactParameters::plasticityRatio},
    {"pull_off_force", &ContactParameters::constantPull},
    {"adhesion_exponent", &ContactParameters::adhesionExponent},
};

/// The keys that a pair has under a law, but for the restitution.
std::vector<MixedKey<ContactParameters>> keysOf(NormalLaw law) {
    std::vector<MixedKey<ContactParameters>> keys(std::begin(kMixed), std::end(kMixed));
    if (law == NormalLaw::HertzMindlin) return keys;
    keys.insert(keys.end(), std::begin(kMixedAdhesion), std::end(kMixedAdhesion));
    if (law == NormalLaw::Eepa) keys.insert(keys.end(), std::begin(kMixedPlastic), std::end(kMixedPlastic));
    return keys;
}

StatedContact mixture(const StatedContact& a, const StatedContact& b, NormalLaw law) {
    StatedContact mixed;
    mixed.restitution = geometricMean(a.restitution, b.restitution);
    for (const auto& key : keysOf(law)) mixed.rest.*key.member = geometricMean(a.rest.*key.member, b.rest.*key.member);
    return mixed;
}

StatedContact readClass(CaseReader& reader, Section& section, const StatedContact* parent, NormalLaw law) {
    StatedContact s;
    s.restitution =
        section.number("restitution", parent != nullptr ? std::optional(parent->restitution) : std::nullopt);
    if ((s.restitution == 0 || s.restitution > 1) && section.has("restitution"))
        reader.fault(section.path("restitution"), "is no share of a speed that spheres rebound with",
                     "give a number > 0 and <= 1");
    for (const auto& key : keysOf(law))
        s.rest.*key.member =
            section.number(key.name, parent != nullptr ? std::optional(parent->rest.*key.member) : std::nullopt);
    if (law == NormalLaw::Eepa) checkEepaClass(reader, section, s.rest);
    return s;
}

/// What there is to tell of a pair.
std::string derivationOf(const LawTables& in, const PairSection& pair, const StatedContact& s,
                         const ContactParameters& p, NormalLaw law) {
    if (!pair.isNamed()) return "";
    std::string rest;
    if (pair.stated.source == PairSource::Mixture) {
        rest = mixedWords(pair, s.rest, keysOf(law));
        if (!pair.section->has("restitution"))
            rest = fmt::format("restitution = {:.6g}{}{}", s.restitution, rest.empty() ? "" : ", ", rest);
        if (!rest.empty()) rest += ": " + meansOf(in, pair, "geometric");
    } else if (!pair.given) {
        rest = "else " + inheritanceOf(in, pair);
    }
    if (rest.empty() && pair.section->has("derived")) return "";  // of the case that was resolved
    return fmt::format("E* = {:.6g} Pa from the moduli of the two{}{}", p.modulus, rest.empty() ? "" : "; ", rest);
}

}  // namespace

void readElastic(const LawTables& in, NormalLaw law) {
    CaseReader& reader = in.reader;
    Case& c = in.c;
    for (const PairSection& p : in.pairs) {
        refuseKeys(reader, *p.section, kLudingKeys, "luding");
        if (!p.isNamed()) refuseKeys(reader, *p.section, {"derived"}, "luding");
        if (law != NormalLaw::Eepa) refuseKeys(reader, *p.section, kPlasticKeys, "eepa");
        if (law == NormalLaw::HertzMindlin) refuseKeys(reader, *p.section, kAdhesiveKeys, "jkr");
        if (p.isNamed()) refuseModuli(reader, *p.section);
        refusePairKeys(reader, p);
    }
    refuseKeys(reader, in.contact(), {"soften"}, "luding");
    refuseKeys(reader, in.settle, {"kc_over_k", "wall_kc_over_k", "coil_kc_over_k", "elastic"}, "luding");
    const double damping = in.settle.number("damping_factor");
    const std::vector<Elasticity> moduli = allModuli(in);
    const auto between = law == NormalLaw::Eepa  ? elastoPlasticAdhesive
                         : law == NormalLaw::Jkr ? elasticAdhesive
                                                 : hertzMindlin;
    std::vector<StatedContact> stated(in.size());
    for (const PairSection& p : in.pairs) {
        const auto [a, b] = p.stated.pair;
        StatedContact parent;
        if (p.stated.source == PairSource::Parent) parent = stated[p.parent()];
        if (p.stated.source == PairSource::Mixture)
            parent = mixture(stated[PairTable::index({a, a})], stated[PairTable::index({b, b})], law);
        StatedContact& s = stated[p.index()];
        s = readClass(reader, *p.section, p.stated.source == PairSource::None ? nullptr : &parent, law);
        ContactParameters& made = c.dosingLaw.of(p.stated.pair);
        made = between(moduli[std::size_t(a)], moduli[std::size_t(b)], s.restitution, s.rest);
        tell(in, p, derivationOf(in, p, s, made, law));
    }
    c.settlingLaw = c.dosingLaw;
    for (ContactParameters& p : c.settlingLaw.pairs) p.dampingShare *= damping;
}

}  // namespace vkdose
