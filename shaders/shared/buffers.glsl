// Bindings of every pass. One set serves all passes; a pass that does not name a buffer does not touch it.
#ifndef VKDOSE_SHARED_BUFFERS_GLSL
#define VKDOSE_SHARED_BUFFERS_GLSL

#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require  // SPIR-V calls a samplerBuffer invalid from 1.6 on
#ifdef PACKED_STORES
#extension GL_ARB_gpu_shader_int64 : require
#endif
#include "shared/layout.h"

layout(local_size_x_id = 0) in;                      // workgroup size, chosen by the host
layout(constant_id = 1) const uint SURFACES = 0u;    // fixed surfaces
layout(constant_id = 2) const uint KINDS = 0u;       // kinds of the first surfaces, 4 bits each (kUnrolledSurfaces)
layout(constant_id = 3) const uint KIND_SET = 0u;    // bit k: there is a surface of kind k; and kEndingWalls
layout(constant_id = 4) const uint MEMBERS = 1u;     // canisters that share the buffers, each with its part of every table
layout(constant_id = 5) const uint MOST_GROUPS = 65535u;  // workgroups in a row of a dispatch; more go in layers
layout(constant_id = 6) const uint FRONT = 0u;       // the front wall among the surfaces, if there is one

layout(push_constant) uniform Push { StepPush push; };

layout(std430, set = 0, binding = 0) buffer StateBuffer { vec4 state[]; };
// Rows: uint[members][rowEntries], then links: uint[members][linkEntries]. Rows: of every particle the indices of those within reach and skin, ascending; then links: of every particle the
// contacts it takes part in, ascending by the other's index, then surfaces, then the coil: slot << 1 | 1 if it is the
// contact's second body.
layout(std430, set = 0, binding = 1) buffer RowBuffer { uint rows[]; };
// Ranges: uvec4[2][particles]: row (first, count), links (first, count); own pair slots (first, count), own surface slots.
layout(std430, set = 0, binding = 2) buffer RangeBuffer { uvec4 ranges[]; };
// History of pairs and surfaces: vec4[pair and surface slots][2]: (xi, delta_max), (rho, torsion), zero while they do not
// touch; with the energy book vec4[3][slots] follow, law/energy.glsl's Exerted.
layout(std430, set = 0, binding = 3) buffer HistoryBuffer { vec4 history[]; };
// History with the coil: vec4[turns][parts][particles], then vec4[particles]: wire angle of each turn, kNoTurn if free.
layout(std430, set = 0, binding = 4) buffer CoilHistoryBuffer { vec4 coilHistory[]; };
layout(std430, set = 0, binding = 5) readonly buffer MemberBuffer { Member members[]; };
layout(std430, set = 0, binding = 6) buffer ControlBuffer {
    Dispatches dispatches;
    Control controls[];
};
// Cells: uint head[members][cellMask + 1], then next[particles].
layout(std430, set = 0, binding = 7) buffer CellBuffer { uint cells[]; };
// Anchors: vec4[2][particles]: high part of the position when the rows were built, and when the contacts were listed.
layout(std430, set = 0, binding = 8) buffer AnchorBuffer { vec4 anchors[]; };
layout(std430, set = 0, binding = 9) buffer SensorBuffer { SensorRecord sensors[]; };
// Who meets in a slot: uvec2[2][slots]: particle, the other particle or the surface (and kSurfaceBits); then those that a
// refresh prepares.
layout(std430, set = 0, binding = 10) buffer EntryBuffer { uvec2 entries[]; };
// The energy book, and its sums.
layout(std430, set = 0, binding = 11) buffer BookBuffer { vec4 books[]; };
layout(std430, set = 0, binding = 12) buffer EnergyBuffer { EnergyRecord energies[]; };
// What a slot's contact exerts: force on its first body [N], w: overlap over the smaller radius; then of each turn of the
// coil that a coil slot's particle touches: vec4[turns][coil slots]. Torques: vec4[slots][2]: on the first body [N m], w: on
// the coil about +z; on the second body.
layout(std430, set = 0, binding = 13) buffer ForceBuffer { vec4 forces[]; };
layout(std430, set = 0, binding = 14) buffer TorqueBuffer { vec4 torques[]; };
// History on its way to the slots that a refresh prepares.
layout(std430, set = 0, binding = 15) buffer CarriedBuffer { vec4 carried[]; };

#ifdef TEXEL_READS
layout(set = 0, binding = 16) uniform textureBuffer stateView;
layout(set = 0, binding = 17) uniform utextureBuffer rowView;
layout(set = 0, binding = 18) uniform utextureBuffer rangeView;
layout(set = 0, binding = 19) uniform textureBuffer historyView;
layout(set = 0, binding = 20) uniform textureBuffer coilHistoryView;
layout(set = 0, binding = 22) uniform textureBuffer anchorView;
layout(set = 0, binding = 23) uniform utextureBuffer entryView;
layout(set = 0, binding = 24) uniform textureBuffer forceView;
layout(set = 0, binding = 25) uniform textureBuffer torqueView;
#endif

