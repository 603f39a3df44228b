// Masses of spheres.
#ifndef VKDOSE_LAW_MASS_GLSL
#define VKDOSE_LAW_MASS_GLSL

/// Mass of a sphere of this radius [kg], and reduced mass of two.
float sphereMass(float density, float r) { return density * (4.0 / 3.0 * 3.14159265358979) * r * r * r; }
float reducedMass(float density, float a, float b) {
    float ma = sphereMass(density, a), mb = sphereMass(density, b);
    return ma * mb / (ma + mb);
}

#endif
