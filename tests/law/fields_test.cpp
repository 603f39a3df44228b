// Coarse-grained fields of the reference against closed forms.

#include "host/backend/reference/fields.h"

#include <random>

#include "tests/law/setups.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::test;
using reference::Branch;
using reference::coarseGrain;

namespace {

FieldRequest request(const Vec3& low, const Vec3& high, std::array<std::uint32_t, 3> cells, double width,
                     Kernel kernel = Kernel::Gaussian) {
    FieldRequest r;
    r.grid = {low, high, cells};
    r.kernel = kernel;
    r.width = width;
    r.contactStress = true;
    return r;
}

/// A world of one powder of the density kDensity.
World onePowder() {
    World world;
    world.density() = kDensity;
    return world;
}

Particles cloud(std::size_t n, double box) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(-0.5, 0.5), radius(0.6e-3, 1.8e-3), speed(-1, 1);
    Particles p;
    for (std::size_t i = 0; i < n; ++i)
        p.add(box * Vec3(unit(random), unit(random), unit(random)), radius(random),
              {speed(random), speed(random), speed(random)});
    return p;
}

FieldPoint sumOf(const FieldRequest& r, const FieldPoints& points) {
    std::array<double, FieldPoint::kNumbers> sum{};
    for (const FieldPoint& p : points)
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += p.numbers()[k] * r.grid.cellVolume();
    return FieldPoint::of(sum.data());
}

/// The kernel's value in the middle over its integral, without a grid: what a sphere alone must show [1/m^directions].
double peak(Kernel kernel, int directions, double w) {
    if (kernel == Kernel::Lucy)
        return directions == 1 ? 5 / (4 * w) : directions == 2 ? 5 / (kPi * w * w) : 105 / (16 * kPi * w * w * w);
    const double cut = 3, tail = std::exp(-cut * cut / 2);  // of the Gaussian, cut at three widths
    const double kept = directions == 1   ? std::erf(cut / std::sqrt(2.0))
                        : directions == 2 ? 1 - tail
                                          : std::erf(cut / std::sqrt(2.0)) - std::sqrt(2 / kPi) * cut * tail;
    return 1 / (std::pow(2 * kPi * w * w, directions / 2.0) * kept);
}

}  // namespace

TEST_CASE("fields: a property of particles is carried by their mass") {
    Particles p = cloud(40, 20e-3);
    double carried = 0, mass = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        p.properties.push_back({double(i), -1, 0, 0.5});
        const double m = massOf(onePowder(), p, i);
        carried += m * double(i);
        mass += m;
    }
    const FieldRequest r = request(Vec3(-20e-3), Vec3(20e-3), {5, 7, 9}, 6e-3);
    const FieldPoints points = coarseGrain(r, onePowder(), p, {});
    const FieldPoint sum = sumOf(r, points);
    CHECK(nearRelative(sum.properties[0], carried, 1e-12));
    CHECK(nearRelative(sum.properties[1], -mass, 1e-12));
    CHECK(sum.properties[2] == 0);
    for (const FieldPoint& at : points)
        if (at.density > 0) CHECK(near(at.property(3), 0.5, 1, 1e-12));
    CHECK(std::isnan(FieldPoint().property(0)));
}

TEST_CASE("fields: the density integrates to the mass in the grid, to rounding, wherever its faces cut the kernels") {
    const double box = 0.02;
    const Particles p = cloud(211, box);
    const auto kernel = GENERATE(Kernel::Gaussian, Kernel::Lucy);
    const auto cells = GENERATE(std::array<std::uint32_t, 3>{1, 1, 1}, std::array<std::uint32_t, 3>{1, 1, 17},
                                std::array<std::uint32_t, 3>{1, 13, 17}, std::array<std::uint32_t, 3>{7, 11, 13});
    const double half = GENERATE(0.6, 0.3);  // of the box: all of the cloud, and part of it
    const FieldRequest r = request(Vec3(-half * box), Vec3(half * box), cells, 0.004, kernel);
    double mass = 0, momentum = 0;
    std::size_t inside = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        if (!glm::all(glm::lessThanEqual(glm::abs(p.position[i]), Vec3(half * box)))) continue;
        mass += massOf(p.radius[i]);
        momentum += massOf(p.radius[i]) * p.velocity[i].z;
        ++inside;
    }
    REQUIRE(inside > 20);
    REQUIRE((half > 0.5) == (inside == p.size()));
    const FieldPoint sum = sumOf(r, coarseGrain(r, onePowder(), p, {}));
    CHECK(nearRelative(sum.density, mass, 1e-13));  // some 200 roundings
    CHECK(nearRelative(sum.number, double(inside), 1e-13));
    CHECK(near(sum.momentum.z, momentum, mass, 1e-13));
}

