// The properties of particles, which a user's law declares by `particle float`: they are read for the law where two
// sides meet, and what flows between them is written for `move`. Without properties nothing is done.
#ifndef VKDOSE_PASS_SIDES_GLSL
#define VKDOSE_PASS_SIDES_GLSL

#ifdef OWN_PROPERTIES
void meetParticles(uint i, uint j) {
    propertiesOfI = forcesAt(propertyIndex(i, 0u));
    propertiesOfJ = forcesAt(propertyIndex(j, 0u));
}
void meetMaterial(uint i, uint material) {
    propertiesOfI = forcesAt(propertyIndex(i, 0u));
    propertiesOfJ = OF_MEMBER(properties[material], kVectorProperties + material);
}
vec4 flowNow() { return userFlow; }
void writeFlow(uint slot, vec4 flow) { forces[flowIndex(slot)] = flow; }
#else
void meetParticles(uint i, uint j) {}
void meetMaterial(uint i, uint material) {}
vec4 flowNow() { return vec4(0.0); }
void writeFlow(uint slot, vec4 flow) {}
#endif

#endif
