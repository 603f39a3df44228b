// `vkdose run --from`: doses from another run's powder. `vkdose resume --set`: a run that stopped at an overlap.

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "host/output/checkpoint.h"
#include "tests/app/sandbox.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;
namespace fs = std::filesystem;

namespace {

const std::string kMini = "'" VKDOSE_SOURCE_DIR "/cases/mini.toml' ";
/// A few particles come out in each of two doses.
const std::string kShort =
    "--quiet --set settle.time_s=0.05 --set coil.speed_rpm=400 --set dose.rotate_s=0.06 --set dose.rest_s=0.02 "
    "--set stop.max_doses=2 --set sensors.interval_s=0.003 ";

std::vector<std::string> lines(const fs::path& file) {
    std::vector<std::string> all;
    std::string text = readText(file);
    for (std::size_t end = 0; (end = text.find('\n')) != std::string::npos; text.erase(0, end + 1))
        all.push_back(text.substr(0, end));
    return all;
}

nlohmann::json summary(const fs::path& folder) {
    return nlohmann::json::parse(readText(folder / "summary.json"));
}

}  // namespace

TEST_CASE("from a settled bed the same case gives the same doses, and goes on without the other run") {
    const std::string backend = GENERATE(as<std::string>{}, "--backend reference ", "");
    CAPTURE(backend);
    const Sandbox box;
    REQUIRE(box.vkdose("run " + kMini + kShort + backend + "--out a").code == 0);
    REQUIRE(fs::exists(box / "a" / kSettledName));
    REQUIRE(fs::exists(box / "a" / kEndName));
    const auto o = box.vkdose("run --from a --out b");
    CAPTURE(o.out, o.err);
    REQUIRE(o.code == 0);
    CHECK_THAT(o.out, Catch::Contains("from     the settled bed of a, at t = 0.05"));
    CHECK(readText(box / "b/case.toml") == readText(box / "a/case.toml"));
    CHECK(readText(box / "b/doses.csv") == readText(box / "a/doses.csv"));
    CHECK(readText(box / "b/particles.csv") == readText(box / "a/particles.csv"));
    // Lines of the doses are the same; that of the settled bed stands in front.
    const std::vector<std::string> whole = lines(box / "a/timeseries.csv"), after = lines(box / "b/timeseries.csv");
    REQUIRE(after.size() > 20);
    REQUIRE(whole.size() > after.size());
    CHECK(std::equal(after.begin() + 1, after.end(), whole.end() - std::ptrdiff_t(after.size() - 1)));
    const nlohmann::json a = summary(box / "a"), b = summary(box / "b");
    CHECK(a["doses"][1]["mass_kg"] > 0);
    CHECK(b["from"] == "the settled bed of a, at t = 0.0500004 s");
    CHECK_FALSE(a.contains("from"));
    for (const char* part : {"settling", "settled", "doses", "analysis", "dosed_while_settling_kg", "closed_form"}) {
        CAPTURE(part);
        CHECK(a[part] == b[part]);
    }
    // The folder of the new run stands alone: cut short, it goes on, and its bed serves others.
    fs::remove_all(box / "a");
    REQUIRE(box.vkdose("run --from b --quiet --out c").code == 0);
    CHECK(readText(box / "c/doses.csv") == readText(box / "b/doses.csv"));
    CHECK(readText(box / "c/timeseries.csv") == readText(box / "b/timeseries.csv"));
}

