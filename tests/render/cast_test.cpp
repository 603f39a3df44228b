// The ray caster against closed forms and against a brute-force picture in double precision.

#include "tests/render/scenes.h"

#include "host/model/body_mesh.h"
#include "host/render/colour.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::test;
using render::Camera;
using render::Image;
using render::Scene;

namespace {

constexpr double kRadius = 1.25e-3;

Vec3 colourOf(const Image::Pixel& p) {
    return Vec3(p.red, p.green, p.blue) / 255.0;
}

geometry::Coil paperCoil() {
    return {0.0104, 0.00875, 0.001, 0.07};
}

/// Camera from -x as in the side view, over the whole coil.
Camera sideCamera(double pixel) {
    Camera c = frontCamera(317, 211, pixel);
    c.right = {0, 0, 1};
    c.towards = {-1, 0, 0};
    c.target = {0, 0, 0.035};
    return c;
}

struct Difference {
    int pixels = 0;  ///< whose cover is not that of the brute-force picture
    int covered = 0;
    double depth = 0;  ///< largest, where the covers agree [m]
};

Difference difference(const Image& image, const Scene& scene, const Camera& camera) {
    Difference d;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const Sight sight = brutePixel(scene, camera, x, y);
            const int hits = int(std::lround(image.at(x, y).cover / 255.0 * kRays * kRays));
            d.covered += sight.hits > 0;
            if (hits != sight.hits)
                ++d.pixels;
            else if (hits > 0)
                d.depth = std::max(d.depth, std::abs(image.depthAt(x, y) - sight.depth));
        }
    return d;
}

}  // namespace

TEST_CASE("a sphere is a disc of its area, with its colour and depth in the middle") {
    Studio studio;
    Scene scene;
    const Vec3 colour(0.8, 0.3, 0.1);
    addSphere(scene, {0.3e-3, -0.2e-3, 0.5e-3}, kRadius, colour);
    const double pixel = 20e-6;
    const Camera camera = frontCamera(317, 211, pixel);
    const Image image = studio.draw(scene, camera);

    double area = 0;
    for (const Image::Pixel& p : image.pixels) area += p.cover / 255.0;
    // Nine rays to a pixel: the rim of 390 pixels is known to about a tenth of one each, with any sign.
    CHECK(nearRelative(area * pixel * pixel, kPi * kRadius * kRadius, 1e-3));

    const Camera::Place middle = camera.project(scene.centre[0]);
    const int x = int(middle.x), y = int(middle.y);
    CHECK(image.at(x, y).cover == 255);
    CHECK(near(image.depthAt(x, y), 0.5e-3 + kRadius, kRadius, 1e-4));  // within the pixel the sphere falls by less
    // Shaded, but of the same colour: light takes the same share of each component; 8 bits are good to 1 in 100.
    const Vec3 seen = render::linearLight(colourOf(image.at(x, y))), light = render::linearLight(colour);
    const double share = seen.x / light.x;
    CHECK(share > 0.7);
    CHECK(nearRelative(seen.y / light.y, share, 0.02));
    CHECK(near(seen.z / light.z, share, 1, 0.1));  // a dark component has fewer digits
}

TEST_CASE("every sphere is where it is projected to, and of its size") {
    Studio studio;
    Scene scene;
    std::vector<Vec3> centres;
    for (int i = 0; i < 7; ++i)
        for (int j = 0; j < 4; ++j)
            addSphere(scene, Vec3((i - 3) * 3e-3, (j - 1.6) * 3.1e-3, (i * j % 5) * 2e-3),
                      0.6e-3 + 0.1e-3 * (i + j) / 2, Vec3(0.5));
    const Camera camera = frontCamera(331, 211, 70e-6);
    std::vector<Blob> found = blobs(studio.draw(scene, camera));
    REQUIRE(found.size() == scene.centre.size());
    for (std::size_t i = 0; i < scene.centre.size(); ++i) {
        const Camera::Place place = camera.project(scene.centre[i]);
        const auto nearest = std::min_element(found.begin(), found.end(), [&](const Blob& a, const Blob& b) {
            return std::hypot(a.x - place.x, a.y - place.y) < std::hypot(b.x - place.x, b.y - place.y);
        });
        // Half of a pixel at the rim counts as one or none: that moves the middle by less than a fifth.
        CHECK(std::hypot(nearest->x - place.x, nearest->y - place.y) < 0.2);
        const double r = scene.radius[i] / camera.pixel;
        CHECK(nearRelative(nearest->pixels, kPi * r * r, 0.05));
    }
}