#ifdef ENERGY_BOOK
const uint kParts = 5u;
#else
const uint kParts = 2u;
#endif
const uint kRowAnchor = 0u;
const uint kListAnchor = 1u;

/// The member that this workgroup works for: a dispatch has a row of workgroups for each that is live. A run on its own is
/// an ensemble of one, for which all that follows from this folds away.
uint self;
#define member members[self]
#define control controls[self]
void openRow(uint row) { self = MEMBERS == 1u ? 0u : members[row].roster.x; }
void openMember() { openRow(push.firstRow + gl_WorkGroupID.y); }

// A member's parameters. What is read from the same place by all, lavapipe reads once, but only if the place is known when
// the pipeline is made; else texel reads are faster.
#ifdef TEXEL_READS
layout(set = 0, binding = 21) uniform textureBuffer memberView;
#define OF_MEMBER(field, vector) \
    (MEMBERS == 1u ? member.field : texelFetch(memberView, int(kMemberVectors * self + (vector))))
#else
#define OF_MEMBER(field, vector) member.field
#endif
ContactParams lawOf(uint kind) {
    return ContactParams(OF_MEMBER(contact[kind].normal, 4u * kind), OF_MEMBER(contact[kind].sliding, 4u * kind + 1u),
                         OF_MEMBER(contact[kind].rolling, 4u * kind + 2u), OF_MEMBER(contact[kind].torsion, 4u * kind + 3u));
}
vec4 gravity() { return OF_MEMBER(gravity, kVectorGravity); }
vec4 domainLow() { return OF_MEMBER(domainLow, kVectorGravity + 1u); }
vec4 domainHigh() { return OF_MEMBER(domainHigh, kVectorGravity + 2u); }
vec4 numerics() { return OF_MEMBER(numerics, kVectorGravity + 3u); }
uvec4 choices() { return uvec4(OF_MEMBER(choices, kVectorGravity + 4u)); }

