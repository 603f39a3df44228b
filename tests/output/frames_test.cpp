#include "host/output/frames.h"

#include <pthread.h>

#include <fstream>
#include <system_error>
#include <thread>

#include "host/core/error.h"
#include "host/core/file.h"
#include "host/law/user_law.h"
#include "host/output/field_row.h"
#include "host/output/frame_files.h"
#include "host/output/frame_writer.h"
#include "host/output/hdf5.h"
#include "host/output/particle_row.h"
#include "host/output/run_files.h"
#include "tests/app/sandbox.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;
namespace fs = std::filesystem;

namespace {

/// A floor and a coil, and a sphere of a millimetre on each other, the floor and the wire.
Case smallWorld(bool contacts = true) {
    Case c;
    c.world.density() = 1000;
    c.world.walls = {geometry::Plane{{0, -0.01, 0}, {0, 1, 0}}};
    c.world.coil = geometry::Coil{0.01, 0.01, 0.001, 0.05};
    c.frames = {0.01, contacts};
    return c;
}

double inexact(int k) {
    return std::sqrt(5.0 + k);
}

/// No two numbers alike, and none that a shorter type would hold.
Frame someFrame(int k) {
    Frame f;
    f.step = 1000000000000ULL + std::uint64_t(k);
    f.time = 0.1 * k + 1.0 / 3;
    f.phase = Phase(k % 3);
    f.dose = k;
    f.coilAngle = -0.7 * k;
    for (int i = 0; i < 5; ++i) {
        const double x = 1e-3 * std::sqrt(2.0 + i + k);
        f.particles.add({x, x / 3, x / 7}, 1e-3 + x / 11, {x / 13, -x, 0}, {1 / x, x / 17, -1 / x});
    }
    f.particles.gone.assign(5, glm::ivec3(k, -7, 0));
    f.bodiesMoved = {Moved(inexact(k)), Moved(0, {{1e-3 * k, inexact(k), 0}, Vec3(0), -inexact(k), 0})};
    f.particles.status[1] = Status::Dosed;
    f.particles.status[2] = Status::Lost;
    const double s = 1e-6 / 3 + k;
    f.contacts = {{ContactClass::ParticleParticle, 0, 3, s / 7, {s, 2 * s, 3 * s}, {-s, s, 0}, s / 5, {1, s, 0}},
                  {ContactClass::ParticleWall, 3, 0, s / 3, {s, 0, 0}, {0, 0, s}, 0, {0, 1.0 / 3, 0}},
                  {ContactClass::ParticleCoil, 4, 1, s / 9, {0, s, 0}, {0, s, 0}, -s, {0, 0, -1.0 / 7}}};
    return f;
}

void checkSame(const Frame& a, const Frame& b) {
    CHECK(a.step == b.step);
    CHECK(a.time == b.time);
    CHECK(a.phase == b.phase);
    CHECK(a.dose == b.dose);
    CHECK(a.coilAngle == b.coilAngle);
    CHECK(a.bodiesMoved == b.bodiesMoved);
    CHECK(a.particles.position == b.particles.position);
    CHECK(a.particles.velocity == b.particles.velocity);
    CHECK(a.particles.spin == b.particles.spin);
    CHECK(a.particles.radius == b.particles.radius);
    CHECK(a.particles.gone == b.particles.gone);
    CHECK(a.particles.status == b.particles.status);
    REQUIRE(a.contacts.size() == b.contacts.size());
    for (std::size_t i = 0; i < a.contacts.size(); ++i) {
        const Contact &p = a.contacts[i], &q = b.contacts[i];
        CHECK(p.kind == q.kind);
        CHECK(p.particle == q.particle);
        CHECK(p.other == q.other);
        CHECK(p.maxOverlap == q.maxOverlap);
        CHECK(p.sliding == q.sliding);
        CHECK(p.rolling == q.rolling);
        CHECK(p.torsion == q.torsion);
        CHECK(p.force == q.force);
    }
}

std::vector<std::string> names(const fs::path& folder) {
    std::vector<std::string> found;
    for (const auto& entry : fs::directory_iterator(folder)) found.push_back(entry.path().filename().string());
    std::sort(found.begin(), found.end());
    return found;
}

}  // namespace

