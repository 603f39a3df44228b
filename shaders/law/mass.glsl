// Masses of spheres.
#ifndef VKDOSE_LAW_MASS_GLSL
#define VKDOSE_LAW_MASS_GLSL

/// Mass of a sphere of this radius, and reduced mass of two masses [kg].
float sphereMass(float density, float r) { return density * (4.0 / 3.0 * 3.14159265358979) * r * r * r; }
float reducedMass(float a, float b) { return a * b / (a + b); }

#endif
