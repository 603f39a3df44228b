// Bindings of every pass. One set serves all passes; a pass that does not name a buffer does not touch it.
#ifndef VKDOSE_SHARED_BUFFERS_GLSL
#define VKDOSE_SHARED_BUFFERS_GLSL

#extension GL_GOOGLE_include_directive : require
#include "shared/layout.h"

layout(local_size_x_id = 0) in;                      // workgroup size, chosen by the host
layout(constant_id = 1) const uint MEMBERS = 1u;     // 1: the member index is a constant and its block a uniform read
layout(constant_id = 2) const uint SURFACES = 0u;    // fixed surfaces of every member
layout(constant_id = 3) const uint KINDS = 0u;       // kinds of the first surfaces, 4 bits each (kUnrolledSurfaces)

layout(push_constant) uniform Push { StepPush push; };

layout(std430, set = 0, binding = 0) buffer StateBuffer { vec4 state[]; };
// Rows: uint row[2 halves][rowWidth][particles], ascending index within a row.
layout(std430, set = 0, binding = 1) buffer RowBuffer { uint rows[]; };
// Marks: x, y: touch bits of the row's slots; z: touch bits of surfaces (0 ...) and coil turns (28 ...); w: row length.
layout(std430, set = 0, binding = 2) buffer MarkBuffer { uvec4 marks[]; };
// Pair history: vec4 [2 halves][rowWidth][parts][particles]: (xi, delta_max), (rho, torsion); with the energy book the
// three of law/energy.glsl's Exerted as well.
layout(std430, set = 0, binding = 3) buffer HistoryBuffer { vec4 history[]; };
// Wall history: vec4 [surfaces + turns][parts][particles], then vec4 [particles]: wire angle in each slot of a turn.
layout(std430, set = 0, binding = 4) buffer WallHistoryBuffer { vec4 wallHistory[]; };
layout(std430, set = 0, binding = 5) readonly buffer MemberBuffer { Member members[]; };
layout(std430, set = 0, binding = 6) buffer ControlBuffer { Control control; };
// Cells: uint head[cellMask + 1], then next[particles].
layout(std430, set = 0, binding = 7) buffer CellBuffer { uint cells[]; };
// Anchor: position at the last rebuild (high part), w unused.
layout(std430, set = 0, binding = 8) buffer AnchorBuffer { vec4 anchors[]; };
layout(std430, set = 0, binding = 9) buffer SensorBuffer { SensorRecord sensors[]; };
// Member of each workgroup; a member never shares a workgroup with another.
layout(std430, set = 0, binding = 10) readonly buffer GroupBuffer { uint groupMember[]; };

// The energy book, and its sums.
layout(std430, set = 0, binding = 11) buffer BookBuffer { vec4 books[]; };
layout(std430, set = 0, binding = 12) buffer EnergyBuffer { EnergyRecord energies[]; };

#ifdef TEXEL_READS
layout(set = 0, binding = 13) uniform samplerBuffer stateView;
layout(set = 0, binding = 14) uniform usamplerBuffer rowView;
layout(set = 0, binding = 15) uniform samplerBuffer historyView;
layout(set = 0, binding = 16) uniform samplerBuffer wallHistoryView;
#endif

#ifdef ENERGY_BOOK
const uint kParts = 5u;
#else
const uint kParts = 2u;
#endif

uint stateIndex(uint side, uint field, uint i) { return (side * kFields + field) * push.particles + i; }
uint rowIndex(uint list, uint slot, uint i) { return (list * push.rowWidth + slot) * push.particles + i; }
uint historyIndex(uint list, uint slot, uint part, uint i) {
    return ((list * push.rowWidth + slot) * kParts + part) * push.particles + i;
}
uint wallHistoryIndex(uint slot, uint part, uint i) { return (slot * kParts + part) * push.particles + i; }
uint wireAngleIndex(uint i) { return wallHistoryIndex(SURFACES + kMaxTurns, 0u, i); }
uint bookIndex(uint field, uint i) { return field * push.particles + i; }

uint memberOfGroup() { return MEMBERS == 1u ? 0u : groupMember[gl_WorkGroupID.x]; }

#ifdef TEXEL_READS
vec4 readState(uint side, uint field, uint i) { return texelFetch(stateView, int(stateIndex(side, field, i))); }
uint readRow(uint list, uint slot, uint i) { return texelFetch(rowView, int(rowIndex(list, slot, i))).x; }
vec4 readHistory(uint list, uint slot, uint part, uint i) {
    return texelFetch(historyView, int(historyIndex(list, slot, part, i)));
}
vec4 readWallHistory(uint index) { return texelFetch(wallHistoryView, int(index)); }
#else
vec4 readState(uint side, uint field, uint i) { return state[stateIndex(side, field, i)]; }
uint readRow(uint list, uint slot, uint i) { return rows[rowIndex(list, slot, i)]; }
vec4 readHistory(uint list, uint slot, uint part, uint i) { return history[historyIndex(list, slot, part, i)]; }
vec4 readWallHistory(uint index) { return wallHistory[index]; }
#endif

// The smallest step and the smallest particle of an error are kept: the same whatever order invocations run in.
void report(uint error, uint particle) {
    atomicMin(control.error[error].first.x, push.stepInBatch);
    atomicMin(control.error[error].first.y, particle);
}

#endif
