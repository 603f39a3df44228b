#pragma once
// Laws with a fault, and what is said of them.

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "host/backend/vulkan/law_trial.h"
#include "host/model/case.h"
#include "tests/support/folder.h"
#include "tests/support/gpu.h"

namespace vkdose::test {

struct Broken {
    const char* name;
    std::string text;
    int line;
    const char* reason;  ///< words of the message
};

/// A law that is right but for a line in its force, the fourth of the file.
inline std::string inForce(const std::string& line) {
    return "parameter float k;\nfloat stiffness(Contact c) { return k; }\nfloat force(Contact c) {\n" + line +
           "\nreturn k * c.overlap;\n}\n";
}

/// The same but for a declaration, the second line of the file.
inline std::string atTop(const std::string& line) {
    return "parameter float k;\n" + line +
           "\nfloat stiffness(Contact c) { return k; }\nfloat force(Contact c) { return k * c.overlap; }\n";
}

/// The same but for what a function returns, in the second line.
inline std::string answers(const std::string& function, const std::string& value) {
    std::string text = "parameter float k;\n";
    text += fmt::format("float {}(Contact c) {{ return {}; }}\n", function, value);
    for (const char* other : {"stiffness", "force"})
        if (function != other) text += fmt::format("float {}(Contact c) {{ return k; }}\n", other);
    return text;
}

inline std::string repeated(const std::string& text, int times) {
    std::string all;
    for (int k = 0; k < times; ++k) all += text;
    return all;
}

/// Loads a case with this law in a file of its own.
inline void loadWith(const Folder& folder, const std::string& law) {
    const auto write = [&](const char* name, const std::string& text) {
        std::ofstream(folder.path() / name, std::ios::binary) << text;
    };
    write("broken.glsl", law);
    write("two.csv", "x,y,z,r\n0,0,0,1e-3\n2.1e-3,0,0,1e-3\n");
    write("broken.toml",
          "boundaries = \"none\"\n[particles]\ndensity = 2500.0\nlist = \"two.csv\"\n[contact]\nlaw = \"broken.glsl\"\n"
          "friction = 0.3\n[contact.parameters]\nk = 1000.0\n[settle]\ntime_s = 0.001\n");
    tryLawsOnDevices();
    loadCase(folder.path() / "broken.toml");
}

inline void refuseAll(const std::vector<Broken>& laws) {
    const Folder folder;
    for (const Broken& law : laws) {
        CAPTURE(law.name, law.text);
        try {
            loadWith(folder, law.text);
            FAIL_CHECK("it is not refused");
        } catch (const CaseError& error) {
            const Diagnostic& first = error.faults().front();
            CAPTURE(error.what());
            CHECK(std::filesystem::path(first.file).filename() == "broken.glsl");
            CHECK(first.line == law.line);
            CHECK_THAT(first.problem, Catch::Contains(law.reason));
        }
    }
}

}  // namespace vkdose::test
