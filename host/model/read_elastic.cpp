// The contacts of spheres whose materials have moduli.
#include "host/law/eepa.h"
#include "host/law/hertz.h"
#include "host/law/jkr.h"
#include "host/model/read_laws.h"

namespace vkdose {
namespace {

/// One pair of materials as its table states it. The ratios of sliding follow from the moduli.
struct StatedContact {
    double restitution = 1;
    ContactParameters rest;  ///< friction, the ratios and what EEPA and JKR have beside
};

/// Tells what does not go together, where the table gives one of its keys.
void tellFaults(CaseReader& reader, Section& section, const Law& law, const ContactParameters& p) {
    for (const ParameterFault& fault : law.faultsOf(p))
        for (const ParameterFault::At& at : fault.at) {
            if (!section.has(at.key)) continue;
            reader.fault(section.path(at.key), at.problem, fault.remedy);
            break;
        }
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
    for (const char* key : {"youngs_modulus", "poisson_ratio"}) {
        section.know(key);
        if (section.has(key))
            reader.fault(section.path(key), "is of a material, not of a pair", "give it in [[material]]");
    }
}

StatedContact mixture(const StatedContact& a, const StatedContact& b, const Law& law) {
    StatedContact mixed;
    mixed.restitution = geometricMean(a.restitution, b.restitution);
    for (const auto& key : parametersOf(law))
        mixed.rest.*key.member = geometricMean(a.rest.*key.member, b.rest.*key.member);
    return mixed;
}

StatedContact readClass(CaseReader& reader, Section& section, const StatedContact* parent, const Law& law) {
    StatedContact s;
    s.restitution =
        section.number("restitution", parent != nullptr ? std::optional(parent->restitution) : std::nullopt);
    if ((s.restitution == 0 || s.restitution > 1) && section.has("restitution"))
        reader.fault(section.path("restitution"), "is no share of a speed that spheres rebound with",
                     "give a number > 0 and <= 1");
    for (const auto& key : parametersOf(law))
        s.rest.*key.member =
            section.number(key.name, parent != nullptr ? std::optional(parent->rest.*key.member) : std::nullopt);
    tellFaults(reader, section, law, s.rest);
    return s;
}

/// What there is to tell of a pair.
std::string derivationOf(const LawTables& in, const PairSection& pair, const StatedContact& s,
                         const ContactParameters& p, const Law& law) {
    if (!pair.isNamed()) return "";
    std::string rest;
    if (pair.stated.source == PairSource::Mixture) {
        rest = mixedWords(pair, s.rest, parametersOf(law));
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

void readElastic(const LawTables& in, const Law& law) {
    CaseReader& reader = in.reader;
    Case& c = in.c;
    for (const PairSection& p : in.pairs)
        if (p.isNamed()) refuseModuli(reader, *p.section);
    const double damping = in.settle.number("damping_factor");
    const std::vector<Elasticity> moduli = allModuli(in);
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
        made = ofModuli(law.kind(), moduli[std::size_t(a)], moduli[std::size_t(b)], s.restitution, s.rest);
        tell(in, p, derivationOf(in, p, s, made, law));
    }
    c.settlingLaw = c.dosingLaw;
    for (ContactParameters& p : c.settlingLaw.pairs) p.dampingShare *= damping;
}

}  // namespace vkdose
