// The tables of the field passes (host/model/field.h), in the manner of shared/tables.h. A device need not bind more
// tables than those of shared/tables.h, so each of these takes the binding of a table that no field pass uses.
#ifndef PARAMETERS
#define PARAMETERS TABLE
#endif
#ifndef LONG  // a table that may be longer than a device binds
#define LONG TABLE
#endif
#ifndef ROW
#define ROW(table, function, first, length)
#endif
#ifndef ROWS
#define ROWS(table, function, first, rows, length)
#endif

TABLE(8, grid, vec4, kFieldVectors * points, the fields)
// One over the sum of the kernel around each particle, then around the nodes of each contact's branch. Then: how many
// others touch each particle.
LONG(10, weights, float, 2 * particles + kFieldNodes * forceEntries, the weights of the fields)
ROW(weights, particleWeightIndex, 0, particles)
ROWS(weights, nodeWeightIndex, particles, forceEntries, kFieldNodes)
ROW(weights, touchesIndex, particles + kFieldNodes * forceEntries, particles)
PARAMETERS(11, fields, FieldParams, 1, the parameters of the fields)
LONG(14, branches, vec4, forceEntries, the branches of the contacts)

#undef TABLE
#undef PARAMETERS
#undef LONG
#undef ROW
#undef ROWS
