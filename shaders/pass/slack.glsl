// Slack: how far a particle may move from where it was when the contact lists were made, and the wire of the coil,
// before they are made anew. A slack in proportion to the speed, not one for all: in a canister being emptied what
// falls from the outlet asks for new lists every 30 steps if all must share its slack, and the bed at rest then lists
// twice what touches.
#ifndef VKDOSE_PASS_SLACK_GLSL
#define VKDOSE_PASS_SLACK_GLSL

float slackUnit() { return 0.5 * numerics().y; }

float slackOf(vec3 velocity) {
    float some = kSlackSteps * numerics().x * length(velocity);
    return min(kLeastSlack * slackUnit() + some, kMostSlack * slackUnit());
}

float coilSlack() { return kCoilSlack * slackUnit(); }

#endif
