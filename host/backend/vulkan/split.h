#pragma once
// A double as two floats, as the device computes with (shaders/law/twofloat.glsl).

#include "host/core/vec.h"

namespace vkdose {

/// The unevaluated sum of two floats that is nearest to a double.
struct Split {
    float high, low;
    explicit Split(double x) {
        // GCC 12.2's vectoriser folds x - double(float(x)) to zero at -O2; through memory it cannot.
        volatile float rounded = float(x);
        high = rounded;
        low = float(x - double(high));
    }
};

struct Split3 {
    glm::vec3 high{0}, low{0};
    explicit Split3(const Vec3& v) {
        for (int i = 0; i < 3; ++i) {
            Split s(v[i]);
            high[i] = s.high;
            low[i] = s.low;
        }
    }
};

}  // namespace vkdose
