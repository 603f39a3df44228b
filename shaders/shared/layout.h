// Buffer layouts seen by both sides: C++ (with GLM) and GLSL. Legal in both; tests/layout compares the offsets that
// SPIR-V declares with offsetof. Everything is built from 16-byte vectors, so that std430 and C++ agree by
// construction.
#ifndef VKDOSE_SHARED_LAYOUT_H
#define VKDOSE_SHARED_LAYOUT_H

#ifdef __cplusplus
#include <glm/glm.hpp>
namespace vkdose::gpu {
using glm::uvec2;
using glm::uvec4;
using glm::vec4;
using uint = glm::uint;
#define SHARED_CONST inline constexpr uint
#define SHARED_REAL inline constexpr float
#define SHARED_FUNCTION constexpr
#else
#define SHARED_CONST const uint
#define SHARED_REAL const float
#define SHARED_FUNCTION
#endif

// --- how many tables there are; the bindings of their views come after theirs ---------------------------------------
SHARED_CONST kTables = 0u
#define TABLE(number, name, element, count, title) +1u  // NOLINT(bugprone-macro-parentheses): a summand
#include "tables.h"
    ;
SHARED_CONST kFirstView = kTables;

// --- limits -------------------------------------------------------------------------------------------------------
SHARED_CONST kMaxSurfaces = 28u;
SHARED_CONST kMaxRegionOutlets = 4u;  // vkdose::kMaxOutlets
// The entry of a contact with a surface holds the surface in these bits. The bits above hold the number of slots that
// its invocation works on.
SHARED_CONST kSurfaceBits = 5u;
SHARED_CONST kUnrolledSurfaces = 8u;  // surfaces whose kind is a specialisation constant; more go through a slower loop
SHARED_CONST kMaxRow = 64u;           // neighbours per particle
SHARED_CONST kMaxLinks = 112u;        // contacts per particle: a row, every surface, every body
SHARED_CONST kEmpty = 0xffffffffu;    // end of a cell's list
SHARED_CONST kMaxBodyTouches = 4u;    // places of one body that one particle touches at once
// What a particle and a body do: force on the particle [N], its moment about the origin of the world [N m], work of the
// body on the particle [J], each summed over the steps since the last sensing.
SHARED_CONST kBodyLoads = 7u;
// Slack: how far a particle may move before the contact lists are made anew. Its unit is half the skin of the rows. A
// particle at rest needs next to none; a falling one gets room for a while.
SHARED_REAL kLeastSlack = 0.0067f;
SHARED_REAL kMostSlack = 0.2f;
SHARED_REAL kSlackSteps = 256.0f;  // steps at the present speed
// Of any point of a body. It may be longer than a particle's, because bodies are not in the rows. That of a driven
// body, that of a free one and that of a particle are less than the skin together.
SHARED_REAL kLeastBodySlack = 0.03f;
SHARED_REAL kMostBodySlack = 0.8f;

SHARED_REAL kAtStop = 1e-7f;  // geometry::kAtStop [m]

// --- particle state: vec4 state[2 halves][2 couples][particles][2 fields] -------------------------------------------
// The halves take turns as source and destination. Two fields side by side are 32 bytes, which a device with 64-bit
// integers can store in four pieces instead of eight.
SHARED_CONST kPosition = 0u;  // xyz: high part [m]; w: radius [m], negative once the particle is out of the motion
SHARED_CONST kResidue = 1u;   // xyz: low part of the position [m]; w: material
// xyz: high part of the half-step velocity [m/s]; w: largest overlap / smaller radius since the last sensing
SHARED_CONST kVelocity = 2u;
// xyz: high part of the half-step angular velocity [rad/s]; w: status as a float (kStatusActive ...)
SHARED_CONST kSpin = 3u;
SHARED_CONST kFields = 4u;

SHARED_FUNCTION uint stateOffset(uint field, uint i, uint particles) {
    return (field / 2u * particles + i) * 2u + field % 2u;
}

SHARED_CONST kStatusActive = 0u;
SHARED_CONST kStatusDosed = 1u;
SHARED_CONST kStatusLost = 2u;
SHARED_CONST kStatusAbsent = 3u;  // waits to be added, or fills a member's last workgroup

// Where the sensors count a particle.
SHARED_CONST kRegionCanister = 0u;
SHARED_CONST kRegionThroat = 1u;
SHARED_CONST kRegionDosed = 2u;
SHARED_CONST kRegionLost = 3u;

// --- materials and surface kinds ------------------------------------------------------------------------------------
SHARED_CONST kFirstPowder = 0u;
SHARED_CONST kWallMaterial = 1u;
SHARED_CONST kCoilMaterial = 2u;
SHARED_CONST kMostMaterials = 8u;  // vkdose::kMostMaterials
SHARED_CONST kMostPairs = kMostMaterials * (kMostMaterials + 1u) / 2u;

/// Where the parameters of a pair of materials are, in either order: as vkdose::PairTable::index.
SHARED_FUNCTION uint pairIndex(uint a, uint b) {
    uint larger = a > b ? a : b, smaller = a > b ? b : a;
    return larger * (larger + 1u) / 2u + smaller;
}

/// No less than the true sum of two lengths [m], however small `way` is. A sum in one float would stand still once
/// `way` is below its resolution. The factor is the next number after one.
SHARED_FUNCTION float wayAfter(float gone, float way) {
    return way > 0.0f ? (gone + way) * (1.0f + 1.1920929e-7f) : gone;
}

SHARED_CONST kPlane = 0u;
SHARED_CONST kTrough = 1u;
SHARED_CONST kTube = 2u;
SHARED_CONST kFront = 3u;
SHARED_CONST kEndingWalls = 16u;  // a bit beside those of the kinds: planes or the trough end at the front wall

// --- one canister's parameters ------------------------------------------------------------------------------------
SHARED_CONST kLeverFull = 0u;
SHARED_CONST kLeverHalf = 1u;

SHARED_CONST kLawUser = 4u;               // of a file of the case's own (law/user.glsl); the others are in laws.h
SHARED_CONST kLawKinds = 16u;             // more than there can be
SHARED_CONST kLimitAbsolute = kLawKinds;  // a bit beside the number of a law: friction is limited by the force's size
SHARED_CONST kOwnParameters = 16u;  // most parameters of such a law; vkdose::kMostLawParameters
SHARED_CONST kOwnProperties = 4u;   // most that it gives each particle; vkdose::kMostLawProperties
SHARED_CONST kOwnMemories = 7u;     // most numbers that it remembers of a contact; vkdose::kMostLawMemories
SHARED_CONST kUserReaches = 31u;    // a bit beside those of the laws: the user's has a reach
// Laws whose contacts hold on beyond touch, and laws that keep the overlap of the last step, a bit each.
SHARED_CONST kReachingLaws = 1u << kUserReaches
#define LAW(number, Name, name, reaches, stiffens, keepsOverlap) | uint(reaches) << uint(number)
#include "laws.h"
    ;
SHARED_CONST kOverlapKeepers = 0u
#define LAW(number, Name, name, reaches, stiffens, keepsOverlap) | uint(keepsOverlap) << uint(number)
#include "laws.h"
    ;

// Hertz-Mindlin, EEPA, JKR: springs are ratios to the stiffness 2 E* a of a contact of the radius a, dampings ratios to
// its damping. A user's law: ratios to its own stiffness and damping.
struct ContactParams {
    // Luding: k1, k2Max, kc [N/m], plasticity depth; Hertz-Mindlin: E* [Pa], 2 sqrt(5/6) beta; EEPA: these, then 1.5 pi
    // delta gamma [N/m], lambda_p; JKR: as Hertz-Mindlin, then the cube root of sqrt(2 pi delta gamma/E*)/4 [m^(1/6)];
    // a user's law: the largest stiffness that is taken from it [N/m]
    vec4 normal;
    vec4 springs;   // of sliding, rolling, torsion: kt, kr, kTo [N/m]; w: law (laws.h), kLimitAbsolute
    vec4 friction;  // coefficients of sliding, rolling, torsion: mu, muR, muTo; w: EEPA: f0 [N]; a
                    // user's law: its farthest reach [m]
    // of sliding, rolling, torsion, then of the normal part: gammaT, gammaR, gammaTo, gamma [kg/s]; EEPA: w: chi/1.5
    vec4 damping;
    vec4 own[kOwnParameters / 4u];  // of a user's law, in the order of its file
};

struct SurfaceParams {
    // xyz: plane point or tube base, high part (front: z in z; walls that end: z of the end in z) [m]; w: kind
    vec4 pointHigh;
    vec4 pointLow;  // xyz: low part; w: tube: +1 touched from inside, -1 from outside; plane, trough: 1 if it ends
    vec4 axis;      // plane normal or tube axis, unit; w: length of tube or throat [m]
    vec4 radius;    // x, y: radius high, low (trough: half width; front: hole) [m]; z: material
};

struct Member {
    ContactParams contact[kMostPairs];  // pairIndex
    SurfaceParams surface[kMaxSurfaces];
    vec4 gravity;     // xyz [m/s2]; w: density of the first powder [kg/m3]
    vec4 domainLow;   // xyz [m]; w: throatZ [m]
    vec4 domainHigh;  // xyz [m]; w: outletZ [m]
    vec4 numerics;    // time step [s], skin [m], cell size [m], largest allowed overlap ratio
    vec4 choices;     // rolling lever (kLeverFull ...), 1 before any step
    uvec4 roster;     // x: in block n, the member that row n of a dispatch works for; y, z: steps that the member has
                      // made at the start and at the end of the batch; w: how far beyond touch
                      // a contact may hold, as the bits of a float [m]
    uvec4 bodies;     // x: how many; y: where they begin in `geometry`; z: where their motions begin in `motions`; w:
                      // from one step's motions to the next one's
    vec4 outlets[2u * kMaxRegionOutlets];  // of a region that deletes: first vector's w: 0 none, and none behind it; 1
                                           // beyond a plane: its normal, then its place along it in w [m]; 2 a box: its
                                           // low, then its high corner [m]
    vec4 densities[kMostMaterials / 4u];   // of each material's particles [kg/m3]
    vec4 properties[kMostMaterials];       // of each material's walls, which a user's law asks for
    vec4 period[2];  // xyz: length of the domain in directions that repeat, else 0, in two floats [m]
};
// Where in a member some of its vectors are.
SHARED_CONST kContactVectors = 4u + kOwnParameters / 4u;
SHARED_CONST kVectorSurface = kMostPairs * kContactVectors;
SHARED_CONST kVectorGravity = kVectorSurface + 4u * kMaxSurfaces;
SHARED_CONST kVectorOutlets = kVectorGravity + 7u;
SHARED_CONST kVectorDensities = kVectorOutlets + 2u * kMaxRegionOutlets;
SHARED_CONST kVectorProperties = kVectorDensities + kMostMaterials / 4u;
SHARED_CONST kVectorPeriod = kVectorProperties + kMostMaterials;
SHARED_CONST kMemberVectors = kVectorPeriod + 2u;

// --- control block: decisions and reports of the device -----------------------------------------------------------
// Calls of particles in order of urgency: errors first (causes before their effects), then rebuild, then refresh. A
// call is one word, kind << kCallShift | particle, and the least wins, whatever order invocations run in. No further
// step of the stride is made after a call. Only kCallSoon lets the stride go on.
SHARED_CONST kErrorRowFull = 0u;
SHARED_CONST kErrorCrowded = 1u;
SHARED_CONST kErrorTables = 2u;
SHARED_CONST kErrorNan = 3u;
SHARED_CONST kErrorOverlap = 4u;
SHARED_CONST kErrorLost = 5u;
SHARED_CONST kErrorFeatures = 6u;
SHARED_CONST kErrorForce = 7u;
SHARED_CONST kErrorLists = 8u;
SHARED_CONST kErrors = 9u;
SHARED_CONST kCallRebuild = 9u;   // of the rows, and so of the contact lists
SHARED_CONST kCallRefresh = 10u;  // of the contact lists
SHARED_CONST kCallShift = 27u;
SHARED_CONST kMostParticles = 1u << kCallShift;
SHARED_CONST kCallWaits = 0xfffffffdu;  // this step was not made, because of a call in an earlier one
SHARED_CONST kCallSoon = 0xfffffffeu;   // a refresh of the contact lists at the end of the stride; names no particle
// Most steps between two decisions. A stride ends where the member's number of steps is a multiple of it.
SHARED_CONST kStride = 8u;

struct Dispatches {   // indirect arguments, three words each: workgroups in a row, a row for each live member, layers.
                      // For all members together: as many workgroups as the one that wants most.
    uvec4 heads;      // workgroups that clear the cell table, 0 while no rebuild of the rows is wanted
    uvec4 particles;  // workgroups over the particles, ditto
    uvec4 refresh;    // workgroups over the particles, 0 while no refresh of the contact lists is wanted
    uvec4 parts;      // workgroups over the particles that were near a body before, ditto
    uvec4 settle;     // one workgroup, ditto
    uvec4 pairs;      // workgroups over the entries of the contact lists: pairs ...
    uvec4 surfaces;   // ... contacts with surfaces ...
    uvec4 bodies;     // ... particles near a body
    uvec4 faces;      // ... of these those near one face of a mesh; then `bodies` has the others
    uvec4 tables[kTables];  // xy: address of each table, its low word first, where passes reach tables by address
};

struct Control {   // a member's
    uvec4 wanted;  // x: 1 if this stride starts with new rows, y: with new contact lists; z, w: if a later one is to
    uvec4 steps;   // x: the member's number of steps, modulo 2^32, before this stride; y: this stride has no more; z:
                   // made of these
    uvec4 listed;  // entries of the contact lists in use: pairs, surfaces, particles near bodies; w: 1 if a call asks
                   // for new lists when the number of steps is next a multiple of kStride
    uvec4 sorted;  // body slots in use, if they are sorted: x: near one face of a mesh, y: others
    uvec4 coming;  // entries taken so far by the refresh at work: those, and links
    uvec4 list;   // x: entries of the rows in use; y: rebuilds since load; z: longest row ever; w: refreshes since load
    vec4 drift;   // x: longest way of a driven body since the last refresh, y: the one that the lists allow for [m]
    uvec4 call;   // x: the most urgent call of the even steps of this stride, y: of the odd ones; kEmpty: none
    uvec4 error;  // the first: x: step of the batch, y: kind, z: particle; x is kEmpty while there is none. It is the
                  // last step that the member makes.
};

// --- sensing: records of workgroups, summed by the host in double precision ---------------------------------------
struct SensorRecord {
    uvec4 count;    // particles per region (kRegionCanister ...)
    vec4 mass;      // per region [kg]
    vec4 motion;    // kinetic energy, rotational energy [J], momentum along z in the throat [kg m/s]
    vec4 extremes;  // x: largest overlap ratio; yz: mass by the periods it has gone through, as keptPeriods [kg]
};

// --- the energy book (host/backend/backend.h, EnergyBook), kept only where the world asks for it [J] ---------------
// vec4 book[3 fields][particles], then vec4 book[3 fields][slots] of the contacts, which book to their first body. The
// book of a particle sums since the last sensing; the book of a contact holds the last step.
SHARED_CONST kBookNormal = 0u;  // plastic, adhesive, viscous, numerical loss
// sliding, rolling, torsion loss; of a contact: loaded
SHARED_CONST kBookSliders = 1u;
// of a particle: loaded, left; w: work of the bodies
SHARED_CONST kBookFlow = 2u;
SHARED_CONST kBookElastic = 2u;  // of a contact: energy of its normal, sliding, rolling, torsion springs
SHARED_CONST kBookFields = 3u;

struct EnergyRecord {
    vec4 normal;    // as kBookNormal
    vec4 sliders;   // as kBookSliders
    vec4 flow;      // loaded, left, kinetic, rotational energy
    vec4 elastic;   // as kBookElastic, of the contacts that the particles own
    vec4 momentum;  // xyz [kg m/s]; w: potential energy
    vec4 angular;   // xyz: angular momentum about the origin [kg m2/s]; w: work of the bodies
};

struct GroupRecord {  // one per workgroup
    SensorRecord sensors;
    EnergyRecord energy;
};

// --- coarse-grained fields (host/model/field.h) --------------------------------------------------------------------
SHARED_CONST kGaussian = 0u;
SHARED_CONST kLucy = 1u;
SHARED_CONST kFieldNodes = 4u;  // of the quadrature along a branch
// A point of the grid: vec4 grid[points][7].
SHARED_CONST kFieldMass = 0u;     // x: density; yzw: momentum
SHARED_CONST kFieldNumber = 1u;   // x: number; y: touching neighbours; zw: kinetic stress xx, yy
SHARED_CONST kFieldKinetic = 2u;  // zz, yz, zx, xy
SHARED_CONST kFieldContact = 3u;  // and two more: rows of the contact stress
SHARED_CONST kFieldProperties = 6u;  // each property times the density; only if a user's law declares some
SHARED_CONST kFieldVectors = 7u;

struct FieldParams {
    vec4 low;      // xyz: corner of the grid [m]; w: reach of the kernel [m]
    vec4 size;     // xyz: of the grid [m]; w: width of the kernel [m]
    vec4 cell;     // xyz: size of a cell [m]; w: its volume [m3]
    vec4 along;    // xyz: 1 in directions that are resolved, else 0; w: a contact's branch is no longer than this [m]
    uvec4 points;  // xyz: number of cells, a point in the middle of each; w: kernel
    uvec4 tile;    // xyz: points of a workgroup; w: 1 if contact stress is wanted
    uvec4 tiles;   // xyz: workgroups; w: particles of a slice
    uvec4 chosen;  // x: 1 + the material whose particles count; 0: all do
    uvec4 tables;  // xy, zw: addresses of `weights` and `branches`, where passes reach tables by address
};

// --- per dispatch -------------------------------------------------------------------------------------------------
struct StepPush {
    uint stepInStride;  // for `decide`: how many steps were recorded since the last decision; 0 outside of a stride
    uint opening;       // 1 if this may be the first step of a member (Member.choices): half a kick, springs at rest
    uint firstRow;      // block of the roster for the first row of the dispatch
    uint live;          // members on the roster
    uint particles;     // slots of all members, padding included
    // Of each member:
    uint share;         // slots for particles, a multiple of the workgroup size
    uint cellMask;      // size of the cell table - 1 (a power of two)
    uint rowEntries;    // room in the rows ...
    uint linkEntries;   // ... and in the links behind the rows of all
    uint pairSlots;     // contact slots, multiples of the workgroup size: first the pairs of all members ...
    uint surfaceSlots;  // ... then the surfaces ...
    uint bodySlots;     // ... then the bodies
    uint slice;         // first particle of the member that a field pass adds up
};

#ifdef __cplusplus
#undef SHARED_CONST
#undef SHARED_REAL
#undef SHARED_FUNCTION
}  // namespace vkdose::gpu
#endif
#endif
