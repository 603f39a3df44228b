// A sweep over runs that are made up: which members run when, what is noted, and how it goes on.
#include "host/study/sweep.h"

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>
#include <tuple>

#include "host/output/checkpoint.h"
#include "host/output/run_folder.h"
#include "tests/study/made_up_runs.h"
#include "tests/study/sweeping.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;
namespace fs = std::filesystem;

TEST_CASE("every member runs once, no more at a time than there are slots, and is noted with its doses") {
    const Sweeping sweep;
    MadeUpRuns runs(3);
    const SweepOutcome outcome = sweep.run(runs);
    CHECK(outcome.whole);
    CHECK(outcome.ok == 12);
    CHECK(runs.most == 3);
    std::sort(runs.started.begin(), runs.started.end());
    CHECK(runs.started == std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11});
    const Table members = sweep.members();
    REQUIRE(members.rows() == 12);
    for (int i = 0; i < 12; ++i) CHECK(members.text(i, "member") == std::to_string(i));
    const std::size_t row = 8;
    CHECK(members.text(row, "seed") == "9");
    CHECK(members.text(row, "coil.speed_rpm") == "60.5");
    CHECK(members.text(row, "status") == "ok");
    CHECK(members.text(row, "stop_reason") == "dose_count");
    CHECK(members.number(row, "simulated_time_s") == 1.5);
    CHECK(members.number(row, "coil_torque_Nm") == 0.5);  // the dose that was cut short does not count
    CHECK(members.text(row, "mean_dose_kg").empty());
    const Table doses = sweep.doses();
    REQUIRE(doses.rows() == 24);
    CHECK(doses.text(17, "member") == "8");
    CHECK(doses.text(17, "contact.kc_over_k") == "0.2");
    CHECK(doses.number(17, "cumulative_mass_kg") == 0.003);
    CHECK(readText(sweep.out / "study.toml") == kGoodStudy);
    CHECK(fs::exists(sweep.out / "base.toml"));

    const std::string noted = readText(sweep.out / "members.csv");
    MadeUpRuns again(3);
    CHECK(sweep.run(again).whole);
    CHECK(again.started.empty());
    CHECK(readText(sweep.out / "members.csv") == noted);
}

TEST_CASE("a member that fails does not keep the others from running, it is run again only when asked for") {
    const Sweeping sweep;
    MadeUpRuns runs(2);
    runs.codes = {{4, 3}, {7, 128 + 9}};
    const SweepOutcome outcome = sweep.run(runs);
    CHECK(outcome.ok == 10);
    CHECK(outcome.failed == 2);
    CHECK(outcome.whole);
    const Table members = sweep.members();
    CHECK(members.text(4, "status") == "failed");
    CHECK(members.text(4, "error") == "particle 7, \"lost\"");
    CHECK(members.text(7, "error") == "ended by signal 9");

    MadeUpRuns nothing(2);
    CHECK(sweep.run(nothing).failed == 2);
    CHECK(nothing.started.empty());

    MadeUpRuns retried(1);
    CHECK(sweep.run(retried, kGoodStudy, true).failed == 0);
    CHECK(retried.started == std::vector<int>{4, 7});
    CHECK(retried.resumed == std::vector<bool>{true, true});
    CHECK(sweep.members().rows() == 12);
    CHECK(sweep.doses().rows() == 24);
}

TEST_CASE("a failed member that somebody let go on to its end is taken over as ok") {
    const Sweeping sweep;
    MadeUpRuns whole(1);
    (void)sweep.run(whole);
    const std::string good = readText(sweep.out / "members.csv");
    fs::remove_all(sweep.out);
    MadeUpRuns runs(1);
    runs.codes = {{4, 3}};
    CHECK(sweep.run(runs).failed == 1);
    const fs::path member = sweep.out / "members/0004";
    SECTION("it is over") {
        fs::copy_file(sweep.out / "members/0005/summary.json", member / "summary.json");
        fs::remove(member / kCheckpointName);
        MadeUpRuns nothing(1);
        CHECK(sweep.run(nothing).ok == 12);
        CHECK(nothing.started.empty());
        CHECK(readText(sweep.out / "members.csv") == good);  // its status and error too
        CHECK(sweep.doses().rows() == 24);
    }
    SECTION("it goes on") {
        fs::copy_file(sweep.out / "members/0005/summary.json", member / "summary.json");
        MadeUpRuns nothing(1);
        CHECK(sweep.run(nothing).failed == 1);
        CHECK(sweep.members().text(4, "error") == "particle 7, \"lost\"");
    }
}

