#include "host/model/free_sites.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/model/body_form.h"
#include "host/model/clearance.h"

namespace vkdose {

Box boxAround(const World& world, const std::vector<std::size_t>& bodies) {
    Box box{Vec3(std::numeric_limits<double>::infinity()), Vec3(-std::numeric_limits<double>::infinity())};
    for (const std::size_t body : bodies)
        for (const geometry::Triangle& triangle : trianglesOf(world.bodies.at(body)))
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
    Rooms(const World& world, const InsertionGrid& grid, const Box& vessel)
        : around_(world), grid_(grid), vessel_(vessel), free_(static_cast<std::size_t>(grid.capacity()), false) {
        for (std::uint64_t i = 0; i < free_.size(); ++i) free_[i] = isClear(grid.site(i), grid.pitch() / 2);
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

std::vector<std::uint64_t> sitesInside(const World& world, const InsertionGrid& grid, const Box& vessel) {
    return Rooms(world, grid, vessel).inner();
}

}  // namespace vkdose
