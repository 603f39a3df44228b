#include "host/output/hdf5.h"

#include "host/core/error.h"
#include "host/output/frame_writer.h"
#include "host/output/frames.h"
#include "tests/app/sandbox.h"
#include "tests/support/catch.h"
#include "tests/support/limited_memory.h"

using namespace vkdose;
using namespace vkdose::test;
using Catch::Contains;

namespace {

/// Writes a data set of so many numbers into a new or existing file, the first few of which are there.
void claim(const std::filesystem::path& file, const char* path, hsize_t count, bool chunked) {
    const bool fresh = !std::filesystem::exists(file);
    const hdf5::Handle f(fresh ? H5Fcreate(file.c_str(), H5F_ACC_EXCL, H5P_DEFAULT, H5P_DEFAULT)
                               : H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT),
                         H5Fclose, "file");
    const hdf5::Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose, "space");
    const hdf5::Handle how(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "how");
    const hsize_t chunk = 1000;
    if (chunked) H5Pset_chunk(how, 1, &chunk);
    if (!fresh) H5Ldelete(f, path, H5P_DEFAULT);
    const hdf5::Handle set(H5Dcreate2(f, path, H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, how, H5P_DEFAULT), H5Dclose,
                           "set");
    if (!chunked) return;
    const hsize_t zero = 0, few = 5;
    const hdf5::Handle part(H5Scopy(space), H5Sclose, "part"), memory(H5Screate_simple(1, &few, nullptr), H5Sclose, "");
    H5Sselect_hyperslab(part, H5S_SELECT_SET, &zero, nullptr, &few, nullptr);
    const std::vector<double> values(few, 1.0);
    REQUIRE(H5Dwrite(set, H5T_NATIVE_DOUBLE, memory, part, H5P_DEFAULT, values.data()) >= 0);
}

}  // namespace

TEST_CASE("a data set that claims more than its file can hold is refused before memory is taken for it") {
    const Sandbox box;
    for (const bool chunked : {true, false}) {
        const auto file = box / (chunked ? "chunked" : "plain");
        claim(file, "/big", 1'000'000'000'000, chunked);
        const hdf5::Reader reader(readText(file));
        CHECK_THROWS_AS(reader.array<double>("/big"), hdf5::Error);
        CHECK_THROWS_WITH(reader.array<double>("/big"),
                          Contains("/big claims 1000000000000 elements of 8 bytes, more than the file can hold"));
    }
}

TEST_CASE("where memory is limited, a failure of HDF5 tells the limit") {
    const auto failure = [] {
        try {
            const hdf5::Reader reader("no file of HDF5");
            return std::string("none");
        } catch (const hdf5::Error& e) {
            return std::string(e.what());
        }
    };
    CHECK_THAT(failure(), Catch::StartsWith("HDF5 failed") && !Catch::Contains("ulimit"));
    const LimitedMemory limited;
    CHECK_THAT(failure(), Catch::StartsWith("HDF5 failed") && Catch::EndsWith("(ulimit -v)"));
}

TEST_CASE("a file that HDF5 cannot make is told by its name, as what cannot be written") {
    CHECK(hdf5::made("a.hdf", [] { return std::string("bytes"); }) == "bytes");
    const auto make = [] { return hdf5::Writer().text("/a", "once"), hdf5::Reader("none").text("/a"); };
    CHECK_THROWS_AS(hdf5::made("a.hdf", make), OutputError);
    CHECK_THROWS_WITH(hdf5::made("a.hdf", make), Catch::StartsWith("cannot make a.hdf: HDF5 failed at "));
}

TEST_CASE("what packs best is read all the same") {
    const std::vector<double> zeros(3'000'001, 0.0), none;
    hdf5::Writer writer;
    writer.array("/zeros", zeros, {zeros.size()});
    writer.array("/none", none, {0});
    writer.text("/empty", "");
    const hdf5::Reader reader(writer.image());
    CHECK(reader.array<double>("/zeros") == zeros);
    CHECK(reader.array<double>("/none").empty());
    CHECK(reader.text("/empty").empty());
}

TEST_CASE("a frame with such a data set is told by its file, and the data set") {
    const Sandbox box;
    Case c;
    c.world.density() = 1000;
    FrameWriter writer(box.path(), c, 0);
    Frame frame;
    frame.particles.add({0, 0, 0}, 1e-3);
    writer.put(frame);
    writer.store();
    claim(box / "frames/particles_000000.hdf", "/VTKHDF/PointData/radius", 1'000'000'000'000, true);
    const Frames frames(box.path());
    CHECK_THROWS_AS(frames.read(frames.entries().at(0)), OutputError);
    CHECK_THROWS_WITH(frames.read(frames.entries().at(0)), Contains("particles_000000.hdf is no frame of vkdose") &&
                                                               Contains("/VTKHDF/PointData/radius claims"));
}