TEST_CASE("frames come back as they were put, to the last bit") {
    const Sandbox box;
    {
        FrameWriter writer(box.path(), smallWorld(), 3);
        for (int k = 0; k < 4; ++k) writer.put(someFrame(k));
        writer.store();
    }
    const Frames frames(box.path());
    REQUIRE(frames.entries().size() == 4);
    for (int k = 0; k < 4; ++k) {
        const FrameEntry& e = frames.entries()[std::size_t(k)];
        const Frame expected = someFrame(k);
        CHECK(e.number == k);
        CHECK(e.step == expected.step);
        CHECK(e.time == expected.time);
        CHECK(e.phase == expected.phase);
        CHECK(e.dose == expected.dose);
        CHECK(e.coilAngle == expected.coilAngle);
        checkSame(frames.read(e), expected);
    }
    // Of each frame three files, of each kind the series, the walls and the index.
    CHECK(names(box / "frames").size() == 3 * 4 + 3 + 2);
}

TEST_CASE("a frame without contacts is a frame, and so is one without any particle in touch") {
    const Sandbox box;
    Frame alone = someFrame(1);
    alone.contacts.clear();
    SECTION("not stored") {
        FrameWriter writer(box.path(), smallWorld(false), 0);
        writer.put(someFrame(1));
        writer.store();
        CHECK_FALSE(fs::exists(box / "frames/contacts_000000.hdf"));
    }
    SECTION("none there") {
        FrameWriter writer(box.path(), smallWorld(), 0);
        writer.put(alone);
        writer.store();
        CHECK(fs::exists(box / "frames/contacts_000000.hdf"));
    }
    const Frames frames(box.path());
    checkSame(frames.read(frames.entries().at(0)), alone);
}

TEST_CASE("the nearest frame, and of two the later") {
    const Sandbox box;
    FrameWriter writer(box.path(), smallWorld(), 0);
    for (int k = 0; k < 4; ++k) {
        Frame f = someFrame(0);
        f.time = k;
        writer.put(f);
    }
    writer.store();
    const Frames frames(box.path());
    CHECK(nearestOf(frames.entries(), -1) == 0);
    CHECK(nearestOf(frames.entries(), 1.4) == 1);
    CHECK(nearestOf(frames.entries(), 1.5) == 2);
    CHECK(nearestOf(frames.entries(), 1.6) == 2);
    CHECK(nearestOf(frames.entries(), 99) == 3);
}

TEST_CASE("a run that goes on drops the frames after its checkpoint and writes the same ones again") {
    const Sandbox whole, cut;
    {
        FrameWriter writer(whole.path(), smallWorld(), 0);
        for (int k = 0; k < 5; ++k) writer.put(someFrame(k));
        writer.store();
    }
    CsvMark mark;
    {
        FrameWriter writer(cut.path(), smallWorld(), 0);
        for (int k = 0; k < 3; ++k) writer.put(someFrame(k));
        mark = writer.store();
        for (int k = 7; k < 13; ++k) writer.put(someFrame(k));  // another future
        writer.store();
    }
    {
        FrameWriter writer(cut.path(), smallWorld(), 0, mark);
        CHECK(Frames(cut.path()).entries().size() == 9);  // until there is something to replace them
        for (int k = 3; k < 5; ++k) writer.put(someFrame(k));
        writer.store();
    }
    CHECK(names(cut / "frames") == names(whole / "frames"));
    for (const std::string& name : names(whole / "frames")) {
        CAPTURE(name);
        CHECK(readText(cut / ("frames/" + name)) == readText(whole / ("frames/" + name)));
    }
    fs::resize_file(cut / "frames/frames.csv", mark.bytes - 1);
    CHECK_THROWS_AS(FrameWriter(cut.path(), smallWorld(), 0, mark), OutputError);
}

