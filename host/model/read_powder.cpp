// The tables [particles], [contact] and the adhesion of [settle].
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "host/core/file.h"
#include "host/model/case_sections.h"
#include "host/model/particle_list.h"
#include "host/model/size_distribution.h"

namespace vkdose {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// ---- particles ----------------------------------------------------------------------------------------------------

SizeDistribution readSize(Section& section) {
    using Kind = SizeDistribution::Kind;
    SizeDistribution size;
    const auto bounds = [&](double low, double high) {  // defaults, in metres
        size.radiusMin = section.number("radius_min_mm", low * 1e3);
        size.radiusMax = section.number("radius_max_mm", high * 1e3);
    };
    const auto kind = section.choice("distribution");
    if (!kind) {
        section.abandon();
        return size;
    }
    size.kind = static_cast<Kind>(*kind);
    switch (size.kind) {
        case Kind::Uniform:
            size.radiusMin = section.number("radius_min_mm");
            size.radiusMax = section.number("radius_max_mm");
            break;
        case Kind::Fixed:
            size.radius = section.number("radius_mm");
            break;
        case Kind::Normal:
            size.radius = section.number("radius_mean_mm");
            size.deviation = section.number("radius_deviation_mm");
            bounds(std::max(size.radius - 2 * size.deviation, 0.1 * size.radius), size.radius + 2 * size.deviation);
            break;
        case Kind::Lognormal:
            size.radius = section.number("radius_median_mm");
            size.deviation = section.number("log_deviation");
            bounds(size.radius * std::exp(-2 * size.deviation), size.radius * std::exp(2 * size.deviation));
            break;
        case Kind::Quantiles:
            size.scaleUp = section.number("scale_up");
            size.r10 = 0.5 * size.scaleUp * section.number("d10_um");
            size.r50 = 0.5 * size.scaleUp * section.number("d50_um");
            size.r90 = 0.5 * size.scaleUp * section.number("d90_um");
            bounds(finestRadius(size), coarsestRadius(size));
            break;
    }
    return size;
}

}  // namespace

void readParticles(CaseReader& reader, Section& root, Case& c) {
    Section& section = root.requiredTable("particles");
    c.world.density = section.number("density");
    if (section.has("list")) {
        const std::string path = section.string("list");
        if (section.has("mass_g"))
            reader.fault("particles.mass_g", "a list of particles has its own mass", "give mass_g or list, not both");
        section.know("mass_g");
        std::vector<Diagnostic> faults;
        const std::filesystem::path file = reader.folderOf("particles.list") / path;
        c.filling.list.emplace();
        if (!section.isString("list")) return;  // already reported
        if (!inputFile(file)) {
            reader.fault("particles.list", unreadable(file), "give the path of a CSV, relative to the case file");
            return;
        }
        c.filling.list = readParticleList(file, faults);
        c.files.push_back(file);
        section.record("list", std::filesystem::absolute(file).lexically_normal().string());
        for (Diagnostic& fault : faults) reader.add(std::move(fault));
        return;
    }
    section.know("list");
    c.filling.mass = section.number("mass_g");
    c.filling.gridGap = section.number("grid_gap");
    c.filling.size = readSize(section.requiredTable("size"));
}

void readRegion(Section& root, std::optional<Boundaries> kind, Case& c) {
    Section& particles = root.table("particles");
    if (!kind)
        for (const char* key : {"region", "drop_mm"}) particles.know(key);
    if (!kind || c.filling.list) return;
    if (kind == Boundaries::Canister) {
        const Canister& can = *c.canister;
        // "the initial position of the lowest particle is higher than the diameter of the coil" (paper)
        double floor = can.flatFloor ? -can.width / 2 : 0.0;
        if (c.world.coil) floor = c.world.coil->radius + c.world.coil->wireRadius;
        floor += particles.number("drop_mm");
        c.filling.region = {{-can.width / 2, floor, 0}, {can.width / 2, kInfinity, can.length}};
        return;
    }
    Section& region = particles.requiredTable("region");
    c.filling.region = {region.vector("low"), region.vector("high")};
}

namespace {

// ---- contact ------------------------------------------------------------------------------------------------------

/// Contact parameters as ratios, the way the file has them.
struct Ratios {
    double k, k1, kc, plasticity, damping, mu, kt, dampingT, muR, kr, dampingR, muTo, kTo, dampingTo;

    /// Similar spheres, `s` times as soft (physics.md, "Similar softer spheres").
    void soften(double s) {
        k /= s;
        damping /= std::sqrt(s);
        plasticity *= s;
    }