TEST_CASE("a checkpoint that cannot be read is given up only when failed members are to run again") {
    const Sweeping sweep;
    MadeUpRuns runs(2);
    runs.codes = {{4, 3}};
    (void)sweep.run(runs);
    std::ofstream(sweep.out / "members/0004/checkpoint.h5") << "of another age";
    MadeUpRuns nothing(2);
    CHECK(sweep.run(nothing).failed == 1);
    MadeUpRuns retried(2);
    CHECK(sweep.run(retried, kGoodStudy, true).failed == 0);
    CHECK(retried.resumed == std::vector<bool>{false});
}

TEST_CASE("doses that the table has lost come back from the members' folders") {
    const Sweeping sweep;
    MadeUpRuns runs(1);
    (void)sweep.run(runs);
    const fs::path table = sweep.out / "doses.csv";
    const std::string good = readText(table);
    SECTION("deleted") {
        fs::remove(table);
    }
    SECTION("emptied") {
        fs::resize_file(table, 0);
    }
    SECTION("cut off") {
        fs::resize_file(table, good.size() / 2);
    }
    SECTION("another number in it") {
        std::string other = good;
        const std::size_t digit = other.find_last_of("123456789");
        REQUIRE(digit != std::string::npos);
        other[digit] = other[digit] == '1' ? '2' : '1';
        std::ofstream(table) << other;
    }
    SECTION("a line twice") {
        std::ofstream(table) << good + good.substr(good.rfind('\n', good.size() - 2) + 1);
    }
    SECTION("a member's folder gone, the table whole") {
        fs::remove_all(sweep.out / "members/0003");
    }
    MadeUpRuns nothing(1);
    CHECK(sweep.run(nothing).ok == 12);
    CHECK(nothing.started.empty());
    CHECK(readText(table) == good);
}

TEST_CASE("a figure that a member does not have goes from its row") {
    const Sweeping sweep;
    MadeUpRuns runs(1);
    (void)sweep.run(runs);
    const fs::path file = sweep.out / "members.csv";
    const std::string good = readText(file);
    const Table table = Table::read(file);
    for (const char* name : {"overshoot_kg", "steady_rate_kg_s"}) {  // of doses to a mass; of the rate
        CAPTURE(name);
        std::string text = csvLine(table.names()) + "\n";
        for (std::size_t i = 0; i < table.rows(); ++i) {
            Row row = table.row(i);
            const auto column = std::find(table.names().begin(), table.names().end(), name) - table.names().begin();
            if (i == 2) {
                REQUIRE(row[std::size_t(column)].empty());
                row[std::size_t(column)] = "0.25";
            }
            text += csvLine(row) + "\n";
        }
        std::ofstream(file) << text;
        MadeUpRuns nothing(1);
        CHECK(sweep.run(nothing).ok == 12);
        CHECK(readText(file) == good);
    }
}

TEST_CASE("a sweep does not go on in a table that lacks a column, and leaves it as it is") {
    const Sweeping sweep;
    MadeUpRuns runs(1);
    (void)sweep.run(runs);
    const std::string name = GENERATE("members.csv", "doses.csv");
    const fs::path table = sweep.out / name;
    std::istringstream lines(readText(table));
    std::ofstream cut(table);
    for (std::string line; std::getline(lines, line);) cut << line.substr(0, line.rfind(',')) << "\n";
    cut.close();
    const std::string before = readText(table);
    MadeUpRuns nothing(1);
    CHECK_THROWS_WITH(sweep.run(nothing), Catch::Contains("columns of " + name) &&
                                              Catch::Contains("it has no column ") &&
                                              Catch::Contains("give another folder with --out"));
    CHECK(nothing.started.empty());
    CHECK(readText(table) == before);
}

TEST_CASE("results that were edited in the table come back from the members' folders") {
    const Sweeping sweep;
    MadeUpRuns runs(1);
    (void)sweep.run(runs);
    const fs::path table = sweep.out / "members.csv";
    const std::string good = readText(table), time = ",1.5,";
    std::string other = good;
    const std::size_t at = other.rfind(time);
    REQUIRE(at != std::string::npos);
    SECTION("a number") {
        other.replace(at, time.size(), ",2.5,");
    }
    SECTION("no number") {
        other.replace(at, time.size(), ",1.\xd5,");
    }
    SECTION("nothing") {
        other.replace(at, time.size(), ",,");
    }
    SECTION("a row twice") {
        const std::size_t row = other.rfind('\n', at);
        other.insert(row, other.substr(row, other.find('\n', at) - row));
    }
    SECTION("a value where there is none") {
        REQUIRE(other[at - 1] == ',');
        other.insert(at, "3");
    }
    std::ofstream(table) << other;
    MadeUpRuns nothing(1);
    CHECK(sweep.run(nothing).ok == 12);
    CHECK(nothing.started.empty());
    CHECK(readText(table) == good);
}

