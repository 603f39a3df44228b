// The tables and how passes read and write them. One set of bindings serves all passes.
#ifndef VKDOSE_SHARED_BUFFERS_GLSL
#define VKDOSE_SHARED_BUFFERS_GLSL

#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require  // SPIR-V calls a samplerBuffer invalid from 1.6 on
#ifdef PACKED_STORES
#extension GL_ARB_gpu_shader_int64 : require
#endif
#include "law/period.glsl"
#include "law/reach.glsl"
#include "shared/layout.h"

layout(local_size_x_id = 0) in;                    // workgroup size, chosen by the host
layout(constant_id = 1) const uint SURFACES = 0u;  // fixed surfaces
layout(constant_id = 2) const uint KINDS = 0u;     // kinds of the first surfaces, 4 bits each (kUnrolledSurfaces)
layout(constant_id = 3) const uint KIND_SET = 0u;  // bit k: there is a surface of kind k; and kEndingWalls
layout(constant_id = 4) const uint MEMBERS = 1u;  // canisters that share the buffers, each with its part of every table
layout(constant_id = 5) const uint MOST_GROUPS = 65535u;  // workgroups in a row of a dispatch; more go in layers
layout(constant_id = 6) const uint FRONT = 0u;            // the front wall among the surfaces, if there is one
layout(constant_id = 7) const uint BODIES = 0u;           // most bodies of a member
layout(constant_id = 8) const uint SHAPE_KINDS = 0u;      // bit k: a body has a shape of kind k (shared/geometry.h)
layout(constant_id = 10) const uint MOST_PLACES = 4u;     // in which a sphere touches a body (law/places.glsl)

layout(constant_id = 11) const uint POWDERS = 1u;     // 1: all particles are of the first powder
layout(constant_id = 12) const uint MANY_WALLS = 0u;  // 1: a surface or body is of a material of its own
layout(constant_id = 13) const uint OUTLETS = 0u;     // most regions of a member that delete
layout(constant_id = 14) const uint PERIODS = 0u;     // 1: a direction of a member repeats
layout(constant_id = 15) const uint WALL_LOADS = 0u;  // 1: the loads on the surfaces of a member are summed
layout(constant_id = 16) const uint ONE_FACE = 0u;    // 1: the pass `faces`, not `bodies` (pass/bodies.comp)

layout(push_constant) uniform Push { StepPush pushed; };
StepPush push = pushed;  // read before any branch, like all that is the same for all: shaders/README.md, Drivers

// The tables (shared/tables.h), and their bindings by name.
#define BOUND(number, name, element, access) \
    layout(std430, set = 0, binding = number) access buffer name##Buffer { element name[]; };
#define BOUND_HEADED(number, name, element, head, headName)         \
    layout(std430, set = 0, binding = number) buffer name##Buffer { \
        head headName;                                              \
        element name[];                                             \
    };
#ifdef ADDRESSED
#include "shared/addressed.glsl"
#else
#define TABLE(number, name, element, count, title) \
    const uint name##Binding = number;             \
    BOUND(number, name, element, )
#define PARAMETERS(number, name, element, count, title) BOUND(number, name, element, readonly)
#define HEADED(number, name, element, count, title, head, headName) BOUND_HEADED(number, name, element, head, headName)
#include "shared/tables.h"
#endif

// Processors read faster through texel views. There stateAt(at) is state[at] read through the view, and likewise for
// every table that has a view. The views' bindings come after those of the tables.
#define TABLE(number, name, element, count, title)
#define HEADED(number, name, element, count, title, head, headName)
#ifdef TEXEL_READS
#define VIEW_vec4 textureBuffer
#define VIEW_uint utextureBuffer
#define VIEW_uvec2 utextureBuffer
#define VIEW_uvec4 utextureBuffer
#define OF_TEXEL_vec4(texel) texel
#define OF_TEXEL_uint(texel) texel.x
#define OF_TEXEL_uvec2(texel) texel.xy
#define OF_TEXEL_uvec4(texel) texel
#define VIEWED(number, name, element, count, title)                                   \
    layout(set = 0, binding = kFirstView + number) uniform VIEW_##element name##View; \
    element name##At(uint at) { return OF_TEXEL_##element(texelFetch(name##View, int(at))); }
