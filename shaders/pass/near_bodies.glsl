// How near a particle and a body can come before the next refresh. Takes pass/margin.glsl and pass/bodies.glsl.
#ifndef VKDOSE_PASS_NEAR_BODIES_GLSL
#define VKDOSE_PASS_NEAR_BODIES_GLSL

/// The largest of the bodies that move freely (pass/free_bodies.comp).
float slackOfFreeBodies() {
    float most = 0.0;
    for (uint b = 0u; b < member.bodies.x; ++b) {
        BodyMotion motion = motionOf(b);
        if (motion.free.w != 0.0) most = max(most, slackOfFreeBody(freeSpeed(motion)));
    }
    return most;
}

/// How far a particle and a body can come nearer before the next refresh. Both may go their slack, and the body a step
/// more before it is told that it has.
float slackToBodies(vec3 at, float slack) {
    if (member.bodies.x == 0u) return slack;
    float most = slack + control.drift.y + 2.0 * motionOf(0u).way.y + (1e-7 + 2.0 * roundingAt(at));
    if ((SHAPE_KINDS & kFreeBodies) != 0u) most += slackOfFreeBodies();
    return most;
}

Two3 centreOn(uint body, uint i) {
    return toBody(motionOf(body), readState(source, kPosition, i).xyz, readState(source, kResidue, i).xyz);
}

#endif