TEST_CASE("what is nearer hides what is behind it, from either side") {
    Studio studio;
    Scene scene;
    addSphere(scene, {0, 0, 0.01}, kRadius, {1, 0, 0});
    addSphere(scene, {0.3e-3, 0, -0.01}, kRadius, {0, 0, 1});
    Camera camera = frontCamera(101, 77, 50e-6);
    Image image = studio.draw(scene, camera);
    CHECK(image.at(50, 38).red > 150);
    CHECK(image.at(50, 38).blue == 0);
    camera.towards = {0, 0, -1};
    camera.right = {-1, 0, 0};
    image = studio.draw(scene, camera);
    CHECK(image.at(50, 38).blue > 150);
    CHECK(image.at(50, 38).red == 0);
}

TEST_CASE("a cloud of spheres looks as ray by ray and sphere by sphere") {
    Studio studio;
    for (const std::size_t n : {1u, 2u, 67u, 331u}) {
        DYNAMIC_SECTION(n << " spheres") {
            Scene scene = cloud(n, 0.02, unsigned(n));
            const Box box{Vec3(-0.0115), Vec3(0.0115)};
            for (const auto view : {render::View::Side, render::View::Iso, render::View::Cut}) {
                const Camera camera = cameraFor(view, box, 211, 173);
                scene.cut = render::cutOf(view);
                const Difference d = difference(studio.draw(scene, camera), scene, camera);
                CHECK(d.covered > (n > 2 ? 5000 : view == render::View::Cut ? -1 : 100));
                // A ray that grazes a sphere to the last digit of a float may miss it: hardly a pixel.
                CHECK(d.pixels <= d.covered / 1000);
                // Of 10 mm a float holds 1e-9 m; near the rim the depth changes by a root of that.
                CHECK(near(d.depth, 0, kRadius, 5e-3));
            }
        }
    }
}

TEST_CASE("spheres far apart and of very different size are all found") {
    Studio studio;
    Scene scene = cloud(40, 0.3, 3);
    addSphere(scene, {0.05, 0.02, 0.01}, 0.0413, Vec3(0.3));
    const Camera camera = frontCamera(211, 157, 2e-3);
    const Difference d = difference(studio.draw(scene, camera), scene, camera);
    CHECK(d.covered > 1000);
    CHECK(d.pixels <= 2);
}

TEST_CASE("a cut opens spheres into flat discs of the size of their section") {
    Studio studio;
    Scene scene;
    addSphere(scene, {0.4e-3, 0, 0}, kRadius, {0.2, 0.7, 0.2});
    addSphere(scene, {-4e-3, 4e-3, 0}, kRadius, {0.2, 0.7, 0.2});  // all of it on the side that is taken away
    scene.cut = render::cutOf(render::View::Cut);
    Camera camera = sideCamera(15e-6);
    camera.target = Vec3(0);
    const Image image = studio.draw(scene, camera);
    CHECK(blobs(image).size() == 1);
    int flat = 0;
    for (const float depth : image.depth) flat += std::abs(depth) < 1e-3 * kRadius;
    const double section = kPi * (kRadius * kRadius - 0.4e-3 * 0.4e-3);
    CHECK(nearRelative(flat * camera.pixel * camera.pixel, section, 0.02));  // a rim of pixels in part
    CHECK(colourOf(image.at(158, 105)) == colourOf(image.at(168, 105)));     // not shaded
    const Vec3 light = render::linearLight(colourOf(image.at(158, 105)));
    CHECK(near(light.y, render::linearLight({0.2, 0.7, 0.2}).y, 1, 0.01));
}

