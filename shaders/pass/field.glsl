// The common part of the field passes: their tables, the kernel, and which contacts there are. Positions are offsets
// from the grid's lower corner. A contact is numbered as its force is (forces in shared/tables.h): by its slot, one
// with a body by the place.
#ifndef VKDOSE_PASS_FIELD_GLSL
#define VKDOSE_PASS_FIELD_GLSL

#define TABLE(number, name, element, count, title) BOUND(number, name, element, )
#define PARAMETERS(number, name, element, count, title) BOUND(number, name, element, readonly)
#ifdef ADDRESSED
#define LONG(number, name, element, count, title) \
    layout(buffer_reference, std430, buffer_reference_align = 16) buffer name##Elements { element at[]; };
#endif
#define ROW(table, function, first, length) \
    uint function(uint i) { return (first) + i; }
#define ROWS(table, function, first, rows, length) \
    uint function(uint row, uint i) { return (first) + row * (length) + i; }
#define particles particleCount()
#define forceEntries bodyForceIndex(bodySlotCount(), 0u)
#include "shared/field_tables.h"
#undef particles
#undef forceEntries
#define field fields[0]
#ifdef ADDRESSED
weightsElements weightsTable = weightsElements(field.tables.xy);
branchesElements branchesTable = branchesElements(field.tables.zw);
#define weights weightsTable.at
#define branches branchesTable.at
#endif

// A branch in its table: xyz is the part of it that lies in wanted particles, w how far from the first particle's
// centre that part begins, in its own lengths.
const vec4 kNoBranch = vec4(0.0, 0.0, 0.0, -1.0);

// Gauss-Legendre on [0, 1] (host/model/field.h).
const vec4 kNodes = vec4(0.06943184420297371, 0.33000947820757187, 0.66999052179242813, 0.93056815579702629);
const vec4 kShares = vec4(0.17392742256872693, 0.32607257743127307, 0.32607257743127307, 0.17392742256872693);

/// Where a contact is found.
struct ContactPlace {
    uint contact;  // kEmpty: it is not in use
    uint slot;
    uint part;  // the place on the body
};

/// A member's k-th contact: pairs first, then surfaces, then the places on bodies.
ContactPlace memberContact(uint k) {
    ContactPlace none = ContactPlace(kEmpty, 0u, 0u);
    if (k < push.pairSlots) {
        uint slot = firstPairSlot() + k;
        return k < control.listed.x ? ContactPlace(slot, slot, 0u) : none;
    }
    k -= push.pairSlots;
    if (k < push.surfaceSlots) {
        uint slot = firstSurfaceSlot() + k;
        return k < control.listed.y ? ContactPlace(slot, slot, 0u) : none;
    }
    k -= push.surfaceSlots;
    if (k >= kMaxBodyTouches * push.bodySlots) return none;
    uint place = k % kMaxBodyTouches, slot = firstBodySlot() + k / kMaxBodyTouches;
    return slot - firstBodySlot() < control.listed.z ? ContactPlace(forceOfPlace(slot, place), slot, place) : none;
}

/// Whether the fields are of this particle's material.
bool isWanted(uint i) { return field.chosen.x == 0u || field.chosen.x == materialOf(i) + 1u; }

/// In directions that repeat, the image of an offset that is nearest to the middle of the grid.
vec3 overGrid(vec3 offset) {
    if (PERIODS == 0u) return offset;
    vec3 middle = 0.5 * field.size.xyz;
    return middle + shortest(offset - middle, period());
}

vec3 offsetOf(uint side, uint i) {
    return overGrid((state[stateIndex(side, kPosition, i)].xyz - field.low.xyz) +
                    state[stateIndex(side, kResidue, i)].xyz);
}

vec3 pointAt(uvec3 cell) { return (vec3(cell) + 0.5) * field.cell.xyz; }

/// The kernel without its norm.
float kernel(vec3 away) {
    if (PERIODS == 1u) away = shortest(away, period());
    vec3 d = field.along.xyz * away;
    float square = dot(d, d), reach = field.low.w, width = field.size.w;
    if (square >= reach * reach) return 0.0;
    if (field.points.w == kGaussian) return exp(-0.5 * square / (width * width));
    float q = sqrt(square) / width, rest = 1.0 - q;
    return (1.0 + 3.0 * q) * rest * rest * rest;
}

#endif