    ContactParameters parameters(double adhesion) const {
        ContactParameters p;
        p.k2Max = k;
        p.k1 = k1 * k;
        p.kc = adhesion * k;
        p.plasticityDepth = plasticity;
        p.gamma = damping;
        p.mu = mu;
        p.kt = kt * k;
        p.gammaT = dampingT * damping;
        p.muR = muR;
        p.kr = kr * k;
        p.gammaR = dampingR * damping;
        p.muTo = muTo;
        p.kTo = kTo * k;
        p.gammaTo = dampingTo * damping;
        return p;
    }
};

/// Reads one class; keys that are not there come from `parent`, or from the defaults when there is none.
Ratios readRatios(Section& section, const Ratios* parent) {
    const auto key = [&](const char* name, double Ratios::*member, std::optional<double> fallback = {}) {
        if (parent != nullptr) fallback = parent->*member;
        return section.number(name, fallback);
    };
    Ratios r{};
    r.k = key("k", &Ratios::k);
    r.k1 = key("k1_over_k", &Ratios::k1);
    r.kc = key("kc_over_k", &Ratios::kc);
    // Without plasticity (k1 = k) the depth has no effect, so that it may be left out.
    r.plasticity = key("plasticity_depth", &Ratios::plasticity, r.k1 < 1 ? std::optional<double>() : 0.0);
    r.damping = key("damping", &Ratios::damping);
    r.mu = key("friction", &Ratios::mu);
    r.kt = key("kt_over_k", &Ratios::kt);
    r.dampingT = key("damping_t_ratio", &Ratios::dampingT);
    r.muR = key("rolling_friction", &Ratios::muR);
    r.kr = key("kr_over_k", &Ratios::kr);
    r.dampingR = key("damping_r_ratio", &Ratios::dampingR);
    r.muTo = key("torsion_friction", &Ratios::muTo);
    r.kTo = key("kto_over_k", &Ratios::kTo);
    r.dampingTo = key("damping_to_ratio", &Ratios::dampingTo);
    return r;
}

/// States the parameters of one class as they are, for the resolved case.
void recordSoftened(Section& section, const Ratios& r) {
    section.record("k", r.k);
    section.record("damping", r.damping);
    section.record("plasticity_depth", r.plasticity);
}

/// Reads by how much the spheres are to be softer, and makes them so.
double readSoftness(CaseReader& reader, Section& contact, const std::array<Section*, kContactClasses>& sections,
                    std::array<Ratios, kContactClasses>& ratios) {
    const double s = contact.number("soften");
    if (s < 1) reader.fault("contact.soften", "makes the spheres harder", "give 1 or more, or a larger k");
    if (!(s > 1)) return 1;
    for (std::size_t i = 0; i < ratios.size(); ++i) {
        ratios[i].soften(s);
        recordSoftened(*sections[i], ratios[i]);
    }
    contact.record("soften", 1.0);  // read again, the case is not softened a second time
    return s;
}

}  // namespace

void readContact(CaseReader& reader, Section& root, Case& c) {
    Section& contact = root.requiredTable("contact");
    c.dosingLaw.coulombLimit = static_cast<CoulombLimit>(contact.choice("coulomb_limit").value_or(0));
    c.dosingLaw.rollingLever = static_cast<RollingLever>(contact.choice("rolling_lever").value_or(0));
    c.world.maxOverlapRatio = contact.number("max_overlap_ratio");
    const Ratios pair = readRatios(contact, nullptr);
    Section& wallSection = contact.table("wall");
    const Ratios wall = readRatios(wallSection, &pair);
    Section& coilSection = contact.table("coil");
    const Ratios coil = readRatios(coilSection, &wall);
    std::array<Ratios, kContactClasses> ratios{pair, wall, coil};
    c.softened = readSoftness(reader, contact, {&contact, &wallSection, &coilSection}, ratios);

    // While the powder settles, adhesion has a strength of its own. A class whose table gives kc_over_k keeps that
    // value by default.
    Section& settle = root.table("settle");
    const double pairKc = settle.number("kc_over_k", pair.kc);
    const double wallKc = settle.number("wall_kc_over_k", wallSection.has("kc_over_k") ? wall.kc : pairKc);
    const double coilKc = settle.number("coil_kc_over_k", coilSection.has("kc_over_k") ? coil.kc : wallKc);
    const std::array<double, kContactClasses> settling{pairKc, wallKc, coilKc};
    const double damping = settle.number("damping_factor");

    c.settlingLaw = c.dosingLaw;
    for (std::size_t i = 0; i < ratios.size(); ++i) {
        c.dosingLaw.classes[i] = ratios[i].parameters(ratios[i].kc);
        c.settlingLaw.classes[i] = ratios[i].parameters(settling[i]);
        c.settlingLaw.classes[i].gamma *= damping;
    }
}

}  // namespace vkdose
