#include "host/model/shared_places.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>

#include "geometry/inside.h"
#include "host/model/body_mesh.h"

namespace vkdose {
namespace {

constexpr double kNear = 0.02;       // largest difference of a distance from the radius, as a fraction of the radius
constexpr double kAlike = 0.999;     // cosine of 2.5 degrees, the largest angle between the normals
constexpr double kTurned = 0.9;      // cosine of the largest angle between the normals where a search begins
constexpr double kReach = 1.2;       // how far is looked, in radii
constexpr int kRounds = 30;          // number of projections onto both in turn
constexpr std::size_t kMost = 40;    // places that are kept of a pair
constexpr double kApart = 0.5;       // radii between two places that are kept
constexpr double kSpacing = 0.5;     // radii between points from which is looked
constexpr double kMostParts = 1e4;   // of an edge
constexpr double kMostPoints = 1e5;  // about so many on a body
constexpr double kAround = 0.7;      // radii from a place to those around it
constexpr int kCoinciding = 3;       // of the four places around that coincide on an area

using Nearest = std::optional<geometry::Closest>;

/// A body as it stands at the start, or a wall.
struct Thing {
    std::function<Nearest(const Vec3&)> nearest;  ///< none beyond the reach
    Vec3 low{-geometry::kEndless}, high{geometry::kEndless};
};

bool within(const Vec3& q, const Vec3& low, const Vec3& high) {
    return glm::all(glm::greaterThanEqual(q, low)) && glm::all(glm::lessThanEqual(q, high));
}

Nearest nearestOf(const RigidBody& body, const geometry::Pose& pose, const Vec3& q, double radius) {
    const Vec3 centre = pose.toBody(q);
    Nearest best;
    for (const geometry::Shape& shape : body.shapes) {
        const auto* mesh = std::get_if<std::shared_ptr<const geometry::MeshSurface>>(&shape);
        const double reach = mesh ? std::min(kReach * radius, (*mesh)->reach()) : kReach * radius;
        for (const geometry::Feature& f : geometry::places(shape, centre, reach))
            if (!best || f.distance < best->distance) best = f;
    }
    if (best) *best = {pose.toWorld(best->point), pose.directionToWorld(best->normal), best->distance};
    return best;
}

/// Points of a triangle in rows along its longest edge, `spacing` apart at most, its corners among them.
template <class Visit>
void forEachPoint(const geometry::Triangle& t, double spacing, const Visit& visit) {
    const auto parts = [spacing](double length) {
        return int(std::clamp(std::ceil(length / spacing), 1.0, kMostParts));
    };
    std::size_t first = 0;
    double longest = 0;
    for (std::size_t i = 0; i < 3; ++i)
        if (const double length = glm::length(t[(i + 1) % 3] - t[i]); length > longest) {
            longest = length;
            first = i;
        }
    const Vec3 &a = t[first], &b = t[(first + 1) % 3], &c = t[(first + 2) % 3];
    const int rows = parts(glm::length(glm::cross(b - a, c - a)) / longest);
    for (int row = 0; row <= rows; ++row) {
        const double up = double(row) / rows;
        const Vec3 from = a + up * (c - a), to = b + up * (c - b);
        const int steps = row == rows ? 0 : parts(glm::length(to - from));
        for (int k = 0; k <= steps; ++k) visit(steps == 0 ? from : from + double(k) / steps * (to - from));
    }
}

class Search {
  public:
    Search(const Case& c, const Particles& particles, double radius) : c_(c), radius_(radius) {
        for (const RigidBody& body : c.world.bodies) add(body, particles);
        for (const Wall& wall : c.world.walls)
            things_.push_back({[&wall](const Vec3& q) { return Nearest(geometry::closestPoint(wall.shape, q)); }});
    }

    std::vector<SharedPlace> all() {
        std::vector<SharedPlace> found;
        for (std::size_t a = 0; a < c_.world.bodies.size(); ++a) {
            std::vector<SharedPlace> ofPair;
            for (std::size_t b = a + 1; b < things_.size(); ++b) {
                if (!together(a, b)) continue;
                ofPair.clear();
                search(a, b, ofPair);
                found.insert(found.end(), ofPair.begin(), ofPair.end());
            }
        }
        return found;
    }

  private:
    /// Whether body a stays where it is as seen from b.
    bool together(std::size_t a, std::size_t b) const {
        const std::vector<RigidBody>& bodies = c_.world.bodies;
        return b < bodies.size() ? bodies[a].movesAs(bodies[b]) : bodies[a].rests();
    }

    void add(const RigidBody& body, const Particles& particles) {
        const geometry::Pose pose = body.pose(0, 0);
        Thing thing{[&body, pose, radius = radius_](const Vec3& q) { return nearestOf(body, pose, q, radius); }};
        const bool ends = std::none_of(body.shapes.begin(), body.shapes.end(),
                                       [](const geometry::Shape& s) { return formOf(s).endless; });
        meshes_.push_back(placed(bodyMesh(body, c_.world.domain), pose));
        if (ends && !meshes_.back().empty()) {
            thing.low = Vec3(geometry::kEndless);
            thing.high = -thing.low;
            for (const geometry::Triangle& t : meshes_.back())
                for (const Vec3& p : t) {
                    thing.low = glm::min(thing.low, p);
                    thing.high = glm::max(thing.high, p);
                }
            thing.low -= Vec3(2 * radius_);
            thing.high += Vec3(2 * radius_);
        }
        things_.push_back(std::move(thing));
        for (const geometry::Shape& shape : body.shapes) {
            const auto* mesh = std::get_if<std::shared_ptr<const geometry::MeshSurface>>(&shape);
            if (mesh == nullptr || !geometry::isClosed((*mesh)->mesh())) continue;
            const auto inside = std::make_shared<geometry::Inside>((*mesh)->mesh());
            const auto holds = [inside, pose](const Vec3& q) { return (*inside)(pose.toBody(q)); };
            if (!std::all_of(particles.position.begin(), particles.position.end(), holds)) solids_.push_back(holds);
        }
    }

