#version 450
// trial: presses a contact to its deepest overlap and draws it apart, once for each loading, and writes down what a
// user's law answers. Only the host's trial runs it (host/backend/vulkan/law_trial.cpp).
#extension GL_GOOGLE_include_directive : require
#include "law/contact.glsl"

layout(local_size_x = 1) in;

struct Loading {
    vec4 contact;  // reduced radius [m], reduced mass [kg], deepest overlap [m], speed [m/s]
    vec4 own[kOwnParameters / 4u];
};
layout(std430, binding = 0) readonly buffer LoadingBuffer { Loading loadings[]; };
// Of each point: overlap, speed, force, stiffness; damping, pull, energy, 0.
layout(std430, binding = 1) writeonly buffer AnswerBuffer { vec4 answers[]; };

const uint kPoints = 64u;  // as in law_trial.cpp

void main() {
    uint which = gl_WorkGroupID.x;
    ContactParams p;
    p.own = loadings[which].own;
    vec4 contact = loadings[which].contact;
    vec4 memory[2];
    memory[0] = vec4(0.0);
    memory[1] = vec4(0.0);
    for (uint k = 0u; k < kPoints; ++k) {
        bool presses = k < kPoints / 2u;
        float share = float(presses ? k + 1u : kPoints - k) / float(kPoints / 2u);
        UserContact c = UserContact(contact.z * share * share * share, presses ? contact.w : -contact.w, contact.x,
                                    contact.y);
        userLoad(p, memory);
        float force = Userforce(c);
        userKeep(memory);
        uint at = 2u * (kPoints * which + k);
        answers[at] = vec4(c.overlap, c.speed, force, Userstiffness(c));
        answers[at + 1u] = vec4(userDamping(c), userPull(c), userEnergy(c), 0.0);
    }
}
