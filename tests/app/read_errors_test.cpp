// A file that cannot be read to its end is an error that names it, whichever file and whichever command. Reads that
// come in pieces or are interrupted change nothing.

#include <fmt/format.h>

#include <map>

#include "geometry/mesh_writer.h"
#include "host/photo/profile.h"
#include "tests/app/sandbox.h"
#include "tests/geometry/facets.h"
#include "tests/photo/drawing.h"
#include "tests/support/catch.h"
#include "tests/support/io_faults.h"

using namespace vkdose;
using namespace vkdose::test;
namespace fs = std::filesystem;

namespace {

const std::string kMini = "base = \"" VKDOSE_SOURCE_DIR "/cases/mini.toml\"\n";
const std::string kShort =
    "--backend reference --quiet --set settle.time_s=0.01 --set dose.rotate_s=0.01 --set dose.rest_s=0.01 "
    "--set stop.max_doses=1 ";

struct Reading {
    std::string command;
    std::string file;  ///< the end of its path
    int code = 2;      ///< of the refusal
};

/// Every file below the folder that the command leaves, with its content, but for what the clock changes.
std::map<std::string, std::string> left(const Sandbox& box) {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(box.path())) {
        const std::string name = entry.path().lexically_relative(box.path()).string();
        const std::string file = entry.path().filename().string();
        if (file == "told" || file == "stderr.txt" || file == "summary.json" || file == "members.csv") continue;
        if (entry.is_regular_file()) all[name] = readText(entry.path());
    }
    return all;
}

/// Makes `stage` a copy of `made`. Every play has the same folder, because cases and checkpoints tell where it is.
void prepare(const Sandbox& stage, const Sandbox& made) {
    for (const auto& entry : fs::directory_iterator(stage.path())) fs::remove_all(entry.path());
    fs::copy(made.path(), stage.path(), fs::copy_options::recursive);
}

/// Plays the command on good reads, on reads in pieces that are interrupted now and then, and on bad ones: from the
/// first read on, from the second of three, from the third.
void checkReading(const Sandbox& made, const Reading& r) {
    CAPTURE(r.command, r.file);
    const Sandbox stage;
    prepare(stage, made);
    const auto whole = stage.vkdose(r.command);
    CAPTURE(whole.err);
    REQUIRE(whole.code == 0);

    const auto expected = left(stage);

    prepare(stage, made);
    const auto same = stage.vkdose(r.command, onBadDisk(r.file, "read:short:61,read:EINTR:1:2,open:EINTR:0:1"));
    CAPTURE(same.err);
    CHECK(same.code == 0);
    const auto got = left(stage);
    CHECK(got.size() == expected.size());
    for (const auto& [name, text] : expected) {
        CAPTURE(name);
        CHECK(got.contains(name));
        if (got.contains(name)) CHECK(got.at(name) == text);
    }
    CHECK_FALSE(readText(stage / "told").empty());

    const std::string size =
        std::to_string(1 + fs::file_size(r.file[0] == '/' ? r.file : (made / r.file).string()) / 3);
    for (const std::string& fault : {std::string("read:EIO"), "read:short:" + size + ",read:EIO:1",
                                     "read:short:" + size + ",read:EIO:2", std::string("open:ESTALE")}) {
        prepare(stage, made);
        const auto o = stage.vkdose(r.command, onBadDisk(r.file, fault));
        CAPTURE(fault, o.out, o.err);
        CHECK(o.code == r.code);
        CHECK_THAT(o.err, Catch::Contains(fs::path(r.file).filename().string()));
        CHECK_THAT(o.err, Catch::Contains(fault == "open:ESTALE" ? "Stale file handle" : "Input/output error"));
        CHECK_FALSE(readText(stage / "told").empty());
    }
}

}  // namespace

TEST_CASE("a file of a case that cannot be read to its end is an error") {
    const Sandbox box;
    box.write("case.toml", kMini);
    std::string list = "x,y,z,r\n";
    for (int i = 0; i < 36; ++i)
        list +=
            fmt::format("{},{},{},0.001\n", 0.003 * (i % 3 - 1), 0.012 + 0.0024 * (i / 9), 0.003 + 0.003 * (i / 3 % 3));
    box.write("list.csv", list);
    const std::string text = readText(VKDOSE_SOURCE_DIR "/cases/mini.toml");
    const std::size_t begin = text.find("[particles]"), end = text.find("[contact]");
    REQUIRE(begin < end);
    const auto withPowder = [&](const std::string& lines) {
        return std::string(text).replace(begin, end - begin, lines);
    };
    box.write("listed.toml", withPowder("[particles]\ndensity = 1427.0\nlist = \"list.csv\"\n\n"));
    box.write("built.toml", "base = \"listed.toml\"\nname = \"built\"\n");
    box.write("sieves.csv", "opening_um,passing_percent\n1800,0\n2200,60\n2600,100\n");
    box.write("sieved.toml", withPowder("[particles]\ndensity = 1427.0\nmass_g = 0.9\n\n[particles.size]\ndistribution "
                                        "= \"sieve\"\nsieves = \"sieves.csv\"\n\n"));
    box.write("block.stl", geometry::stlBytes(block(Vec3(-2e-3), Vec3(2e-3)), "block", 1e-3));
    box.write("way.csv", "time_s,y\n0,0\n0.1,0.001\n0.2,0.002\n0.3,0.001\n0.4,0\n");
    box.write("moved.toml", kMini +
                                "[[body]]\nname = \"block\"\nmesh = \"block.stl\"\nunit = \"mm\"\nat = [0, 0.05, "
                                "0.008]\n[body.motion]\nkind = \"table\"\nfile = \"way.csv\"\n");
    for (const char* name : {"liquid-bridge.toml", "liquid-bridge.csv", "liquid-bridge.glsl"})
        fs::copy(fs::path(VKDOSE_SOURCE_DIR "/cases/laws") / name, box / name);

    const std::string check = "check --assume --backend reference ";
    for (const Reading& r : std::vector<Reading>{{check + "listed.toml", "listed.toml"},
                                                 {check + "listed.toml", "list.csv"},
                                                 {check + "built.toml", "listed.toml"},
                                                 {check + "sieved.toml", "sieves.csv"},
                                                 {check + "moved.toml", "block.stl"},
                                                 {check + "moved.toml", "way.csv"},
                                                 {check + "liquid-bridge.toml", "liquid-bridge.glsl"},
                                                 {"run " + kShort + "listed.toml --out out", "list.csv"},
                                                 {"export-body moved.toml block", "block.stl"},
                                                 {"test compare listed.toml --steps 3 --twins 1", "list.csv"}})
        checkReading(box, r);

    const auto json = box.vkdose(check + "listed.toml --json", onBadDisk("list.csv", "read:short:99,read:EIO:2"));
    CHECK(json.code == 2);
    CHECK_THAT(json.out, Catch::Contains("list.csv cannot be read from byte 198 on: Input/output error"));
}

