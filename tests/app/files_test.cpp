// A user's files beside, above and below the program's own are safe from it.

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <map>

#include "tests/app/sandbox.h"
#include "tests/support/catch.h"

using namespace vkdose::test;
namespace fs = std::filesystem;

namespace {

const std::string kMini = "'" VKDOSE_SOURCE_DIR "/cases/mini.toml' ";
/// The mini canister cut to a few steps.
const std::string kShort =
    "--backend reference --quiet --set settle.time_s=0.002 --set dose.rotate_s=0.001 "
    "--set dose.rest_s=0.001 --set stop.max_doses=1 ";
/// A process that waits for a pipe is ended, with code 124.
const std::string kPatience = "timeout 120 ";

/// Every file below a folder with what is in it; of what is no file its name.
std::map<std::string, std::string> contents(const fs::path& folder) {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const std::string name = entry.path().lexically_relative(folder).string();
        if (name != "stdout.txt" && name != "stderr.txt")
            all[name] = entry.is_regular_file() ? readText(entry.path()) : "";
    }
    return all;
}

void checkRefused(const Sandbox& box, const std::string& arguments, const std::string& says) {
    const auto before = contents(box.path());
    const auto o = box.vkdose(arguments);
    CAPTURE(arguments, o.err);
    CHECK(o.code == 2);
    CHECK_THAT(o.err, Catch::Contains(says));
    CHECK(contents(box.path()) == before);
}

fs::path pipeAt(const fs::path& path) {
    REQUIRE(mkfifo(path.c_str(), 0600) == 0);
    return path;
}

}  // namespace

