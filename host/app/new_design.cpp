#include "host/app/new_design.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/advice/figures.h"
#include "host/app/backends.h"
#include "host/app/measures.h"
#include "host/core/vec.h"
#include "host/model/bed_weight.h"
#include "host/model/size_distribution.h"

namespace vkdose {

namespace {

constexpr double kAssumedBulk = 500;  // kg/m3, as many food and pharmaceutical powders have
constexpr int kUsualSpheres = 3000;
constexpr int kMostSpheres = 4'500'000;
/// Spheres across the gap between two turns and across the outlet, so that they do not arch; a little more than
/// `vkdose check` asks for (host/advice/device_rules.cpp).
constexpr double kLargestInTurn = 2.1, kMeanInTurn = 1.6, kLargestInOutlet = 2.6, kMeanInOutlet = 4.2;
constexpr double kSpheresInDose = 40;
/// Largest over smallest sphere, as in the paper's case. Finer ones would be most of the spheres and little of the
/// mass, and the grid that the fill falls from has a place of the largest's size for each.
constexpr double kWidestSizes = 3;
constexpr double kGravity = 9.81;
/// Volume fraction of a settled bed with the contacts of a free-flowing powder below: 0.563 in
/// cases/devices/free-beads.
constexpr double kFreeBedFraction = 0.56;
/// More spheres than were asked for, by this factor, are told.
constexpr double kTellSpheres = 1.2;
/// A dose to a mass may take so many times as long as by the closed form.
constexpr double kDoseTime = 3;

constexpr const char* kGiven = "given";

/// Puts an answer into its place, or what was assumed in its stead, which the user is told.
class Choice {
  public:
    explicit Choice(NewDesign& design) : design_(design) {}

    Reasoned operator()(const std::optional<double>& given, double standard, const std::string& why) const {
        return given ? Reasoned{*given, kGiven} : Reasoned{standard, why};
    }
    void assumed(bool missing, const std::string& what) const {
        if (missing) design_.assumed.push_back(what);
    }

