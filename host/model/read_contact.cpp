// The table [contact] and the adhesion of [settle].
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "host/model/bed_weight.h"
#include "host/model/case_sections.h"
#include "host/model/contact_targets.h"
#include "host/model/normal_law.h"
#include "host/model/particles.h"
#include "host/model/read_user_law.h"
#include "host/model/restitution.h"
#include "host/model/stability.h"

namespace vkdose {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// One class of contacts as its table states it, together with what it takes from the class above it.
struct Stated {
    Ratios ratios{};
    ContactTargets targets;
};

void refuseBoth(CaseReader& reader, const Section& section, const char* key, const char* other) {
    if (section.has(key) && section.has(other))
        reader.fault(section.path(key), fmt::format("stands beside {}, which says the same otherwise", other),
                     fmt::format("give {} or {}, not both", key, other));
}

/// A target that the table states; its value is left out of the resolved case, which has what it led to.
std::optional<double> target(Section& section, const char* key) {
    if (!section.has(key)) {
        section.know(key);
        return {};
    }
    const double value = section.number(key);
    section.forget(key);
    return value;
}

void readStiffness(CaseReader& reader, Section& section, ContactTargets& t) {
    refuseBoth(reader, section, "contact_duration_s", "k");
    refuseBoth(reader, section, "overlap_under_bed", "k");
    refuseBoth(reader, section, "overlap_under_bed", "contact_duration_s");
    const auto duration = target(section, "contact_duration_s"), overlap = target(section, "overlap_under_bed");
    if (!section.has("k") && !duration && !overlap) return;
    t.duration = duration;
    t.overlap = overlap;
}

void readAdhesion(CaseReader& reader, Section& section, ContactTargets& t) {
    refuseBoth(reader, section, "bond_number", "kc_over_k");
    const auto bond = target(section, "bond_number");
    if (section.has("kc_over_k") || bond) {
        t.bond = bond;
        t.bondUnderBed = false;
    }
    if (!section.has("bond_load")) {
        section.know("bond_load");
        return;
    }
    t.bondUnderBed = section.choice("bond_load") == 1;
    section.forget("bond_load");
    if (!t.bond)
        reader.fault(section.path("bond_load"), "says after which load a bond_number holds, and there is none",
                     "give bond_number, or leave it out");
}

void readDamping(CaseReader& reader, Section& section, ContactTargets& t) {
    refuseBoth(reader, section, "restitution", "damping");
    const auto restitution = target(section, "restitution");
    if (section.has("damping") || restitution) {
        t.restitution = restitution;
        t.speed = 0;
    }
    if (restitution && *restitution == 0)
        reader.fault(section.path("restitution"), "is that of contacts that creep apart and never rebound",
                     "give a number > 0, 0.05 for hardly any rebound");
    if (restitution && *restitution > 1)
        reader.fault(section.path("restitution"), "lets spheres rebound faster than they came",
                     "give a number > 0 and <= 1");
    const auto speed = target(section, "restitution_speed");
    if (speed) t.speed = *speed;
    if (speed && !t.restitution)
        reader.fault(section.path("restitution_speed"), "says at which speed a restitution holds, and there is none",
                     "give restitution, or leave it out");
}

/// Reads one class; keys that are not there come from `parent`, or from the defaults when there is none. A parameter
/// that a target will set has no value in the file. Until then it stands at one that keeps its place in the resolved
/// case.
Stated readClass(CaseReader& reader, Section& section, const Stated* parent) {
    static constexpr double kUnset = 1;
    Stated stated;
    if (parent != nullptr) stated.targets = parent->targets;
    ContactTargets& t = stated.targets;
    readStiffness(reader, section, t);
    readAdhesion(reader, section, t);
    readDamping(reader, section, t);

    const auto key = [&](const char* name, double Ratios::*member, std::optional<double> fallback = {}) {
        if (parent != nullptr) fallback = parent->ratios.*member;
        return section.number(name, fallback);
    };
    const auto unless = [](bool set) { return set ? std::optional<double>(kUnset) : std::nullopt; };
    Ratios& r = stated.ratios;
    r.k = key("k", &Ratios::k, unless(t.duration || t.overlap));
    r.k1 = key("k1_over_k", &Ratios::k1);
    r.kc = key("kc_over_k", &Ratios::kc, unless(t.bond.has_value()));
    // Without plasticity (k1 = k) the depth has no effect, so that it may be left out.
    r.plasticity = key("plasticity_depth", &Ratios::plasticity, r.k1 < 1 ? std::optional<double>() : 0.0);
    r.damping = key("damping", &Ratios::damping, unless(t.restitution.has_value()));
    r.mu = key("friction", &Ratios::mu);
    r.kt = key("kt_over_k", &Ratios::kt);
    r.dampingT = key("damping_t_ratio", &Ratios::dampingT);
    r.muR = key("rolling_friction", &Ratios::muR);
    r.kr = key("kr_over_k", &Ratios::kr);
    r.dampingR = key("damping_r_ratio", &Ratios::dampingR);
    r.muTo = key("torsion_friction", &Ratios::muTo);
    r.kTo = key("kto_over_k", &Ratios::kTo);
    r.dampingTo = key("damping_to_ratio", &Ratios::dampingTo);
    return stated;
}

/// States the parameters of one class as they are, for the resolved case.
void recordChanged(Section& section, const Ratios& r) {
    section.record("k", r.k);
    section.record("kc_over_k", r.kc);
    section.record("damping", r.damping);
    section.record("plasticity_depth", r.plasticity);
}

/// Reads by how much the spheres are to be softer.
double readSoftness(CaseReader& reader, Section& contact) {
    const double s = contact.number("soften");
    if (s < 1) reader.fault("contact.soften", "makes the spheres harder", "give 1 or more, or a larger k");
    if (!(s > 1)) return 1;
    contact.record("soften", 1.0);  // read again, the case is not softened a second time
    return s;
}

double fillMass(const Case& c) {
    if (!c.filling.list) return c.filling.mass;
    double mass = 0;
    for (const double r : c.filling.list->radius) mass += sphereMass(c.world.density(), r);
    return mass;
}

/// The contact of mean spheres that the targets of a class are meant for.
MeanContact meanContact(const Case& c, ContactClass kind, double radius) {
    MeanContact m;
    const double density = c.world.density();
    const double other = kind == ContactClass::ParticleParticle ? radius : kInfinity;
    const bool round = kind == ContactClass::ParticleCoil && c.world.coil && c.world.coilWireCurved;
    m.radius = radius;
    m.mass = reducedMass(density, radius, other);
    m.reduced = reducedSize(radius, round ? c.world.coil->wireRadius : other);
    m.weight = sphereMass(density, radius) * glm::length(c.world.gravity);
    const double down = -c.world.gravity.y;
    if (c.canister && down > 0)
        m.load = loadUnderBed(density, down, bedDepth(*c.canister, fillMass(c), density), radius);
    return m;
}

/// What became of the targets, in words: "damping = 0.0825 kg/s from restitution = 0.45".
std::string derivation(const ContactTargets& t, const Ratios& r) {
    std::string text;
    const auto add = [&](const std::string& what) { text += (text.empty() ? "" : "; ") + what; };
    if (t.duration) add(fmt::format("k = {:.6g} N/m from contact_duration_s = {:.6g}", r.k, *t.duration));
    if (t.overlap) add(fmt::format("k = {:.6g} N/m from overlap_under_bed = {:.6g}", r.k, *t.overlap));
    if (t.bond)
        add(fmt::format("kc_over_k = {:.6g} from bond_number = {:.6g} after {}", r.kc, *t.bond,
                        t.bondUnderBed ? "the bed's weight" : "a load beyond the plastic limit"));
    if (t.restitution)
        add(fmt::format("damping = {:.6g} kg/s from restitution = {:.6g} {}", r.damping, *t.restitution,
                        t.speed > 0 ? fmt::format("at {:.6g} m/s", t.speed) : "of slow impacts"));
    return text;
}

constexpr std::array<const char*, kContactClasses> kClassPaths{"contact", "contact.wall", "contact.coil"};

/// Tells of keys that belong to another law than the case's.
void refuseKeys(CaseReader& reader, Section& section, std::initializer_list<const char*> keys, const char* law) {
    for (const char* key : keys) {
        section.know(key);
        if (section.has(key))
            reader.fault(section.path(key), fmt::format("is a key of the law {}", law),
                         fmt::format("remove it, or give contact.law = \"{}\"", law));
    }
}

using Tables = std::array<Section*, kContactClasses>;

constexpr std::initializer_list<const char*> kLudingKeys{
    "k",           "contact_duration_s", "overlap_under_bed", "k1_over_k", "kc_over_k",
    "bond_number", "bond_load",          "plasticity_depth",  "damping",   "restitution_speed",
    "derived",     "kt_over_k",          "damping_t_ratio"};
constexpr std::initializer_list<const char*> kElasticKeys{"youngs_modulus", "poisson_ratio"};
constexpr std::initializer_list<const char*> kPlasticKeys{"plasticity_ratio", "pull_off_force", "adhesion_exponent"};
constexpr std::initializer_list<const char*> kAdhesiveKeys{"surface_energy"};

/// One class of contacts of a law of spheres with moduli, as its table states it.
struct StatedHertz {
    Elasticity material;
    double restitution = 1;
    ContactParameters rest;  ///< friction, the ratios and what EEPA and JKR have beside
};

/// What EEPA has beside the elastic law.
void checkEepaClass(CaseReader& reader, Section& section, const ContactParameters& p) {
    if (p.plasticityRatio >= 1 && section.has("plasticity_ratio"))
        reader.fault(section.path("plasticity_ratio"), "lets nothing of the overlap spring back",
                     "give a number >= 0 and < 1, 0.5 for unloading twice as stiff as loading");
    if (p.adhesionExponent < 1 && section.has("adhesion_exponent"))
        reader.fault(section.path("adhesion_exponent"), "makes the pull end abruptly where the contact opens",
                     "give a number >= 1, as a rule 1.5");
    if (p.surfaceEnergy > 0 && p.plasticityRatio == 0 && section.has("surface_energy"))
        reader.fault(section.path("surface_energy"),
                     "acts on flattened contacts, and with plasticity_ratio = 0 none is",
                     "give a plasticity_ratio > 0, or a surface energy of 0");
}

StatedHertz readHertzClass(CaseReader& reader, Section& section, const StatedHertz* parent, NormalLaw law) {
    const auto key = [&](const char* name, std::optional<double> inherited) {
        return section.number(name, parent != nullptr ? inherited : std::nullopt);
    };
    const auto ratio = [&](const char* name, double ContactParameters::*member) {
        return key(name, parent != nullptr ? std::optional(parent->rest.*member) : std::nullopt);
    };
    StatedHertz h;
    const StatedHertz& above = parent != nullptr ? *parent : h;
    h.material.modulus = key("youngs_modulus", above.material.modulus);
    h.material.poisson = key("poisson_ratio", above.material.poisson);
    if (h.material.poisson > 0.5 && section.has("poisson_ratio"))
        reader.fault(section.path("poisson_ratio"), "is that of no solid", "give 0 to 0.5");
    h.restitution = key("restitution", above.restitution);
    if ((h.restitution == 0 || h.restitution > 1) && section.has("restitution"))
        reader.fault(section.path("restitution"), "is no share of a speed that spheres rebound with",
                     "give a number > 0 and <= 1");
    h.rest.mu = ratio("friction", &ContactParameters::mu);
    h.rest.muR = ratio("rolling_friction", &ContactParameters::muR);
    h.rest.kr = ratio("kr_over_k", &ContactParameters::kr);
    h.rest.gammaR = ratio("damping_r_ratio", &ContactParameters::gammaR);
    h.rest.muTo = ratio("torsion_friction", &ContactParameters::muTo);
    h.rest.kTo = ratio("kto_over_k", &ContactParameters::kTo);
    h.rest.gammaTo = ratio("damping_to_ratio", &ContactParameters::gammaTo);
    if (law == NormalLaw::HertzMindlin) return h;
    h.rest.surfaceEnergy = ratio("surface_energy", &ContactParameters::surfaceEnergy);
    if (law != NormalLaw::Eepa) return h;
    h.rest.plasticityRatio = ratio("plasticity_ratio", &ContactParameters::plasticityRatio);
    h.rest.constantPull = ratio("pull_off_force", &ContactParameters::constantPull);
    h.rest.adhesionExponent = ratio("adhesion_exponent", &ContactParameters::adhesionExponent);
    checkEepaClass(reader, section, h.rest);
    return h;
}

/// The laws of spheres whose materials have moduli.
void readHertz(CaseReader& reader, const Tables& sections, Section& settle, NormalLaw law, Case& c) {
    for (Section* section : sections) {
        refuseKeys(reader, *section, kLudingKeys, "luding");
        if (law != NormalLaw::Eepa) refuseKeys(reader, *section, kPlasticKeys, "eepa");
        if (law == NormalLaw::HertzMindlin) refuseKeys(reader, *section, kAdhesiveKeys, "jkr");
    }
    refuseKeys(reader, *sections[0], {"soften"}, "luding");
    refuseKeys(reader, settle, {"kc_over_k", "wall_kc_over_k", "coil_kc_over_k", "elastic"}, "luding");
    const double damping = settle.number("damping_factor");
    std::array<StatedHertz, kContactClasses> stated;
    for (int i = 0; i < kContactClasses; ++i)
        stated[i] = readHertzClass(reader, *sections[i], i == 0 ? nullptr : &stated[i - 1], law);
    const auto between = law == NormalLaw::Eepa  ? elastoPlasticAdhesive
                         : law == NormalLaw::Jkr ? elasticAdhesive
                                                 : hertzMindlin;
    for (int i = 0; i < kContactClasses; ++i)
        c.dosingLaw.between(0, i) =
            between(stated[0].material, stated[i].material, stated[i].restitution, stated[i].rest);
    c.settlingLaw = c.dosingLaw;
    for (ContactParameters& p : c.settlingLaw.pairs) p.dampingShare *= damping;
}

void readLuding(CaseReader& reader, const Tables& sections, Section& settle, double meanRadius, Case& c) {
    for (Section* section : sections) {
        refuseKeys(reader, *section, kElasticKeys, "hertz-mindlin");
        refuseKeys(reader, *section, kPlasticKeys, "eepa");
        refuseKeys(reader, *section, kAdhesiveKeys, "jkr");
    }
    std::array<Stated, kContactClasses> stated;
    for (int i = 0; i < kContactClasses; ++i)
        stated[i] = readClass(reader, *sections[i], i == 0 ? nullptr : &stated[i - 1]);
    c.softened = readSoftness(reader, *sections[0]);
    std::string missedAbove;
    for (int i = 0; i < kContactClasses; ++i) {
        Ratios& r = stated[i].ratios;
        const ContactTargets& targets = stated[i].targets;
        const auto missed = meetTargets(targets, meanContact(c, static_cast<ContactClass>(i), meanRadius), r);
        // A target that a class takes from the class above it is told there, if it is missed there too.
        const bool told = missed && missedAbove == missed->key && !sections[i]->has(missed->key);
        if (missed && !told) reader.fault(sections[i]->path(missed->key), missed->problem, missed->remedy);
        missedAbove = missed ? missed->key : "";
        std::string words;
        if (sections[i]->has("derived")) words = sections[i]->string("derived");
        if (targets.any()) words = derivation(targets, r);
        if (c.softened > 1) r.soften(c.softened);
        if (c.softened > 1 && !words.empty()) words += fmt::format("; then softened {:.6g} times", c.softened);
        if (c.softened > 1 || targets.any()) recordChanged(*sections[i], r);
        if (words.empty()) continue;
        sections[i]->record("derived", words);
        c.derivations.push_back(fmt::format("{}: {}", kClassPaths[i], words));
    }

    // While the powder settles, adhesion has a strength of its own. A class whose table gives its adhesion keeps it by
    // default, and so does every class where the case says nothing of adhesion while settling.
    const auto own = [&](int i) { return sections[i]->has("kc_over_k") || sections[i]->has("bond_number"); };
    const bool pairStated = settle.has("kc_over_k"), wallStated = settle.has("wall_kc_over_k");
    const double pairKc = settle.number("kc_over_k", stated[0].ratios.kc);
    const double wallKc = settle.number("wall_kc_over_k", own(1) || !pairStated ? stated[1].ratios.kc : pairKc);
    const bool settleStates = pairStated || wallStated;
    const double coilKc = settle.number("coil_kc_over_k", own(2) || !settleStates ? stated[2].ratios.kc : wallKc);
    const std::array<double, kContactClasses> settling{pairKc, wallKc, coilKc};
    const double damping = settle.number("damping_factor");
    const bool elastic = settle.boolean("elastic");

    c.settlingLaw = c.dosingLaw;
    for (int i = 0; i < kContactClasses; ++i) {
        c.dosingLaw.between(0, i) = stated[i].ratios.parameters(stated[i].ratios.kc);
        c.settlingLaw.between(0, i) = stated[i].ratios.parameters(settling[i]);
        c.settlingLaw.between(0, i).gamma *= damping;
        if (elastic) c.settlingLaw.between(0, i).k2Max = c.settlingLaw.between(0, i).k1;
    }
}

/// A law of the user's own: its parameters, and friction and the ratios of the springs to its stiffness.
void readUser(CaseReader& reader, const Tables& sections, Section& settle, Case& c) {
    for (Section* section : sections) {
        for (const char* key : kLudingKeys)
            if (std::string_view(key) != "kt_over_k" && std::string_view(key) != "damping_t_ratio")
                refuseKeys(reader, *section, {key}, "luding");
        refuseKeys(reader, *section, kElasticKeys, "hertz-mindlin");
        refuseKeys(reader, *section, {"restitution"}, "hertz-mindlin");
        refuseKeys(reader, *section, kPlasticKeys, "eepa");
        refuseKeys(reader, *section, kAdhesiveKeys, "jkr");
    }
    refuseKeys(reader, *sections[0], {"soften"}, "luding");
    refuseKeys(reader, settle, {"kc_over_k", "wall_kc_over_k", "coil_kc_over_k", "elastic", "damping_factor"},
               "luding");
    const std::shared_ptr<const UserLaw> law = readUserLaw(reader, *sections[0]);
    c.dosingLaw.user = law;
    for (int i = 0; i < kContactClasses; ++i) {
        Section& section = *sections[i];
        const ContactParameters* above = i == 0 ? nullptr : &c.dosingLaw.between(0, i - 1);
        ContactParameters& p = c.dosingLaw.between(0, i);
        const auto ratio = [&](const char* name, double ContactParameters::*member) {
            p.*member = section.number(name, above != nullptr ? std::optional(above->*member) : std::nullopt);
        };
        p.law = NormalLaw::User;
        ratio("friction", &ContactParameters::mu);
        ratio("kt_over_k", &ContactParameters::kt);
        ratio("damping_t_ratio", &ContactParameters::gammaT);
        ratio("rolling_friction", &ContactParameters::muR);
        ratio("kr_over_k", &ContactParameters::kr);
        ratio("damping_r_ratio", &ContactParameters::gammaR);
        ratio("torsion_friction", &ContactParameters::muTo);
        ratio("kto_over_k", &ContactParameters::kTo);
        ratio("damping_to_ratio", &ContactParameters::gammaTo);
        if (law)
            p.own = readOwn(reader, section, *law, above != nullptr ? &above->own : nullptr);
        else
            section.know("parameters");
    }
    c.settlingLaw = c.dosingLaw;
}

/// Whether the case names a file in place of a law of the program's.
bool namesFile(const Section& contact, const Node* law) {
    return contact.isString("law") && law->string.ends_with(".glsl");
}

}  // namespace

void placeContact(Section& root) {
    Section& contact = root.requiredTable("contact");
    contact.table("wall");
    contact.table("coil");
    root.table("settle");
}

void readContact(CaseReader& reader, Section& root, double meanRadius, Case& c) {
    Section& contact = root.requiredTable("contact");
    const bool user = namesFile(contact, contact.node("law"));
    const auto law = user ? NormalLaw::User : static_cast<NormalLaw>(contact.choice("law").value_or(0));
    c.dosingLaw.coulombLimit = static_cast<CoulombLimit>(contact.choice("coulomb_limit").value_or(0));
    c.dosingLaw.rollingLever = static_cast<RollingLever>(contact.choice("rolling_lever").value_or(0));
    c.world.maxOverlapRatio = contact.number("max_overlap_ratio");
    const Tables sections{&contact, &contact.table("wall"), &contact.table("coil")};
    Section& settle = root.table("settle");
    if (!user) refuseUserLaw(reader, sections);
    if (law == NormalLaw::User)
        readUser(reader, sections, settle, c);
    else if (law == NormalLaw::Luding)
        readLuding(reader, sections, settle, meanRadius, c);
    else
        readHertz(reader, sections, settle, law, c);
}

}  // namespace vkdose