TEST_CASE("a frame that cannot be written is told at the next one or at the end") {
    const Sandbox box;
    FrameWriter writer(box.path(), smallWorld(), 0);
    writer.put(someFrame(0));
    writer.store();
    fs::remove_all(box / "frames");
    CHECK_NOTHROW(writer.put(someFrame(1)));
    SECTION("next") {
        CHECK_THROWS_WITH(writer.put(someFrame(2)), Catch::Contains("particles_000001.hdf"));
    }
    SECTION("end") {
        CHECK_THROWS_AS(writer.store(), OutputError);
    }
}

namespace {

/// While it lives no thread begins: stacks are larger by default than all memory there is to address.
class NoThreads {
  public:
    NoThreads() {
        pthread_getattr_default_np(&before_);
        pthread_attr_t huge;
        pthread_attr_init(&huge);
        pthread_attr_setstacksize(&huge, std::size_t{1} << 60);
        pthread_setattr_default_np(&huge);
        pthread_attr_destroy(&huge);
    }
    ~NoThreads() { pthread_setattr_default_np(&before_); }
    NoThreads(const NoThreads&) = delete;
    NoThreads& operator=(const NoThreads&) = delete;

  private:
    pthread_attr_t before_{};
};

}  // namespace

TEST_CASE("where no thread is to be had frames are written all the same") {
    const Sandbox box;
    const Case c = smallWorld();
    {
        const NoThreads none;
        CHECK_THROWS_AS(std::thread([] {}), std::system_error);
        FrameWriter writer(box.path(), c, 0);
        for (int k = 0; k < 3; ++k) writer.put(someFrame(k));
        writer.store();
    }
    const Frames frames(box.path());
    REQUIRE(frames.entries().size() == 3);
    for (int k = 0; k < 3; ++k) checkSame(frames.read(frames.entries()[std::size_t(k)]), someFrame(k));
}

TEST_CASE("a new run removes the frames of a former one and nothing else") {
    const Sandbox box;
    {
        FrameWriter writer(box.path(), smallWorld(), 0);
        writer.put(someFrame(0));
    }
    box.write("frames/view.pvsm", "mine");
    removeRun(box.path(), filesOfRun(box.path()));
    CHECK(names(box / "frames") == std::vector<std::string>{"view.pvsm"});
    CHECK(Frames(box.path()).entries().empty());
    fs::remove(box / "frames/view.pvsm");
    removeRun(box.path(), filesOfRun(box.path()));
    CHECK_FALSE(fs::exists(box / "frames"));
    box.write("frames", "a user's file of that name");
    removeRun(box.path(), filesOfRun(box.path()));
    CHECK(fs::is_regular_file(box / "frames"));
}

TEST_CASE("frames of a run under way are those whose lines are whole, what is no frame is refused by name") {
    const Sandbox box;
    {
        FrameWriter writer(box.path(), smallWorld(), 0);
        for (int k = 0; k < 3; ++k) writer.put(someFrame(k));
    }
    const fs::path index = box / "frames/frames.csv", file = box / "frames/particles_000002.hdf";
    const std::string lines = readText(index), bytes = readText(file);
    box.write("frames/frames.csv", lines.substr(0, lines.size() - 5));
    CHECK(Frames(box.path()).entries().size() == 2);
    box.write("frames/frames.csv", lines + "3,7,later,rest,1,0\n");
    CHECK_THROWS_WITH(Frames(box.path()), Catch::Contains("3,7,later,rest,1,0"));
    box.write("frames/frames.csv", "a,b\n");
    CHECK_THROWS_WITH(Frames(box.path()), Catch::Contains("frames.csv"));
    box.write("frames/frames.csv", lines);

    const Frames frames(box.path());
    const auto refused = [&](const std::string& content) {
        std::ofstream(file, std::ios::binary) << content;
        CHECK_THROWS_WITH(frames.read(frames.entries()[2]), Catch::Contains("particles_000002.hdf"));
    };
    refused("");
    refused(bytes.substr(0, bytes.size() / 2));
    refused(readText(box / "frames/contacts_000002.hdf"));
    fs::remove(file);
    CHECK_THROWS_WITH(frames.read(frames.entries()[2]),
                      Catch::Contains("frames.csv lists frame 2") && Catch::Contains("particles_000002.hdf"));
    CHECK(Frames(box / "nowhere").entries().empty());
}

