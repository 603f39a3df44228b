// Slack: the distance that a particle, or a body, may go before the contact lists are made anew.
// It grows with the speed. One slack for all is worse: in a canister being emptied, the particles that fall from the
// outlet ask for new lists every 30 steps, and the bed at rest lists twice as many contacts as touch.
#ifndef VKDOSE_PASS_SLACK_GLSL
#define VKDOSE_PASS_SLACK_GLSL

#include "law/precise.glsl"

float slackUnit() { return 0.5 * numerics().y; }

/// What a particle there adds to the distance at which it is near, because lists are made from the high parts of
/// positions alone, while contacts are computed from both parts [m]. The low part is at most 2^-24 of the largest
/// coordinate in each direction.
float roundingAt(vec3 at) {
    precise float most = 1.1e-7 * max(abs(at.x), max(abs(at.y), abs(at.z)));
    if (PERIODS == 1u) {  // an image is rounded as well
        vec3 lengths = period().high;
        most += 1.1e-7 * max(lengths.x, max(lengths.y, lengths.z));
    }
    return most;
}

/// The same bits in every pass that asks, so `precise`: `move` holds a particle to the slack that `near` listed its
/// contacts for.
float slackOf(vec3 velocity) {
    precise float some = kSlackSteps * numerics().x * sqrt(preciseDot(velocity, velocity));
    precise float all = kLeastSlack * slackUnit() + some;
    return min(all, kMostSlack * slackUnit());
}

/// Of a body whose points go at most `way` in a step [m].
float bodySlack(float way) {
    return clamp(kSlackSteps * way, kLeastBodySlack * slackUnit(), kMostBodySlack * slackUnit());
}

/// `speed`: freeSpeed [m/s].
float slackOfFreeBody(float speed) { return bodySlack(numerics().x * speed); }

#endif