TEST_CASE("a folder that another process holds is not prepared for a run") {
    const Sandbox box;
    REQUIRE(box.vkdose("run " + kMini + kShort + "--out out").code == 0);
    const int held = ::open((box / "out").c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    REQUIRE(::flock(held, LOCK_EX | LOCK_NB) == 0);
    checkRefused(box, "run " + kMini + kShort + "--out out --force", "another vkdose is writing into out");
    checkRefused(box, "resume out", "another vkdose is writing into out");
    ::close(held);
    CHECK(box.vkdose("run " + kMini + kShort + "--out out --force").code == 0);
}

TEST_CASE("of two runs that are started into one folder at once, what is there is one of them whole") {
    const Sandbox box;
    const auto words = [](int i, const std::string& out) {
        std::vector<std::string> all{
            "run", VKDOSE_SOURCE_DIR "/cases/mini.toml", "--backend", "reference", "--quiet", "--force", "--out", out};
        for (const char* value : {"settle.time_s=0.002", "dose.rotate_s=0.001", "dose.rest_s=0.001", "stop.max_doses=1",
                                  i == 0 ? "sensors.interval_s=0.001" : "sensors.interval_s=0.0005"})
            all.insert(all.end(), {"--set", value});
        return all;
    };
    const auto codeOf = [](pid_t child) {
        int status = 0;
        waitpid(child, &status, 0);
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    };
    const auto result = [&](const std::string& out) {
        auto files = contents(box / out);
        CHECK(files.erase("summary.json") == 1);  // has the time of day
        return files;
    };
    REQUIRE(codeOf(box.start(words(0, "first"))) == 0);
    REQUIRE(codeOf(box.start(words(1, "second"))) == 0);
    const auto first = result("first"), second = result("second");
    REQUIRE(first != second);
    for (int round = 0; round < 40; ++round) {
        const pid_t a = box.start(words(0, "both")), b = box.start(words(1, "both"));
        const int codeA = codeOf(a), codeB = codeOf(b);
        CAPTURE(round, codeA, codeB);
        CHECK((codeA == 0 || codeB == 0));
        CHECK((codeA == 0 || codeA == 2));
        CHECK((codeB == 0 || codeB == 2));
        const auto both = result("both");
        CHECK((both == first || both == second));
    }
}

TEST_CASE("run --force removes what the former run wrote and nothing else") {
    const Sandbox box;
    const std::string fields =
        "--set 'field=[{name=\"f\",preset=\"outlet\"}]' --set sensors.interval_s=0.001 --set frames.interval_s=0.001 ";
    REQUIRE(box.vkdose("run " + kMini + kShort + fields + "--out out").code == 0);
    REQUIRE(fs::exists(box / "out/frames/particles_000000.hdf"));
    REQUIRE(fs::exists(box / "out/fields/f.csv"));
    REQUIRE(box.vkdose("report out").code == 0);
    const std::vector<std::string> mine{
        "frames/notes.csv", "frames/particles.hdf",  "frames/mine_000001.hdf", "frames/particles_1.hdf",
        "fields/g.csv",     "fields/f-filtered.csv", "fields/f_mean.csv",      "notes.txt",
        "picture.png"};
    for (const std::string& name : mine) box.write("out/" + name, "time_s,phase,dose,file\n");
    REQUIRE(box.vkdose("run " + kMini + kShort + "--set frames.interval_s=0 --out out --force").code == 0);
    for (const std::string& name : mine) {
        CAPTURE(name);
        CHECK(readText(box / ("out/" + name)) == "time_s,phase,dose,file\n");
    }
    CHECK_FALSE(fs::exists(box / "out/frames/particles_000000.hdf"));
    CHECK_FALSE(fs::exists(box / "out/frames/frames.csv"));
    CHECK_FALSE(fs::exists(box / "out/fields/f.csv"));
    CHECK_FALSE(fs::exists(box / "out/report.html"));  // of the run before, it would lie

    box.write("out/report.html", "<html>my own</html>");
    REQUIRE(box.vkdose("run " + kMini + kShort + "--out out --force").code == 0);
    CHECK(readText(box / "out/report.html") == "<html>my own</html>");
}

TEST_CASE("run --force is for a folder that holds a run") {
    const Sandbox box;
    for (const char* folder : {"mine", "mine/frames", "mine/fields"}) fs::create_directories(box / folder);
    for (const char* file : {"mine/frames/particles_000000.hdf", "mine/fields/a.csv", "mine/report.html",
                             "mine/summary.json", "mine/case.toml", "mine/timeseries.csv", "mine/particles.csv"})
        box.write(file, "my own work\n");
    checkRefused(box, "run " + kMini + kShort + "--out mine --force", "mine is not empty and holds no run of vkdose");
    checkRefused(box, "run " + kMini + kShort + "--out mine", "choose another folder");
}

TEST_CASE("what a command reads it does not replace") {
    const Sandbox box;
    REQUIRE(box.vkdose("run " + kMini + kShort + "--out run").code == 0);
    box.write("base.toml", readText(VKDOSE_SOURCE_DIR "/cases/mini.toml"));
    box.write("study.toml", "base = \"base.toml\"\nseeds = [1]\n");
    box.write("next.toml", "base = \"base.toml\"\n[particles]\nlist = \"run/particles.csv\"\n");
    box.write("run/over.toml", "base = \"case.toml\"\n");
    box.write("b.csv", "dose,mass_g\n1,0.1\n");

    checkRefused(box, "run next.toml " + kShort + "--out run --force",
                 "run/particles.csv, which the run would replace");
    checkRefused(box, "run run/over.toml --set seed=9 " + kShort + "--out run --force", "run/case.toml");
    checkRefused(box, "run run/case.toml --set seed=9 --quiet --out ./run/. --force", "case.toml");
    checkRefused(box, "sweep study.toml --backend reference --out .", "holds something else than a sweep");
    checkRefused(box, "sweep study.toml --backend reference --prepare --out .", "holds something else than a sweep");
    box.write("members.csv", "member,seed\n");  // as if a sweep had been there
    checkRefused(box, "sweep study.toml --backend reference --out .", "");
    fs::remove(box / "members.csv");
    checkRefused(box, "export-body base.toml --out base.toml", "base.toml is read by this command");
    fs::create_symlink("base.toml", box / "link");
    checkRefused(box, "export-body base.toml --out link", "link is read by this command");
    checkRefused(box, "report run --out run/timeseries.csv", "run/timeseries.csv is read by this command");
    checkRefused(box, "report run --experiment b.csv --out b.csv", "b.csv is read by this command");
    checkRefused(box, "render run --out run/particles.csv", "run/particles.csv is read by this command");
    checkRefused(box, "render run --movie run/summary.json", "run/summary.json is read by this command");
    checkRefused(box, "profile b.csv --mm-per-pixel 1 --out b.csv", "b.csv is read by this command");
    checkRefused(box, "profile b.csv --mm-per-pixel 1 --out c.csv --check ./b.csv", "b.csv is read by this command");

    // The same run once more, from its own case: nothing is lost.
    const std::string before = readText(box / "run/particles.csv");
    const auto again = box.vkdose("run run/case.toml --backend reference --quiet --out run --force");
    CAPTURE(again.err);
    CHECK(again.code == 0);
    CHECK(readText(box / "run/particles.csv") == before);
}

TEST_CASE("links that lead in a circle are told by name, wherever a command meets them") {
    const Sandbox box;
    REQUIRE(box.vkdose("run " + kMini + kShort + "--out run").code == 0);
    const auto circle = [&](const std::string& name, const std::string& arguments) {
        fs::remove(box / name);
        fs::create_symlink(fs::path(name).filename(), box / name);
        const auto o = box.vkdose(arguments);
        CAPTURE(name, arguments, o.err);
        CHECK(o.code == 2);
        CHECK_THAT(o.err, Catch::Contains(name) && Catch::Contains("cannot be read"));
        CHECK_FALSE(o.err.find("internal error") != std::string::npos);
        fs::remove(box / name);
    };
    circle("run/checkpoint.h5", "resume run");
    circle("run/case.toml", "report run");
    circle("loop.toml", "run loop.toml");
    circle("study.toml", "sweep study.toml");
}

TEST_CASE("a pipe is not waited for, whatever it is given for") {
    const Sandbox box;
    REQUIRE(
        box.vkdose("run " + kMini + kShort + "--set sensors.interval_s=0.001 --set frames.interval_s=0.001 --out run")
            .code == 0);
    pipeAt(box / "p");
    box.write("base.toml", "base = \"p\"\n");
    box.write("list.toml", "base = '" VKDOSE_SOURCE_DIR "/cases/mini.toml'\n[particles]\nlist = \"p\"\n");
    box.write("study.toml", "base = \"p\"\nseeds = [1]\n");
    box.write("aim.toml", "base = '" VKDOSE_SOURCE_DIR "/cases/mini.toml'\n[calibrate]\nmeasured = \"p\"\n");
    fs::create_directories(box / "sweep");
    box.write("sweep/members.csv", "member,seed\n");
    const std::vector<std::string> reading{"run p",
                                           "check p",
                                           "check base.toml",
                                           "check list.toml",
                                           "export-body p",
                                           "test compare p",
                                           "sweep p",
                                           "sweep study.toml",
                                           "calibrate p",
                                           "calibrate aim.toml",
                                           "report run --experiment p",
                                           "report run --profile p",
                                           "report run --profile p@1",
                                           "report sweep --expected p",
                                           "profile p --mm-per-pixel 1",
                                           "report p",
                                           "resume p",
                                           "render p",
                                           "run " + kMini + "--out p"};
    for (const std::string& command : reading) {
        const auto o = box.vkdose(command, kPatience);
        CAPTURE(command, o.err);
        CHECK(o.code == 2);
        CHECK_FALSE(o.err.empty());
    }
    const std::vector<std::string> writing{"export-body " + kMini + "--out p", "report run --out p",
                                           "render run --out p", "render run --movie p.mp4"};
    pipeAt(box / "p.mp4");
    for (const std::string& command : writing) {
        const auto o = box.vkdose(command, kPatience);
        CAPTURE(command, o.err);
        CHECK(o.code == 5);
        CHECK_THAT(o.err, Catch::Contains("a pipe"));
    }
    CHECK(fs::is_fifo(box / "p"));
    // In the place of a file of a run.
    for (const char* name : {"timeseries.csv", "case.toml", "summary.json", "particles.csv", "frames/frames.csv"}) {
        const std::string good = readText(box / ("run/" + std::string(name)));
        fs::remove(box / ("run/" + std::string(name)));
        pipeAt(box / ("run/" + std::string(name)));
        for (const std::string command : {"report run", "render run", "resume run"}) {
            CAPTURE(command, name);
            CHECK(box.vkdose(command, kPatience).code != 124);
        }
        fs::remove(box / ("run/" + std::string(name)));
        box.write("run/" + std::string(name), good);
    }
}

TEST_CASE("a link to a result stays, and a pipe that is read gets it") {
    const Sandbox box;
    box.write("mesh.stl", "old");
    fs::create_symlink("mesh.stl", box / "link.stl");
    REQUIRE(box.vkdose("export-body " + kMini + "--out link.stl").code == 0);
    CHECK(fs::is_symlink(box / "link.stl"));
    const std::string mesh = readText(box / "mesh.stl");
    CHECK_THAT(mesh, Catch::StartsWith("vkdose: mini, lengths in mm"));
    REQUIRE(box.vkdose("run " + kMini + kShort + "--out run").code == 0);
    box.write("page.html", "old");
    fs::create_symlink("page.html", box / "link.html");
    REQUIRE(box.vkdose("report run --out link.html").code == 0);
    CHECK(fs::is_symlink(box / "link.html"));
    CHECK_THAT(readText(box / "page.html"), Catch::StartsWith("<!DOCTYPE html>"));
    const auto o = box.vkdose("export-body " + kMini + "--out pipe", "mkfifo pipe; (cat pipe > got &); exec 3<>pipe; ");
    CAPTURE(o.err);
    CHECK(o.code == 0);
    CHECK(fs::is_fifo(box / "pipe"));
}

TEST_CASE("a disk that is full at the start of a run is told as such, and nothing is left behind") {
    const Sandbox box;
    // The limit on the size of a file stands in for the end of the disk; it lets the message through.
    const std::string full = "ulimit -f 1; ";
    const auto none = box.vkdose("run " + kMini + kShort + "--out a/b/out", full);
    CAPTURE(none.err);
    CHECK(none.code == 5);
    CHECK_THAT(none.err, Catch::Contains("cannot write a/b/out/") && Catch::Contains("File too large; make room"));
    CHECK(box.files().empty());

    fs::create_directories(box / "there");
    CHECK(box.vkdose("run " + kMini + kShort + "--out there", full).code == 5);
    CHECK(contents(box.path()) == std::map<std::string, std::string>{{"there", ""}});

    box.write("study.toml", "base = '" VKDOSE_SOURCE_DIR "/cases/mini.toml'\nseeds = [1]\n");
    const auto sweep = box.vkdose("sweep study.toml --backend reference --out s", full);
    CAPTURE(sweep.err);
    CHECK(sweep.code == 5);
    CHECK_FALSE(fs::exists(box / "s"));
}

TEST_CASE("a folder that is missing is told as that") {
    const Sandbox box;
    const auto o = box.vkdose("export-body " + kMini + "--out no/c.stl");
    CHECK(o.code == 5);
    CHECK_THAT(o.err, Catch::Contains("there is no folder no") && !Catch::Contains("make room"));
}

// NOLINTBEGIN(misc-misleading-bidirectional): these names are meant to mislead.
TEST_CASE("names that deceive are refused, those that are only odd are handled") {
    const Sandbox box;
    const std::string mini = readText(VKDOSE_SOURCE_DIR "/cases/mini.toml");
    const auto named = [&](const std::string& name) { return "run " + kMini + "--set 'name=\"" + name + "\"' "; };
    checkRefused(box, named("mini\u202elmth"),
                 "\"mini\\u202elmth\" is no name for a folder: it holds what cannot be seen");
    checkRefused(box, named("mini "), "begins or ends with a blank");
    checkRefused(box, named("\u200bmini"), "holds what cannot be seen");
    const auto missing = box.vkdose("check 'no\u202esuch\x1b[2J.toml'");
    CHECK(missing.code == 2);
    CHECK_THAT(missing.err, Catch::StartsWith("no\\u202esuch\\x1b[2J.toml: there is no such file"));

    for (const std::string folder : {"-rf", "my runs ", "\u202egnp"}) {
        CAPTURE(folder);
        const auto o = box.vkdose(named("-x") + kShort + "'--out=" + folder + "'");
        CAPTURE(o.err);
        CHECK(o.code == 0);
        CHECK(fs::exists(box / folder / "summary.json"));
        const auto page = box.vkdose("report -- '" + folder + "'");
        CHECK(page.code == 0);
        CHECK_THAT(page.out, !Catch::Contains("\u202e"));
        const auto again = box.vkdose(named("-x") + kShort + "'--out=" + folder + "'");
        CHECK(again.code == 2);
        CHECK_THAT(again.err, !Catch::Contains("\u202e"));
    }
}
// NOLINTEND(misc-misleading-bidirectional)
