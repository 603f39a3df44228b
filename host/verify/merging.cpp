// Places of a mesh that merge into one contact and part again, as a sphere moves over them: the energy of the contact
// follows the sphere without a jump.

#include <fmt/format.h>

#include <cmath>

#include "host/verify/cases.h"
#include "host/verify/setups.h"

namespace vkdose::verify {

namespace {

/// Corners of a cut across z, in radii; strips of triangles join them.
using Profile = std::vector<Vec3>;

geometry::Shape surfaceOf(const std::vector<Profile>& profiles) {
    std::vector<geometry::Triangle> triangles;
    const Vec3 back(0, 0, -4 * kRadius), front(0, 0, 4 * kRadius);
    for (const Profile& profile : profiles)
        for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
            const Vec3 a = profile[i] * kRadius, b = profile[i + 1] * kRadius;
            triangles.push_back({a + back, a + front, b + front});
            triangles.push_back({a + back, b + front, b + back});
        }
    return meshOf(triangles);
}

/// Two faces whose normals are so many degrees apart.
std::vector<Profile> groove(double degrees) {
    const double half = degrees / 2 * kPi / 180;
    const Vec3 end = 4.0 * Vec3(std::cos(half), std::sin(half), 0);
    return {{{-end.x, end.y, 0}, {0, 0, 0}, end}};
}

/// A slot between two blocks, so wide [radii].
std::vector<Profile> slot(double width) {
    const double x = width / 2;
    return {{{-4, 0, 0}, {-x, 0, 0}, {-x, -2, 0}}, {{x, -2, 0}, {x, 0, 0}, {4, 0, 0}}};
}

struct Surface {
    std::string name;
    std::vector<Profile> profiles;
    Vec3 from;  ///< where the sphere is let go [radii]
};

}  // namespace

// An elastic sphere falls onto such places off their middle and rebounds many times, by a tenth of its radius deep.
void mergingPlaces(Stage& stage) {
    const double k = 20, press = 100, dt = 5e-6;
    const std::vector<Surface> surfaces{{"a groove of 30 degrees", groove(30), {0.2, 1.2, 0.1}},
                                        {"a groove of 90 degrees", groove(90), {0.3, 1.7, 0.1}},
                                        {"a slot of 0.4 radii", slot(0.4), {0.1, 1.1, 0.1}}};
    const double scale = massOf(kRadius) * press * kRadius;
    for (const Surface& surface : surfaces) {
        RuledWorld world = space(spring(k), dt);
        world.gravity = Vec3(0, -press, 0);
        world.energyBook = true;
        world.maxOverlapRatio = 0.3;
        world.bodies = {bodyOf({surfaceOf(surface.profiles)})};
        Particles one;
        one.add(surface.from * kRadius, kRadius);
        Trial trial(stage, world, one);
        trial.advance(1);
        const double before = trial.energy().present();
        double most = 0;
        for (int call = 0; call < 20; ++call) {
            trial.advance(1000);
            most = std::max(most, std::abs(trial.energy().present() - before));
        }
        stage.check(fmt::format("change of the energy, {}", surface.name), "J", 0, most,
                    {1e-3, "time step of 1/500 of a contact, in units of the weight by a radius", scale});
    }
}

}  // namespace vkdose::verify
