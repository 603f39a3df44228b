// From the tree of a case file to a Case, section by section. The keys and their defaults are all in this file.
#include "host/model/case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/model/case_reader.h"
#include "host/model/checks.h"
#include "host/model/particle_list.h"
#include "host/model/size_distribution.h"
#include "host/model/stability.h"

namespace vkdose {
namespace {

enum class Boundaries { Canister, List, None };

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// ---- particles ----------------------------------------------------------------------------------------------------

SizeDistribution readSize(Section& section) {
    using Kind = SizeDistribution::Kind;
    SizeDistribution size;
    const auto positive = [&](const char* key, Unit unit = kMillimetre, std::optional<double> fallback = std::nullopt) {
        return section.number(key, Bound::Positive, unit, fallback);
    };
    const auto bounds = [&](double low, double high) {  // defaults, in metres
        size.radiusMin = positive("radius_min_mm", kMillimetre, low * 1e3);
        size.radiusMax = positive("radius_max_mm", kMillimetre, high * 1e3);
    };
    const auto kind = section.choice("distribution", {"uniform", "fixed", "normal", "lognormal", "quantiles"});
    if (!kind) {
        section.abandon();
        return size;
    }
    size.kind = static_cast<Kind>(*kind);
    switch (size.kind) {
        case Kind::Uniform:
            size.radiusMin = positive("radius_min_mm");
            size.radiusMax = positive("radius_max_mm");
            break;
        case Kind::Fixed:
            size.radius = positive("radius_mm");
            break;
        case Kind::Normal:
            size.radius = positive("radius_mean_mm");
            size.deviation = positive("radius_deviation_mm");
            bounds(std::max(size.radius - 2 * size.deviation, 0.1 * size.radius), size.radius + 2 * size.deviation);
            break;
        case Kind::Lognormal:
            size.radius = positive("radius_median_mm");
            size.deviation = positive("log_deviation", kPlain);
            bounds(size.radius * std::exp(-2 * size.deviation), size.radius * std::exp(2 * size.deviation));
            break;
        case Kind::Quantiles:
            size.scaleUp = positive("scale_up", kPlain, 1.0);
            size.r10 = 0.5 * size.scaleUp * positive("d10_um", kMicrometre);
            size.r50 = 0.5 * size.scaleUp * positive("d50_um", kMicrometre);
            size.r90 = 0.5 * size.scaleUp * positive("d90_um", kMicrometre);
            bounds(finestRadius(size), coarsestRadius(size));
            break;
    }
    return size;
}

void readParticles(CaseReader& reader, Section& root, Case& c) {
    Section& section = root.requiredTable("particles");
    c.world.density = section.number("density", Bound::Positive, {1, "kg/m3"});
    if (section.has("list")) {
        const std::string path = section.string("list");
        if (section.has("mass_g"))
            reader.fault("particles.mass_g", "a list of particles has its own mass", "give mass_g or list, not both");
        section.know("mass_g");
        std::vector<Diagnostic> faults;
        const std::filesystem::path file = reader.folderOf("particles.list") / path;
        c.filling.list = readParticleList(file, faults);
        section.record("list", std::filesystem::absolute(file).lexically_normal().string());
        for (Diagnostic& fault : faults) reader.add(std::move(fault));
        return;
    }
    section.know("list");
    c.filling.mass = section.number("mass_g", Bound::Positive, kGram);
    c.filling.size = readSize(section.requiredTable("size"));
}

/// The box of the insertion grid: the canister above its coil, or as given.
void readRegion(Section& root, std::optional<Boundaries> kind, Case& c) {
    Section& particles = root.table("particles");
    if (!kind) particles.know("region");
    if (!kind || c.filling.list) return;
    if (kind == Boundaries::Canister) {
        const Canister& can = *c.canister;
        // "the initial position of the lowest particle is higher than the diameter of the coil" (paper)
        double floor = can.flatFloor ? -can.width / 2 : 0.0;
        if (c.world.coil) floor = c.world.coil->radius + c.world.coil->wireRadius;
        c.filling.region = {{-can.width / 2, floor, 0}, {can.width / 2, kInfinity, can.length}};
        return;
    }
    Section& region = particles.requiredTable("region");
    c.filling.region = {region.vector("low"), region.vector("high")};
}

// ---- contact ------------------------------------------------------------------------------------------------------

/// Contact parameters as ratios, the way the file has them.
struct Ratios {
    double k, k1, kc, plasticity, damping, mu, kt, dampingT, muR, kr, dampingR, muTo, kTo, dampingTo;

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
    const auto key = [&](const char* name, Bound bound, double Ratios::*member, std::optional<double> fallback = {},
                         Unit unit = kPlain) {
        if (parent != nullptr) fallback = parent->*member;
        return section.number(name, bound, unit, fallback);
    };
    constexpr double kTwoSevenths = 0.286;  // sliding then oscillates as fast as the normal direction (paper)
    const Bound low = Bound::NonNegative;
    Ratios r{};
    r.k = key("k", Bound::Positive, &Ratios::k, {}, {1, "N/m"});
    r.k1 = key("k1_over_k", Bound::Positive, &Ratios::k1);
    r.kc = key("kc_over_k", low, &Ratios::kc);
    // Without plasticity (k1 = k) the depth means nothing and may be left out.
    r.plasticity = key("plasticity_depth", low, &Ratios::plasticity, r.k1 < 1 ? std::optional<double>() : 0.0);
    r.damping = key("damping", low, &Ratios::damping, {}, {1, "kg/s"});
    r.mu = key("friction", low, &Ratios::mu);
    r.kt = key("kt_over_k", Bound::Positive, &Ratios::kt, kTwoSevenths);
    r.dampingT = key("damping_t_ratio", low, &Ratios::dampingT, kTwoSevenths);
    r.muR = key("rolling_friction", low, &Ratios::muR, 0.0);
    r.kr = key("kr_over_k", Bound::Positive, &Ratios::kr, kTwoSevenths);
    r.dampingR = key("damping_r_ratio", low, &Ratios::dampingR, kTwoSevenths);
    r.muTo = key("torsion_friction", low, &Ratios::muTo, 0.0);
    r.kTo = key("kto_over_k", Bound::Positive, &Ratios::kTo, kTwoSevenths);
    r.dampingTo = key("damping_to_ratio", low, &Ratios::dampingTo, kTwoSevenths);
    return r;
}

void readContact(Section& root, Case& c) {
    Section& contact = root.requiredTable("contact");
    c.world.law.coulombLimit =
        static_cast<CoulombLimit>(contact.choice("coulomb_limit", {"luding", "absolute"}, 0).value_or(0));
    c.world.law.rollingLever =
        static_cast<RollingLever>(contact.choice("rolling_lever", {"full", "half"}, 0).value_or(0));
    const Ratios pair = readRatios(contact, nullptr);
    Section& wallSection = contact.table("wall");
    const Ratios wall = readRatios(wallSection, &pair);
    Section& coilSection = contact.table("coil");
    const Ratios coil = readRatios(coilSection, &wall);
    const std::array<Ratios, kContactClasses> ratios{pair, wall, coil};

    // While settling, adhesion has its own strength, except where a class was given one of its own.
    Section& settle = root.table("settle");
    const auto adhesion = [&](const char* key, double fallback) {
        return settle.number(key, Bound::NonNegative, kPlain, fallback);
    };
    const double pairKc = adhesion("kc_over_k", pair.kc);
    const double wallKc = adhesion("wall_kc_over_k", wallSection.has("kc_over_k") ? wall.kc : pairKc);
    const double coilKc = adhesion("coil_kc_over_k", coilSection.has("kc_over_k") ? coil.kc : wallKc);
    const std::array<double, kContactClasses> settling{pairKc, wallKc, coilKc};

    c.settlingLaw = c.world.law;
    for (std::size_t i = 0; i < ratios.size(); ++i) {
        c.world.law.classes[i] = ratios[i].parameters(ratios[i].kc);
        c.settlingLaw.classes[i] = ratios[i].parameters(settling[i]);
    }
}

// ---- boundaries ---------------------------------------------------------------------------------------------------

void addCanister(Case& c) {
    const Canister& can = *c.canister;
    const double half = can.width / 2;
    auto& surfaces = c.world.surfaces;
    if (can.flatFloor) {
        surfaces.push_back(geometry::Plane{{-half, 0, 0}, {1, 0, 0}});
        surfaces.push_back(geometry::Plane{{half, 0, 0}, {-1, 0, 0}});
        surfaces.push_back(geometry::Plane{{0, -half, 0}, {0, 1, 0}});
    } else {
        surfaces.push_back(geometry::Trough{half});
    }
    surfaces.push_back(geometry::Plane{{0, 0, 0}, {0, 0, 1}});
    surfaces.push_back(geometry::Front{can.length, can.outletDiameter / 2, can.throatLength});
    c.world.throatZ = can.length;
    c.world.outletZ = can.length + can.throatLength;
}

void readCanister(Section& root, Case& c) {
    Section& section = root.requiredTable("canister");
    Canister can;
    can.length = section.number("length_mm", Bound::Positive, kMillimetre);
    can.width = section.number("width_mm", Bound::Positive, kMillimetre);
    can.height = section.number("height_mm", Bound::Positive, kMillimetre);
    can.flatFloor = section.choice("floor", {"trough", "flat"}, 0) == std::size_t{1};
    can.outletDiameter = section.number("outlet_diameter_mm", Bound::Positive, kMillimetre);
    can.throatLength = section.number("throat_length_mm", Bound::Positive, kMillimetre);
    c.canister = can;
    addCanister(c);
}

/// A direction from the file as a unit vector; a zero vector is a fault.
Vec3 readDirection(CaseReader& reader, Section& section, const char* key) {
    const Vec3 v = section.vector(key);
    const double length = glm::length(v);
    if (length == 0) reader.fault(section.path(key), "has no direction", "give a vector that is not zero");
    return v / length;
}

void readSurfaces(CaseReader& reader, Section& root, Case& c) {
    for (Section* plane : root.tables("plane")) {
        const Vec3 point = plane->vector("point");
        c.world.surfaces.push_back(geometry::Plane{point, readDirection(reader, *plane, "normal")});
    }
    for (Section* tube : root.tables("cylinder")) {
        geometry::Tube shape;
        shape.base = tube->vector("base");
        shape.axis = readDirection(reader, *tube, "axis");
        shape.radius = tube->number("radius_mm", Bound::Positive, kMillimetre);
        if (tube->has("length_mm")) shape.length = tube->number("length_mm", Bound::Positive, kMillimetre);
        tube->know("length_mm");
        shape.inside = tube->boolean("inside", true);
        c.world.surfaces.push_back(shape);
    }
    if (c.world.surfaces.empty() && !reader.faulty())
        reader.fault("boundaries", "the list is empty",
                     "add [[plane]] or [[cylinder]], or write boundaries = \"none\"");
}

/// A table that the chosen boundaries leave without a use is a mistake worth telling.
void refuseUnused(CaseReader& reader, Section& root, Boundaries kind) {
    const auto refuse = [&](const char* key, const char* needed) {
        if (!root.has(key)) return;
        root.know(key);
        reader.fault(key, "has no use with these boundaries",
                     fmt::format("write boundaries = \"{}\" or remove it", needed));
    };
    if (kind != Boundaries::Canister) refuse("canister", "canister");
    if (kind != Boundaries::List) refuse("plane", "list");
    if (kind != Boundaries::List) refuse("cylinder", "list");
}

std::optional<Boundaries> readBoundaries(CaseReader& reader, Section& root, Case& c) {
    const auto index = root.choice("boundaries", {"canister", "list", "none"}, 0);
    for (const char* key : {"canister", "plane", "cylinder"})
        if (!index || !root.has(key)) root.know(key);
    if (!index) return std::nullopt;
    const auto kind = static_cast<Boundaries>(*index);
    if (kind == Boundaries::Canister) readCanister(root, c);
    if (kind == Boundaries::List) readSurfaces(reader, root, c);
    refuseUnused(reader, root, kind);
    return kind;
}

/// The value of one of two keys of which exactly one must be given; the index of that key in `which`.
double readEither(CaseReader& reader, Section& section, const char* first, Unit firstUnit, const char* second,
                  Unit secondUnit, int& which) {
    which = section.has(second) && !section.has(first) ? 1 : 0;
    section.know(first);
    section.know(second);
    if (section.has(first) && section.has(second))
        reader.fault(section.path(second), fmt::format("{} is given too", first), "give one of the two");
    if (!section.has(first) && !section.has(second)) {
        reader.fault(section.path(first), "is missing", fmt::format("give {} or {}", first, second));
        return kNaN;
    }
    return section.number(which == 0 ? first : second, Bound::Positive, which == 0 ? firstUnit : secondUnit);
}

void readCoil(CaseReader& reader, Section& root, Case& c) {
    if (!root.has("coil")) {
        root.know("coil");
        return;
    }
    Section& section = root.table("coil");
    geometry::Coil coil{};
    int which = 0;
    coil.length = section.number("length_mm", Bound::Positive, kMillimetre);
    const double winding = readEither(reader, section, "turns", kPlain, "pitch_mm", kMillimetre, which);
    coil.pitch = which == 0 ? coil.length / winding : winding;
    coil.wireRadius = section.number("wire_diameter_mm", Bound::Positive, kMillimetre) / 2;
    const double size = readEither(reader, section, "radius_mm", kMillimetre, "clearance_mm", kMillimetre, which);
    coil.radius = size;
    if (which == 1 && !c.canister)
        reader.fault("coil.clearance_mm", "needs a canister to be measured from", "give radius_mm");
    else if (which == 1)  // between the wire and the narrower of trough and hole
        coil.radius = std::min(c.canister->width, c.canister->outletDiameter) / 2 - size - coil.wireRadius;
    coil.zStart = section.number("z_start_mm", Bound::Any, kMillimetre, 0.0);
    coil.startAngle = section.number("start_angle_deg", Bound::Any, kDegree, 0.0);
    coil.hand = section.choice("hand", {"right", "left"}, 0) == std::size_t{1} ? -1 : 1;
    c.schedule.coilSpeed = section.number("speed_rpm", Bound::NonNegative, kRpm);
    c.world.coil = coil;
}

// ---- time ---------------------------------------------------------------------------------------------------------

void readStop(Section& root, Case& c) {
    const bool doses = c.schedule.rotateTime > 0;
    Section& section = root.table("stop");
    StopRule stop;
    const auto rule =
        section.choice("rule", {"none", "experiment", "simulation"}, doses ? std::size_t{1} : std::size_t{0});
    if (!rule) {
        section.abandon();
        return;
    }
    stop.kind = static_cast<StopRule::Kind>(*rule);
    stop.threshold = 0;
    if (stop.kind == StopRule::Kind::Experiment)
        stop.threshold = section.number("threshold_g", Bound::NonNegative, kGram, 0.15);
    if (stop.kind != StopRule::Kind::None) stop.doses = static_cast<int>(section.integer("doses", 1, 3));
    if (section.has("max_doses"))
        stop.maxDoses = static_cast<int>(std::min<std::int64_t>(section.integer("max_doses", 1), 1 << 30));
    if (section.has("end_time_s")) stop.endTime = section.number("end_time_s", Bound::Positive, kSecond);
    section.know("max_doses");
    section.know("end_time_s");
    c.schedule.stop = stop;
}

void readSchedule(Section& root, Case& c) {
    Section& settle = root.table("settle");
    c.schedule.settleTime = settle.number("time_s", Bound::NonNegative, kSecond, 0.0);
    Section& dose = root.table("dose");
    c.schedule.rotateTime = dose.number("rotate_s", Bound::NonNegative, kSecond, 0.0);
    c.schedule.restTime = dose.number("rest_s", Bound::NonNegative, kSecond, 0.0);
    readStop(root, c);
    Section& sensors = root.table("sensors");
    c.sensorInterval = sensors.number("interval_s", Bound::Positive, kSecond, 0.01);
}

/// Reads what the file says of time step and skin; 0 stands for a value still to be worked out.
void readTime(Section& root, Case& c) {
    Section& time = root.table("time");
    if (time.isString("step_s"))
        time.choice("step_s", {"auto"});
    else if (time.has("step_s"))
        c.world.timeStep = time.number("step_s", Bound::Positive, kSecond);
    if (time.has("skin_mm")) c.world.skin = time.number("skin_mm", Bound::Positive, kMillimetre);
    time.know("step_s");
    time.know("skin_mm");
}

void readDomain(Section& root, bool& given, Case& c) {
    given = root.has("domain");
    root.know("domain");
    if (!given) return;
    Section& domain = root.table("domain");
    c.world.domain = {domain.vector("low"), domain.vector("high")};
}

// ---- what follows from the rest -----------------------------------------------------------------------------------

/// Smallest and largest radius, and the mean.
struct SizeRange {
    double smallest = kInfinity;
    double largest = 0;
    double mean = 0;
};

SizeRange sizeRange(const Case& c) {
    if (!c.filling.list)
        return {smallestRadius(c.filling.size), largestRadius(c.filling.size), meanRadius(c.filling.size)};
    SizeRange range;
    const std::vector<double>& radii = c.filling.list->radius;
    for (const double r : radii) {
        range.smallest = std::min(range.smallest, r);
        range.largest = std::max(range.largest, r);
        range.mean += r / static_cast<double>(radii.size());
    }
    return range;
}

void completeTime(Section& time, Case& c, const SizeRange& sizes) {
    const auto modes = contactModes(c.world.law, c.world.density, sizes.smallest, contactClasses(c.world));
    if (c.world.timeStep == 0) {
        // Three digits are enough and read better in the resolved case.
        const double exact = automaticTimeStep(modes);
        const double unit = std::pow(10.0, std::floor(std::log10(exact)) - 2);
        c.world.timeStep = std::stod(fmt::format("{:.2e}", std::floor(exact / unit) * unit));
        time.record("step_s", c.world.timeStep);
    }
    if (c.world.skin == 0) c.world.skin = time.number("skin_mm", Bound::Positive, kMillimetre, 0.1 * sizes.mean * 1e3);
    const double steps = std::max(1.0, std::round(c.sensorInterval / c.world.timeStep));
    c.sensorInterval = steps * c.world.timeStep;
}

/// The domain a case does not state: the canister up to the top of the grid, or the particles and ten diameters.
Box defaultDomain(const Case& c, const SizeRange& sizes, const Insertion& filled) {
    const double diameter = 2 * sizes.largest;
    if (c.canister) {
        const Canister& can = *c.canister;
        const double half = can.width / 2;
        const double top = std::max(can.height - half, filled.fillHeight);
        return {Vec3(-half, -half, 0) - diameter, Vec3(half, top, can.length + can.throatLength) + diameter};
    }
    Box box{Vec3(kInfinity), Vec3(-kInfinity)};
    for (std::size_t i = 0; i < filled.particles.size(); ++i) {
        box.low = glm::min(box.low, filled.particles.position[i] - filled.particles.radius[i]);
        box.high = glm::max(box.high, filled.particles.position[i] + filled.particles.radius[i]);
    }
    const Vec3 size = box.high - box.low;
    const double margin = std::max({10 * diameter, size.x, size.y, size.z});
    return {box.low - margin, box.high + margin};
}

}  // namespace

Case loadCase(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
    Node tree = readTree(file);
    merge(tree, overrideTree(overrides));
    CaseReader reader(file.string(), std::move(tree));
    Section& root = reader.root();
    Case c;
    c.name = root.string("name", file.stem().string());
    c.reason = root.string("reason", "");
    c.seed = static_cast<std::uint64_t>(root.integer("seed", 0, 1));
    c.world.gravity = root.vector("gravity", Vec3(0, -9.81, 0));
    c.bulkDensity = root.number("bulk_density", Bound::Positive, {1, "kg/m3"}, 471.0);
    readParticles(reader, root, c);
    readContact(root, c);
    const std::optional<Boundaries> kind = readBoundaries(reader, root, c);
    readCoil(reader, root, c);
    readRegion(root, kind, c);
    readSchedule(root, c);
    readTime(root, c);
    bool domainGiven = false;
    readDomain(root, domainGiven, c);
    reader.finish();
    checkFields(reader, c);
    reader.throwIfFaulty();

    const SizeRange sizes = sizeRange(c);
    completeTime(root.table("time"), c, sizes);
    checkTimeStep(reader, c, sizes.smallest);
    checkFilling(reader, c, sizes.largest);
    reader.throwIfFaulty();

    const Insertion filled = insertParticles(c);
    if (!domainGiven) {
        c.world.domain = defaultDomain(c, sizes, filled);
        root.table("domain").record("low", c.world.domain.low);
        root.table("domain").record("high", c.world.domain.high);
    }
    checkPlacement(reader, c, filled.particles);
    reader.throwIfFaulty();
    c.resolved = reader.resolved();
    return c;
}

}  // namespace vkdose
