// Hundreds of broken case files, made from the shipped ones with a fixed seed. Those certainly wrong must be refused
// with a message that names the culprit; those that may still be valid must be refused clearly or load, and what loads
// must load again from its own resolved form.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <set>

#include "tests/model/case_breaker.h"
#include "tests/model/case_files.h"
#include "tests/model/mutants.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

std::string textOf(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

/// Free boundaries and every kind of value a case can have.
const std::string kListed = R"(name = "listed"
boundaries = "list"
gravity = [0.0, -9.81, 0.0]
[particles]
density = 1427.0
mass_g = 0.1
[particles.size]
distribution = "normal"
radius_mean_mm = 1.0
radius_deviation_mm = 0.1
[particles.region]
low = [-0.01, 0.0, -0.01]
high = [0.01, 0.05, 0.01]
[contact]
k = 2000.0
k1_over_k = 0.2
kc_over_k = 0.5
plasticity_depth = 0.05
damping = 0.02
friction = 0.5
[[plane]]
point = [0.0, -0.001, 0.0]
normal = [0.0, 1.0, 0.0]
[[cylinder]]
base = [0.0, 0.0, 0.0]
axis = [0.0, 1.0, 0.0]
radius_mm = 30.0
inside = true
[settle]
time_s = 0.1
[frames]
interval_s = 0.02
contacts = true
[[field]]
name = "map"
kernel = "lucy"
cells = [1, 20, 8]
interval_s = 0.05
average = false
low = [-0.01, 0.0, -0.01]
high = [0.01, 0.05, 0.01]
[domain]
low = [-0.1, -0.1, -0.1]
high = [0.1, 0.1, 0.1]
)";

/// Refused with a CaseError whose faults are clear, one of them naming the culprit at its line.
void checkRefused(const Folder& folder, const Mutant& m) {
    const auto file = folder.write("mutant.toml", m.text);
    const std::vector<std::string> lines = linesOf(m.text);
    const auto blamed = static_cast<std::size_t>(std::max(m.line, 1)) - 1;
    INFO(m.kind << "; blames line " << m.line << ", \"" << m.culprit << "\"");
    INFO((blamed < lines.size() ? lines[blamed].substr(0, 200) : ""));
    std::vector<Diagnostic> faults;
    try {
        loadCase(file);
    } catch (const CaseError& error) {
        faults = error.faults();
    } catch (const std::exception& error) {
        FAIL_CHECK("not a fault of the case but: " << error.what());
        return;
    }
    if (faults.empty()) {
        FAIL_CHECK("was accepted");
        return;
    }
    INFO(CaseError(faults).what());
    for (const Diagnostic& fault : faults) CHECK(unclear(fault) == "");
    const bool named = std::any_of(faults.begin(), faults.end(), [&](const Diagnostic& f) {
        return f.file == file.string() && (m.line == 0 || f.line == m.line) &&
               f.text().find(m.culprit) != std::string::npos;
    });
    CHECK(named);
}

}  // namespace

TEST_CASE("hundreds of case files that are certainly wrong are refused, each with its culprit") {
    const Folder folder;
    std::size_t count = 0;
    std::set<std::string> kinds;
    std::uint32_t seed = 1;
    for (const std::string& text :
         {textOf(shippedCase("mini.toml")), textOf(shippedCase("quickstart.toml")),
          textOf(shippedCase("paper-48g.toml")), kListed, textOf(shippedCase("mixture.toml"))}) {
        for (const Mutant& m : Breaker(text, seed++).all()) {
            checkRefused(folder, m);
            kinds.insert(m.kind);
            ++count;
        }
    }
    CHECK(count >= 500);
    CHECK(kinds.size() >= 25);
}

TEST_CASE("the files the mutants are made from are good") {
    const Folder folder;
    CHECK_NOTHROW(loadCase(folder.write("listed.toml", kListed)));
}

TEST_CASE("texts that are hardly a case at all are refused") {
    const Folder folder;
    const auto repeated = [](const std::string& what, std::size_t n) {
        std::string text;
        for (std::size_t i = 0; i < n; ++i) text += what;
        return text;
    };
    for (const Mutant& m : std::vector<Mutant>{
             {"a key of a hundred thousand parts", repeated("a.", 100000) + "a = 1\n", "", 1},
             {"a header of a hundred thousand parts", "[" + repeated("a.", 100000) + "a]\n", "", 1},
             {"arrays in arrays", "seed = " + repeated("[", 100000) + repeated("]", 100000) + "\n", "", 1},
             {"tables in tables", "seed = " + repeated("{a=", 5000) + "1" + repeated("}", 5000) + "\n", "", 1},
             {"dotted tables in tables", "seed = " + repeated("{a.a.a.a.a.a=", 200) + "1" + repeated("}", 200) + "\n",
              "", 1},
             {"a long key", std::string(100000, 'k') + " = 1\n", "", 1},
             {"a long value", "seed = \"" + std::string(100000, 'v') + "\"\n", "seed", 1},
             {"a thousand unknown keys in a table",
              "[contact]\n" +
                  [] {
                      std::string text;
                      for (int i = 0; i < 1000; ++i) text += "q" + std::to_string(i) + " = 1\n";
                      return text;
                  }(),
              "q7", 0},
             {"megabytes", repeated("# not a case\n", 200000), "", 0},
             {"nothing", "", "particles", 0},
             {"a comment", "# nothing\n", "particles", 0},
         })
        checkRefused(folder, m);
}

TEST_CASE(
    "files that may still be valid load or are refused clearly, and what loads can be resolved and loaded again") {
    const Folder folder;
    const std::vector<std::string> texts{textOf(shippedCase("mini.toml")), kListed};
    Choice choice(20);
    std::size_t loaded = 0;
    const auto mutate = [&](std::string text) {
        const std::vector<std::string> lines = linesOf(text);
        std::vector<std::string> other = lines;
        const std::size_t a = choice.below(lines.size()), b = choice.below(lines.size());
        switch (choice.below(6)) {
            case 0:
                text[choice.below(text.size())] ^= static_cast<char>(1u << choice.below(8));
                return text;
            case 1:
                other.erase(other.begin() + static_cast<std::ptrdiff_t>(a));
                return joined(other);
            case 2:
                std::swap(other[a], other[b]);
                return joined(other);
            case 3:
                other.insert(other.begin() + static_cast<std::ptrdiff_t>(a), lines[b]);
                return joined(other);
            case 4: {
                const std::size_t at = text.find_first_of("0123456789", choice.below(text.size()));
                if (at != std::string::npos) text[at] = static_cast<char>('0' + choice.below(10));
                return text;
            }
            default:
                return text.substr(0, choice.below(text.size()));
        }
    };
    for (int n = 0; n < 600; ++n) {
        std::string text = choice.of(texts);
        for (std::size_t times = 1 + choice.below(3); times > 0 && !text.empty(); --times) text = mutate(text);
        INFO(text);
        std::string resolved;
        try {
            resolved = loadCase(folder.write("case.toml", text)).resolved;
        } catch (const CaseError& error) {
            for (const Diagnostic& fault : error.faults()) CHECK(unclear(fault) == "");
            continue;
        }
        ++loaded;
        INFO(resolved);
        REQUIRE_NOTHROW(loadCase(folder.write("resolved.toml", resolved)));
        CHECK(loadCase(folder.path() / "resolved.toml").resolved == resolved);
    }
    CHECK(loaded >= 50);
}
