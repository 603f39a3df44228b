// Who may ask the workbench, and what of the disk it reaches.

#include "host/studio/gate.h"

#include <map>

#include "host/studio/workspace.h"

#include "tests/support/catch.h"
#include "tests/support/folder.h"

using namespace vkdose;
using namespace vkdose::studio;
using test::Folder;
namespace fs = std::filesystem;

TEST_CASE("the gate lets in who has the token, from this host and this origin alone") {
    const Gate gate(4000, "secret");
    const auto passes = [&](const Caller& caller) { return !gate.refusal(caller).has_value(); };
    CHECK(passes({"127.0.0.1:4000", "", "", "secret"}));
    CHECK(passes({"localhost:4000", "http://localhost:4000", "a=1; vkdose-4000=secret", ""}));
    CHECK_FALSE(passes({"127.0.0.1:4000", "", "", ""}));
    CHECK_FALSE(passes({"127.0.0.1:4000", "", "", "secre"}));
    CHECK_FALSE(passes({"127.0.0.1:4000", "", "vkdose-4001=secret", ""}));  // of another workbench
    CHECK_FALSE(passes({"127.0.0.1:4000", "", "xvkdose-4000=secret", ""}));
    CHECK_FALSE(passes({"evil.example:4000", "", "vkdose-4000=secret", ""}));  // a name that points here
    CHECK_FALSE(passes({"127.0.0.1:4001", "", "vkdose-4000=secret", ""}));
    CHECK_FALSE(passes({"", "", "vkdose-4000=secret", ""}));
    CHECK_FALSE(passes({"127.0.0.1:4000", "http://evil.example", "vkdose-4000=secret", ""}));
    CHECK_FALSE(passes({"127.0.0.1:4000", "null", "vkdose-4000=secret", ""}));
    CHECK_FALSE(passes({"127.0.0.1:4000", "http://127.0.0.1:4001", "vkdose-4000=secret", ""}));
    CHECK(gate.address() == "http://127.0.0.1:4000/?token=secret");
    CHECK_THAT(gate.cookie(), Catch::Contains("HttpOnly") && Catch::Contains("SameSite=Strict"));
    const Gate one(1), other(1);
    CHECK(one.token().size() == 32);
    CHECK(one.token() != other.token());
}

TEST_CASE("a workspace reaches what is inside of it, and nothing by dots, links or absolute paths") {
    const Folder outer;
    outer.write("outside.toml", "secret");
    fs::create_directories(outer.path() / "work/sub");
    fs::create_symlink(outer.path() / "outside.toml", outer.path() / "work/link.toml");
    fs::create_directory_symlink(outer.path(), outer.path() / "work/up");
    const Workspace work(outer.path() / "work");
    const fs::path root = fs::canonical(outer.path() / "work");
    CHECK(work.inside("a.toml") == root / "a.toml");
    CHECK(work.inside("new/deep/c.toml") == root / "new/deep/c.toml");
    for (const char* name :
         {"", ".", "..", "../outside.toml", "sub/../../outside.toml", "/etc/passwd", "link.toml", "up/outside.toml",
          "up", "sub/..", "sub/../b.toml", ".hidden/a.toml", "..\\outside.toml", "a\nb.toml", "....//x.toml"}) {
        CAPTURE(name);
        CHECK_FALSE(work.inside(name).has_value());
    }
    CHECK_FALSE(work.inside(std::string("a\0.toml", 7)).has_value());
    CHECK_THROWS_WITH(Workspace(outer.path() / "nowhere"), Catch::Contains("there is no folder"));
}

TEST_CASE("a workspace lists cases, studies and what they left, and looks into no run and no hidden folder") {
    const Folder folder;
    for (const char* name : {"b.toml", "a.toml", "sub/c.toml", "out/run/case.toml", "out/run/timeseries.csv",
                             "out/sweep/study.toml", "out/sweep/members.csv", "out/sweep/members/0000/case.toml",
                             ".git/x.toml", "notes.txt", "1/2/3/4/5/deep.toml"}) {
        fs::create_directories((folder.path() / name).parent_path());
        folder.write(name, "");
    }
    folder.write("b.toml", "base = \"a.toml\"\nseeds = 2\n");
    const std::map<Workspace::Kind, std::string> kinds{{Workspace::Kind::Case, ""},
                                                       {Workspace::Kind::Study, "study "},
                                                       {Workspace::Kind::Run, "run "},
                                                       {Workspace::Kind::Sweep, "sweep "}};
    std::vector<std::string> names;
    for (const Workspace::Entry& e : Workspace(folder.path()).entries()) names.push_back(kinds.at(e.kind) + e.name);
    CHECK(names == std::vector<std::string>{"a.toml", "study b.toml", "run out/run", "sweep out/sweep", "sub/c.toml"});
}

TEST_CASE("a study is told by its tables, and the command that plays it too") {
    using studio::commandOfStudy;
    CHECK(std::string(commandOfStudy("[[axis]]\nkey = \"seed\"\n")) == "sweep");
    CHECK(std::string(commandOfStudy("seeds = 3\n")) == "sweep");
    CHECK(std::string(commandOfStudy("[calibrate]\n")) == "calibrate");
    CHECK(std::string(commandOfStudy("[design]\n")) == "design");
    CHECK(commandOfStudy("seed = 3\n") == nullptr);
    CHECK(commandOfStudy("[") == nullptr);
}