TEST_CASE("the coil is drawn where its wire is, at any angle") {
    Studio studio;
    Scene scene;
    scene.coil = paperCoil();
    for (const double angle : {0.0, 1.1, -300.0}) {
        scene.coilAngle = angle;
        const Camera camera = sideCamera(0.25e-3);
        const Image image = studio.draw(scene, camera);
        int covered = 0, wrong = 0;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) {
                if (image.at(x, y).cover == 0) continue;
                ++covered;
                // The depth is that of one of the nine rays: there the wire's surface must be.
                double nearest = 1;
                for (int part = 0; part < kRays * kRays; ++part) {
                    const Ray ray = rayOf(camera, x, y, part);
                    const double far = glm::dot(ray.origin - camera.target, camera.towards) - image.depthAt(x, y);
                    const Vec3 point = ray.origin + far * ray.way;
                    nearest = std::min(nearest, std::abs(geometry::closestPoint(*scene.coil, angle, point).distance));
                }
                // The chords between its joints leave the centre line by 0.0003 of the coil's radius.
                wrong += !near(nearest, 0, scene.coil->wireRadius, 0.004);
            }
        // Seen from the side, half turns of wire that cross: some 16 x 23 mm x 2 mm, less where they overlap.
        CHECK(covered * camera.pixel * camera.pixel > 300e-6);
        CHECK(wrong == 0);
    }
    // The wire at its nearest to the viewer, in the middle of a turn; and half a pitch on, nothing.
    scene.coilAngle = kPi / 2;  // at z = s the angle is pi/2 + 2 pi s/p: -x at a quarter of the pitch
    const Camera camera = sideCamera(0.25e-3);
    const Image image = studio.draw(scene, camera);
    const Camera::Place wire = camera.project({-0.0104, 0, 3.25 * 0.00875});
    const Camera::Place gap = camera.project({-0.0104, 0, 3.5 * 0.00875});
    CHECK(near(image.depthAt(int(wire.x), int(wire.y)), 0.0114, 0.001, 0.1));
    CHECK(image.depthAt(int(gap.x), int(gap.y)) < 0.005);
}

TEST_CASE("a picture of spheres and a coil hides each behind the other") {
    Studio studio;
    Scene scene;
    scene.coil = paperCoil();
    scene.coilAngle = kPi / 2;
    const Vec3 before(-0.014, 0, 3.25 * 0.00875), behind(0, 0, 5.25 * 0.00875);
    addSphere(scene, before, 1e-3, {1, 0, 0});
    addSphere(scene, behind, 0.9e-3, {1, 0, 0});
    const Camera camera = sideCamera(0.25e-3);
    const Image image = studio.draw(scene, camera);
    const auto at = [&](const Vec3& x) {
        const Camera::Place p = camera.project(x);
        return image.at(int(p.x), int(p.y));
    };
    CHECK(at(before).red > 3 * at(before).green);
    CHECK(at(behind).red < 1.1 * at(behind).green);  // grey wire
    scene.coil.reset();
    const Image without = studio.draw(scene, camera);
    CHECK(blobs(without).size() == 2);
}

TEST_CASE("spheres darken each other where they are close") {
    Studio studio;
    Scene scene;
    addSphere(scene, Vec3(0), kRadius, Vec3(0.7));
    const Camera camera = frontCamera(211, 173, 25e-6);
    const Image alone = studio.draw(scene, camera);
    addSphere(scene, {2 * kRadius, 0, 0}, kRadius, Vec3(0.7));
    addSphere(scene, {0, 2 * kRadius, kRadius}, kRadius, Vec3(0.7));
    const Image beside = studio.draw(scene, camera);
    const auto brightness = [&](const Image& image, double x, double y) {
        const Camera::Place p = camera.project({x, y, 0});
        return double(image.at(int(p.x), int(p.y)).green);
    };
    CHECK(brightness(beside, 0.9 * kRadius, 0) < 0.85 * brightness(alone, 0.9 * kRadius, 0));
    CHECK(near(brightness(beside, -0.7 * kRadius, -0.5 * kRadius), brightness(alone, -0.7 * kRadius, -0.5 * kRadius),
               255, 0.02));
}

TEST_CASE("the same scene gives the same bits, and an empty one an empty picture") {
    Studio studio;
    Scene scene = cloud(131, 0.02, 9);
    scene.coil = geometry::Coil{0.008, 0.005, 0.0008, 0.02};
    const Camera camera = cameraFor(render::View::Iso, {Vec3(-0.012), Vec3(0.022)}, 173, 139);
    const Image first = studio.draw(scene, camera), again = studio.draw(scene, camera);
    CHECK(std::equal(first.pixels.begin(), first.pixels.end(), again.pixels.begin(),
                     [](const Image::Pixel& a, const Image::Pixel& b) {
                         return a.red == b.red && a.green == b.green && a.blue == b.blue && a.cover == b.cover;
                     }));
    CHECK(first.depth == again.depth);

    const Image empty = studio.draw({}, camera);
    CHECK(std::all_of(empty.pixels.begin(), empty.pixels.end(), [](const Image::Pixel& p) { return p.cover == 0; }));
    CHECK(std::all_of(empty.depth.begin(), empty.depth.end(), [](float d) { return d < -1e29f; }));
}

