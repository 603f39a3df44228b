#pragma once
// The device's answer to "which distinct features of a body does this sphere touch?" beside the host's in double
// precision, for random spheres around a body.
//
// In a few places the answer hangs on the last digits: a contact that barely touches, two directions 20 degrees apart.
// A sphere whose answer in double precision changes when it is moved or grown by a ten-millionth of its radius is left
// out, and these are counted.

#include <algorithm>
#include <random>

#include "tests/geometry/facets.h"
#include "tests/pass/narrow_phase.h"
#include "tests/support/near.h"

namespace vkdose::test {

/// A sphere's place as the device gets it.
inline Vec3 rounded(const Vec3& v) {
    const Split3 s(v);
    return Vec3(s.high) + Vec3(s.low);
}

/// Whether two answers have the same features, whatever their order: depths within `depth` [m], directions within
/// `direction`.
inline bool alike(const std::vector<geometry::Feature>& a, const std::vector<geometry::Feature>& b, double depth,
                  double direction) {
    if (a.size() != b.size()) return false;
    std::vector<bool> taken(b.size(), false);
    for (const geometry::Feature& f : a) {
        bool found = false;
        for (std::size_t k = 0; k < b.size() && !found; ++k) {
            found = !taken[k] && std::abs(f.distance - b[k].distance) <= depth &&
                    glm::length(f.normal - b[k].normal) <= direction;
            if (found) taken[k] = true;
        }
        if (!found) return false;
    }
    return true;
}

/// Whether the answer hangs on the last digits.
inline bool onEdge(const std::vector<geometry::Shape>& shapes, const Vec3& q, double radius,
                   const std::vector<geometry::Feature>& answer) {
    constexpr double kNudge = 1e-7;
    const auto changes = [&](const Vec3& off, double grown) {
        // Edges and corners turn a direction by the nudge; nothing else may turn it by more.
        return !alike(answer, geometry::touched(shapes, q + kNudge * radius * off, radius * (1 + kNudge * grown)),
                      10 * kNudge * radius, 1e-4);
    };
    for (int d = 0; d < 3; ++d) {
        Vec3 off(0);
        for (const double step : {-1.0, 1.0}) {
            off[d] = step;
            if (changes(off, 0)) return true;
        }
    }
    return changes(Vec3(0), 1) || changes(Vec3(0), -1);
}

/// A body and where the spheres around it are, in its frame.
struct Setup {
    std::string name;
    std::vector<geometry::Shape> shapes;
    double radius = 0;  ///< of the spheres [m]
    Vec3 low{0}, high{0};
    double depthError = 1e-6;  ///< allowed error of an overlap, as a fraction of it
    double turnError = 2e-6;   ///< allowed error of a direction [rad]
    double error = 1e-13;      ///< allowed error of an overlap beside that [m]
};

struct Tally {
    std::size_t asked = 0, met = 0, several = 0, left = 0, wrongNumber = 0, wrongPlace = 0, deepestNotFirst = 0,
                missed = 0, farNear = 0, otherFromList = 0;
    double worstDepth = 0;  ///< error of an overlap, as a fraction of what is allowed
    double worstTurn = 0;   ///< error of a direction
};

inline geometry::Pose anyPose(std::mt19937_64& random) {
    std::normal_distribution<double> normal;
    const double w = normal(random), x = normal(random), y = normal(random), z = normal(random);
    return {glm::normalize(geometry::Rotation(w, x, y, z)), within(random, Vec3(-0.1), Vec3(0.1))};
}

/// `spheres` that touch by up to a fifth of their radius, and a tenth as many that do not.
inline Tally compare(Narrow& narrow, const Setup& setup, std::size_t spheres, unsigned seed = 11) {
    std::mt19937_64 random(seed);
    const geometry::Pose pose = anyPose(random);
    const double radius = double(float(setup.radius));
    std::vector<Query> queries;
    std::vector<std::vector<geometry::Feature>> expected;
    std::vector<Vec3> centres;
    Tally tally;
    std::size_t others = 0;
    for (std::size_t n = 0; n < 200 * spheres && queries.size() < spheres; ++n) {
        const Vec3 world = rounded(pose.toWorld(within(random, setup.low, setup.high)));
        const Vec3 q = pose.toBody(world);
        const std::vector<geometry::Feature> found = geometry::touched(setup.shapes, q, radius);
        const bool touches = !found.empty() && found.front().distance > 0.8 * radius;
        if (!touches && (!found.empty() || 10 * others++ > queries.size())) continue;
        queries.push_back({world, radius, 0});
        expected.push_back(found);
        centres.push_back(q);
    }
    const PackedBodies packed = packBodies({bodyOf(setup.shapes)}, radius * 1.05);
    const std::vector<Answer> answers = narrow.ask(packed, {pose}, queries);
    for (std::size_t i = 0; i < queries.size(); ++i) {
        ++tally.asked;
        if (onEdge(setup.shapes, centres[i], radius, expected[i])) {
            ++tally.left;
            continue;
        }
        const Answer& a = answers[i];
        if (!expected[i].empty()) ++tally.met;
        if (expected[i].size() > 1) ++tally.several;
        if (!expected[i].empty() && !(a.mayTouch && a.mayBeNear)) ++tally.missed;
        if (expected[i].empty() && a.mayBeNear) ++tally.farNear;
        if (!a.sameFromList) ++tally.otherFromList;
        if (a.count != expected[i].size()) {
            ++tally.wrongNumber;
            continue;
        }
        std::vector<geometry::Feature> world = expected[i];
        for (geometry::Feature& f : world) f.normal = pose.directionToWorld(f.normal);
        if (!alike(world, a.features, 0.01 * radius, 0.01)) ++tally.wrongPlace;
        for (std::size_t k = 0; k < world.size(); ++k) {
            if (a.features[k].distance < a.features[0].distance) ++tally.deepestNotFirst;
            // The nearest in direction is the same feature.
            const auto nearest = std::min_element(
                a.features.begin(), a.features.end(), [&](const geometry::Feature& f, const geometry::Feature& g) {
                    return glm::dot(f.normal, world[k].normal) > glm::dot(g.normal, world[k].normal);
                });
            // An overlap delta - p^2/delta is known as well as its delta and p are, each of which counts twice at most.
            // A normal counts by its share. The ridge of two planes turns by more than they do: by one over the sine of
            // their angle, which is 20 degrees or more.
            const double share = world[k].share, counts = share == 1 ? 1 : 4;
            const double turns = share == 1 ? 1 : counts / std::sin(kPi / 9);
            const double depth = radius - world[share == 1 ? k : 0].distance;
            const double allowed = counts * (setup.depthError * depth + setup.error);
            tally.worstDepth = std::max(tally.worstDepth, std::abs(nearest->distance - world[k].distance) / allowed);
            tally.worstTurn = std::max(tally.worstTurn,
                                       std::min(share, 1.0) * glm::length(nearest->normal - world[k].normal) / turns);
        }
    }
    return tally;
}

inline void check(Narrow& narrow, const Setup& setup, std::size_t spheres, std::size_t atLeast) {
    const Tally t = compare(narrow, setup, spheres);
    CAPTURE(setup.name, setup.radius, t.asked, t.met, t.several, t.left, t.wrongNumber, t.wrongPlace, t.deepestNotFirst,
            t.missed, t.farNear, t.otherFromList, t.worstDepth, t.worstTurn);
    CHECK(t.met >= atLeast);
    CHECK(t.left * 100 <= t.asked);
    CHECK(t.wrongNumber == 0);
    CHECK(t.wrongPlace == 0);
    CHECK(t.deepestNotFirst == 0);
    CHECK(t.missed == 0);
    CHECK(t.otherFromList == 0);
    CHECK(t.worstDepth <= 1);
    CHECK(t.worstTurn <= setup.turnError);
}

}  // namespace vkdose::test
