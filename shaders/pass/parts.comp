#version 450
// parts: keeps, for each slot of a particle near a body that `near` prepared, the parts of the body's mesh that the
// particle can touch before the next refresh. `bodies` then looks at no others. Sorts the slots: of those that are near
// one face and nothing else, `faces` makes short work. Reads state, coming entries, the shapes and motions of the
// bodies; writes `nearby` and the controls.
//
// `near` could do the same for every particle. But few are near a mesh, and the others of their lanes would wait.
#extension GL_GOOGLE_include_directive : require
#include "shared/buffers.glsl"
#include "pass/margin.glsl"
#define KEEPS_NEARBY
#include "pass/bodies.glsl"
#include "pass/near_bodies.glsl"

void listParts(uint slot) {
    uvec2 who = entries[comingEntryIndex(slot)];
    uint i = who.x, body = who.y;
    vec4 p = readState(source, kPosition, i);
    float radius = p.w, slack = slackToBodies(p.xyz, slackOfParticle(i));
    if (reaches()) radius += longestReach();
    Two3 centre = centreOn(body, i);
    if (!openNearby(slot)) return;
    uint kept = kWholeCell, meshes = 0u;
    uvec2 shapes = geometryAt(kBodyVectors * body).xy;
    for (uint s = 0u; s < shapes.y; ++s) {
        uint shape = shapes.x + kShapeVectors * s;
        uvec4 head = geometryAt(shape);
        if (head.x != kShapeMesh) continue;
        ++meshes;
        kept = listNearby(shape, head, centre, radius, slack);
    }
    if (meshes != 1u) kept = kWholeCell;
    nearby[nearbyStart] = kept;
    if (!sortsSlots()) return;
    bool oneFace = kept == 1u && (nearbyAt(0u) & kAllParts) == kPartFace && shapes.y == 1u;
    uint place = 0u;
    if (oneFace) place = atomicAdd(control.sorted.x, 1u);
    if (!oneFace) place = push.bodySlots - 1u - atomicAdd(control.sorted.y, 1u);
    nearby[sortedWord(place)] = slot;
}

void main() {
    openMember();
    openBodies();
    uint slots = min(control.coming.z, push.bodySlots);
    if (control.wanted.y == 0u) slots = 0u;
    // The dispatch has as many invocations as the lists before had slots; there may be more now.
    uint all = gl_NumWorkGroups.x * gl_NumWorkGroups.z * gl_WorkGroupSize.x;
    for (uint k = invocation(); k < slots; k += all) {
        listParts(firstBodySlot() + k);
        if (k + all >= slots) break;  // at the end: shaders/README.md, Drivers
    }
}
