// Elastic spheres (Hertz 1882, Mindlin 1949), damped as by Tsuji (1992), as the program's own "hertz-mindlin".
parameter float modulus_Pa;        // E*, effective Young's modulus of the two bodies
parameter float damping_ratio;     // 2 sqrt(5/6) beta, with beta = -ln e / sqrt(pi^2 + ln^2 e) of the restitution e

memory float k;                    // stiffness at this overlap [N/m], which force leaves to the other functions

float force(Contact c) {
    k = 2.0 * modulus_Pa * sqrt(c.radius * c.overlap);
    return 2.0 / 3.0 * k * c.overlap;
}

float stiffness(Contact c) { return k; }

float damping(Contact c) { return damping_ratio * sqrt(k * c.mass); }

float energy(Contact c) { return 4.0 / 15.0 * k * c.overlap * c.overlap; }
