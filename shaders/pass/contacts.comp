#version 450
// contacts: what every listed contact exerts in this step, one contact per invocation; of the coil, all contacts of one
// particle. Built with and without TEXEL_READS (shared/buffers.glsl) and ENERGY_BOOK (pass/contacts_energy.glsl).
// Reads the source half of the state, entries, histories; writes histories, forces and torques, which `move` gathers.
// A contact that does not touch exerts nothing and remembers nothing.
//
// Shape of the code: software devices execute every branch under a mask, and only loops without a lane left are skipped.
// So the three kinds of contact stand in loops of at most one trip, and a workgroup has only one kind. The parameters
// are read before, where all lanes share one load.
#extension GL_GOOGLE_include_directive : require
#include "shared/buffers.glsl"
#include "shared/body.glsl"
#include "law/contact.glsl"
#include "law/coil.glsl"
#ifdef ENERGY_BOOK
#include "law/energy.glsl"
#endif

ContactParams pairLaw, wallLaw, coilLaw;
CoilParams coil;
uvec4 choices;
float springDt;

#ifdef ENERGY_BOOK
#include "pass/contacts_energy.glsl"
#endif
#include "pass/contacts_pairs.glsl"
#include "pass/contacts_walls.glsl"

void main() {
    pairLaw = member.contact[kParticleParticle];
    wallLaw = member.contact[kParticleWall];
    coilLaw = member.contact[kParticleCoil];
    coil = member.coil;
    choices = member.choices;
    springDt = push.opening == 1u ? 0.0 : member.numerics.x;

    uint group = gl_WorkGroupID.x, pairGroups = control.contacts.w, surfaceGroups = control.listed.w;
    uint pair = group * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    uint surface = pair - pairGroups * gl_WorkGroupSize.x;
    uint turning = surface - surfaceGroups * gl_WorkGroupSize.x;
    bool isPair = group < pairGroups, isSurface = !isPair && group < pairGroups + surfaceGroups;

    for (uint once = isPair && pair < control.listed.x ? 1u : 0u; once > 0u; --once) meetParticles(pair);
    for (uint once = isSurface && surface < control.listed.y ? 1u : 0u; once > 0u; --once)
        meetSurface(push.pairSlots + surface);
    for (uint once = !isPair && !isSurface && turning < control.listed.z ? 1u : 0u; once > 0u; --once)
        meetCoil(springSlots() + turning);
}
