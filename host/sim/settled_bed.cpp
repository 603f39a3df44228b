#include "host/sim/settled_bed.h"

#include <algorithm>
#include <utility>

#include "host/law/law.h"

namespace vkdose {

SettledBed settledBed(const Case& c, double time, const Particles& particles, const std::vector<Contact>& contacts,
                      std::vector<geometry::Pose> bodies) {
    SettledBed bed{time, particles, {}, {}, {}, std::move(bodies)};
    const double gravity = glm::length(c.world.gravity);
    for (const Contact& contact : contacts) {
        if (contact.kind != ContactClass::ParticleParticle) continue;
        const double a = particles.radius.at(contact.particle), b = particles.radius.at(contact.other);
        const ContactParameters& law =
            c.dosingLaw.between(particles.material[contact.particle], particles.material[contact.other]);
        const double smaller = std::min(a, b);
        const double weight =
            std::min(massOf(c.world, particles, contact.particle), massOf(c.world, particles, contact.other)) * gravity;
        const double apart =
            glm::length(c.world.shortest(particles.position[contact.particle] - particles.position[contact.other]));
        const double reduced = 2 * a * b / (a + b);
        bed.pullOff.push_back(pullOff(law, reduced, contact.maxOverlap) / weight);
        // A contact is listed where it touched in the last step, and may have parted by its end.
        bed.overlap.push_back(std::max(0.0, a + b - apart) / smaller);
        bed.largestOverlap.push_back(normalLaw(law).largestOverlap(law, reduced, contact.maxOverlap) / smaller);
    }
    return bed;
}

void put(Record& record, const std::optional<SettledBed>& bed) {
    if (!bed) return;
    std::vector<double> place;
    std::vector<std::uint32_t> status;
    for (std::size_t i = 0; i < bed->particles.size(); ++i) {
        const Vec3& x = bed->particles.position[i];
        place.insert(place.end(), {x.x, x.y, x.z});
        status.push_back(static_cast<std::uint32_t>(bed->particles.status[i]));
    }
    record.putOne("settled_time", bed->time);
    record.put("settled_position", std::move(place));
    record.put("settled_status", std::move(status));
    record.put("settled_pull_off", bed->pullOff);
    record.put("settled_overlap", bed->overlap);
    record.put("settled_largest_overlap", bed->largestOverlap);
    std::vector<double> poses;
    for (const geometry::Pose& p : bed->bodies)
        poses.insert(poses.end(),
                     {p.rotation.w, p.rotation.x, p.rotation.y, p.rotation.z, p.origin.x, p.origin.y, p.origin.z});
    record.put("settled_bodies", std::move(poses));
}

void get(const Record& record, const Particles& filled, std::optional<SettledBed>& bed) {
    bed.reset();
    if (!record.arrays().contains("settled_time")) return;
    SettledBed read{record.one<double>("settled_time"), filled, {}, {}, {}, {}};
    const auto& place = record.get<double>("settled_position", 3 * filled.size());
    const auto& status = record.get<std::uint32_t>("settled_status", filled.size());
    for (std::size_t i = 0; i < filled.size(); ++i) {
        read.particles.position[i] = {place[3 * i], place[3 * i + 1], place[3 * i + 2]};
        read.particles.status[i] = static_cast<Status>(status[i]);
    }
    read.pullOff = record.get<double>("settled_pull_off");
    read.overlap = record.get<double>("settled_overlap", read.pullOff.size());
    read.largestOverlap = record.get<double>("settled_largest_overlap", read.pullOff.size());
    const auto& poses = record.get<double>("settled_bodies");
    for (std::size_t i = 0; i + 6 < poses.size(); i += 7)
        read.bodies.push_back({geometry::Rotation(poses[i], poses[i + 1], poses[i + 2], poses[i + 3]),
                               {poses[i + 4], poses[i + 5], poses[i + 6]}});
    bed = std::move(read);
}

}  // namespace vkdose