  private:
    NewDesign& design_;
};

void designCanister(NewDesign& d, const NewAnswers& a) {
    const auto& size = a.canister.value();
    d.length = {size[0], "given; along the coil, from the rear wall to the outlet's wall"};
    d.width = {size[1], "given; inside"};
    d.height = {size[2], "given; from the lowest point of the floor"};
    d.flatFloor = a.flatFloor;
    const Choice choose(d);
    d.outlet = choose(a.outlet, d.width.value, "assumed: as wide as the canister");
    choose.assumed(!a.outlet, fmt::format("an outlet of {} (--outlet)", lengthText(d.outlet.value)));
    if (d.height.value <= d.width.value / 2)
        throw UsageError(fmt::format(
            "--canister: its height of {} ends below the coil's axis, half its width of {} above the floor; "
            "write length x width x height: 80x30x100mm",
            lengthText(d.height.value), lengthText(d.width.value)));
    if (d.outlet.value > d.width.value)
        throw UsageError(fmt::format("--outlet: {} is wider than the canister; give at most {}",
                                     lengthText(d.outlet.value), lengthText(d.width.value)));
}

std::string windings(double turns, double pitch) {
    return fmt::format("{} turns of {}", figureText(turns, 4), lengthText(pitch));
}

/// A coil of so many turns and this pitch: it ends with the throat, and the throat is as long as it reaches.
void placeGivenCoil(NewDesign& d, const NewAnswers& a) {
    const double own = *a.turns * *a.pitch, beyond = own - d.length.value;
    const Choice choose(d);
    const bool reaches = beyond > 1e-9 && beyond <= 0.5 * d.length.value;
    d.throat = reaches ? choose(a.throat, beyond, "assumed: as far as the coil reaches beyond the outlet's wall")
                       : choose(a.throat, rounded(*a.pitch, 2), "assumed: a pitch");
    const double room = d.length.value + d.throat.value;
    if (own > room * (1 + 1e-9))
        throw UsageError(
            fmt::format("--coil: {} are {} long, canister and throat together {}; give {}x{} to end with the throat, "
                        "or {} to leave "
                        "the turns to vkdose",
                        windings(*a.turns, *a.pitch), lengthText(own), lengthText(room), figureText(room / *a.pitch, 4),
                        figureText(*a.pitch * 1e3, 6) + "mm", figureText(*a.pitch * 1e3, 6) + "mm"));
    d.pitch = {*a.pitch, "given"};
    d.coilLength = {own, fmt::format("given: {}", windings(*a.turns, *a.pitch))};
    d.coilStart = {room - own, "so that the coil ends with the throat"};
    if (d.coilStart.value <= 0.25 * d.length.value) return;
    d.accepted.emplace_back("coil-start");
    d.notes.push_back(
        fmt::format("{} are {} long, canister and throat {}: the coil begins {} from the rear wall, and the powder "
                    "behind it stays. A coil from the rear wall on has {} turns of that pitch (--coil {}mm), or that "
                    "many turns of {} (--coil {}turns).",
                    windings(*a.turns, *a.pitch), lengthText(own), lengthText(room), lengthText(d.coilStart.value),
                    figureText(room / *a.pitch), figureText(*a.pitch * 1e3, 6), lengthText(room / *a.turns),
                    figureText(*a.turns, 6)));
}

/// A coil from the rear wall to the throat's end, by its pitch or by its turns.
void fitCoil(NewDesign& d, const NewAnswers& a) {
    const double pitch = a.pitch ? *a.pitch : d.length.value / std::max(1.0, *a.turns - 1);
    d.throat = Choice(d)(a.throat, rounded(pitch, 2), "assumed: a pitch");
    const double room = d.length.value + d.throat.value;
    d.coilLength = {room, "from the rear wall to the throat's end"};
    d.coilStart = {0, "at the rear wall"};
    d.pitch = a.pitch ? Reasoned{*a.pitch, kGiven}
                      : Reasoned{room / *a.turns,
                                 fmt::format("given: {} turns over the coil's length", figureText(*a.turns, 4))};
}

void designCoil(NewDesign& d, const NewAnswers& a) {
    if (a.turns && a.pitch)
        placeGivenCoil(d, a);
    else
        fitCoil(d, a);
    const Choice choose(d);
    const double room = std::min(d.width.value, d.outlet.value);
    choose.assumed(!a.throat, fmt::format("a throat of {} (--throat)", lengthText(d.throat.value)));
    d.wire = choose(a.wire, rounded(std::min(d.pitch.value / 5, room / 10), 2), "assumed: a fifth of the pitch");
    d.clearance = choose(a.clearance, rounded(0.02 * room, 2), "assumed: 2 % of the outlet's diameter");
    choose.assumed(!a.wire, fmt::format("a wire of {} (--wire)", lengthText(d.wire.value)));
    choose.assumed(!a.clearance, fmt::format("{} between wire and wall (--clearance)", lengthText(d.clearance.value)));
    if (d.wire.value >= d.pitch.value)
        throw UsageError(
            fmt::format("--wire: turns of {} touch one another at a pitch of {}; give a thinner wire or a "
                        "larger pitch",
                        lengthText(d.wire.value), lengthText(d.pitch.value)));
    if (room / 2 - d.clearance.value - 1.5 * d.wire.value <= 0)
        throw UsageError(
            fmt::format("--wire, --clearance: a wire of {} and a clearance of {} leave no coil in a hole of "
                        "{}",
                        lengthText(d.wire.value), lengthText(d.clearance.value), lengthText(room)));
}

/// From the axis to the wire's centre line.
double coilRadius(const NewDesign& d) {
    return std::min(d.width.value, d.outlet.value) / 2 - d.clearance.value - d.wire.value / 2;
}

/// Volume of the canister up to the height `h` above its floor, where that is above the coil's axis.
double volumeUpTo(const NewDesign& d, double h) {
    const double w = d.width.value;
    return d.length.value * (d.flatFloor ? w * h : kPi * w * w / 8 + w * (h - w / 2));
}

/// Volume fraction at which spheres of such a powder settle: rolling resistance and adhesion keep a bed loose.
double bedFractionOf(const NewAnswers& a) {
    return a.flow == Flow::Free ? kFreeBedFraction : kBedFraction;
}

void designDensities(NewDesign& d, const NewAnswers& a) {
    const Choice choose(d);
    const double fraction = bedFractionOf(a);
    const double ofDensity = a.density ? rounded(fraction * *a.density, 2) : kAssumedBulk;
    d.bulkDensity = choose(a.bulkDensity, ofDensity,
                           a.density ? fmt::format("assumed: {} of the density, as spheres settle", fraction)
                                     : "assumed; weigh a known volume of the settled powder");
    choose.assumed(!a.bulkDensity, fmt::format("{} kg/m3 (--bulk-density)", figureText(d.bulkDensity.value)));
    d.density =
        choose(a.density, rounded(d.bulkDensity.value / fraction, 3),
               fmt::format("of the simulated spheres: their bed (volume fraction {}) has the bulk density", fraction));
    // The default of the program is that of cocoa, which check asks about; here somebody has said it.
    if (a.bulkDensity && *a.bulkDensity == 471 && std::abs(d.density.value / 1427 - 1) > 0.02)
        d.accepted.emplace_back("bulk-density");
}

void designPowder(NewDesign& d, const NewAnswers& a, const std::filesystem::path& file) {
    if (a.powder.empty()) return designDensities(d, a);
    const PowderFile powder = readPowderFile(a.powder);
    d.powder = {fromCase(a.powder, file), powder.title, spheresOf(powder)};
    const PowderSpheres& spheres = d.powder->spheres;
    const Choice choose(d);
    d.density = {spheres.density, "of the powder's file"};
    d.bulkDensity = choose(spheres.bulkDensity, rounded(kBedFraction * spheres.density, 2),
                           fmt::format("assumed: {} of the density, as spheres settle", kBedFraction));
    choose.assumed(!spheres.bulkDensity,
                   fmt::format("{} kg/m3 (bulk_density of the powder's file)", figureText(d.bulkDensity.value)));
}

void designFill(NewDesign& d, const NewAnswers& a) {
    const Choice choose(d);
    const double high = std::max(0.55 * d.width.value, std::min(1.5 * d.width.value, 0.7 * d.height.value));
    d.fill = choose(a.fill, rounded(d.bulkDensity.value * volumeUpTo(d, std::min(high, 0.9 * d.height.value)), 2),
                    "assumed: a bed up to half a width over the coil, at most 0.7 of the height");
    choose.assumed(!a.fill, fmt::format("a fill of {} (--fill)", massText(d.fill.value)));
    const double takes = d.fill.value / d.bulkDensity.value, holds = volumeUpTo(d, d.height.value);
    if (takes > 0.95 * holds)
        throw UsageError(fmt::format("--fill: {} of {} kg/m3 take {} cm3, the canister holds {} cm3; give at most {}",
                                     massText(d.fill.value), figureText(d.bulkDensity.value), figureText(takes * 1e6),
                                     figureText(holds * 1e6),
                                     massText(roundedDown(0.95 * holds * d.bulkDensity.value, 2))));
}

/// By the closed form [kg]; 0 for a mesh that conveys nothing.
double massPerTurn(const NewDesign& d) {
    if (d.mesh) {
        const double section = kPi * d.mesh->radius * d.mesh->radius - d.mesh->solid;
        return d.bulkDensity.value * d.mesh->advance * std::max(0.0, section);
    }
    return d.bulkDensity.value * d.pitch.value * kPi * coilRadius(d) * coilRadius(d);
}

void designDoseToMass(NewDesign& d, double mass, double perTurn) {
    if (mass > d.fill.value)
        throw UsageError(fmt::format("--dose: {} is more than the fill of {}; give less, or a larger --fill",
                                     massText(mass), massText(d.fill.value)));
    d.target = d.massPerDose = mass;
    const double turns = perTurn > 0 ? mass / perTurn : 2;
    d.expectedTurning = turns * 2 * kPi / d.speed.value;
    d.rotate = {roundedUp(kDoseTime * d.expectedTurning, 2),
                perTurn > 0 ? fmt::format("at the longest: {} times the {} turns of the closed form", kDoseTime,
                                          figureText(turns))
                            : "assumed: some turns, as the mesh does not tell what a turn conveys"};
}

void designDose(NewDesign& d, const NewAnswers& a) {
    const Choice choose(d);
    // Half of the speed at which the wire's centripetal acceleration equals gravity.
    const double fast = 0.5 * std::sqrt(kGravity / coilRadius(d));
    d.speed = choose(a.speed, std::min(2 * kPi, 2 * kPi / 60 * roundedDown(fast * 60 / (2 * kPi), 2)), "assumed");
    choose.assumed(!a.speed, fmt::format("{} rpm (--speed)", figureText(d.speed.value * 60 / (2 * kPi))));
    const double perTurn = massPerTurn(d);
    if (a.dose) return designDoseToMass(d, *a.dose, perTurn);
    const double turns = perTurn > 0 ? std::min(2.0, 0.25 * d.fill.value / perTurn) : 2.0;
    d.rotate = choose(a.rotate, rounded(turns * 2 * kPi / d.speed.value, 2),
                      turns < 2 ? "assumed: a quarter of the fill by the closed form" : "assumed: two turns");
    choose.assumed(!a.rotate, fmt::format("{} s of turning (--rotate)", figureText(d.rotate.value)));
    d.expectedTurning = d.rotate.value;
    d.massPerDose = perTurn * d.rotate.value * d.speed.value / (2 * kPi);
}

/// The distribution of the powder itself; without sizes that of spheres with a diameter of 1 m, to be scaled.
SizeDistribution ownSizes(const NewDesign& d, const NewAnswers& a) {
    SizeDistribution s;
    if (d.powder) {
        s = d.powder->spheres.size;
        if (byVolume(s)) s.radiusMin = std::max(s.radiusMin, s.radiusMax / kWidestSizes);
    } else if (a.sizes.size() == 3) {
        s.kind = SizeDistribution::Kind::Quantiles;
        s.r10 = a.sizes[0] / 2;
        s.r50 = a.sizes[1] / 2;
        s.r90 = a.sizes[2] / 2;
        s.radiusMax = coarsestRadius(s);
        s.radiusMin = std::max(finestRadius(s), s.radiusMax / kWidestSizes);
    } else {
        const double radius = a.sizes.empty() ? 0.5 : a.sizes[0] / 2;
        s.kind = SizeDistribution::Kind::Uniform;
        s.radiusMin = 0.8 * radius;
        s.radiusMax = 1.2 * radius;
    }
    return s;
}

struct Limit {
    double scale;  ///< the largest with which the spheres are still small enough
    const char* why;
};

/// What the device asks of the spheres.
Limit largestScale(const NewDesign& d, const SizeDistribution& own) {
    const double mean = 2 * meanRadius(own), largest = 2 * largestRadius(own);
    const double round = 2 * kPi * coilRadius(d);
    const double gap = d.pitch.value * round / std::hypot(round, d.pitch.value) - d.wire.value;
    const double sphere = d.density.value * 4.0 / 3.0 * kPi * meanCubedRadius(own);
    const std::vector<Limit> limits{
        {std::min(gap / (kLargestInTurn * largest), gap / (kMeanInTurn * mean)), "the gap between the turns"},
        {std::min(d.outlet.value / (kLargestInOutlet * largest), d.outlet.value / (kMeanInOutlet * mean)),
         "the outlet"},
        {(0.9 * coilRadius(d) - d.wire.value / 2) / (largest / 2), "the coil's diameter"},
        {std::cbrt(d.massPerDose / (kSpheresInDose * sphere)), "the dose, which should be many spheres"}};
    return *std::min_element(limits.begin(), limits.end(),
                             [](const Limit& a, const Limit& b) { return a.scale < b.scale; });
}

void designSpheres(NewDesign& d, const NewAnswers& a) {
    const SizeDistribution own = ownSizes(d, a);
    const int budget = a.spheres.value_or(kUsualSpheres);
    const double unit = d.fill.value / (d.density.value * 4.0 / 3.0 * kPi * meanCubedRadius(own));
    const Limit limit = largestScale(d, own);
    double scale = std::cbrt(unit / budget);
    std::string why = fmt::format("so large that the fill is {} {} spheres", a.spheres ? "the given" : "about", budget);
    if (scale > limit.scale) {
        scale = limit.scale;
        why = fmt::format("as large as {} allows; the fill is then some {:.0f} spheres", limit.why,
                          rounded(unit / std::pow(scale, 3), 2));
    }
    const bool grains = d.powder.has_value() || !a.sizes.empty();
    if (grains && scale < 1) {
        scale = 1;
        why = fmt::format("as they are; the fill is {:.0f} spheres", rounded(unit, 2));
        if (limit.scale < 1)
            d.notes.push_back(
                fmt::format("The powder itself is too coarse for {}: the spheres will arch, as the powder "
                            "may.",
                            limit.why));
    }
    const double count = unit / std::pow(scale, 3);
    if (count > kMostSpheres)
        throw UsageError(
            fmt::format("--fill: {} in spheres as small as {} asks for ({}) are {:.2g} million; give less, "
                        "or a wider pitch, outlet or coil",
                        massText(d.fill.value), limit.why, lengthText(2 * scale * largestRadius(own)), count * 1e-6));
    if (a.spheres && count > kTellSpheres * budget)
        d.notes.push_back(fmt::format(
            "{} spheres were asked for, and there are about {:.0f}: {} allows none larger than {}.{}", budget,
            rounded(count, 2), scale < limit.scale ? "the powder itself" : limit.why,
            lengthText(2 * scale * largestRadius(own)),
            a.sizes.size() == 3 ? fmt::format(" With one size in place of three (--sizes {}) there are fewer.",
                                              figureText(a.sizes[1] * 1e6) + "um")
                                : ""));
    if (grains && scale > 1) scale = std::max(1.0, roundedDown(scale, 3));
    d.size = enlarged(own, scale);
    if (!grains) d.size.scaleUp = 1;
    d.sizeWhy = why;
    if (d.powder && scale > 1 && !d.powder->spheres.stressScaled)
        d.notes.push_back(fmt::format(
            "The spheres are {} times as large as those that the powder's file is of, and its contacts do not follow "
            "(contact.scaling): what the powder was held against need not hold. More spheres (--spheres) are smaller.",
            figureText(scale)));
    Choice(d).assumed(!grains, fmt::format("spheres of {} to {} (--sizes, --spheres)", lengthText(2 * d.size.radiusMin),
                                           lengthText(2 * d.size.radiusMax)));
}

void designFlow(NewDesign& d, const NewAnswers& a) {
    d.flow = a.flow.value_or(Flow::Easy);
    d.flowGiven = a.flow.has_value();
    Choice(d).assumed(!a.flow, "a powder that flows easily (--flow)");
    d.k1OverK = d.flow == Flow::Free ? 1 : 0.2;
    // Starting points for a calibration.
    d.bond = d.flow == Flow::Free ? 0 : d.flow == Flow::Easy ? 5 : 50;
    d.rollingFriction = d.flow == Flow::Free ? 0.05 : d.flow == Flow::Easy ? 0.2 : 0.5;
}

}  // namespace

std::filesystem::path fromCase(const std::filesystem::path& file, const std::filesystem::path& caseFile) {
    const std::filesystem::path folder = caseFile.has_parent_path() ? caseFile.parent_path() : ".";
    std::error_code code;
    const std::filesystem::path relative = std::filesystem::proximate(file, folder, code);
    return code || relative.empty() ? std::filesystem::absolute(file) : relative;
}

NewDesign trialOf(NewDesign design) {
    design.bond = 0;
    return design;
}

NewDesign designOf(const NewAnswers& answers, const std::filesystem::path& file) {
    NewDesign d;
    designCanister(d, answers);
    if (answers.mesh.empty())
        designCoil(d, answers);
    else
        designMesh(d, answers, file);
    designPowder(d, answers, file);
    designFill(d, answers);
    designDose(d, answers);
    d.rest = {roundedUp(2 * std::sqrt(2 * d.outlet.value / kGravity), 1),
              "twice the time of a fall through the outlet's height, so that the dose comes to an end"};
    d.doses = answers.doses.value_or(3);
    designSpheres(d, answers);
    if (!d.powder) designFlow(d, answers);
    // First guesses, with which the case loads.
    d.stiffness.value = 1000;
    d.settle.value = 1;
    return d;
}

}  // namespace vkdose