#define PARAMETERS(number, name, element, count, title) \
    layout(set = 0, binding = kFirstView + number) uniform textureBuffer name##View;
#else
#define VIEWED(number, name, element, count, title) \
    element name##At(uint at) { return name[at]; }
#define PARAMETERS(number, name, element, count, title)
#endif
#include "shared/tables.h"

#ifdef ENERGY_BOOK
const uint kOwnPart = 5u;
#else
const uint kOwnPart = 2u;
#endif
#ifdef USER_LAW
const uint kParts = kOwnPart + 2u;  // the last two are the memory of the user's law
#else
const uint kParts = kOwnPart + ((LAWS & kOverlapKeepers) != 0u ? 1u : 0u);  // for the overlap of the last step
#endif
const uint kPlaceParts = kParts + 1u;                     // of a place on a body
const uint kBodyHistory = kMaxBodyTouches * kPlaceParts;  // of a body slot

/// The member that this workgroup works for. A dispatch has a row of workgroups for each live member. A run on its own
/// is an ensemble of one member; the compiler then removes all that depends on this.
uint self;
uint source;       // which half of its state is current; `move` writes the other one
uint stepInBatch;  // the step at work, counted from the start of the batch; outside of a stride, the next one
#define member members[self]
#define control controls[self]
void openRow(uint row) { self = MEMBERS == 1u ? 0u : members[row].roster.x; }
void openMember() {
    openRow(push.firstRow + gl_WorkGroupID.y);
    uint made = control.steps.x + push.stepInStride;
    source = made & 1u;
    stepInBatch = made - member.roster.y;
}

/// Whether the member does not make this step of the stride: it is beyond what `decide` allowed, or the step before
/// made a call or was not made either. Calls of this very step come in while others ask; they have a word of their own.
bool waits() {
    uint most = control.steps.y, before = control.call[1u - (push.stepInStride & 1u)];
    return push.stepInStride >= most || before < kCallSoon;
}

// A member's parameters. lavapipe reads a value once for all invocations if they read it from the same place and the
// place is known when the pipeline is made. Otherwise texel reads are faster.
#ifdef TEXEL_READS
#define OF_MEMBER(field, vector) \
    (MEMBERS == 1u ? member.field : texelFetch(membersView, int(kMemberVectors * self + (vector))))
#else
#define OF_MEMBER(field, vector) member.field
#endif
/// The law of a pair of materials (pairIndex).
ContactParams lawOf(uint pair) {
    ContactParams p;
    p.normal = OF_MEMBER(contact[pair].normal, kContactVectors * pair);
    p.springs = OF_MEMBER(contact[pair].springs, kContactVectors * pair + 1u);
    p.friction = OF_MEMBER(contact[pair].friction, kContactVectors * pair + 2u);
    p.damping = OF_MEMBER(contact[pair].damping, kContactVectors * pair + 3u);
#ifdef USER_LAW
    p.own[0] = OF_MEMBER(contact[pair].own[0], kContactVectors * pair + 4u);
    p.own[1] = OF_MEMBER(contact[pair].own[1], kContactVectors * pair + 5u);
    p.own[2] = OF_MEMBER(contact[pair].own[2], kContactVectors * pair + 6u);
    p.own[3] = OF_MEMBER(contact[pair].own[3], kContactVectors * pair + 7u);
#endif
    return p;
}
/// Whether the law of a contact depends on more than on what it is with. This is a function, as is joints() below.
bool ownLaws() { return POWDERS > 1u || MANY_WALLS == 1u; }
/// Density of a material's particles [kg/m3]. `first` is that of the first powder, which passes read before any branch.
float densityOf(uint material, float first) {
    if (POWDERS == 1u) return first;
    uint at = material / 4u;
    vec4 four = OF_MEMBER(densities[at], kVectorDensities + at);
    return four[material % 4u];
}
vec4 gravity() { return OF_MEMBER(gravity, kVectorGravity); }
vec4 domainLow() { return OF_MEMBER(domainLow, kVectorGravity + 1u); }
vec4 domainHigh() { return OF_MEMBER(domainHigh, kVectorGravity + 2u); }
vec4 numerics() { return OF_MEMBER(numerics, kVectorGravity + 3u); }
vec4 outletVector(uint k) { return OF_MEMBER(outlets[k], kVectorOutlets + k); }
/// In directions that repeat, the domain's length. Asked only where PERIODS is 1.
Period period() {
    return Period(OF_MEMBER(period[0], kVectorPeriod).xyz, OF_MEMBER(period[1], kVectorPeriod + 1u).xyz);
}
uvec4 choices() { return uvec4(OF_MEMBER(choices, kVectorGravity + 4u)); }