TEST_CASE("a run begins with any frame that keeps its state") {
    const std::string backend = GENERATE(as<std::string>{}, "--backend reference ", "");
    CAPTURE(backend);
    const Sandbox box;
    REQUIRE(
        box.vkdose("run " + kMini + kShort + backend + "--set frames.interval_s=0.015 --set frames.states=true --out a")
            .code == 0);
    CHECK(fs::exists(box / "a/frames/state_000001.h5"));
    // That at the end of settling is the settled bed.
    REQUIRE(box.vkdose("run --from a --at 0.05 --quiet --set frames.interval_s=0 --out settled").code == 0);
    CHECK(readText(box / "settled/doses.csv") == readText(box / "a/doses.csv"));
    CHECK(readText(box / "settled/particles.csv") == readText(box / "a/particles.csv"));

    // In the middle of a dose: the first line of the new run is that of the frame, and then dose 1 begins.
    const auto o = box.vkdose("run --from a --at 0.081 --out middle");
    CAPTURE(o.out, o.err);
    REQUIRE(o.code == 0);
    CHECK_THAT(o.out, Catch::Contains("of a, at t = 0.0") && Catch::Contains("from     frame "));
    const auto fields = [](const std::string& line, std::size_t from, std::size_t to) {
        std::istringstream stream(line);
        std::string found, field;
        for (std::size_t i = 0; std::getline(stream, field, ','); ++i)
            if (i == 0 || (i >= from && i < to)) found += field + ",";
        return found;
    };
    // Time, masses, numbers and energies.
    const std::string begin = fields(lines(box / "middle/timeseries.csv").at(1), 5, 14);
    std::vector<std::string> before;
    for (const std::string& line : lines(box / "a/timeseries.csv")) before.push_back(fields(line, 5, 14));
    CHECK(std::count(before.begin(), before.end(), begin) == 1);
    CHECK(summary(box / "middle")["doses"][0]["dose"] == 1);
    CHECK(summary(box / "middle")["doses"].size() == 2);

    CHECK_THAT(box.vkdose("run --from settled --at 0.08 --out b").err, Catch::Contains("frames.states = true"));
    CHECK_THAT(box.vkdose("run --from a --at midle --out b").err, Catch::Contains("--at midle is no state"));
    // A new run in the folder removes them.
    REQUIRE(box.vkdose("run " + kMini + kShort + backend + "--force --out a").code == 0);
    CHECK_FALSE(fs::exists(box / "a/frames"));
}

TEST_CASE("a run from another's bed that is cut short goes on to the same files") {
    const Sandbox box;
    REQUIRE(box.vkdose("run " + kMini + kShort + "--backend reference --out a").code == 0);
    const std::string from = "run --from a --quiet --set frames.interval_s=0.01 --set checkpoint.time_s=0.006 ";
    REQUIRE(box.vkdose(from + "--out whole").code == 0);
    const pid_t child = box.start({"run", "--from", "a", "--quiet", "--set", "frames.interval_s=0.01", "--set",
                                   "checkpoint.time_s=0.006", "--out", "cut"});
    while (!fs::exists(box / "cut" / kCheckpointName)) {
        if (waitpid(child, nullptr, WNOHANG) == child) FAIL("the run ended before it could be killed");
        usleep(1000);
    }
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    fs::remove_all(box / "a");
    REQUIRE(box.vkdose("resume cut --quiet").code == 0);
    for (const char* name : {"case.toml", "timeseries.csv", "doses.csv", "particles.csv", "frames/frames.csv",
                             "frames/particles_000000.hdf", "frames/particles_000005.hdf"}) {
        CAPTURE(name);
        REQUIRE(fs::exists(box / "whole" / name));
        CHECK(readText(box / "cut" / name) == readText(box / "whole" / name));
    }
    CHECK(summary(box / "cut")["from"] == summary(box / "whole")["from"]);
}

