#include "host/bench/plain_loop.h"

#include <algorithm>
#include <barrier>
#include <cmath>
#include <thread>
#include <vector>

// This file is compiled without vectorisation (CMakeLists.txt), because a loop that the compiler vectorises with AVX is
// another yardstick.

namespace vkdose::bench {

namespace {

using V = glm::vec3;

struct Sphere {
    V at;
    float radius;
};
struct Motion {
    V velocity;
    float inverseMass;
    V spin;
    float inverseInertia;
};
struct Load {
    V force{0}, torque{0};
};

/// The memory of a pair, and the other one of the two.
struct Near {
    std::uint32_t other;
    float maxOverlap = 0;
    V sliding{0}, rolling{0};
};

/// Lists every pair closer than the sum of radii + skin once, in the row of the smaller index. (With a full list both
/// of a pair compute the contact and nobody adds to another's load. It reached 0.62 of the speed.)
struct List {
    std::vector<std::uint32_t> start;
    std::vector<Near> near;

    List(const std::vector<Sphere>& s, float skin) {
        float largest = 0;
        for (const Sphere& a : s) largest = std::max(largest, a.radius);
        const float width = 2 * largest + skin;
        const auto cell = [&](const Sphere& a, int axis) {
            return std::int64_t(std::floor(a.at[axis] / width)) + (1 << 20);
        };
        const auto key = [](std::int64_t x, std::int64_t y, std::int64_t z) { return (x << 42) + (y << 21) + z; };
        std::vector<std::pair<std::int64_t, std::uint32_t>> sorted;
        for (std::uint32_t i = 0; i < s.size(); ++i)
            sorted.emplace_back(key(cell(s[i], 0), cell(s[i], 1), cell(s[i], 2)), i);
        std::sort(sorted.begin(), sorted.end());
        start.push_back(0);
        for (std::uint32_t i = 0; i < s.size(); ++i) {
            const std::int64_t x = cell(s[i], 0), y = cell(s[i], 1), z = cell(s[i], 2);
            for (int column = 0; column < 9; ++column) {
                // The three cells of a column follow each other in the order.
                const std::int64_t first = key(x + column % 3 - 1, y + column / 3 - 1, z - 1);
                auto at = std::lower_bound(sorted.begin(), sorted.end(), std::pair(first, 0u));
                for (; at != sorted.end() && at->first <= first + 2; ++at) collect(s, skin, i, at->second);
            }
            start.push_back(std::uint32_t(near.size()));
        }
    }

  private:
    void collect(const std::vector<Sphere>& s, float skin, std::uint32_t i, std::uint32_t j) {
        const V apart = s[i].at - s[j].at;
        const float reach = s[i].radius + s[j].radius + skin;
        if (i < j && glm::dot(apart, apart) < reach * reach) near.push_back({j});
    }
};

/// Spring, dashpot and slider in the tangent plane.
struct Slider {
    float stiffness, viscosity, friction;

    V force(float bearing, const V& n, const V& v, float dt, V& spring) const {
        if (friction <= 0) return V(0);
        const V tangent = spring - n * glm::dot(n, spring);
        const float square = glm::dot(tangent, tangent);
        spring = (square > 0 ? tangent * std::sqrt(glm::dot(spring, spring) / square) : V(0)) + v * dt;
        const V trial = -stiffness * spring - viscosity * v;
        const float size = glm::dot(trial, trial), limit = friction * bearing;
        if (size <= limit * limit) return trial;
        const V slipping = trial * (limit / std::sqrt(size));
        spring = -(slipping + viscosity * v) / stiffness;
        return slipping;
    }
};

/// The law between two spheres, without torsion (formulas: physics.md).
struct Law {
    float k1, k2Max, kc, depth, gamma, lever;
    Slider sliding{}, rolling{};
    bool shifted;  ///< CoulombLimit::Luding

    explicit Law(const ContactLaw& law) {
        const ContactParameters& p = law.of(ContactClass::ParticleParticle);
        k1 = float(p.k1), k2Max = float(p.k2Max), kc = float(p.kc), gamma = float(p.gamma);
        depth = float(p.k2Max / (p.k2Max - p.k1) * p.plasticityDepth);
        lever = law.rollingLever == RollingLever::Full ? 1.0f : 0.5f;
        sliding = {float(p.kt), float(p.gammaT), float(p.mu)};
        rolling = {float(p.kr), float(p.gammaR), float(p.muR)};
        shifted = p.coulombLimit == CoulombLimit::Luding;
    }

    float normal(float overlap, float reduced, float& maxOverlap) const {
        maxOverlap = std::max(maxOverlap, overlap);
        const float limit = depth * reduced, capped = std::min(maxOverlap, limit);
        const float k2 = k1 + (k2Max - k1) * (capped / limit);
        const float unloading = k2 * overlap - (k2 - k1) * capped;
        if (overlap > limit) return unloading;
        if (unloading >= k1 * overlap) return k1 * overlap;
        if (unloading > -kc * overlap) return unloading;
        maxOverlap = overlap * (k2 + kc) / (k2 - k1);
        return -kc * overlap;
    }

