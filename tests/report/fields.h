#pragma once
// Fields of a run made by hand.

#include "host/output/field_files.h"
#include "tests/app/sandbox.h"

namespace vkdose::test {

/// cases/mini.toml with a plane of 4 cells along z and 3 along y, and what else is asked for.
inline Case caseWithFields(bool stress, bool profile = false) {
    Case c = loadCase(VKDOSE_SOURCE_DIR "/cases/mini.toml");
    FieldSensor s;
    s.name = "plane";
    s.request.grid = {Vec3(-1e-3, -7e-3, 0), Vec3(1e-3, 5e-3, 16e-3), {1, 3, 4}};
    s.request.width = 2e-3;
    s.stress = stress;
    c.fields.push_back(s);
    if (!profile) return c;
    s.name = "heights";
    s.preset = FieldSensor::Preset::HeightProfile;
    s.request.grid.cells = {1, 1, 4};
    c.fields.push_back(s);
    return c;
}

/// Of a plane's point: denser upwards, faster along z; a cell without powder at the rear and top.
inline FieldPoint pointAt(std::size_t y, std::size_t z, double speed) {
    FieldPoint p;
    if (y == 2 && z == 0) return p;
    p.density = 100 * double(y + 1);
    p.number = 1;
    p.touches = double(z);
    p.momentum = p.density * Vec3(9, -speed * double(y), speed * double(z));
    p.contactStress = {Vec3(10 * double(z), 99, 99), Vec3(99, 20 * double(z), 99), Vec3(99, 99, -3 * double(z))};
    return p;
}

inline FieldSample sampleOf(int number, int dose, double speed) {
    FieldSample f;
    f.number = number;
    f.time = 0.1 * (number + 1);
    f.phase = dose == 0 ? Phase::Settle : Phase::Rotate;
    f.dose = dose;
    for (std::size_t z = 0; z < 4; ++z)
        for (std::size_t y = 0; y < 3; ++y) f.points.push_back(pointAt(y, z, speed));
    return f;
}

/// The first map while the powder falls, ten times as fast as ever later.
inline void writeMaps(const Sandbox& box, const Case& c, int maps) {
    FieldFiles files(box / "run", c);
    for (int n = 0; n < maps; ++n) files.write(sampleOf(n, n, n == 0 ? 1.0 : 0.1));
}

}  // namespace vkdose::test