TEST_CASE("another adhesion, speed and time of a dose begin with one bed, as the case would say them") {
    const Sandbox box;
    REQUIRE(box.vkdose("run " + kMini + kShort + "--backend reference --out a").code == 0);
    const std::string set = "--set contact.kc_over_k=0.9 --set coil.speed_rpm=300 --set dose.rotate_s=0.05 ";
    REQUIRE(box.vkdose("run --from a --quiet --out b " + set).code == 0);
    // Had the powder settled for these doses, it would lie the same.
    REQUIRE(box.vkdose("run " + kMini + kShort + set + "--backend reference --out c").code == 0);
    CHECK(readText(box / "b/case.toml") == readText(box / "c/case.toml"));
    CHECK(readText(box / "b/doses.csv") == readText(box / "c/doses.csv"));
    CHECK(readText(box / "b/doses.csv") != readText(box / "a/doses.csv"));
    const nlohmann::json b = summary(box / "b"), c = summary(box / "c");
    CHECK(b["settled"] == c["settled"]);  // its adhesion is that of the doses
    CHECK(b["settled"] != summary(box / "a")["settled"]);
    // The end of the other run, and a case named beside it.
    const auto end = box.vkdose("run " + kMini + kShort + "--from a --at end --out d");
    CAPTURE(end.err);
    REQUIRE(end.code == 0);
    const nlohmann::json d = summary(box / "d");
    CHECK(d["doses"].size() == 2);
    CHECK(d["doses"][0]["start_time_s"] == summary(box / "a")["simulated_time_s"]);
    CHECK(d["dosed_while_settling_kg"] == summary(box / "a")["ledger"]["dosed_mass_kg"]);
}

TEST_CASE("with regions and a second powder the doses from a settled bed are those of the other run") {
    const Sandbox box;
    const auto mixture = [](const char* density) {
        return "base = \"" VKDOSE_SOURCE_DIR "/cases/mini.toml\"\n[[powder]]\nname = \"sugar\"\ndensity = " +
               std::string(density) +
               "\nmass_g = 0.2\n[powder.size]\ndistribution = \"fixed\"\nradius_mm = 0.8\n"
               "[[region]]\nname = \"low\"\nkind = \"beyond\"\npoint = [0, 0, 0]\nnormal = [0, -1, 0]\ndeletes = "
               "false\n";
    };
    box.write("two.toml", mixture("1590"));
    const auto first = box.vkdose("run two.toml " + kShort + "--backend reference --out a");
    CAPTURE(first.out, first.err);
    REQUIRE(first.code == 0);
    REQUIRE(box.vkdose("run --from a --out b").code == 0);
    CHECK(readText(box / "b/doses.csv") == readText(box / "a/doses.csv"));
    CHECK(box.vkdose("report b").code == 0);  // it reads every line of the time series
    box.write("two.toml", mixture("1591"));
    const auto other = box.vkdose("run two.toml " + kShort + "--from a --out c");
    CHECK(other.code == 2);
    CHECK_THAT(other.err, Catch::Contains("powder[0].density = 1591: is 1590"));
}

