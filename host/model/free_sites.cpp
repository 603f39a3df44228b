#include "host/model/free_sites.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/model/body_form.h"
#include "host/model/overlaps.h"

namespace vkdose {

Box boxAround(const std::vector<RigidBody>& bodies, const std::vector<std::size_t>& which) {
    Box box{Vec3(std::numeric_limits<double>::infinity()), Vec3(-std::numeric_limits<double>::infinity())};
    for (const std::size_t body : which)
        for (const geometry::Triangle& triangle : trianglesOf(bodies.at(body)))
            for (const Vec3& corner : triangle) {
                box.low = glm::min(box.low, corner);
                box.high = glm::max(box.high, corner);
            }
    return box;
}

namespace {

/// Sites that are joined, and whether powder could leave them through a side of the vessel's box.
struct Room {
    std::vector<std::uint64_t> sites;
    bool leaks = false;
};

class Rooms {
  public:
    Rooms(const World& world, const InsertionGrid& grid, const Box& vessel, double reach)
        : around_(world), grid_(grid), vessel_(vessel), free_(static_cast<std::size_t>(grid.capacity()), false) {
        for (std::uint64_t i = 0; i < free_.size(); ++i) free_[i] = isClear(grid.site(i), reach);
        for (std::uint64_t i = 0; i < free_.size(); ++i)
            if (free_[i]) rooms_.push_back(roomFrom(i));
    }

    /// The largest that does not leak, or else the largest.
    std::vector<std::uint64_t> inner() {
        const auto worse = [](const Room& a, const Room& b) {
            return a.leaks != b.leaks ? a.leaks : a.sites.size() < b.sites.size();
        };
        const auto best = std::max_element(rooms_.begin(), rooms_.end(), worse);
        if (best == rooms_.end()) return {};
        std::sort(best->sites.begin(), best->sites.end());
        return best->sites;
    }

  private:
    bool isClear(const Vec3& x, double reach) const { return around_.nearest(x, reach).what.empty(); }

    /// Takes the free sites that are joined to this one.
    Room roomFrom(std::uint64_t first) {
        Room room;
        const auto take = [&](std::uint64_t site) {
            free_[site] = false;
            room.sites.push_back(site);
            room.leaks = room.leaks || leaks(grid_.site(site));
        };
        take(first);
        std::size_t next = 0;
        while (next < room.sites.size()) {
            const std::uint64_t site = room.sites[next++];
            for (const std::uint64_t beside : grid_.beside(site)) {
                // Two sites on both sides of a wall keep half a pitch each: it stands in the middle between them.
                const Vec3 between = (grid_.site(site) + grid_.site(beside)) / 2.0;
                if (free_[beside] && isClear(between, grid_.pitch() / 4)) take(beside);
            }
        }
        return room;
    }

    /// Whether nothing stands between a site and a side of the vessel's box that is half a pitch away.
    bool leaks(const Vec3& site) const {
        for (const int axis : {0, 2})
            for (const Vec3& end : {vessel_.low, vessel_.high}) {
                Vec3 side = site;
                side[axis] = end[axis];
                if (std::abs(side[axis] - site[axis]) < 0.51 * grid_.pitch() && isClear(side, grid_.pitch() / 4))
                    return true;
            }
        return false;
    }

    Clearance around_;
    const InsertionGrid& grid_;
    Box vessel_;
    std::vector<bool> free_;  ///< of no room yet
    std::vector<Room> rooms_;
};

}  // namespace

std::vector<std::uint64_t> sitesInside(const World& world, const InsertionGrid& grid, const Box& vessel, double reach) {
    return Rooms(world, grid, vessel, reach).inner();
}

double roomInside(const World& world, const Box& vessel, double radius) {
    constexpr double kMostCells = 1e6;
    const Vec3 edges = vessel.high - vessel.low;
    const double cell = std::max(0.37 * radius, std::cbrt(edges.x * edges.y * edges.z / kMostCells));
    const InsertionGrid grid(vessel, cell / 2, 0);
    // A centre stands up to a cell farther from a wall than it could: so half a cell is taken off what it keeps. The
    // radius is no whole number of cells, so that the errors at walls along the grid are those of all others.
    std::vector<std::uint64_t> covered = sitesInside(world, grid, vessel, std::max(radius - cell / 2, 0.0));
    // From cell to cell: the centre that is nearest to each, as far as a centre covers.
    std::vector<std::uint64_t> nearest(static_cast<std::size_t>(grid.capacity()));
    std::vector<double> distance(nearest.size(), radius);
    for (const std::uint64_t site : covered) {
        nearest[site] = site;
        distance[site] = 0;
    }
    for (std::size_t next = 0; next < covered.size(); ++next)
        for (const std::uint64_t beside : grid.beside(covered[next])) {
            const double way = glm::distance(grid.site(beside), grid.site(nearest[covered[next]]));
            if (way >= distance[beside]) continue;
            distance[beside] = way;
            nearest[beside] = nearest[covered[next]];
            covered.push_back(beside);
        }
    const auto cells = std::ranges::count_if(distance, [&](double way) { return way < radius; });
    return edges.x * edges.y * edges.z * static_cast<double>(cells) / std::max(grid.capacity(), 1.0);
}

std::vector<std::uint64_t> clearSites(const World& world, const InsertionGrid& grid, const Clearance& around,
                                      const Particles& now) {
    const double reach = grid.pitch() / 2;
    Particles all = now;
    std::vector<bool> clear(static_cast<std::size_t>(grid.capacity()));
    for (std::uint64_t i = 0; i < clear.size(); ++i) {
        const Vec3 x = grid.site(i);
        clear[i] = around.nearest(x, reach).what.empty() && !world.doses(x);
        all.add(x, reach, Vec3(0), Vec3(0), kFirstPowder);
    }
    forEachOverlap(world, all, [&](std::size_t i, std::size_t j, double) {
        const std::size_t first = std::min(i, j), second = std::max(i, j);
        if (first < now.size() && second >= now.size()) clear[second - now.size()] = false;
    });
    std::vector<std::uint64_t> sites;
    for (std::uint64_t i = 0; i < clear.size(); ++i)
        if (clear[i]) sites.push_back(i);
    return sites;
}

}  // namespace vkdose
