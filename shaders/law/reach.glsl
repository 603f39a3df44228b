// Which laws of the normal force occur, and how far beyond touch a contact holds on. Both are known when a pipeline is
// made, so that a law which is not used, and a reach that no law has, cost nothing.
#ifndef VKDOSE_LAW_REACH_GLSL
#define VKDOSE_LAW_REACH_GLSL

#include "shared/layout.h"

layout(constant_id = 9) const uint LAWS = 1u;  // bit k: contacts of some class follow the law k (shared/laws.h)

/// Whether any contact may hold on beyond touch. This is a function, as is joints() in shared/buffers.glsl.
bool reaches() { return (LAWS & kReachingLaws) != 0u; }

#endif
