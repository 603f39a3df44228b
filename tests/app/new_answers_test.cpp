// Whatever the answers to `vkdose new` are: they are refused in words of their own, or the case that follows from them
// is one that `vkdose check` takes.

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <random>

#include "geometry/flight.h"
#include "geometry/mesh_writer.h"
#include "geometry/shape.h"
#include "host/advice/advice.h"
#include "host/app/backends.h"
#include "host/app/new_design.h"
#include "host/core/error.h"
#include "tests/support/catch.h"
#include "tests/support/folder.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

class Answers {
  public:
    explicit Answers(unsigned seed) : random_(seed) {}

    NewAnswers next() {
        NewAnswers a;
        const double size = between(3e-3, 0.6);
        a.canister = {size * between(0.5, 3), size * between(0.3, 1), size * between(0.4, 3)};
        const double width = (*a.canister)[1], length = (*a.canister)[0];
        a.flatFloor = maybe(0.3);
        if (maybe(0.5)) a.outlet = width * between(0.3, 1);
        if (maybe(0.3)) a.throat = width * between(0.05, 1);
        const int coil = int(random_() % 3);
        if (coil != 1) a.pitch = width * between(0.08, 1);
        if (coil != 0) a.turns = coil == 2 ? length / *a.pitch * between(0.3, 1.2) : between(2, 20);
        if (maybe(0.3)) a.wire = width * between(0.01, 0.2);
        if (maybe(0.3)) a.clearance = width * between(0.002, 0.1);
        if (maybe(0.7)) a.bulkDensity = between(80, 2500);
        if (maybe(0.3)) a.density = a.bulkDensity.value_or(500) * between(1.5, 3);
        const double holds = a.bulkDensity.value_or(500) * length * width * (*a.canister)[2];
        if (maybe(0.5)) a.fill = holds * between(0.02, 0.9);
        if (maybe(0.5)) a.sizes = {width * between(1e-3, 0.3)};
        if (maybe(0.2)) a.sizes = {1e-4, 1e-4 * between(1.1, 3), 1e-4 * between(3.1, 9)};
        if (maybe(0.8)) a.flow = std::array{Flow::Free, Flow::Easy, Flow::Cohesive}[random_() % 3];
        if (maybe(0.3)) a.speed = between(0.3, 30);
        if (maybe(0.3))
            a.rotate = between(0.05, 30);
        else if (maybe(0.2))
            a.dose = a.fill.value_or(0.3 * holds) * between(1e-3, 0.5);
        a.doses = 1 + int(random_() % 9);
        if (maybe(0.8)) a.spheres = int(between(1, 3000));
        return a;
    }

  private:
    /// As likely in each decade.
    double between(double low, double high) {
        return low * std::pow(high / low, std::uniform_real_distribution<double>(0, 1)(random_));
    }
    bool maybe(double share) { return std::uniform_real_distribution<double>(0, 1)(random_) < share; }

    std::mt19937_64 random_;
};

/// As `vkdose new` does it.
NewDesign designed(const NewAnswers& answers, const std::filesystem::path& file) {
    NewDesign d = designOf(answers, file);
    fitContacts(d, loadResolvedCase(newCaseText(trialOf(d)), file));
    return d;
}

NewAnswers fewAndLarge(Flow flow, int spheres) {
    NewAnswers a;
    a.canister = {0.4, 0.25, 0.5};
    a.pitch = 0.2;
    a.fill = 1;
    a.bulkDensity = 2000;
    a.flow = flow;
    a.spheres = spheres;
    return a;
}

}  // namespace

