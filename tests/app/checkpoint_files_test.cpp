// Checkpoints, and the files that belong to them, that cannot be used.

#include "tests/app/cut_runs.h"

using namespace vkdose;
using namespace vkdose::test;

TEST_CASE("a checkpoint that cannot be used is refused by name") {
    const Sandbox box;
    const fs::path file = interrupted(box);
    const std::string good = readText(file);
    const auto refused = [&](const std::string& content, const std::string& why) {
        box.write("out/checkpoint.h5", content);
        const auto o = box.vkdose("resume out");
        CAPTURE(o.err);
        CHECK(o.code == 2);
        CHECK_THAT(o.err, Catch::Contains("out/checkpoint.h5") && Catch::Contains(why));
    };
    refused("", "not a checkpoint of vkdose");
    refused("name = \"mini\"\n", "not a checkpoint of vkdose");
    refused(good.substr(512), "not a checkpoint of vkdose");
    refused(good.substr(0, good.size() / 2), "cut off");
    refused(good + "x", "damaged");
    std::string later = good;
    later.replace(good.find("version 7"), 9, "version 8");
    refused(later, "format version 8");
    const auto missing = box.vkdose("resume nowhere");
    CHECK(missing.code == 2);
    CHECK_THAT(missing.err, Catch::Contains("nowhere/checkpoint.h5"));

    box.write("out/checkpoint.h5", good);
    box.write("out/timeseries.csv", "time_s\n");
    const auto shorter = box.vkdose("resume out");
    CHECK(shorter.code == 2);
    CHECK_THAT(shorter.err, Catch::Contains("timeseries.csv"));
}

TEST_CASE("a checkpoint that is whole, but lacks a part, is refused by the part's name") {
    const Sandbox box;
    const fs::path file = interrupted(box);
    const Checkpoint good = readCheckpoint(file);
    const auto without = [](const Record& record, const std::string& name) {
        Record left;
        for (const auto& [key, array] : record.arrays())
            if (key != name) std::visit([&, &k = key](const auto& values) { left.put(k, values); }, array);
        return left;
    };
    const auto refused = [&](const Checkpoint& bad, const std::string& name) {
        writeCheckpoint(file, bad);
        const auto o = box.vkdose("resume out");
        CAPTURE(name, o.err);
        CHECK(o.code == 2);
        CHECK_THAT(o.err, Catch::Contains("out/checkpoint.h5") && Catch::Contains(name));
    };
    REQUIRE(good.run.run.arrays().size() > 5);
    REQUIRE(good.run.backend.arrays().size() > 5);
    for (const auto& [name, array] : good.run.run.arrays()) {
        Checkpoint bad = good;
        bad.run.run = without(good.run.run, name);
        refused(bad, name);
    }
    for (const auto& [name, array] : good.run.backend.arrays()) {
        Checkpoint bad = good;
        bad.run.backend = without(good.run.backend, name);
        refused(bad, name);
    }
}

TEST_CASE("no cut and no flipped bit of a checkpoint goes unnoticed") {
    const Sandbox box;
    const fs::path file = interrupted(box);
    REQUIRE_NOTHROW(readCheckpoint(file));
    const std::string good = readText(file);
    std::mt19937 random(8);
    for (int i = 0; i < 150; ++i) {
        const std::size_t length = random() % good.size();
        box.write("out/checkpoint.h5", good.substr(0, length));
        CAPTURE(length);
        CHECK_THROWS_AS(readCheckpoint(file), CheckpointError);
    }
    // Behind the text of the head its block is empty: what stands there is nobody's.
    const std::size_t text = good.find('\0');
    for (int i = 0; i < 150; ++i) {
        std::size_t at = random() % good.size();
        if (i % 3 == 0) at = random() % text;
        if (at >= text && at < 512) continue;
        std::string bad = good;
        bad[at] = char(bad[at] ^ (1 << random() % 8));
        box.write("out/checkpoint.h5", bad);
        CAPTURE(at);
        CHECK_THROWS_AS(readCheckpoint(file), CheckpointError);
    }
}

TEST_CASE("what has been changed before the checkpoint's mark is refused by name, and left as it is") {
    const Sandbox box;
    interrupted(box);
    for (const std::string name : {"timeseries.csv", "doses.csv", "frames/frames.csv", "fields/outlet.csv"}) {
        const std::string good = readText(box / "out" / name);
        const std::size_t line = good.find('\n') + 1;
        std::string bad = good;
        SECTION(name + ": a byte more") {
            bad.insert(line - 1, "0");
        }
        SECTION(name + ": another byte") {
            bad[line - 2] ^= 1;
        }
        if (bad == good) continue;
        box.write("out/" + name, bad);
        const auto o = box.vkdose("resume out");
        CAPTURE(o.err);
        CHECK(o.code == 2);
        CHECK_THAT(o.err, Catch::Contains("out/" + name));
        CHECK(readText(box / "out" / name) == bad);
    }
}