TEST_CASE("powder that does not fit is refused by key, with both values, and nothing is written") {
    const Sandbox box;
    REQUIRE(box.vkdose("run " + kMini + kShort + "--backend reference --out a").code == 0);
    const auto refused = [&](const std::string& arguments) {
        const auto o = box.vkdose("run --from a --out b " + arguments);
        CAPTURE(arguments, o.out);
        CHECK(o.code == 2);
        CHECK_FALSE(fs::exists(box / "b"));
        return o.err;
    };
    CHECK_THAT(refused("--set coil.wire_diameter_mm=1.5 --set canister.lid=true"),
               Catch::Contains("coil.wire_diameter_mm = 1.5: is 1.6 in the run of a") &&
                   Catch::Contains("canister.lid = true: is false") && Catch::Contains("without --from"));
    CHECK_THAT(refused("--set seed=2"), Catch::Contains("seed = 2: is 1 in the run of a"));
    CHECK_THAT(refused("--set particles.mass_g=0.8"), Catch::Contains("particles.mass_g = 0.8: is 0.9"));
    CHECK_THAT(refused("--set particles.density=1500"), Catch::Contains("particles.density = 1500: is 1427"));
    CHECK_THAT(refused("--set sensors.energy=true"), Catch::Contains("sensors.energy = true: is false"));
    // What a contact remembers means something else under another law.
    std::string elastic = readText(VKDOSE_SOURCE_DIR "/cases/mini.toml");
    const std::size_t contact = elastic.find("[contact]"), wall = elastic.find("[contact.wall]");
    elastic.replace(contact, wall - contact,
                    "[contact]\nlaw = \"hertz-mindlin\"\nyoungs_modulus = 1e6\npoisson_ratio = 0.3\nrestitution = 0.5\n"
                    "friction = 0.5\n");
    elastic.erase(elastic.find("kc_over_k"), std::string("kc_over_k = 0.2").size());
    box.write("elastic.toml", elastic);
    CHECK_THAT(refused("elastic.toml"),
               Catch::Contains("contact.law = \"hertz-mindlin\": is \"luding\" in the run of a"));
    CHECK_THAT(refused("--set stop.end_time_s=0.04"),
               Catch::Contains("stop.end_time_s") && Catch::Contains("t = 0.05"));
    CHECK_THAT(refused("--at checkpoint"),
               Catch::Contains("a/checkpoint.h5 is not there; the run has --at settled, --at end"));
    CHECK_THAT(refused("--backend reference"), Catch::Contains("--from"));
    CHECK_THAT(box.vkdose("run --from nowhere --out b").err, Catch::Contains("no run of vkdose"));
    CHECK_THAT(box.vkdose("run").err, Catch::Contains("a case is missing"));
    const auto itself = box.vkdose("run --from a --out a --force");
    CHECK(itself.code == 2);
    CHECK_THAT(itself.err, Catch::Contains("choose another folder with --out"));
    CHECK(fs::exists(box / "a" / kSettledName));
    // A foreign file in the place of the state.
    box.write("a/settled.h5", "nothing");
    CHECK_THAT(box.vkdose("run --from a --out b").err, Catch::Contains("settled.h5 is not a checkpoint"));
    // A new run in its place takes the old run's states away.
    box.write("a/settled.h5", "stale");
    REQUIRE(box.vkdose("run " + kMini +
                       "--quiet --set settle.time_s=0.02 --set dose.rotate_s=0 --set dose.rest_s=0 "
                       "--set stop.rule=none --backend reference --force --out a")
                .code == 0);
    CHECK_FALSE(fs::exists(box / "a" / kEndName));
    CHECK(box.vkdose("run --from a --quiet --set stop.max_doses=1 --set dose.rotate_s=0.02 --out e").code == 0);
}

TEST_CASE(
    "a run that an overlap stopped goes on with a larger limit, and ends as if it had been larger from the start") {
    const Sandbox box;
    const std::string arguments = "run " + kMini + kShort + "--backend reference --set checkpoint.time_s=0.001 ";
    REQUIRE(box.vkdose(arguments + "--out whole").code == 0);
    const double largest = summary(box / "whole")["max_overlap_ratio"];
    const double limit = 0.9 * largest;
    const auto stopped = box.vkdose(arguments + "--out cut --set contact.max_overlap_ratio=" + std::to_string(limit));
    REQUIRE(stopped.code == 3);
    CHECK_THAT(stopped.err, Catch::Contains("`vkdose resume cut --set contact.max_overlap_ratio="));
    const auto other = box.vkdose("resume cut --set contact.friction=0.1 --set seed=3");
    CHECK(other.code == 2);
    CHECK_THAT(other.err, Catch::Contains("contact.friction = 0.1: cannot be changed in a run that has begun") &&
                              Catch::Contains("seed = 3") && Catch::Contains("vkdose run --from cut"));
    const auto on = box.vkdose("resume cut --quiet --set contact.max_overlap_ratio=0.2");
    CAPTURE(on.err);
    REQUIRE(on.code == 0);
    for (const char* name : {"case.toml", "timeseries.csv", "doses.csv", "particles.csv"}) {
        CAPTURE(name);
        CHECK(readText(box / "cut" / name) == readText(box / "whole" / name));
    }
    CHECK(summary(box / "cut")["max_overlap_ratio"] == largest);
}
