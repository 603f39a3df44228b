#pragma once
// The bed from the side: z to the right, y up, seen through the wall at -x. Front spheres hide those behind. The powder
// would hide the coil, so the front half of the coil is drawn over it. Bodies are drawn as their edges, over all.

#include <optional>
#include <vector>

#include "host/model/case.h"
#include "host/model/skin.h"
#include "host/sim/frame.h"
#include "host/terminal/pixels.h"

namespace vkdose::terminal {

/// The things that do not change while a run goes on.
struct Scene {
    std::optional<Canister> canister;
    std::optional<geometry::Coil> coil;
    std::vector<RigidBody> bodies;
    std::vector<std::string> loaded;  ///< loadNames
    std::vector<Skin> skins;          ///< of the bodies in their own frames, without shapes that go on for ever
    double fast = 0.1;                ///< speed that has the colour of what moves [m/s]
};

/// The scene of a case; `tipVelocity` is the coil's (Derived::tipVelocity), 0 for none [m/s].
Scene sceneOf(const Case& c, double tipVelocity);

/// Draws a frame into at most so many cells, no smaller than necessary. It shows canister, coil and bodies in their
/// length, and in height the bodies and as far as the highest sphere, rounded up to the next centimetre.
Canvas sideView(const Scene& scene, const Frame& frame, int columns, int rows, Style style);

/// Colour of a speed [m/s]: blue at rest, pale in between, orange from `fast` on. It follows the root of the speed, so
/// that creeping shows.
Colour speedColour(double speed, double fast);

}  // namespace vkdose::terminal