TEST_CASE("a result that a member's folder does not tell stays as the table has it") {
    const Sweeping sweep;
    MadeUpRuns runs(1);
    (void)sweep.run(runs);
    std::ofstream(sweep.out / "members" / "0011" / "summary.json") << R"({"error": null, "stop_reason": "dose_count"})";
    const std::string good = readText(sweep.out / "members.csv");
    MadeUpRuns nothing(1);
    CHECK(sweep.run(nothing).ok == 12);
    CHECK(readText(sweep.out / "members.csv") == good);
}

TEST_CASE("an interrupted sweep goes on with the members that had begun, from their checkpoints") {
    const Sweeping sweep;
    MadeUpRuns runs(2);
    const Halt why = GENERATE(Halt::Interrupted, Halt::TimeIsUp);
    Halt now = Halt::None;
    runs.onEnd = [&] { now = runs.started.size() >= 5 ? why : Halt::None; };
    const SweepOutcome outcome = sweep.run(runs, kGoodStudy, false, [&] { return now; });
    CHECK_FALSE(outcome.whole);
    CHECK(outcome.halt == why);
    CHECK(outcome.ok == 4);
    CHECK(outcome.members == 12);
    // None of those that have yet to end has come to a first sample.
    std::set<std::string> ended;
    for (std::size_t row = 0; row < 4; ++row) ended.insert(sweep.members().text(row, "member"));
    double work = 0;
    for (const Member& m : membersOf(sweep.place.study()))
        if (!ended.contains(std::to_string(m.number))) work += m.expectedWork;
    CHECK(outcome.workLeft == Approx(work));
    const std::vector<int> cut = sweep.members().rows() == 5 ? std::vector<int>{} : std::vector<int>{-1};
    REQUIRE(cut.empty());
    const Table between = sweep.members();
    CHECK(between.text(4, "status") == "interrupted");
    const int number = std::stoi(between.row(4)[0]);

    MadeUpRuns rest(2);
    CHECK(sweep.run(rest).ok == 12);
    CHECK(rest.started.size() == 8);
    const auto at = std::find(rest.started.begin(), rest.started.end(), number);
    REQUIRE(at != rest.started.end());
    CHECK(rest.resumed[std::size_t(at - rest.started.begin())]);
    CHECK(std::count(rest.resumed.begin(), rest.resumed.end(), true) == 1);
    CHECK(sweep.members().rows() == 12);
    CHECK(sweep.doses().rows() == 24);
}

TEST_CASE("what is left counts a bed that several members have once, and what has been done of a member not at all") {
    const Sweeping sweep;
    const std::string text =
        "base = \"good.toml\"\n[set]\nsettle.time_s = 0.1\nsettle.kc_over_k = 0.3\n"
        "[[axis]]\nkey = \"contact.kc_over_k\"\nvalues = [0.1, 0.2, 0.4]\n";
    MadeUpRuns none(2);
    none.beds = true;
    const SweepOutcome outcome = sweep.run(none, text, false, [] { return Halt::TimeIsUp; });
    CHECK(none.started.empty());
    const std::vector<Member> members = sweep.place.members(text);
    REQUIRE(bedsOf(members).size() == 1);
    const double each = members[0].expectedWork, settling = members[0].settlingWork;
    REQUIRE(settling > 0);
    CHECK(outcome.workLeft == Approx(3 * each - 2 * settling));

    const fs::path begun = sweep.out / "members/0001";
    fs::create_directories(begun);
    std::ofstream(begun / kCheckpointName) << "state";
    std::ofstream(begun / "timeseries.csv") << "time_s\n" << members[1].expectedTime / 4 << "\n";
    const SweepOutcome later = sweep.run(none, text, false, [] { return Halt::TimeIsUp; });
    CHECK(later.workLeft == Approx(3 * each - settling - each / 4).epsilon(1e-4));
}

TEST_CASE("a runner may put the members into another order, knowing what is left of each") {
    const Sweeping sweep;
    const Study study = sweep.place.study();
    const std::vector<Member> members = membersOf(study);
    // Of member 3 a third is done.
    const fs::path begun = SweepFolder(sweep.out, study, members).memberFolder(3);
    fs::create_directories(begun);
    std::ofstream(begun / kCheckpointName) << "state";
    std::ofstream(begun / "timeseries.csv") << "time_s\n" << members[3].expectedTime / 3 << "\n";
    MadeUpRuns runs(2);
    runs.backwards = true;
    CHECK(sweep.run(runs).ok == 12);
    CHECK(runs.started == std::vector<int>{11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0});
    REQUIRE(runs.steps.size() == 12);
    for (const Member& m : members) {
        const double whole = m.expectedWork / double(m.particles);
        // The time stands in the table with six digits.
        CHECK(runs.steps[m.number] == Approx(m.number == 3 ? whole * 2 / 3 : whole).epsilon(1e-5));
    }
    for (int i = 0; i < 12; ++i) CHECK(sweep.members().row(std::size_t(i))[0] == std::to_string(i));
}

