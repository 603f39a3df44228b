// What particles do to bodies and walls, summed since the last sensing for each particle (shared/tables.h).
#ifndef VKDOSE_PASS_LOADS_GLSL
#define VKDOSE_PASS_LOADS_GLSL

#include "law/grown.glsl"
#include "shared/buffers.glsl"

void addToLoad(uint which, uint i, uint number, float value) {
    uint at = bodyLoadIndex(kBodyLoads * which + number, i);
    bodyLoads[at] = grown(bodyLoads[at], value);
}

/// Adds what a step brought: the force on the particle [N], its moment about a point that the host knows [N m], the
/// work of the body [J]. `which` is a body, or BODIES and the number of a surface.
void addLoad(uint which, uint i, vec3 force, vec3 moment, float work) {
    for (uint d = 0u; d < 3u; ++d) {
        addToLoad(which, i, d, force[d]);
        addToLoad(which, i, 3u + d, moment[d]);
    }
    addToLoad(which, i, 6u, work);
}

#endif