namespace {

void addBody(Scene& scene, const geometry::Shape& shape, bool seeThrough, int around = 64) {
    for (const Facet& f : skinOf(shapeMesh(shape, {}, around), formOf(shape).solid).facets)
        scene.facets.push_back({f, seeThrough});
}

}  // namespace

TEST_CASE("a body of triangles covers what its shape covers, without a gap between them") {
    Studio studio;
    const double pixel = 20e-6, radius = 1.5e-3;
    const Camera camera = frontCamera(201, 177, pixel);
    Scene scene;
    addBody(scene, geometry::Ball{Vec3(0.2e-3, -0.1e-3, 0.3e-3), radius}, false, 96);
    const Image image = studio.draw(scene, camera);
    double area = 0;
    for (const Image::Pixel& p : image.pixels) area += p.cover / 255.0;
    // A polygon of 96 corners in place of the circle lacks (2 pi / 96)^2 / 6 of its area.
    CHECK(nearRelative(area * pixel * pixel, kPi * radius * radius, 2e-3));
    const Camera::Place middle = camera.project({0.2e-3, -0.1e-3, 0});
    int gaps = 0;
    for (int y = 0; y < camera.height; ++y)
        for (int x = 0; x < camera.width; ++x)
            if (std::hypot(x + 0.5 - middle.x, y + 0.5 - middle.y) < radius / pixel - 2)
                gaps += image.at(x, y).cover != 255;
    CHECK(gaps == 0);
    CHECK(near(image.depthAt(int(middle.x), int(middle.y)), 0.3e-3 + radius, radius, 2e-3));
}

TEST_CASE("a body hides what is behind it, unless it is seen through, and then dims it in the pixels it covers") {
    Studio studio;
    const Camera camera = frontCamera(101, 77, 50e-6);
    const geometry::Block wall{{0, -1e-3, 3e-3}, {1.5e-3, 1e-3, 4e-3}, false};  // before the right half of the sphere
    Scene scene;
    addSphere(scene, Vec3(0), kRadius, {1, 0, 0});
    const Image bare = studio.draw(scene, camera);
    Scene hidden = scene, dimmed = scene;
    addBody(hidden, wall, false);
    addBody(dimmed, wall, true);
    const Image behind = studio.draw(hidden, camera), through = studio.draw(dimmed, camera);
    CHECK(near(behind.depthAt(60, 38), 4e-3, 1e-3, 1e-4));
    CHECK(behind.at(60, 38).red - behind.at(60, 38).green < 20);
    // Two walls of the pane, seen from the front, take 7 % each.
    const double left = 0.93 * 0.93;
    for (const int x : {55, 60, 65}) {
        const double before = render::linearLight(colourOf(bare.at(x, 38))).x;
        const double after = render::linearLight(colourOf(through.at(x, 38))).x;
        CHECK(near(after, left * before + (1 - left) * 0.2, 1, 0.02));
        CHECK(through.depthAt(x, 38) == bare.depthAt(x, 38));
    }
    CHECK(through.at(40, 38).red == bare.at(40, 38).red);
    CHECK(near(through.at(78, 38).cover / 255.0, 1 - left, 1, 0.01));  // beside the sphere: the pane alone
}

TEST_CASE("a cut shows a solid body as a flat section, a wall as a line") {
    Studio studio;
    Camera camera = frontCamera(101, 77, 50e-6);
    Scene scene;
    scene.cut = render::CutPlane{{0, 0, 1}, 0.2e-3};
    addBody(scene, geometry::Ball{Vec3(0), kRadius}, false);
    const Image ball = studio.draw(scene, camera);
    CHECK(near(ball.depthAt(50, 38), 0.2e-3, 1e-3, 1e-3));
    CHECK(near(ball.depthAt(60, 38), 0.2e-3, 1e-3, 1e-3));
    scene.facets.clear();
    addBody(scene, geometry::Cone{{0, 0, -1e-3}, {0, 0, 1}, kRadius, kRadius, 2e-3}, false);
    const Image tube = studio.draw(scene, camera);
    CHECK(tube.at(50, 38).cover == 0);
}