TEST_CASE("a torn row, and doses of a member without a row, are cut out and made again") {
    const Sweeping sweep;
    MadeUpRuns runs(1);
    (void)sweep.run(runs);
    const std::string members = readText(sweep.out / "members.csv"), doses = readText(sweep.out / "doses.csv");
    // As if killed while writing the row of member 11, whose run is over: it is noted, not run again.
    std::ofstream(sweep.out / "members.csv") << members.substr(0, members.size() - 9);
    MadeUpRuns again(1);
    CHECK(sweep.run(again).ok == 12);
    CHECK(again.started.empty());
    CHECK(readText(sweep.out / "members.csv") == members);
    CHECK(readText(sweep.out / "doses.csv") == doses);
}

TEST_CASE("a study that has changed is refused, one that has only grown goes on") {
    const Sweeping sweep;
    MadeUpRuns runs(1);
    (void)sweep.run(runs);
    const std::string before = readText(sweep.out / "members.csv");
    struct Change {
        std::string from, to, says;
    };
    for (const Change& change : std::vector<Change>{
             {"[4, 9]", "[9, 4]", "member 0 was another point"},
             {"[4, 9]", "[4]", "member 6 of members.csv is no longer in it"},
             {"[0.2, 0.50]", "[0.2, 0.6]", "member 3 was another point"},
             {"[0.2, 0.50]", "[0.2, 0.50, 0.6]", "member 6 was another point"},
             {"\"contact.kc_over_k\"", "\"contact.friction\"", "varies other keys"},
             {"\"stop.max_doses\" = 2", "\"stop.max_doses\" = 3", "member 0 was another case"},
         }) {
        MadeUpRuns none(1);
        CAPTURE(change.to);
        CHECK_THROWS_WITH(sweep.run(none, replaced(kGoodStudy, change.from, change.to)),
                          Catch::Contains(change.says) && Catch::Contains("study.toml has changed"));
        CHECK(none.started.empty());
        CHECK(readText(sweep.out / "members.csv") == before);
        CHECK(readText(sweep.out / "study.toml") == kGoodStudy);
    }
    // A case that tells its reason is the same case.
    (void)sweep.place.write("good.toml", replaced(kGoodCase, "seed = 3", "reason = \"a sample\"\nseed = 3"));
    MadeUpRuns none(1);
    CHECK(sweep.run(none).ok == 12);
    CHECK(none.started.empty());
    MadeUpRuns more(1);
    CHECK(sweep.run(more, replaced(kGoodStudy, "[4, 9]", "[4, 9, 11]")).ok == 18);
    CHECK(more.started == std::vector<int>{12, 13, 14, 15, 16, 17});
    CHECK(readText(sweep.out / "members.csv").substr(0, before.size()) == before);
}

TEST_CASE("with a single seed values may be added to the first axis") {
    const Sweeping sweep;
    const std::string single = replaced(kGoodStudy, "[4, 9]", "[4]");
    MadeUpRuns runs(1);
    (void)sweep.run(runs, single);
    MadeUpRuns more(1);
    CHECK(sweep.run(more, replaced(single, "[0.2, 0.50]", "[0.2, 0.50, 0.6]")).ok == 9);
    CHECK(more.started == std::vector<int>{6, 7, 8});
}

TEST_CASE("progress does not climb over members that Ctrl-C cut short") {
    struct Watch : SweepObserver {
        void onProgress(const SweepProgress& p) override { fractions.push_back(p.fraction); }
        std::vector<double> fractions;
    } watch;
    const Sweeping sweep;
    MadeUpRuns runs(3);
    Halt now = Halt::None;
    runs.onEnd = [&] { now = Halt::Interrupted; };  // after the first of twelve
    const SweepOutcome outcome = sweep.run(
        runs, kGoodStudy, false, [&] { return now; }, &watch);
    CHECK_FALSE(outcome.whole);
    REQUIRE(watch.fractions.size() == 3);  // one ended, two were cut short before they did anything
    CHECK(watch.fractions[0] > 0);
    CHECK(watch.fractions[2] == Approx(watch.fractions[0]));
}