TEST_CASE("fields: a sphere far from every face shows the kernel with its closed-form norm") {
    const auto kernel = GENERATE(Kernel::Gaussian, Kernel::Lucy);
    const double w = kernel == Kernel::Gaussian ? 1e-3 : 3e-3, depth = 0.015;
    const auto cells = GENERATE(std::array<std::uint32_t, 3>{1, 1, 61}, std::array<std::uint32_t, 3>{1, 61, 61},
                                std::array<std::uint32_t, 3>{61, 61, 61});
    const FieldRequest r = request(Vec3(-depth / 2), Vec3(depth / 2), cells, w, kernel);
    Particles p;
    p.add(Vec3(0), kRadius);  // on the middle point
    const FieldPoints points = coarseGrain(r, onePowder(), p, {});
    const int directions = r.grid.resolvedDirections();
    const double m = massOf(kRadius) / std::pow(depth, 3 - directions);
    const double top = m * peak(kernel, directions, w);
    // The norm is a sum over points. For the Gaussian all that this leaves is its edge, three widths out, where it
    // falls from 1.1 % of its peak to zero: two points, a circle or a sphere, along which the sum counts up to half a
    // cell too much or too little. Lucy's kernel ends smoothly; its third derivative jumps by 96/w^3 in the middle and
    // by 24/w^3 at its ends, which by Euler and Maclaurin is worth h^4/720 of that in one direction, over an integral
    // of 4 w/5, and less in more directions, where the middle is a smaller part.
    const double h = r.grid.cell().z;
    const double edge = directions == 1 ? 2 : directions == 2 ? 2 * kPi * 3 * w : 4 * kPi * 9 * w * w;
    const double tolerance = kernel == Kernel::Gaussian ? edge * h / 2 * std::exp(-4.5) * peak(kernel, directions, w)
                                                        : std::pow(h / w, 4) * (96 + 2 * 24) / 720 / 0.8;
    CAPTURE(directions, tolerance);
    CHECK(nearRelative(points[points.size() / 2].density, top, tolerance));
    for (std::size_t k = 0; k < points.size(); k += 7) {
        Vec3 away = r.grid.point(k);
        for (int d = 0; d < 3; ++d)
            if (!r.grid.resolved(d)) away[d] = 0;
        CHECK(near(points[k].density, top * r.shape(glm::length(away)), top, tolerance));
    }
}

TEST_CASE("fields: a bed that moves as one has exactly that velocity everywhere, and no temperature") {
    Particles p = cloud(97, 0.02);
    const Vec3 v(0.013, -0.4, 1.7);
    for (Vec3& velocity : p.velocity) velocity = v;
    const FieldRequest r = request(Vec3(-0.02), Vec3(0.02), {9, 8, 7}, 0.006, Kernel::Lucy);
    std::size_t filled = 0;
    for (const FieldPoint& at : coarseGrain(r, onePowder(), p, {})) {
        if (at.density == 0) {
            CHECK(std::isnan(at.velocity().x));
            continue;
        }
        ++filled;
        CHECK(near(at.velocity(), v, glm::length(v), 1e-14));
        CHECK(near(at.temperature(), 0, glm::dot(v, v), 1e-28));
    }
    CHECK(filled > 100);
}

TEST_CASE("fields: a rigid rotation of a lattice is seen as such within it") {
    Particles p;
    const Vec3 spin(3, -2, 5);
    for (int x = -8; x <= 8; ++x)
        for (int y = -8; y <= 8; ++y)
            for (int z = -8; z <= 8; ++z) {
                const Vec3 at = 1e-3 * Vec3(x, y, z);
                p.add(at, 0.5e-3, glm::cross(spin, at));
            }
    const FieldRequest r = request(Vec3(-8.5e-3), Vec3(8.5e-3), {17, 17, 17}, 2.5e-3, Kernel::Lucy);
    const FieldPoints points = coarseGrain(r, onePowder(), p, {});
    const double speed = glm::length(spin) * 5e-3;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const Vec3 at = r.grid.point(k);
        if (glm::any(glm::greaterThan(glm::abs(at), Vec3(3.1e-3)))) continue;   // whole kernels only
        CHECK(near(points[k].velocity(), glm::cross(spin, at), speed, 1e-12));  // by the symmetry of the lattice
    }
}