/// How far beyond touch a contact may hold: asked only where law/reach.glsl says that one can [m].
float longestReach() { return uintBitsToFloat(member.roster.w); }

/// The number of the step at work since the member's load, modulo 2^32.
uint stepNumber() { return control.steps.x + push.stepInStride; }

/// Which of its member's invocations this is.
uint invocation() {
    return (gl_WorkGroupID.z * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
}
/// Workgroups in a row, layers: together at least `groups`, and just as many for the particles (TableSizes::share).
uvec2 spread(uint groups) {
    uint layers = max(1u, (groups + MOST_GROUPS - 1u) / MOST_GROUPS);
    return uvec2((groups + layers - 1u) / layers, layers);
}

/// Whether this is the member's first step. The record is read before a branch, and so should this be called: behind
/// one lavapipe reads lane by lane.
bool opening() {
    uvec4 chosen = choices();
    return push.opening == 1u && chosen.y == 1u;
}
/// By how much springs grow in this step: not at all in a member's first.
float springStep() {
    float dt = numerics().x;
    return opening() ? 0.0 : dt;
}

uint particleCount() { return push.particles; }
uint rowEntryCount() { return push.rowEntries; }
uint linkEntryCount() { return push.linkEntries; }
uint firstParticle() { return self * push.share; }
uint firstPairSlot() { return self * push.pairSlots; }
uint firstSurfaceSlot() { return MEMBERS * push.pairSlots + self * push.surfaceSlots; }
uint springSlotCount() { return MEMBERS * (push.pairSlots + push.surfaceSlots); }
uint bodySlotCount() { return MEMBERS * push.bodySlots; }
uint firstBodySlot() { return springSlotCount() + self * push.bodySlots; }
uint slotCount() { return springSlotCount() + bodySlotCount(); }
bool ofPair(uint slot) { return slot < MEMBERS * push.pairSlots; }

// Where the elements of the tables are. shared/tables.h uses these names of sizes. Some are functions above, because a
// macro's text cannot contain its own name.
#define canisters MEMBERS
#define particles particleCount()
#define cellHeads (push.cellMask + 1u)
#define rowEntries rowEntryCount()
#define linkEntries linkEntryCount()
#define springSlots springSlotCount()
#define bodySlots bodySlotCount()
#define bodies BODIES
#define bodied (BODIES > 0u ? 1u : 0u)
#ifdef OWN_PROPERTIES
#define propertied 1u
#else
#define propertied 0u
#endif
#define loaded (BODIES + WALL_LOADS * SURFACES)
#define slots slotCount()
#define historyParts kParts
#define bodyHistory kBodyHistory
#define TABLE(number, name, element, count, title)
#define ROW(table, function, first, length) \
    uint function(uint i) { return (first) + i; }
#define ROWS(table, function, first, rows, length) \
    uint function(uint row, uint i) { return (first) + row * (length) + i; }
#include "shared/tables.h"
#undef canisters
#undef particles
#undef cellHeads
#undef rowEntries
#undef linkEntries
#undef springSlots
#undef bodySlots
#undef bodies
#undef bodied
#undef propertied
#undef slots
#undef historyParts
#undef bodyHistory

uint stateIndex(uint side, uint field, uint i) {
    return side * kFields * push.particles + stateOffset(field, i, push.particles);
}
uint historyIndex(uint part, uint slot) { return part < 2u ? springIndex(slot, part) : exertedIndex(part - 2u, slot); }
/// Vector `part` of the history of place `touch` in a body slot: 0, 1: History; 2: direction in the frame of the body;
/// with an energy book 3, 4, 5: Exerted; then the memory of a user's law.
uint placeHistoryIndex(uint slot, uint touch, uint part) {
    return bodyHistoryIndex(slot - springSlotCount(), kPlaceParts * touch + part);
}
uint forceOfPlace(uint slot, uint touch) { return bodyForceIndex(slot - springSlotCount(), touch); }

vec4 readState(uint side, uint field, uint i) { return stateAt(stateIndex(side, field, i)); }
vec4 readHistory(uint part, uint slot) { return historyAt(historyIndex(part, slot)); }
#ifdef TEXEL_READS
SurfaceParams readSurface(uint s) {
    int at = int(kMemberVectors * self + kVectorSurface + 4u * s);
    return SurfaceParams(texelFetch(membersView, at), texelFetch(membersView, at + 1), texelFetch(membersView, at + 2),
                         texelFetch(membersView, at + 3));
}
#else
SurfaceParams readSurface(uint s) { return member.surface[s]; }
#endif
/// What a particle is made of, by the w of its kResidue.
uint materialIn(float residue) { return POWDERS == 1u ? kFirstPowder : uint(residue); }
uint materialOf(uint i) { return materialIn(readState(source, kResidue, i).w); }
/// What a surface is made of.
uint materialOfWall(SurfaceParams p) { return MANY_WALLS == 1u ? uint(p.radius.z) : kWallMaterial; }
uint surfaceOf(uint other) { return other & ((1u << kSurfaceBits) - 1u); }

/// Whether there are walls that go on into the throat (law/surface.glsl, jointContact). This is a function, because
/// lavapipe of Mesa 22.3 makes no pipeline of a pass that does not use a boolean constant made from others.
bool joints() { return (KIND_SET & kEndingWalls) != 0u && (KIND_SET & (1u << kFront)) != 0u; }
SurfaceParams frontSurface() {
    uint at = kVectorSurface + 4u * FRONT;
    return SurfaceParams(OF_MEMBER(surface[FRONT].pointHigh, at), OF_MEMBER(surface[FRONT].pointLow, at + 1u),
                         OF_MEMBER(surface[FRONT].axis, at + 2u), OF_MEMBER(surface[FRONT].radius, at + 3u));
}

// The stores of every step. PACKED_STORES writes 64 bits at a time, for devices that store component by component.
#ifdef PACKED_STORES
layout(std430, set = 0, binding = stateBinding) buffer PackedStateBuffer { u64vec4 packedState[]; };
layout(std430, set = 0, binding = anchorsBinding) buffer PackedAnchorBuffer { u64vec4 packedAnchors[]; };
layout(std430, set = 0, binding = historyBinding) buffer PackedHistoryBuffer { u64vec4 packedHistory[]; };
layout(std430, set = 0, binding = forcesBinding) buffer PackedForceBuffer { u64vec2 packedForces[]; };
layout(std430, set = 0, binding = torquesBinding) buffer PackedTorqueBuffer { u64vec4 packedTorques[]; };

#include "shared/pack.glsl"

/// `field` and the one after it, kPosition or kVelocity.
void writeState(uint side, uint field, uint i, vec4 a, vec4 b) {
    packedState[stateIndex(side, field, i) / 2u] = pack(a, b);
}
void writeSpeedLow(uint i, vec4 velocity, vec4 spin) {
    packedAnchors[speedLowIndex(i, 0u) / 2u] = pack(velocity, spin);
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
void writeSpeedLow(uint i, vec4 velocity, vec4 spin) {
    anchors[speedLowIndex(i, 0u)] = velocity;
    anchors[speedLowIndex(i, 1u)] = spin;
}
void writeHistory(uint slot, vec4 a, vec4 b) {
    history[historyIndex(0u, slot)] = a;
    history[historyIndex(1u, slot)] = b;
}
void writeForce(uint slot, vec4 force) { forces[slot] = force; }
void writeTorques(uint slot, vec4 first, vec4 second) {
    torques[torqueIndex(slot, 0u)] = first;
    torques[torqueIndex(slot, 1u)] = second;
}
#endif
void writeTorque(uint slot, vec4 first) { torques[torqueIndex(slot, 0u)] = first; }

#define callOfStep control.call[push.stepInStride & 1u]
/// An error or another call (kErrorLost ...), for `decide` at the end of the stride.
void report(uint kind, uint particle) { atomicMin(callOfStep, kind << kCallShift | particle); }

#endif
