// The tables of the field passes (host/model/field.h), in the manner of shared/tables.h. A device need not bind more
// tables than those of shared/tables.h, so each of these takes the binding of a table that no field pass uses.
#ifndef PARAMETERS
#define PARAMETERS TABLE
#endif

TABLE(9, grid, vec4, kFieldVectors * points, the fields)
TABLE(11, weights, float, 2 * particles + kFieldNodes * forceEntries, the weights of the fields)
PARAMETERS(12, fields, FieldParams, 1, the parameters of the fields)
TABLE(15, branches, vec4, forceEntries, the branches of the contacts)

#undef TABLE
#undef PARAMETERS