TEST_CASE("new: answers are refused in words of their own, or give a case that check takes") {
    const Folder folder;
    const std::filesystem::path file = folder.path() / "my.toml";
    Answers answers(29);
    int made = 0, refused = 0, adhesive = 0;
    for (int i = 0; i < 400; ++i) {
        const NewAnswers a = answers.next();
        NewDesign d;
        try {
            d = designOf(a, file);
        } catch (const UsageError&) {
            ++refused;
            continue;
        }
        // A filling of many spheres is no other case, and takes long.
        if (d.fill.value > 2e4 * sphereMass(d.density.value, d.size.radiusMin)) continue;
        CAPTURE(i, newCaseText(d));
        std::optional<Case> c;
        try {
            fitContacts(d, caseOf(trialOf(d), file));
            c = caseOf(d, file);
        } catch (const UsageError&) {
            ++refused;
            continue;
        }
        // What is written by now must hold.
        std::string fault;
        try {
            warningsOf(*c, insertParticles(*c));
        } catch (const std::exception& e) {
            fault = e.what();
        }
        CHECK(fault == "");
        ++made;
        adhesive += d.bond > 0;
    }
    CAPTURE(made, refused, adhesive);
    CHECK(made > 100);
    CHECK(adhesive > 50);
}

TEST_CASE("new: few and large spheres have contacts so stiff that they reach their Bond number") {
    const Folder folder;
    const std::filesystem::path file = folder.path() / "my.toml";
    for (const Flow flow : {Flow::Easy, Flow::Cohesive})
        for (const int spheres : {1, 3, 10, 60, 1000}) {
            CAPTURE(int(flow), spheres);
            const NewDesign d = designed(fewAndLarge(flow, spheres), file);
            const Case c = loadResolvedCase(newCaseText(d), file);
            CHECK(d.bond == (flow == Flow::Easy ? 5 : 50));
            CHECK_THAT(c.resolved, Catch::Contains("kc_over_k = ") && !Catch::Contains("kc_over_k = 0\n"));
        }
}

TEST_CASE("new: of a mesh whose parts convey differently the pitches are told") {
    const Folder folder;
    const auto screw = [](double inner, double outer, double from, double to, int hand) {
        const double turns = 60e-3 / ((from + to) / 2);
        return geometry::tessellated(geometry::Flight{inner, outer, 0.5e-3, from, to, 2 * kPi * turns, 0, 0, hand},
                                     0.5e-3, Vec3(-1), Vec3(1));
    };
    const auto notesOf = [&](const std::vector<geometry::Triangle>& mesh) {
        folder.write("screw.stl", geometry::stlBytes(mesh, "screw", 1e-3));
        NewAnswers a;
        a.canister = {0.05, 0.025, 0.05};
        a.mesh = (folder.path() / "screw.stl").string();
        a.meshUnit = "mm";
        const NewDesign d = designOf(a, folder.path() / "my.toml");
        std::string all;
        for (const std::string& note : d.notes) all += note + "\n";
        return all + newCaseText(d);
    };
    for (const int hand : {1, -1}) {
        CAPTURE(hand);
        const std::string even = notesOf(screw(3e-3, 10e-3, 10e-3, 10e-3, hand));
        CHECK_THAT(even, Catch::Contains("conveys powder by 10 mm, as a screw") &&
                             !Catch::Contains("Its pitch changes") && !Catch::Contains("one way and others"));
        // The pitch grows by half towards the end at the outlet.
        const std::string growing = notesOf(screw(3e-3, 10e-3, 8e-3, 12e-3, hand));
        CAPTURE(growing.substr(0, 900));
        CHECK_THAT(growing, Catch::Contains("Its pitch changes: a turn conveys powder by 8") &&
                                Catch::Contains("mm at its end in the canister and by 12") &&
                                Catch::Contains("in the mean"));
        CHECK_THAT(notesOf(screw(3e-3, 10e-3, 12e-3, 8e-3, hand)), Catch::Contains("a turn conveys powder by 12"));
    }
    // A ribbon without, another of the other hand within.
    auto ribbons = screw(8e-3, 10e-3, 12e-3, 12e-3, 1);
    const auto inner = screw(3e-3, 5e-3, 8e-3, 8e-3, -1);
    ribbons.insert(ribbons.end(), inner.begin(), inner.end());
    const std::string both = notesOf(ribbons);
    CAPTURE(both.substr(0, 900));
    CHECK_THAT(both, Catch::Contains("Parts of the mesh convey") && Catch::Contains("12 mm") &&
                         Catch::Contains("8 mm") && Catch::Contains("What it doses is not foreseen"));
}