TEST_CASE("fields: the kinetic stress is that of the strays from the mean velocity") {
    Particles p;  // in one place, so that the kernel cancels
    p.add(Vec3(0), 1e-3, {1, 0, 2});
    p.add(Vec3(0), 1e-3, {-1, 1, 2});
    p.add(Vec3(0), 1e-3, {0, -1, 2});
    const FieldRequest r = request(Vec3(-0.01), Vec3(0.01), {5, 5, 5}, 0.006, Kernel::Lucy);
    const FieldPoint sum = sumOf(r, coarseGrain(r, onePowder(), p, {}));
    const double m = massOf(1e-3);
    const std::array<double, 6> strays{2, 2, 0, 0, 0, -1};  // xx yy zz yz zx xy
    for (std::size_t k = 0; k < 6; ++k) CHECK(near(sum.kineticStress[k], strays[k] * m, m, 1e-12));
    CHECK(nearRelative(sum.temperature(), 4.0 / 9, 1e-12));
}

TEST_CASE("fields: the stress of a contact integrates to force times branch, and follows the kernel's mean along it") {
    Particles p;
    p.add(Vec3(0), kRadius);
    p.add(Vec3(0, 0, 2e-3), kRadius);
    const Vec3 force(1, -2, 3), along(0.5e-3, 0.2e-3, -2e-3);
    const std::vector<Branch> branches{{0, 1, true, Vec3(0.1e-3), along, force}};
    const double length = glm::length(along);
    // The promised accuracy of the quadrature (host/model/field.h).
    const auto [ratio, tolerance] = GENERATE(std::pair(2.0, 2e-5), std::pair(4.0, 1e-2));
    const double w = length / ratio;
    const FieldRequest r = request(Vec3(-0.008), Vec3(0.008), {25, 25, 25}, w);
    const FieldPoints points = coarseGrain(r, onePowder(), p, branches);
    const FieldPoint sum = sumOf(r, points);
    for (std::size_t a = 0; a < 3; ++a)
        CHECK(near(sum.contactStress[a], force[int(a)] * along, glm::length(force) * length, 1e-13));
    CHECK(nearRelative(sum.touches, 2, 1e-13));
    // The same mean in a thousand equal pieces, on the line through the branch's middle, where it is largest.
    const double scale = glm::length(force) * length * peak(Kernel::Gaussian, 3, w);
    for (const Vec3& at : {Vec3(0), Vec3(1.3e-3, 0, 0), Vec3(-1e-3, 0.4e-3, 1e-3)}) {
        double exact = 0, nodes = 0;
        const auto value = [&](double s) {
            const double d = glm::length(at - (branches[0].centre - s * along)) / w;
            return std::exp(-0.5 * d * d);
        };
        for (int k = 0; k < 1000; ++k) exact += value((k + 0.5) / 1000) / 1000;
        for (std::size_t n = 0; n < kBranchNodes.size(); ++n) nodes += kBranchShares[n] * value(kBranchNodes[n]);
        CHECK(near(nodes, exact, 1, tolerance));
    }
    for (std::size_t k = 0; k < points.size(); k += 11) {
        double mean = 0;
        for (int s = 0; s < 200; ++s)
            mean += r.shape(glm::length(r.grid.point(k) - (branches[0].centre - (s + 0.5) / 200 * along))) / 200;
        const double expected = peak(Kernel::Gaussian, 3, w) * mean * force.z * along.z;
        // Where the Gaussian is cut, single nodes are in or out of reach: 1.1 % of the peak each.
        CHECK(near(points[k].contactStress[2].z, expected, scale, tolerance + 1.2e-2));
    }
}

TEST_CASE("fields: each of two powders bears the stress of the branch from its centres to the contact point") {
    const double large = 1.5e-3, small = 0.5e-3, overlap = 0.1e-3;
    const Vec3 force(1, -2, 3), direction = glm::normalize(Vec3(0.3, 0.1, -1));
    const double length = large + small - overlap;
    const bool largeFirst = GENERATE(true, false);
    Particles p;
    p.add(Vec3(0), largeFirst ? large : small, Vec3(0), Vec3(0), largeFirst ? 0 : 1);
    p.add(-length * direction, largeFirst ? small : large, Vec3(0), Vec3(0), largeFirst ? 1 : 0);
    const std::vector<Branch> branches{{0, 1, true, Vec3(0), length * direction, force},
                                       {1, 0, false, p.position[1], 0.4e-3 * direction, 2.0 * force}};
    FieldRequest r = request(Vec3(-0.012), Vec3(0.012), {33, 33, 33}, 1.5e-3, Kernel::Lucy);
    const std::array<double, 2> inside{large - overlap / 2, small - overlap / 2};
    World world = onePowder();
    world.density(1) = kDensity;
    for (const int material : {0, 1}) {
        r.material = material;
        const bool first = (material == 0) == largeFirst;
        const FieldPoints points = coarseGrain(r, world, p, branches);
        const FieldPoint sum = sumOf(r, points);
        // The wall's branch is wholly of the particle that touches it.
        const double along = inside[std::size_t(material)] + (first ? 0 : 2 * 0.4e-3);
        for (std::size_t a = 0; a < 3; ++a)
            CHECK(near(sum.contactStress[a], force[int(a)] * along * direction, glm::length(force) * length, 1e-13));
    }
    // Where: the middle of the stress is the middle of the part. The grid places the middle of a kernel that it
    // resolves to a small part of a cell.
    r.material = 0;
    const FieldPoints points = coarseGrain(r, world, p, {branches[0]});
    Vec3 middle(0);
    double whole = 0;
    for (std::size_t k = 0; k < points.size(); ++k) {
        middle += points[k].contactStress[2].z * r.grid.point(k);
        whole += points[k].contactStress[2].z;
    }
    const Vec3 expected = (largeFirst ? 0.5 * inside[0] : length - 0.5 * inside[0]) * -direction;
    CHECK(near(middle / whole, expected, length, 0.02));
}