TEST_CASE("a list of frames with a line of any length is told with its place, and with the beginning of the line") {
    const Sandbox box;
    fs::create_directories(box / "run/frames");
    const fs::path list = box / "run/frames/frames.csv";
    box.write("run/frames/frames.csv", csvHeader(kFrameColumns) + "\n" + std::string(10000, 'x') + "\n");
    try {
        (void)Frames(box / "run").entries();
        FAIL("it was taken");
    } catch (const OutputError& e) {
        const std::string said = e.what();
        CHECK_THAT(said, Catch::StartsWith(list.string() + ":2: xxx") && Catch::EndsWith(": is no frame of a run"));
        CHECK(said.size() < list.string().size() + 200);
    }
}

TEST_CASE("frames hold the bodies: those at rest beside the walls, those that move in their place") {
    const Sandbox box;
    Case c = smallWorld();
    RigidBody still, lift;
    still.shapes = {geometry::Block{Vec3(-0.05), Vec3(-0.04), false}};
    lift.shapes = {geometry::Block{Vec3(-0.002), Vec3(0.002), false}};
    lift.course.motion = geometry::Slide{{0, 0.01, 0}};
    lift.material = kCoilMaterial;  // contacts of the coil's class
    c.world.bodies = {still, lift};
    Frame f;
    f.time = 0.5;  // the lift's upper side is at y = 7 mm then
    f.particles.add({0, 0.0079, 0}, 1e-3);
    f.particles.add({-0.045, -0.0393, -0.045}, 1e-3);
    f.particles.add({0, -0.0093, 0}, 1e-3);
    f.contacts = {{ContactClass::ParticleCoil, 0, 2, 0, Vec3(0), Vec3(0), 0, {0, 0.1, 0}},
                  {ContactClass::ParticleWall, 1, 1, 0, Vec3(0), Vec3(0), 0, {0, 0.1, 0}},
                  {ContactClass::ParticleWall, 2, 0, 0, Vec3(0), Vec3(0), 0, {0, 0.1, 0}}};
    {
        FrameWriter writer(box.path(), c, 0);
        writer.put(f);
        writer.store();
    }
    const auto read = [&](const char* file) { return hdf5::Reader(*fileContent(box / "frames" / file)); };
    const hdf5::Reader contacts = read("contacts_000000.hdf");
    const auto ends = contacts.array<double>("/VTKHDF/Points");
    const auto overlap = contacts.array<double>("/VTKHDF/CellData/overlap");
    REQUIRE(ends.size() == 18);
    // Single precision; a micrometre is a thousandth of the radius.
    for (const auto& [at, y] : {std::pair(4, 0.007), std::pair(10, -0.04), std::pair(16, -0.01)})
        CHECK(std::abs(ends[std::size_t(at)] - y) < 1e-6);
    CHECK(std::abs(overlap[0] - 0.1e-3) < 1e-6);
    CHECK(std::abs(overlap[1] - 0.3e-3) < 1e-6);

    const auto moving = read("bodies_000000.hdf").array<double>("/VTKHDF/Points");
    double low = 1, high = -1;
    for (std::size_t i = 1; i < moving.size(); i += 3) {
        low = std::min(low, moving[i]);
        high = std::max(high, moving[i]);
    }
    CHECK(std::abs(low - 0.003) < 1e-6);
    CHECK(std::abs(high - 0.007) < 1e-6);
    CHECK(read("bodies_000000.hdf").array<std::uint32_t>("/VTKHDF/CellData/body") == std::vector<std::uint32_t>(12, 2));

    // In phases it stands where its own clock says.
    c.world.bodies[1].clock = Clock::Phases;
    f.time = 9;
    f.bodiesMoved = {0, 0.5};
    const Sandbox phased;
    {
        FrameWriter writer(phased.path(), c, 0);
        writer.put(f);
        writer.store();
    }
    const auto bytes = fileContent(phased / "frames/bodies_000000.hdf");
    CHECK(hdf5::Reader(*bytes).array<double>("/VTKHDF/Points") == moving);
    CHECK(hdf5::Reader(*fileContent(phased / "frames/contacts_000000.hdf")).array<double>("/VTKHDF/Points") == ends);
    const Frames frames(phased.path());
    CHECK(frames.read(frames.entries().at(0)).bodiesMoved == f.bodiesMoved);

    // And where its forces have brought it, if it moves freely: the slide went 5 mm by then.
    c.world.bodies[1].clock = Clock::Forces;
    c.world.bodies[1].course.motion = geometry::Free{1, {}, {}};
    f.bodiesMoved = {Moved(), Moved(Vec3(0, 0.005, 0))};
    const Sandbox thrown;
    {
        FrameWriter writer(thrown.path(), c, 0);
        writer.put(f);
        writer.store();
    }
    const auto free = fileContent(thrown / "frames/bodies_000000.hdf");
    CHECK(hdf5::Reader(*free).array<double>("/VTKHDF/Points") == moving);
    CHECK(hdf5::Reader(*fileContent(thrown / "frames/contacts_000000.hdf")).array<double>("/VTKHDF/Points") == ends);
    const Frames freeFrames(thrown.path());
    CHECK(freeFrames.read(freeFrames.entries().at(0)).bodiesMoved == f.bodiesMoved);

    const auto owners = read("walls.hdf").array<std::uint32_t>("/VTKHDF/CellData/body");
    CHECK(std::count(owners.begin(), owners.end(), 1U) == 12);
    CHECK(std::count(owners.begin(), owners.end(), 0U) > 0);
    CHECK(std::count(owners.begin(), owners.end(), 2U) == 0);
}