TEST_CASE("a file of a run's folder that cannot be read to its end is an error") {
    const Sandbox box;
    const auto run = box.vkdose("run '" VKDOSE_SOURCE_DIR "/cases/mini.toml' " + kShort +
                                "--set frames.interval_s=0.005 --set frames.states=true --out run");
    CAPTURE(run.err);
    REQUIRE(run.code == 0);
    box.write("balance.csv", "dose,mass_g\n1,0.01\n2,0.02\n");
    box.write("profile.csv", "z_mm,height_mm\n1,5\n2,5\n3,6\n4,6\n5,7\n");
    Drawing bed;
    bed.surface = [](double x) { return 100 + x / 6; };
    box.write("bed.png", photo::pngBytes(photo::pictureOf(draw(bed))));
    const std::string report = "report run --experiment balance.csv --profile profile.csv@0";
    const std::string on = "run --from run --quiet --out on ";
    for (const Reading& r : std::vector<Reading>{{report, "run/case.toml"},
                                                 {report, "run/timeseries.csv"},
                                                 {report, "run/doses.csv"},
                                                 {report, "run/summary.json"},
                                                 {report, "run/particles.csv"},
                                                 {report, "run/frames/frames.csv"},
                                                 {report, "run/frames/particles_000001.hdf"},
                                                 {report, "balance.csv"},
                                                 {report, "profile.csv"},
                                                 {"render run --size 64x64", "run/case.toml"},
                                                 {"render run --size 64x64", "run/frames/frames.csv"},
                                                 {on + "--at settled", "run/settled.h5"},
                                                 {on + "--at end", "run/end.h5"},
                                                 {on + "--at 0.01", "run/frames/frames.csv"},
                                                 {"profile bed.png --mm-per-pixel 0.2", "bed.png"}})
        checkReading(box, r);
}

TEST_CASE("a file of an unfinished run that cannot be read to its end is an error") {
    const Sandbox box;
    // It stops at an overlap some steps after a checkpoint.
    const auto stopped = box.vkdose("run '" VKDOSE_SOURCE_DIR "/cases/mini.toml' " + kShort +
                                    "--set frames.interval_s=0.005 --set checkpoint.time_s=0.002 --set "
                                    "contact.max_overlap_ratio=0.001 --out run");
    CAPTURE(stopped.err);
    REQUIRE(stopped.code == 3);
    REQUIRE(fs::exists(box / "run/checkpoint.h5"));
    const std::string resume = "resume run --quiet --set contact.max_overlap_ratio=0.2";
    for (const char* file : {"checkpoint.h5", "case.toml", "timeseries.csv", "doses.csv", "frames/frames.csv"})
        checkReading(box, {resume, "run/" + std::string(file)});
}

TEST_CASE("a file of a study that cannot be read to its end is an error") {
    const Sandbox box;
    box.write("base.toml", kMini);
    const std::string study =
        "base = \"base.toml\"\n[set]\nsettle.time_s = 0.01\ndose.rotate_s = 0.01\ndose.rest_s = "
        "0.01\n\"stop.max_doses\" "
        "= 1\n[[axis]]\nkey = \"contact.friction\"\nvalues = [0.2, 0.4]\n";
    box.write("study.toml", study);
    box.write("measured.csv", "dose,mass_g\n1,0.5\n2,0.51\n3,0.52\n4,0.5\n5,0.51\n");
    box.write("calibration.toml", study + "[calibrate]\nmeasured = \"measured.csv\"\nalong = \"contact.friction\"\n");
    const std::string sweep = "sweep study.toml --backend reference --jobs 1 --quiet --out out";
    checkReading(box, {sweep, "study.toml"});
    checkReading(box, {sweep, "base.toml"});
    checkReading(box, {"calibrate calibration.toml --dry-run --assume --backend reference", "measured.csv"});

    REQUIRE(box.vkdose(sweep).code == 0);
    checkReading(box, {sweep, "out/members.csv"});
    checkReading(box, {sweep, "out/doses.csv"});
    checkReading(box, {sweep, "out/study.toml"});
    checkReading(box, {"report out", "out/members.csv"});
    checkReading(box, {"report out", "out/study.toml"});
}