TEST_CASE("fields: in a column at rest the vertical stress balances the weight above, and the floor's reaction") {
    constexpr int kSpheres = 12;
    const double k = 2000, m = massOf(kRadius), weight = m * kGravity;
    RuledWorld world = planeWorld(spring(k), 1e-6);
    world.gravity = Vec3(0, -kGravity, 0);
    Particles p;
    double y = 0;
    for (int i = 0; i < kSpheres; ++i) {  // each contact bears what is above it
        y += (i == 0 ? 1 : 2) * kRadius - (kSpheres - i) * weight / k;
        p.add({0, y, 0}, kRadius);
    }
    const auto backend = makeReferenceBackend();
    backend->load(world, p);
    // A grid whose lower face is the floor; the kernel wide enough to make layers a continuum.
    const double half = 2e-3, top = 2 * kRadius * (kSpheres + 6), area = 4 * half * half;
    FieldRequest r = request({-half, 0, -half}, {half, top, half}, {1, 180, 1}, 2 * kRadius);
    CHECK(sumOf(r, backend->fields(r)).contactStress[1].y == 0);  // no step, no forces
    backend->advance(1, 0);
    const FieldPoints points = backend->fields(r);
    const double h = r.grid.cell().y;

    double above = 0, worst = 0;
    for (std::size_t n = points.size(); n-- > 0;) {
        above += points[n].density * area * h * kGravity;
        const double at = r.grid.point(n).y;
        if (at < 2 * r.reach()) continue;  // kernels that the floor cuts are not the same everywhere
        const double borne = points[n].contactStress[1].y * area;
        worst = std::max(worst, std::abs(borne - (above - 0.5 * points[n].density * area * h * kGravity)));
    }
    // Where the Gaussian is cut its derivative is not the flow of force; 1.1 % of a sphere's weight at each end.
    CHECK(near(worst, 0, kSpheres * weight, 2e-3));
    CHECK(nearRelative(above, kSpheres * weight, 1e-12));

    // The integral is the virial: each contact's force times its branch, the floor's the whole weight over a radius.
    double virial = 0;
    for (int i = 0; i < kSpheres; ++i) {
        const double f = (kSpheres - i) * weight;
        virial += f * ((i == 0 ? 1 : 2) * kRadius - f / k);
    }
    const FieldPoint sum = sumOf(r, points);
    CHECK(nearRelative(sum.contactStress[1].y, virial, 1e-9));  // positions round the overlaps of a micrometre
    // The topmost and the lowest touch one other sphere, the rest two.
    CHECK(nearRelative(sum.coordination(), 2.0 * (kSpheres - 1) / kSpheres, 1e-12));
}

TEST_CASE("fields: what cannot be met is refused with what would be right") {
    FieldRequest r = request(Vec3(-0.01), Vec3(0.01), {10, 10, 10}, 2e-3);
    CHECK_FALSE(faultOf(r));
    r.width = 0.5e-3;  // cells of 2 mm
    CHECK(faultOf(r)->find("cells of at most 0.00172414 m") != std::string::npos);
    r.width = 0;
    CHECK(faultOf(r)->find("no width") != std::string::npos);
    r = request(Vec3(-0.01), Vec3(0.01), {100, 100, 101}, 2e-3);
    CHECK(faultOf(r)->find("1000000") != std::string::npos);
    r = request(Vec3(-0.01), Vec3(0.01), {100, 100, 100}, 3e-3);
    CHECK(faultOf(r)->find("larger cells") != std::string::npos);
    r = request(Vec3(0.01), Vec3(-0.01), {10, 10, 10}, 3e-3);
    CHECK(faultOf(r)->find("low < high") != std::string::npos);
    const auto backend = makeReferenceBackend();
    backend->load(freeWorld(spring(1), 1e-6), cloud(3, 0.01));
    CHECK_THROWS(backend->fields(r));
}