TEST_CASE("no property of a user's law has a name that particles or fields have in tables, lists or frames") {
    std::vector<std::string> names;
    for (const Row& columns : {columnNames(kParticleColumns), columnNames(kFieldWhenColumns),
                               columnNames(kPlaceColumns), columnNames(kQuantityColumns), columnNames(kStressColumns)})
        names.insert(names.end(), columns.begin(), columns.end());
    for (const char* ofMap : {"density", "volume_fraction", "momentum", "velocity", "coordination",
                              "granular_temperature", "kinetic_stress", "contact_stress", "time"})
        names.emplace_back(ofMap);
    for (const char* ofList : {"x", "y", "z", "r", "vx", "vy", "vz", "wx", "wy", "wz", "powder"})
        names.emplace_back(ofList);
    Case c = smallWorld();
    c.world.materials.push_back({"sugar", true, 1500});
    Frame frame = someFrame(1);
    const hdf5::Reader reader(particlesFile(frame, c.world, 0));
    const Record inFrames = reader.record("/VTKHDF/PointData");
    CHECK(inFrames.arrays().size() == 11);
    for (const auto& [name, values] : inFrames.arrays()) names.push_back(name);
    const std::string law = "float force(Contact c) { return 1.0; }\nfloat stiffness(Contact c) { return 1.0; }\n";
    for (const std::string& name : names) {
        CAPTURE(name);
        const LawReading read = readLaw("heat.glsl", "particle float " + name + ";\n" + law);
        CHECK(read.faults.size() == 1);
    }
    CHECK(readLaw("heat.glsl", "particle float charge;\n" + law).faults.empty());
}
