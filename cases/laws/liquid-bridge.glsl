// Elastic wet spheres. Each contact has a bridge of liquid, which comes about at touch and holds until it ruptures.
// Force: Willett, Adams, Johnson and Seville, Langmuir 16 (2000) 9396, their closed form for equal spheres.
// Rupture: Lian, Thornton and Adams, Journal of Colloid and Interface Science 161 (1993) 138.
parameter float stiffness_N_m, damping_kg_s;                 // of touching spheres: spring and dashpot
parameter float surface_tension_N_m, contact_angle_rad;      // of the liquid
parameter float bridge_volume_m3;                            // of liquid in one bridge

const float kPi = 3.14159265;

// Pull of the bridge [N].
float bridge(Contact c) {
    float r = 2.0 * c.radius;                                // of equal spheres their own
    float gap = max(-c.overlap, 0.0) * sqrt(r / bridge_volume_m3);
    return 2.0 * kPi * r * surface_tension_N_m * cos(contact_angle_rad) / (1.0 + 1.05 * gap + 2.5 * gap * gap);
}

float force(Contact c) { return stiffness_N_m * max(c.overlap, 0.0) - bridge(c); }

float stiffness(Contact c) { return stiffness_N_m; }

float damping(Contact c) { return c.overlap > 0.0 ? damping_kg_s : 0.0; }

float pull(Contact c) { return bridge(c); }

float reach(Contact c) { return (1.0 + 0.5 * contact_angle_rad) * pow(bridge_volume_m3, 1.0 / 3.0); }