    /// Looks from points on the surface of body a, on both its sides.
    void search(std::size_t a, std::size_t b, std::vector<SharedPlace>& found) const {
        const Thing& other = things_[b];
        std::vector<const geometry::Triangle*> near;
        double area = 0;
        for (const geometry::Triangle& t : meshes_[a]) {
            const Vec3 low = glm::min(t[0], glm::min(t[1], t[2])), high = glm::max(t[0], glm::max(t[1], t[2]));
            if (!glm::all(glm::lessThanEqual(glm::max(low, other.low), glm::min(high, other.high)))) continue;
            near.push_back(&t);
            area += glm::length(glm::cross(t[1] - t[0], t[2] - t[0])) / 2;
        }
        const double spacing = std::max(kSpacing * radius_, std::sqrt(area / kMostPoints));
        for (const geometry::Triangle* t : near) {
            const Vec3 square = glm::cross((*t)[1] - (*t)[0], (*t)[2] - (*t)[0]);
            if (!(glm::length(square) > 0)) continue;
            const Vec3 away = radius_ * glm::normalize(square);
            forEachPoint(*t, spacing, [&](const Vec3& p) {
                for (const Vec3& way : {away, -away})
                    if (found.size() < kMost) look(a, b, p, way, found);
            });
        }
    }

    /// From a sphere that touches a at `p`, with its centre on the `way` from there. Most are far from b, or touch it
    /// elsewhere.
    void look(std::size_t a, std::size_t b, const Vec3& p, const Vec3& way, std::vector<SharedPlace>& found) const {
        const Nearest other = things_[b].nearest(p + way);
        if (!other || other->distance > kReach * radius_ || glm::dot(other->normal, way) < kTurned * radius_) return;
        const std::optional<Vec3> place = commonPlace(a, b, p + way);
        if (!place || !free(*place)) return;
        const bool known = std::any_of(found.begin(), found.end(), [&](const SharedPlace& before) {
            return glm::length(before.centre - *place) < kApart * radius_;
        });
        if (!known) found.push_back({a, b, isArea(a, b, *place), *place});
    }

    /// Where a sphere that starts at `q` touches both in the same place, if it gets there.
    std::optional<Vec3> commonPlace(std::size_t a, std::size_t b, Vec3 q) const {
        for (int n = 0; n < kRounds; ++n) {
            const Nearest first = things_[a].nearest(q);
            if (!first) return std::nullopt;
            const Vec3 onFirst = q + (radius_ - first->distance) * first->normal;
            const Nearest second = things_[b].nearest(onFirst);
            if (!second) return std::nullopt;
            const Vec3 next = onFirst + (radius_ - second->distance) * second->normal;
            const bool rests = glm::length(next - q) < 1e-3 * radius_;
            q = next;
            if (rests) break;
        }
        return alike(a, b, q) ? std::optional(q) : std::nullopt;
    }

    bool alike(std::size_t a, std::size_t b, const Vec3& q) const {
        const Nearest first = things_[a].nearest(q), second = things_[b].nearest(q);
        return first && second && std::abs(first->distance - radius_) < kNear * radius_ &&
               std::abs(second->distance - radius_) < kNear * radius_ &&
               glm::dot(first->normal, second->normal) >= kAlike;
    }

    bool free(const Vec3& q) const {
        if (!within(q, c_.world.domain.low, c_.world.domain.high) || c_.world.doses(q)) return false;
        const bool clear = std::all_of(things_.begin(), things_.end(), [&](const Thing& thing) {
            if (!within(q, thing.low, thing.high)) return true;
            const Nearest nearest = thing.nearest(q);
            return !nearest || nearest->distance > (1 - kNear) * radius_;
        });
        return clear && std::none_of(solids_.begin(), solids_.end(), [&](const auto& holds) { return holds(q); });
    }

    bool isArea(std::size_t a, std::size_t b, const Vec3& q) const {
        const Nearest at = things_[a].nearest(q);
        const Vec3 across = geometry::anyNormal(at->normal), along = glm::cross(at->normal, across);
        int coinciding = 0;
        for (const Vec3& way : {across, -across, along, -along}) {
            Vec3 moved = q + kAround * radius_ * way;
            if (const Nearest onFirst = things_[a].nearest(moved))
                moved += (radius_ - onFirst->distance) * onFirst->normal;
            coinciding += alike(a, b, moved);
        }
        return coinciding >= kCoinciding;
    }

    const Case& c_;
    double radius_;
    std::vector<Thing> things_;                             ///< bodies, then walls
    std::vector<std::vector<geometry::Triangle>> meshes_;   ///< of the bodies, in their place
    std::vector<std::function<bool(const Vec3&)>> solids_;  ///< whether a point is inside of a closed mesh
};

}  // namespace

std::vector<SharedPlace> sharedPlaces(const Case& c, const Particles& particles, double radius) {
    const std::vector<RigidBody>& bodies = c.world.bodies;
    bool any = false;  // whose places could coincide
    for (auto a = bodies.begin(); a != bodies.end(); ++a)
        any = any || a->rests() || std::any_of(a + 1, bodies.end(), [&](const RigidBody& b) { return a->movesAs(b); });
    if (!any) return {};
    return Search(c, particles, radius).all();
}

}  // namespace vkdose
