#pragma once
// Case files that a test writes and breaks.

#include <array>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "host/core/error.h"
#include "host/model/case.h"
#include "tests/support/folder.h"

namespace vkdose::test {

inline std::filesystem::path shippedCase(const std::string& name) {
    return std::filesystem::path(VKDOSE_SOURCE_DIR) / "cases" / name;
}

/// Every case of the folders that hold nothing but cases.
inline std::vector<std::filesystem::path> shippedCases() {
    std::vector<std::filesystem::path> all;
    for (const char* folder : {"", "devices"})
        for (const auto& entry : std::filesystem::directory_iterator(shippedCase(folder)))
            if (entry.path().extension() == ".toml" && entry.path().filename() != "queue.toml")
                all.push_back(entry.path());
    return all;
}

/// The parameters of the pairs of a case with one powder.
inline std::array<ContactParameters, kContactClasses> classesOf(const ContactLaw& law) {
    return {law.between(0, 0), law.between(0, 1), law.between(0, 2)};
}

/// A valid small case; the tests break one thing of it at a time.
inline const std::string kGoodCase = R"(name = "good"
seed = 3
boundaries = "canister"
[particles]
density = 1427.0
mass_g = 0.9
[particles.size]
distribution = "uniform"
radius_min_mm = 0.9
radius_max_mm = 1.3
[contact]
k = 2000.0
k1_over_k = 0.2
kc_over_k = 0.5
plasticity_depth = 0.05
damping = 0.02
friction = 0.5
rolling_friction = 0.2
[contact.wall]
friction = 0.2
[canister]
length_mm = 16.0
width_mm = 14.0
height_mm = 60.0
outlet_diameter_mm = 14.0
throat_length_mm = 5.0
[coil]
turns = 3
length_mm = 21.0
wire_diameter_mm = 1.6
radius_mm = 5.9
speed_rpm = 120.0
[settle]
time_s = 0.15
[dose]
rotate_s = 0.3
rest_s = 0.1
[stop]
rule = "experiment"
)";

/// A second powder for it.
inline const std::string kSugar = R"([[powder]]
name = "sugar"
density = 1590.0
mass_g = 0.4
[powder.size]
distribution = "fixed"
radius_mm = 1.0
)";

/// Two particles and nothing else.
inline const std::string kFreeCase = R"(boundaries = "none"
gravity = [0, 0, 0]
[particles]
density = 1427.0
list = "two.csv"
[contact]
k = 24067.0
k1_over_k = 0.2
kc_over_k = 0.0
plasticity_depth = 0.05
damping = 0.0827
friction = 0.5
[settle]
time_s = 0.01
)";

/// A case with a few spheres around (0, 30 mm, 0), and these tables: its bodies and what else the test is about.
inline std::string withBodies(const std::string& tables) {
    return R"(boundaries = "none"
[particles]
density = 1427.0
mass_g = 0.2
[particles.size]
distribution = "fixed"
radius_mm = 1.25
[particles.region]
low = [-0.008, 0.022, -0.008]
high = [0.008, 0.038, 0.008]
[contact]
k = 2000.0
k1_over_k = 0.2
kc_over_k = 0.5
plasticity_depth = 0.05
damping = 0.02
friction = 0.5
[settle]
time_s = 0.1
)" + tables;
}

/// The case that a file with this text holds.
inline Case loadText(const std::string& text, const std::vector<std::string>& overrides = {}) {
    const Folder folder;
    return loadCase(folder.write("case.toml", text), overrides);
}

/// What is wrong with the case in this file, as it is told; "no fault" if it loads.
inline std::string faultOf(const std::filesystem::path& file) {
    try {
        (void)loadCase(file);
    } catch (const CaseError& e) {
        return e.what();
    }
    return "no fault";
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    if (at == std::string::npos) throw std::logic_error("nothing to replace: " + from);
    return text.replace(at, from.size(), to);
}

}  // namespace vkdose::test
