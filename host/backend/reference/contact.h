#pragma once
// One contact: the place where two bodies touch, their motion there, and the four laws put together.

#include <optional>

#include "geometry/motion.h"
#include "host/core/vec.h"
#include "host/law/law_program.h"
#include "host/model/material.h"

namespace vkdose::reference {

/// A sphere in motion.
struct Body {
    Vec3 position;    ///< [m]
    Vec3 velocity;    ///< [m/s]
    Vec3 spin;        ///< [rad/s]
    double radius;    ///< [m]
    double mass = 0;  ///< [kg]; of a wall without meaning
};

/// The memory of a contact.
struct History {
    double maxOverlap = 0;  ///< delta_max [m]
    Vec3 sliding{0};        ///< xi [m]
    Vec3 rolling{0};        ///< rho [m]
    double torsion = 0;     ///< [m]
    double overlap = 0;     ///< in the last step [m]
    // Of a user's law:
    LawProgram::Memory own{};
    double stiffness = 0;  ///< in the last step; 0: the contact is new [N/m]
};

/// Kinematics of a contact; `i` is the particle (the smaller index of a pair), `j` the other one or the wall.
struct Touch {
    Vec3 normal;       ///< from j to i
    double overlap;    ///< delta; of a contact that holds on beyond touch not positive [m]
    double reduced;    ///< 2 a_i a_j / (a_i + a_j), wall 2 a_i [m]
    double smaller;    ///< the smaller radius, wall a_i [m]
    double mass;       ///< reduced mass m_i m_j/(m_i + m_j), wall m_i [kg]
    Vec3 leverI;       ///< from the centre of i to the contact point [m]
    Vec3 leverJ;       ///< from the centre of j; zero for a wall [m]
    Vec3 velocity;     ///< of i relative to j at the contact point [m/s]
    Vec3 spin;         ///< omega_i - omega_j [rad/s]
    double share = 1;  ///< how much the overlap falls per way along the normal (geometry/features.h)
    LawSides sides;    ///< what a user's law knows of them
};

/// Contact of two spheres, if their overlap is above -reach [m].
std::optional<Touch> touchSphere(const Body& i, const Body& j, double reach = 0);

/// Contact with a wall at `distance` from the centre of `i` along `normal`. The velocities of `i` and those of `wall`
/// are of a time `back` before its position [s]. Nothing unless the overlap is above -reach [m].
std::optional<Touch> touchWall(const Body& i, const Vec3& normal, double distance, const geometry::Moving& wall,
                               double reach = 0, double back = 0);

/// Velocity of i relative to j at the ends of their levers [m/s].
Vec3 contactVelocity(const Body& i, const Vec3& leverI, const Body& j, const Vec3& leverJ);

/// The parts that a contact's force is made of, and the state of the elements that exert them.
struct Parts {
    double hysteretic;           ///< along the normal, of the law without damping; `share` of it acts [N]
    double damping;              ///< along the normal, what acts [N]
    Vec3 sliding;                ///< on i [N]
    Vec3 rolling;                ///< couple on i [N m]
    Vec3 torsion;                ///< couple on i [N m]
    bool adhesive;               ///< on the adhesive branch
    bool slides, rolls, twists;  ///< whether the slider slips
    NormalLaw law;               ///< of the normal force
    double arriving;             ///< work that pressing a new contact so far takes [J]
    double stored;               ///< what a user's law says that the contact would give back [J]
    double kt, kr, kTo;          ///< stiffness of sliding, rolling, torsion [N/m]
    double share;                ///< of the touch
};

/// Forces and torques of a contact. The opposite force and the opposite couple act on j; the force acts there on j's
/// own lever.
struct Response {
    Vec3 force;    ///< on i [N]
    Vec3 torqueI;  ///< on i about its centre [N m]
    Vec3 torqueJ;  ///< on j about its centre [N m]
    Vec3 couple;   ///< rolling and torsion part of torqueI [N m]
    Parts parts{};
    LawProperties flows{};  ///< what i gains of each property, and j loses [unit/s]
};

/// The law of a contact of these two materials. `dt` [s] is the time by which the springs advance; `history` is
/// updated. `user` is the program of `law.user`; null without a user's law.
Response contactResponse(const ContactLaw& law, MaterialPair pair, const Touch& touch, double dt, History& history,
                         LawProgram* user = nullptr);

}  // namespace vkdose::reference
