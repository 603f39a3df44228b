// Luding's linear, plastic and adhesive law (Granular Matter 10 (2008) 235, eqs. 4-7), as the program's own "luding".
parameter float k1, k, kc;         // stiffness of loading, of unloading at most, of adhesion [N/m]
parameter float depth;             // overlap over the radius 2 R at which unloading is stiffest
parameter float gamma;             // dashpot [kg/s]

memory float largest;              // the largest overlap, pulled back on the adhesive branch [m]

float force(Contact c) {
    float range = k - k1;
    largest = range > 0.0 ? max(largest, c.overlap) : c.overlap;
    if (range <= 0.0) return k1 * c.overlap;
    float limit = k / range * depth * (2.0 * c.radius);
    float effective = min(largest, limit);
    float k2 = k1 + range * min(1.0, largest / limit);
    float unloading = k2 * (c.overlap - effective) + k1 * effective;
    float f = c.overlap <= limit ? min(unloading, k1 * c.overlap) : unloading;
    if (f <= -kc * c.overlap) {
        f = -kc * c.overlap;
        if (k2 > k1) largest = c.overlap * (k2 + kc) / (k2 - k1);
    }
    return f;
}

float stiffness(Contact c) { return k; }

float damping(Contact c) { return gamma; }

float pull(Contact c) { return kc * c.overlap; }