    /// Adds the force and torque of the contact to i and to j.
    void act(const Sphere& i, const Sphere& j, const Motion& u, const Motion& v, float dt, Near& near, Load& onI,
             Load& onJ) const {
        const V apart = i.at - j.at;
        const float square = glm::dot(apart, apart), reach = i.radius + j.radius;
        if (square >= reach * reach) {
            near = {near.other};
            return;
        }
        const float distance = std::sqrt(square), overlap = reach - distance;
        const float reduced = 2 * i.radius * j.radius / reach;
        const V n = apart / distance;
        const V leverI = (overlap / 2 - i.radius) * n, leverJ = (j.radius - overlap / 2) * n;
        const V relative = u.velocity - v.velocity + glm::cross(u.spin, leverI) - glm::cross(v.spin, leverJ);
        const float approach = glm::dot(relative, n), hysteretic = normal(overlap, reduced, near.maxOverlap);
        const float f = hysteretic - gamma * approach;
        const float bearing = shifted ? std::max(0.0f, hysteretic + kc * overlap) : std::abs(f);
        const V tangential = sliding.force(bearing, n, relative - approach * n, dt, near.sliding);
        const float arm = lever * reduced;
        const V rolls = -arm * glm::cross(n, u.spin - v.spin);
        const V couple = arm * glm::cross(n, rolling.force(bearing, n, rolls, dt, near.rolling));
        const V force = f * n + tangential;
        onI.force += force;
        onI.torque += glm::cross(leverI, tangential) + couple;
        onJ.force -= force;
        onJ.torque -= glm::cross(leverJ, tangential) + couple;
    }
};

std::vector<Sphere> spheresOf(const Particles& p) {
    std::vector<Sphere> spheres;
    for (std::size_t i = 0; i < p.size(); ++i) spheres.push_back({V(p.position[i]), float(p.radius[i])});
    return spheres;
}

}  // namespace

struct PlainLoop::Loop {
    std::vector<Sphere> sphere;
    std::vector<Motion> motion;
    std::vector<std::vector<Load>> load;  // one for each thread, so that no two threads add to the same load
    List list;
    Law law;
    float dt;

    Loop(const RuledWorld& w, const Particles& p, int threads, double inertia)
        : sphere(spheresOf(p)),
          load(threads, std::vector<Load>(p.size())),
          list(sphere, float(w.skin)),
          law(w.law),
          dt(float(w.timeStep)) {
        for (std::size_t i = 0; i < p.size(); ++i) {
            const double r = p.radius[i], mass = inertia * w.density() * 4 / 3 * kPi * r * r * r;
            motion.push_back({V(p.velocity[i]), float(1 / mass), V(p.spin[i]), float(1 / (0.4 * mass * r * r))});
        }
    }

    /// The first row of a thread. Every thread has rows with about the same number of pairs.
    std::size_t firstRow(std::size_t thread) const {
        const auto share = std::uint32_t(list.near.size() * thread / load.size());
        return std::size_t(std::lower_bound(list.start.begin(), list.start.end() - 1, share) - list.start.begin());
    }

    void forces(std::size_t begin, std::size_t end, std::vector<Load>& mine) {
        for (std::size_t i = begin; i < end; ++i) {
            const Sphere a = sphere[i];
            const Motion u = motion[i];
            Load onI;
            for (std::uint32_t e = list.start[i]; e < list.start[i + 1]; ++e) {
                Near& near = list.near[e];
                law.act(a, sphere[near.other], u, motion[near.other], dt, near, onI, mine[near.other]);
            }
            mine[i].force += onI.force;
            mine[i].torque += onI.torque;
        }
    }

    void move(std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            Motion& u = motion[i];
            for (std::vector<Load>& l : load) {
                u.velocity += dt * u.inverseMass * l[i].force;
                u.spin += dt * u.inverseInertia * l[i].torque;
                l[i] = {};
            }
            sphere[i].at += dt * u.velocity;
        }
    }
};

PlainLoop::PlainLoop(const RuledWorld& world, const Particles& particles, int threads, double inertia)
    : loop_(std::make_unique<Loop>(world, particles, threads, inertia)) {}

PlainLoop::~PlainLoop() = default;

void PlainLoop::advance(std::uint32_t steps) {
    Loop& loop = *loop_;
    const std::size_t n = loop.sphere.size(), threads = loop.load.size();
    std::barrier<> together{std::ptrdiff_t(threads)};
    const auto work = [&](std::size_t t) {
        const std::size_t begin = loop.firstRow(t), end = t + 1 < threads ? loop.firstRow(t + 1) : n;
        for (std::uint32_t s = 0; s < steps; ++s) {
            loop.forces(begin, end, loop.load[t]);
            together.arrive_and_wait();
            loop.move(n * t / threads, n * (t + 1) / threads);
            together.arrive_and_wait();
        }
    };
    std::vector<std::thread> others;
    for (std::size_t t = 1; t < threads; ++t) others.emplace_back(work, t);
    work(0);
    for (std::thread& t : others) t.join();
}

Particles PlainLoop::particles() const {
    Particles p;
    for (std::size_t i = 0; i < loop_->sphere.size(); ++i) {
        const Motion& u = loop_->motion[i];
        p.add(Vec3(loop_->sphere[i].at), double(loop_->sphere[i].radius), Vec3(u.velocity), Vec3(u.spin));
    }
    return p;
}

double PlainLoop::listed() const {
    return 2 * double(loop_->list.near.size()) / double(loop_->sphere.size());
}

double PlainLoop::touching() const {
    const std::vector<Sphere>& s = loop_->sphere;
    std::size_t found = 0;
    for (std::size_t i = 0; i < s.size(); ++i)
        for (std::uint32_t e = loop_->list.start[i]; e < loop_->list.start[i + 1]; ++e) {
            const Sphere& other = s[loop_->list.near[e].other];
            if (glm::length(s[i].at - other.at) < s[i].radius + other.radius) ++found;
        }
    return 2 * double(found) / double(s.size());
}

}  // namespace vkdose::bench