/// Which of its member's invocations this is.
uint invocation() {
    return (gl_WorkGroupID.z * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
}
/// Workgroups in a row, layers: together at least `groups`, and just as many for the particles (TableSizes::share).
uvec2 spread(uint groups) {
    uint layers = max(1u, (groups + MOST_GROUPS - 1u) / MOST_GROUPS);
    return uvec2((groups + layers - 1u) / layers, layers);
}

bool opening() { return push.opening == 1u && choices().w == 1u; }
/// By how much springs grow in this step: not at all in a member's first.
float springStep() { return opening() ? 0.0 : numerics().x; }

uint firstParticle() { return self * push.share; }
uint firstPairSlot() { return self * push.pairSlots; }
uint firstSurfaceSlot() { return MEMBERS * push.pairSlots + self * push.surfaceSlots; }
uint springSlots() { return MEMBERS * (push.pairSlots + push.surfaceSlots); }
uint firstCoilSlot() { return springSlots() + self * push.coilSlots; }
uint slotCount() { return springSlots() + MEMBERS * push.coilSlots; }
bool ofPair(uint slot) { return slot < MEMBERS * push.pairSlots; }

uint stateIndex(uint side, uint field, uint i) {
    return side * kFields * push.particles + stateOffset(field, i, push.particles);
}
uint linkIndex(uint at) { return MEMBERS * push.rowEntries + at; }
uint headIndex(uint cell) { return self * (push.cellMask + 1u) + cell; }
uint nextIndex(uint i) { return MEMBERS * (push.cellMask + 1u) + i; }
uint rowRangeIndex(uint i) { return i; }
uint slotRangeIndex(uint i) { return push.particles + i; }
uint historyIndex(uint part, uint slot) {
    return part < 2u ? 2u * slot + part : part * springSlots() + slot;
}
uint coilHistoryIndex(uint turn, uint part, uint i) { return (turn * kParts + part) * push.particles + i; }
uint wireAngleIndex(uint i) { return coilHistoryIndex(kMaxTurns, 0u, i); }
uint anchorIndex(uint which, uint i) { return which * push.particles + i; }
uint comingEntryIndex(uint slot) { return slotCount() + slot; }
uint turnForceIndex(uint turn, uint slot) {
    return slotCount() + turn * MEMBERS * push.coilSlots + slot - springSlots();
}
uint bookIndex(uint field, uint i) { return field * push.particles + i; }
uint slotBookIndex(uint field, uint slot) { return kBookFields * push.particles + field * slotCount() + slot; }

#ifdef TEXEL_READS
vec4 readState(uint side, uint field, uint i) { return texelFetch(stateView, int(stateIndex(side, field, i))); }
uint readRow(uint at) { return texelFetch(rowView, int(at)).x; }
uvec4 readRange(uint at) { return texelFetch(rangeView, int(at)); }
vec4 readHistory(uint part, uint slot) { return texelFetch(historyView, int(historyIndex(part, slot))); }
vec4 readCoilHistory(uint at) { return texelFetch(coilHistoryView, int(at)); }
vec4 readAnchor(uint which, uint i) { return texelFetch(anchorView, int(anchorIndex(which, i))); }
uvec2 readEntry(uint slot) { return texelFetch(entryView, int(slot)).xy; }
vec4 readForce(uint slot) { return texelFetch(forceView, int(slot)); }
vec4 readTorque(uint side, uint slot) { return texelFetch(torqueView, int(2u * slot + side)); }
SurfaceParams readSurface(uint s) {
    int at = int(kMemberVectors * self + kVectorSurface + 4u * s);
    return SurfaceParams(texelFetch(memberView, at), texelFetch(memberView, at + 1), texelFetch(memberView, at + 2),
                         texelFetch(memberView, at + 3));
}
#else
vec4 readState(uint side, uint field, uint i) { return state[stateIndex(side, field, i)]; }
uint readRow(uint at) { return rows[at]; }
uvec4 readRange(uint at) { return ranges[at]; }
vec4 readHistory(uint part, uint slot) { return history[historyIndex(part, slot)]; }
vec4 readCoilHistory(uint at) { return coilHistory[at]; }
vec4 readAnchor(uint which, uint i) { return anchors[anchorIndex(which, i)]; }
uvec2 readEntry(uint slot) { return entries[slot]; }
vec4 readForce(uint slot) { return forces[slot]; }
vec4 readTorque(uint side, uint slot) { return torques[2u * slot + side]; }
SurfaceParams readSurface(uint s) { return member.surface[s]; }
#endif
uint surfaceOf(uint other) { return other & ((1u << kSurfaceBits) - 1u); }

// Where walls go on into the throat (law/surface.glsl, jointContact).
/// A function: of a boolean constant made from others, in a pass that does not use it, lavapipe of Mesa 22.3 makes no pipeline.
bool joints() { return (KIND_SET & kEndingWalls) != 0u && (KIND_SET & (1u << kFront)) != 0u; }
SurfaceParams frontSurface() {
    uint at = kVectorSurface + 4u * FRONT;
    return SurfaceParams(OF_MEMBER(surface[FRONT].pointHigh, at), OF_MEMBER(surface[FRONT].pointLow, at + 1u),
                         OF_MEMBER(surface[FRONT].axis, at + 2u), OF_MEMBER(surface[FRONT].radius, at + 3u));
}

// What every step stores. PACKED_STORES writes 64 bits at a time, for devices that store component by component.
#ifdef PACKED_STORES
layout(std430, set = 0, binding = 0) buffer PackedStateBuffer { u64vec4 packedState[]; };
layout(std430, set = 0, binding = 3) buffer PackedHistoryBuffer { u64vec4 packedHistory[]; };
layout(std430, set = 0, binding = 13) buffer PackedForceBuffer { u64vec2 packedForces[]; };
layout(std430, set = 0, binding = 14) buffer PackedTorqueBuffer { u64vec4 packedTorques[]; };

u64vec2 pack(vec4 a) {
    return u64vec2(packUint2x32(floatBitsToUint(a.xy)), packUint2x32(floatBitsToUint(a.zw)));
}
u64vec4 pack(vec4 a, vec4 b) { return u64vec4(pack(a), pack(b)); }

/// `field` and the one after it, kPosition or kVelocity.
void writeState(uint side, uint field, uint i, vec4 a, vec4 b) {
    packedState[stateIndex(side, field, i) / 2u] = pack(a, b);
}
void writeHistory(uint slot, vec4 a, vec4 b) { packedHistory[slot] = pack(a, b); }
void writeForce(uint slot, vec4 force) { packedForces[slot] = pack(force); }
void writeTorques(uint slot, vec4 first, vec4 second) { packedTorques[slot] = pack(first, second); }
#else
void writeState(uint side, uint field, uint i, vec4 a, vec4 b) {
    uint at = stateIndex(side, field, i);
    state[at] = a;
    state[at + 1u] = b;
}
void writeHistory(uint slot, vec4 a, vec4 b) {
    history[2u * slot] = a;
    history[2u * slot + 1u] = b;
}
void writeForce(uint slot, vec4 force) { forces[slot] = force; }
void writeTorques(uint slot, vec4 first, vec4 second) {
    torques[2u * slot] = first;
    torques[2u * slot + 1u] = second;
}
#endif
void writeTorque(uint slot, vec4 first) { torques[2u * slot] = first; }

/// An error or another call (kErrorLost ...), for `decide` at the end of the step.
void report(uint kind, uint particle) { atomicMin(control.call.x, kind << kCallShift | particle); }

#endif
