#pragma once
// The sum of all contact forces, and the histories that the contacts carry from step to step.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "host/backend/backend.h"
#include "host/backend/reference/contact.h"
#include "host/backend/reference/energy.h"
#include "host/backend/reference/fields.h"
#include "host/backend/reference/neighbours.h"

namespace vkdose::reference {

/// The deepest contact of a step.
struct Deepest {
    double ratio = 0;  ///< overlap over the smaller radius [-]
    ContactClass kind = ContactClass::ParticleParticle;
    std::uint32_t particle = 0;
    std::uint32_t other = 0;
};

/// Forces and torques of the contacts on the particles and the bodies at one instant.
struct Loads {
    std::vector<Vec3> force;           ///< without gravity [N]
    std::vector<Vec3> torque;          ///< about the particle's centre [N m]
    std::vector<LawProperties> flows;  ///< of each particle's properties [unit/s]; empty: there are none
    std::vector<BodyLoad> bodies;      ///< of all that tell loads (loadNames); `work` in this step
    EnergyBook energy;                 ///< energies that contacts book and store in this step; if the world asks for it
    Deepest deepest;
    std::vector<Branch> branches;  ///< of every contact
};

/// The drive at that instant, which turns the coil and the bodies that follow it. And what other bodies follow.
struct Drive {
    double angle;                       ///< of the coil since load, about +z [rad]
    double rate;                        ///< [rad/s]
    double time;                        ///< since load [s]
    std::span<const BodyClock> clocks;  ///< of bodies that move in phases; empty: they stand at their start
    std::span<const FreeBody> free;     ///< of bodies that move freely; other entries are unspecified
};

class Forces {
  public:
    /// Makes the program of a user's law. Throws LawRefused where it is not in the language.
    void follow(const ContactLaw& law);
    /// Forgets every contact. `world` is the one that is evaluated from now on.
    void reset(std::size_t particles, const World& world);

    /// Contact forces of all active particles. Histories advance by `springDt` [s]. Histories of contacts that have
    /// parted are dropped. Throws RunError when a particle touches a body in too many places.
    void evaluate(const RuledWorld& world, const Particles& particles, const Neighbours& neighbours, const Drive& drive,
                  double springDt, Loads& loads);

    /// Every contact touching at the last `evaluate`, by class, particle, other.
    std::vector<Contact> contacts() const;

    /// The contacts for Backend::snapshot, and back. Call `restore` after `reset`; throws RecordError if an index does
    /// not fit.
    void save(Record& record) const;
    void restore(const Record& record);

  private:
    struct Known {
        std::uint32_t other = 0;  ///< the larger index of a pair, or the surface
        History history;
        Exerted exerted;
    };
    /// A fixed surface in the current step.
    struct Met {
        bool continues = false;  ///< it touched at the last step, and `known` holds its history
        Known known;
        geometry::Closest closest{};
        double reach = 0;  ///< beyond touch [m]
        bool touches = false;
    };
    /// A contact with one feature of a body.
    struct OnBody {
        std::uint32_t body = 0;
        Vec3 direction{0};  ///< from the body to the particle, in the body's frame; unit
        History history;
        Exerted exerted;
    };
    /// What a wall did to a particle, and the particle to the wall.
    struct Pushed {
        Exerted exerted;
        Vec3 point;   ///< of contact [m]
        Vec3 couple;  ///< on the particle [N m]
    };
    /// A body at this instant.
    struct Placed {
        geometry::Pose pose;
        geometry::Moving moving;  ///< during the step before; in the opening step, at the instant
        bool yields = false;      ///< it moves freely, and contacts see its mass
    };

    void pairs(std::size_t i);
    void surfaces(std::size_t i);
    void meetSurfaces(std::size_t i);
    void joinAtFront(std::size_t i);
    void placeBodies();
    void bodies(std::size_t i);
    void touchBody(std::size_t i, std::uint32_t b, std::span<const OnBody> before);
    void loadBody(std::uint32_t b, const Pushed& pushed);
    void loadWall(std::uint32_t which, const Pushed& pushed);
    void bookBody(std::size_t i, std::uint32_t b, const Exerted& before, const Exerted& now);
    Pushed wall(std::size_t i, int material, std::uint32_t other, Touch touch, History& history);
    Exerted exertedBy(MaterialPair pair, const Touch& touch, const Response& response, const History& history) const;
    void book(const Exerted& before, const Exerted& now, const Body& i, const Body& j);
    void partPair(std::size_t i, const Known& known);
    void partWall(std::size_t i, const Exerted& before);
    double reachOf(const ContactParameters& p, double reduced, bool continues);
    void flow(std::size_t i, const LawProperties& rate, double sign);
    LawProgram* user() { return user_ ? &*user_ : nullptr; }
    Body body(std::size_t i) const;
    Body imageNear(std::size_t i, std::size_t j) const;
    int materialOf(std::size_t i) const { return particles_->material[i]; }
    void note(const Touch& touch, ContactClass kind, std::size_t particle, std::size_t other);

    std::vector<std::vector<Known>> pairs_, surfaces_;  ///< per particle, ascending in `other`
    std::vector<std::vector<OnBody>> onBodies_;         ///< per particle, ascending in `body`
    std::vector<RigidBody> bodies_;                     ///< allBodies
    std::size_t walls_ = 0;                             ///< how many there are
    std::optional<LawProgram> user_;                    ///< the user's law, if the contacts follow one
    std::vector<OnBody> beforeOnBodies_;                ///< scratch: those of one particle at the last step
    std::vector<Placed> placed_;                        ///< scratch: the bodies
    std::vector<Known> before_;                         ///< scratch: a row as it was at the last step
    std::vector<Met> met_;                              ///< scratch: the surfaces of one particle

    // The arguments of the `evaluate` in progress.
    const RuledWorld* world_ = nullptr;
    const Particles* particles_ = nullptr;
    const Neighbours* neighbours_ = nullptr;
    Drive drive_{};
    double springDt_ = 0;  ///< 0 in the opening step
    Loads* loads_ = nullptr;
};

}  // namespace vkdose::reference
