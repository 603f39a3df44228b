// The tables of the bodies, in the manner of shared/tables.h. Each takes the binding of a table that none of their
// passes uses, because a device need not bind more tables than those of shared/tables.h. WRITTEN is as TABLE, but a
// pass writes it.
#ifndef WRITTEN
#define WRITTEN TABLE
#endif

// Of each canister what packBodies made (shared/geometry.h).
TABLE(6, geometry, uvec4, geometryVectors, the shapes of the bodies)
// Of each body slot, if the body has one mesh: how many of its triangles can come within reach before the next refresh,
// and which. kEmpty if they find no room: then the passes look at all of the cell.
WRITTEN(7, nearby, uint, nearbyWords, the triangles near each particle)
// Of each canister, of each step of the batch, or once if no body moves: where each body is and how it moves. Where a
// body moves freely, also of the step after the batch.
TABLE(8, motions, BodyMotion, bodyMotions, the motions of the bodies)

#undef TABLE
#undef WRITTEN
