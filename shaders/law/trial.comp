#version 450
// trial: presses a contact to its deepest overlap and draws it apart, once for each loading, and writes down what a
// user's law answers. Each dispatch makes one point of every loading. Only the host's trial runs it
// (host/backend/vulkan/law_trial.cpp).
#extension GL_GOOGLE_include_directive : require
#include "law/contact.glsl"

layout(local_size_x = 1) in;

struct Loading {
    vec4 contact;  // reduced radius [m], reduced mass [kg], deepest overlap [m], speed [m/s]
    vec4 own[kOwnParameters / 4u];
    vec4 sides[2];  // their properties
};
layout(std430, binding = 0) readonly buffer LoadingBuffer { Loading loadings[]; };
// Of each point: overlap, speed, force, stiffness; damping, pull, energy, reach; flows.
layout(std430, binding = 1) writeonly buffer AnswerBuffer { vec4 answers[]; };
// Of each loading: what the law remembers from point to point.
layout(std430, binding = 2) buffer MemoryBuffer { vec4 memories[]; };
layout(push_constant) uniform PointBlock { uint number; } point;

const uint kPart = 32u;           // of a loading: pressed, drawn apart, beyond touch
const uint kPoints = 3u * kPart;  // as in law_trial.cpp

void main() {
    uint which = gl_WorkGroupID.x, k = point.number;
    ContactParams p;
    p.own = loadings[which].own;
    vec4 contact = loadings[which].contact;
    vec4 memory[2];
    memory[0] = vec4(0.0);
    memory[1] = vec4(0.0);
    userParameters(p);
    userRecall(memory);
    userSides(vec4(0.0), vec4(0.0));
    float reach = userReach(UserContact(0.0, 0.0, contact.x, 0.0));
    bool presses = k < kPart;
    float share = float(presses ? k + 1u : 2u * kPart - k) / float(kPart);
    float overlap = contact.z * share * share * share;
    if (k >= 2u * kPart) overlap = -reach * float(k - 2u * kPart) / float(kPart);
    UserContact c = UserContact(overlap, presses ? contact.w : -contact.w, contact.x, contact.y);
    memory[0] = memories[2u * which];
    memory[1] = memories[2u * which + 1u];
    userRecall(memory);
    userSides(loadings[which].sides[0], loadings[which].sides[1]);
    float force = Userforce(c);
    userKeep(memory);
    memories[2u * which] = memory[0];
    memories[2u * which + 1u] = memory[1];
    uint at = 3u * (kPoints * which + k);
    answers[at] = vec4(c.overlap, c.speed, force, Userstiffness(c));
    answers[at + 1u] = vec4(userDamping(c), userPull(c), userEnergy(c), reach);
    answers[at + 2u] = userFlows(c);
}
