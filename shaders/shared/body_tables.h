// The tables of the bodies, in the manner of shared/tables.h. Each takes the binding of a table that none of their
// passes uses, because a device need not bind more tables than those of shared/tables.h.

// Of each canister what packBodies made (shared/geometry.h).
TABLE(7, geometry, uvec4, geometryVectors, the shapes of the bodies)
// Of each canister, of each step of the batch, or once if no body moves: where each body is and how it moves.
TABLE(9, motions, BodyMotion, bodyMotions, the motions of the bodies)

#undef TABLE
