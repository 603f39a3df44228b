#include "host/model/particle_list.h"

#include "tests/model/case_files.h"
#include "tests/support/catch.h"

using namespace vkdose;
using test::Folder;

TEST_CASE("particle list: columns in any order, blank lines, CRLF") {
    const Folder folder;
    std::vector<Diagnostic> faults;
    const Particles p = readParticleList(
        folder.write("p.csv", "r,x,y,z,vx,vy,vz\r\n1e-3, 0.01,-0.02 ,+3e-2,1,2,3\r\n\r\n0.5e-3,0,0,0,0,0,0\r\n"),
        faults);
    REQUIRE(faults.empty());
    REQUIRE(p.size() == 2);
    CHECK(p.position[0] == Vec3(0.01, -0.02, 0.03));
    CHECK(p.velocity[0] == Vec3(1, 2, 3));
    CHECK(p.spin[0] == Vec3(0));
    CHECK(p.radius[0] == 1e-3);
    CHECK(p.radius[1] == 0.5e-3);
    CHECK(p.status[1] == Status::Active);
}

TEST_CASE("particle list: comments stand where they like") {
    const Folder folder;
    std::vector<Diagnostic> faults;
    const Particles p = readParticleList(
        folder.write("list.csv", "# three\nx,y,z,r\n# the first\n0,0,0,1e-3\n1,0,0,1e-3\n# the end\n"), faults);
    CHECK(faults.empty());
    CHECK(p.size() == 2);
}

TEST_CASE("particle list: spins and a last line without its end") {
    const Folder folder;
    std::vector<Diagnostic> faults;
    const Particles p = readParticleList(folder.write("p.csv", "x,y,z,r,wx,wy,wz\n0,0,0,1e-3,4,5,6"), faults);
    REQUIRE(faults.empty());
    REQUIRE(p.size() == 1);
    CHECK(p.spin[0] == Vec3(4, 5, 6));
}

TEST_CASE("particle list: the end state of a run") {
    const Folder folder;
    std::vector<Diagnostic> faults;
    const std::string header = "id,x_m,y_m,z_m,vx_m_s,vy_m_s,vz_m_s,wx_rad_s,wy_rad_s,wz_rad_s,radius_m,status\n";
    const Particles p = readParticleList(
        folder.write("p.csv", header + "0,1,2,3,4,5,6,7,8,9,1e-3,active\n1,0,0,0,0,0,0,0,0,0,1e-3,dosed\n"), faults);
    REQUIRE(faults.empty());
    REQUIRE(p.size() == 1);
    CHECK(p.position[0] == Vec3(1, 2, 3));
    CHECK(p.velocity[0] == Vec3(4, 5, 6));
    CHECK(p.spin[0] == Vec3(7, 8, 9));
    CHECK(p.radius[0] == 1e-3);
    readParticleList(folder.write("p.csv", header + "0,1,2,3,4,5,6,7,8,9,1e-3,activ\n"), faults);
    REQUIRE(faults.size() == 1);
    CHECK(faults[0].key == "status");
}

TEST_CASE("particle list: every fault names its line") {
    struct Row {
        std::string text;
        int line;
        std::string key;
        std::string fragment;
    };
    const std::vector<Row> rows{
        {"", 0, "", "empty"},
        {"x,y,z\n0,0,0\n", 1, "r", "missing in the header"},
        {"x,y,z,R\n", 1, "R", "did you mean r?"},
        {"x,y,z,r,radius\n", 1, "radius", "unknown column"},
        {"x,y,z,r,x\n", 1, "x", "twice"},
        {"x,y,z,r,vx,vy\n", 1, "v", "only some"},
        {"x,y,z,r\n0,0,0,1e-3\n\n0,0,1e-3\n", 4, "", "3 fields"},
        {"x,y,z,r\n0,0,zero,1e-3\n", 2, "z", "not a number"},
        {"x,y,z,r\n0,0,1mm,1e-3\n", 2, "z", "not a number"},
        {"x,y,z,r\n0,0,,1e-3\n", 2, "z", "empty"},
        {"x,y,z,r\n0,nan,0,1e-3\n", 2, "y", "finite"},
        {"x,y,z,r\n0,1e999,0,1e-3\n", 2, "y", "beyond what a number can be"},
        {"x,y,z,r\n0,0,0,-1e-3\n", 2, "r", "not positive"},
        {"x,y,z,r\n0,0,0,0\n", 2, "r", "not positive"},
        {"x,y,z,r\n0,\"0,0,1\n", 2, "", "not CSV"},
        {"x,y,z,r\n\n", 0, "", "no particles"},
    };
    const Folder folder;
    for (const Row& row : rows) {
        INFO(row.text);
        const auto file = folder.write("bad.csv", row.text);
        std::vector<Diagnostic> faults;
        readParticleList(file, faults);
        REQUIRE_FALSE(faults.empty());
        CHECK(faults[0].file == file.string());
        CHECK(faults[0].line == row.line);
        CHECK(faults[0].key == row.key);
        CHECK_THAT(faults[0].text(), Catch::Contains(row.fragment));
    }
}

TEST_CASE("particle list: many faults are counted, not all told") {
    const Folder folder;
    std::string text = "x,y,z,r\n";
    for (int i = 0; i < 50; ++i) text += "a,0,0,1e-3\n";
    std::vector<Diagnostic> faults;
    readParticleList(folder.write("bad.csv", text), faults);
    REQUIRE(faults.size() == 21);
    CHECK_THAT(faults.back().text(), Catch::Contains("30 more"));
}

TEST_CASE("particle list: a file that is not there") {
    std::vector<Diagnostic> faults;
    readParticleList("nowhere/none.csv", faults);
    REQUIRE(faults.size() == 1);
    CHECK_THAT(faults[0].text(), Catch::Contains("nowhere/none.csv: there is no such file"));
}
