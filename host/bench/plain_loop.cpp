#include "host/bench/plain_loop.h"

#include <algorithm>
#include <barrier>
#include <cmath>
#include <thread>
#include <vector>

namespace vkdose::bench {

namespace {

struct Sphere {
    float x, y, z, radius;
};
struct Velocity {
    float x, y, z, inverseMass;
};

/// Every pair closer than the sum of radii + skin, in both particles' rows.
struct List {
    std::vector<std::uint32_t> start, other;

    List(const std::vector<Sphere>& s, float skin) {
        float largest = 0;
        for (const Sphere& a : s) largest = std::max(largest, a.radius);
        const float width = 2 * largest + skin;
        const auto cell = [&](const Sphere& a, int axis) {
            return std::int64_t(std::floor((axis == 0 ? a.x : axis == 1 ? a.y : a.z) / width)) + (1 << 20);
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
            start.push_back(std::uint32_t(other.size()));
        }
    }

  private:
    void collect(const std::vector<Sphere>& s, float skin, std::uint32_t i, std::uint32_t j) {
        const float dx = s[i].x - s[j].x, dy = s[i].y - s[j].y, dz = s[i].z - s[j].z;
        const float reach = s[i].radius + s[j].radius + skin;
        if (i != j && dx * dx + dy * dy + dz * dz < reach * reach) other.push_back(j);
    }
};

std::vector<Sphere> spheresOf(const Particles& p) {
    std::vector<Sphere> spheres;
    for (std::size_t i = 0; i < p.size(); ++i)
        spheres.push_back({float(p.position[i].x), float(p.position[i].y), float(p.position[i].z), float(p.radius[i])});
    return spheres;
}

}  // namespace

struct PlainLoop::Loop {
    // Two halves that take turns, so that nobody reads what another thread is writing.
    std::vector<Sphere> sphere[2];
    std::vector<Velocity> velocity[2];
    std::vector<Sphere> loaded;
    List list;
    float k, gamma, dt;
    int threads;
    int source = 0;

    Loop(const World& w, const Particles& p, int n)
        : loaded(spheresOf(p)),
          list(loaded, float(w.skin)),
          k(float(w.law.of(ContactClass::ParticleParticle).k1)),
          gamma(float(w.law.of(ContactClass::ParticleParticle).gamma)),
          dt(1e-6f * float(w.timeStep)),
          threads(n) {
        sphere[0] = sphere[1] = loaded;
        for (const Sphere& s : loaded)
            velocity[0].push_back({0, 0, 0, 1 / (float(w.density) * 4.18879f * s.radius * s.radius * s.radius)});
        velocity[1] = velocity[0];
    }

    void step(int from, std::size_t begin, std::size_t end) {
        const std::vector<Sphere>& at = sphere[from];
        const std::vector<Velocity>& moving = velocity[from];
        for (std::size_t i = begin; i < end; ++i) {
            const Sphere a = at[i];
            Velocity u = moving[i];
            float fx = 0, fy = 0, fz = 0;
            for (std::uint32_t e = list.start[i]; e < list.start[i + 1]; ++e) {
                const Sphere& b = at[list.other[e]];
                const float dx = a.x - b.x, dy = a.y - b.y, dz = a.z - b.z;
                const float square = dx * dx + dy * dy + dz * dz, reach = a.radius + b.radius;
                if (square >= reach * reach) continue;
                const Velocity& v = moving[list.other[e]];
                const float distance = std::sqrt(square), inverse = 1 / distance;
                const float approach = ((u.x - v.x) * dx + (u.y - v.y) * dy + (u.z - v.z) * dz) * inverse;
                const float f = (k * (reach - distance) - gamma * approach) * inverse;
                fx += f * dx;
                fy += f * dy;
                fz += f * dz;
            }
            u.x += dt * u.inverseMass * fx;
            u.y += dt * u.inverseMass * fy;
            u.z += dt * u.inverseMass * fz;
            velocity[1 - from][i] = u;
            sphere[1 - from][i] = {a.x + dt * u.x, a.y + dt * u.y, a.z + dt * u.z, a.radius};
        }
    }
};

PlainLoop::PlainLoop(const World& world, const Particles& particles, int threads)
    : loop_(std::make_unique<Loop>(world, particles, threads)) {}

PlainLoop::~PlainLoop() = default;

void PlainLoop::advance(std::uint32_t steps) {
    Loop& loop = *loop_;
    std::barrier together(loop.threads);
    const std::size_t n = loop.loaded.size();
    const auto work = [&](int thread) {
        const std::size_t begin = n * thread / loop.threads, end = n * (thread + 1) / loop.threads;
        for (std::uint32_t s = 0; s < steps; ++s) {
            loop.step((loop.source + int(s)) % 2, begin, end);
            together.arrive_and_wait();
        }
    };
    std::vector<std::thread> others;
    for (int t = 1; t < loop.threads; ++t) others.emplace_back(work, t);
    work(0);
    for (std::thread& t : others) t.join();
    loop.source = (loop.source + int(steps % 2)) % 2;
}

double PlainLoop::listed() const {
    return double(loop_->list.other.size()) / double(loop_->loaded.size());
}

double PlainLoop::touching() const {
    const Loop& loop = *loop_;
    const std::vector<Sphere>& at = loop.sphere[loop.source];
    std::size_t found = 0;
    for (std::size_t i = 0; i < at.size(); ++i)
        for (std::uint32_t e = loop.list.start[i]; e < loop.list.start[i + 1]; ++e) {
            const Sphere &a = at[i], &b = at[loop.list.other[e]];
            if (std::hypot(a.x - b.x, a.y - b.y, a.z - b.z) < a.radius + b.radius) ++found;
        }
    return double(found) / double(at.size());
}

}  // namespace vkdose::bench
