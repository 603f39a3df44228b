// The contacts of Luding's law, and the adhesion of [settle].
#include <array>
#include <cmath>
#include <limits>

#include "host/law/law.h"
#include "host/model/bed_weight.h"
#include "host/model/contact_targets.h"
#include "host/model/powders.h"
#include "host/model/read_laws.h"
#include "host/model/stability.h"

namespace vkdose {
namespace {

/// One pair of materials as its table states it, together with what it takes from others.
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
    if (section.has("kc_over_k")) t.bondUnderBed = false;
    if (section.has("kc_over_k") || bond) t.bond = bond;
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
    if (section.has("damping")) t.speed = 0;
    if (section.has("damping") || restitution) t.restitution = restitution;
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

/// Reads one pair; keys that are not there come from `parent`, or from the defaults when there is none. A parameter
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

/// States the parameters of one pair as they are, for the resolved case.
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

/// The radius of the mean grain of each material [m]; infinite for walls, NaN while the case is at fault. A powder
/// without particles has that of the others, so that its targets lead to figures of the right order.
std::vector<double> meanRadii(const LawTables& in) {
    const std::vector<Material>& materials = in.c.world.materials;
    std::vector<double> radii(materials.size(), std::numeric_limits<double>::quiet_NaN());
    if (!in.reader.faulty()) {
        const PowderSizes sizes = powderSizes(in.c);
        for (std::size_t m = 0; m < radii.size(); ++m)
            radii[m] = (std::isfinite(sizes[m].smallest) ? sizes[m].mean : overall(sizes).mean) / in.scale;
    }
    for (std::size_t m = 0; m < radii.size(); ++m)
        if (!materials[m].powder) radii[m] = kInfinity;
    return radii;
}

/// The contact of mean spheres that the targets of a pair are meant for. Of two powders the smaller and the lighter
/// sphere are those that overlaps and weights are compared with.
MeanContact meanContact(const Case& c, MaterialPair pair, const std::vector<double>& radii) {
    MeanContact m;
    const double a = radii[std::size_t(pair.a)], b = radii[std::size_t(pair.b)];
    const bool sphere = c.world.materials[std::size_t(pair.b)].powder;
    const bool round = pair.b == kCoilMaterial && c.world.coil && c.world.coilWireCurved;
    m.radius = b < a ? b : a;
    m.mass = reducedMass(c.world, pair, a, b);
    m.reduced = reducedSize(a, round ? c.world.coil->wireRadius : b);
    const double gravity = glm::length(c.world.gravity);
    m.weight = sphereMass(c.world.density(pair.a), a) * gravity;
    if (sphere) m.weight = std::min(m.weight, sphereMass(c.world.density(pair.b), b) * gravity);
    const double down = -c.world.gravity.y;
    if (c.canister && down > 0) {
        const double density = solidDensity(c);
        m.load = loadUnderBed(density, down, bedDepth(*c.canister, fillOf(c).mass, density), m.radius);
    }
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

/// Springs and dashpots of the two sides act in series.
constexpr MixedKey<Ratios> kInSeries[] = {{"k", &Ratios::k}, {"damping", &Ratios::damping}};
constexpr MixedKey<Ratios> kGeometric[] = {
    {"k1_over_k", &Ratios::k1},          {"kc_over_k", &Ratios::kc},   {"plasticity_depth", &Ratios::plasticity},
    {"friction", &Ratios::mu},           {"kt_over_k", &Ratios::kt},   {"damping_t_ratio", &Ratios::dampingT},
    {"rolling_friction", &Ratios::muR},  {"kr_over_k", &Ratios::kr},   {"damping_r_ratio", &Ratios::dampingR},
    {"torsion_friction", &Ratios::muTo}, {"kto_over_k", &Ratios::kTo}, {"damping_to_ratio", &Ratios::dampingTo}};

/// What two powders make together, of the parameters that each has with itself.
Stated mixture(const Stated& a, const Ratios& ofA, const Stated& b, const Ratios& ofB) {
    Stated mixed;
    Ratios& r = mixed.ratios;
    for (const auto& key : kInSeries) r.*key.member = harmonicMean(ofA.*key.member, ofB.*key.member);
    for (const auto& key : kGeometric) r.*key.member = geometricMean(ofA.*key.member, ofB.*key.member);
    // A powder without plasticity has neither adhesion nor a depth of its own.
    if (ofA.k1 == 1 || ofB.k1 == 1) r.kc = 0;
    if (ofA.k1 == 1) r.plasticity = ofB.plasticity;
    if (ofB.k1 == 1) r.plasticity = ofA.plasticity;
    // One restitution each makes one restitution, with the damping that it needs.
    if (a.targets.restitution && b.targets.restitution && a.targets.speed == b.targets.speed) {
        mixed.targets.restitution = geometricMean(*a.targets.restitution, *b.targets.restitution);
        mixed.targets.speed = a.targets.speed;
    }
    return mixed;
}

std::string derivationOf(const LawTables& in, const PairSection& pair, const Stated& stated, const Ratios& r) {
    std::string words = stated.targets.any() ? derivation(stated.targets, r) : "";
    const auto add = [&](const std::string& more) { words += (words.empty() ? "" : "; ") + more; };
    if (pair.stated.source == PairSource::Mixture) {
        std::string series = mixedWords(pair, r, kInSeries);
        // What follows from a target is told with it.
        if (stated.targets.restitution) series = pair.section->has("k") ? "" : fmt::format("k = {:.6g}", r.k);
        const std::string rest = mixedWords(pair, r, kGeometric);
        if (!series.empty()) add(series + ": " + meansOf(in, pair, "harmonic"));
        if (!rest.empty()) add(rest + ": " + meansOf(in, pair, "geometric"));
    } else if (pair.isNamed() && !pair.given) {
        add(inheritanceOf(in, pair));
    }
    return words;
}

/// Adhesion while the powder settles, k_c/k of each pair. A pair whose table gives its adhesion keeps it by default,
/// and so does every one where the case says nothing of adhesion while settling.
std::vector<double> settlingAdhesion(const LawTables& in, const std::vector<Stated>& stated) {
    const auto isPowder = [&](int material) { return in.c.world.materials[std::size_t(material)].powder; };
    std::vector<char> owns(in.size());  // the walls of a pair state its adhesion, or those from which it takes all
    Section& settle = in.settle;
    const bool pairStated = settle.has("kc_over_k"), wallStated = settle.has("wall_kc_over_k");
    const bool coilStated = settle.has("coil_kc_over_k");
    const double pairKc = settle.number("kc_over_k", stated[0].ratios.kc);
    std::vector<double> kc(in.size());
    for (const PairSection& p : in.pairs) {
        Section& section = *p.section;
        const MaterialPair pair = p.stated.pair;
        const double usual = stated[p.index()].ratios.kc;
        const bool inherits = p.isNamed() && p.stated.source == PairSource::Parent && !isPowder(p.stated.parent.b);
        const bool own = section.has("kc_over_k") || section.has("bond_number") || (inherits && owns[p.parent()]);
        owns[p.index()] = own;
        double& value = kc[p.index()];
        if (isPowder(pair.b)) {
            value = pairStated ? pairKc : usual;
        } else if (pair.b != kCoilMaterial) {
            value = own || !pairStated ? usual : pairKc;
            if (wallStated) value = kc[PairTable::index({kFirstPowder, kWallMaterial})];
            if (!p.isNamed()) value = settle.number("wall_kc_over_k", value);
        } else {
            value = own || !(pairStated || wallStated) ? usual : kc[PairTable::index({pair.a, kWallMaterial})];
            if (coilStated) value = kc[PairTable::index({kFirstPowder, kCoilMaterial})];
            if (!p.isNamed()) value = settle.number("coil_kc_over_k", value);
        }
        if (p.isNamed()) value = section.number("settling_kc_over_k", value);
    }
    return kc;
}

}  // namespace

void readLuding(const LawTables& in) {
    CaseReader& reader = in.reader;
    Case& c = in.c;
    const std::vector<double> radii = meanRadii(in);
    std::vector<Stated> stated(in.size());
    std::vector<Ratios> met(in.size());  // with what the targets led to
    std::vector<std::string> missed(in.size());
    for (const PairSection& p : in.pairs) {
        Stated parent;
        const MaterialPair pair = p.stated.pair;
        if (p.stated.source == PairSource::Parent) parent = stated[p.parent()];
        if (p.stated.source == PairSource::Mixture) {
            const std::size_t a = PairTable::index({pair.a, pair.a}), b = PairTable::index({pair.b, pair.b});
            parent = mixture(stated[a], met[a], stated[b], met[b]);
        }
        Stated& s = stated[p.index()];
        s = readClass(reader, *p.section, p.stated.source == PairSource::None ? nullptr : &parent);
        met[p.index()] = s.ratios;
        const auto miss = meetTargets(s.targets, meanContact(c, pair, radii), met[p.index()]);
        if (!miss) continue;
        // A target that a pair takes from another one is told there, if it is missed there too.
        missed[p.index()] = miss->key;
        const bool told =
            p.stated.source == PairSource::Parent && missed[p.parent()] == miss->key && !p.section->has(miss->key);
        if (!told) reader.fault(p.section->path(miss->key), miss->problem, miss->remedy);
    }
    c.softened = readSoftness(reader, in.contact());
    for (const PairSection& p : in.pairs) {
        Ratios& r = met[p.index()];
        std::string words = derivationOf(in, p, stated[p.index()], r);
        if (c.softened > 1) r.soften(c.softened);
        if (c.softened > 1 && (!words.empty() || p.section->has("derived"))) {
            if (words.empty()) words = p.section->string("derived");
            words += fmt::format("; then softened {:.6g} times", c.softened);
        }
        if (c.softened > 1 || stated[p.index()].targets.any()) recordChanged(*p.section, r);
        stated[p.index()].ratios = r;
        tell(in, p, words);
    }

    const std::vector<double> settling = settlingAdhesion(in, stated);
    const double damping = in.settle.number("damping_factor");
    const bool elastic = in.settle.boolean("elastic");
    c.settlingLaw = c.dosingLaw;
    for (const PairSection& p : in.pairs) {
        const Ratios& r = stated[p.index()].ratios;
        c.dosingLaw.of(p.stated.pair) = r.parameters(r.kc);
        ContactParameters& settled = c.settlingLaw.of(p.stated.pair);
        settled = r.parameters(settling[p.index()]);
        settled.gamma *= damping;
        if (elastic) settled.k2Max = settled.k1;
    }
}

}  // namespace vkdose
