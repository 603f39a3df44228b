#include "host/report/expected.h"

#include <cmath>
#include <limits>

#include "host/core/error.h"
#include "host/report/toml_values.h"
#include "tests/app/sandbox.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::report;
using vkdose::test::Sandbox;

namespace {

const double kNone = std::numeric_limits<double>::quiet_NaN();

/// A point at these settings, on one axis each, with this beta [g/dose].
Point at(const std::vector<std::pair<std::string, double>>& settings, double beta, double error = kNone) {
    Point p;
    for (const auto& [key, value] : settings) {
        p.keys[key] = {std::to_string(value), value};
        p.places.push_back({{key}, std::to_string(value)});
    }
    p.outputs["beta_kg_per_dose"] = {beta * 1e-3, error * 1e-3};
    return p;
}

Expected value(double grams) {
    Expected e;
    e.quantity = "beta_kg_per_dose";
    e.value = grams * 1e-3;
    return e;
}

Expected trend(Kind kind, const std::string& along) {
    Expected e;
    e.kind = kind;
    e.quantity = "beta_kg_per_dose";
    e.along = along;
    return e;
}

}  // namespace

TEST_CASE("a value matches, is within some per cent, or contradicts") {
    CHECK(judge(value(3.7), {at({}, 3.8)}).kind == Verdict::Kind::Matches);
    const Verdict within = judge(value(4), {at({}, 4.41)});
    CHECK(within.kind == Verdict::Kind::Within);
    CHECK(within.text == "within 11 %");  // 10.25, never told as less than it is
    CHECK(within.found == "4.41 g");
    const Verdict off = judge(value(4), {at({}, 5.2)});
    CHECK(off.kind == Verdict::Kind::Contradicts);
    CHECK(off.text == "contradicts (+30 %)");
    CHECK(judge(value(3.7), {}).kind == Verdict::Kind::NotRun);
    CHECK(judge(value(3.7), {at({}, kNone)}).kind == Verdict::Kind::NotRun);
}

TEST_CASE("a figure that is not to be exceeded") {
    Expected e = value(4);
    e.kind = Kind::AtMost;
    CHECK(judge(e, {at({}, 0)}).kind == Verdict::Kind::Matches);
    CHECK(judge(e, {at({}, 4.5)}).kind == Verdict::Kind::Within);
    CHECK(judge(e, {at({}, 6)}).kind == Verdict::Kind::Contradicts);
}

TEST_CASE("two standard errors are no contradiction, and large ones no match") {
    CHECK(judge(value(4), {at({}, 4.6, 0.35)}).kind == Verdict::Kind::Matches);
    for (const double found : {4.0, 5.2}) {
        const Verdict open = judge(value(4), {at({}, found, 0.7)});
        CHECK(open.kind == Verdict::Kind::NotJudged);
        CHECK(open.text == "known to 35 % only");
    }
    CHECK(judge(value(4), {at({}, 5.2, 0.5)}).kind == Verdict::Kind::Contradicts);
}

TEST_CASE("only points that carry the conditions count") {
    Expected e = value(3.7);
    e.where["contact.kc_over_k"] = {"0.872", 0.872};
    const Point near = at({{"contact.kc_over_k", 0.873}}, 3.7), far = at({{"contact.kc_over_k", 0.6}}, 9);
    CHECK(judge(e, {far}).kind == Verdict::Kind::NotRun);
    CHECK(judge(e, {far, near}).kind == Verdict::Kind::Matches);
    e.where["coil.hand"] = {"left", kNone};
    CHECK(judge(e, {near}).kind == Verdict::Kind::NotRun);
}

TEST_CASE("a trend holds on every line or not at all") {
    const Expected falls = trend(Kind::Falls, "k");
    const std::vector<Point> down{at({{"k", 2}}, 3), at({{"k", 1}}, 4), at({{"k", 3}}, 2)};  // in any order
    CHECK(judge(falls, down).kind == Verdict::Kind::TrendHolds);
    CHECK(judge(falls, down).found == "4 g to 2 g");
    CHECK(judge(trend(Kind::Rises, "k"), down).kind == Verdict::Kind::Contradicts);

    std::vector<Point> lines;
    for (const double mu : {0.3, 0.5})
        for (const double k : {1.0, 2.0, 3.0}) lines.push_back(at({{"k", k}, {"mu", mu}}, mu == 0.3 ? 5 - k : 1 + k));
    const Verdict half = judge(falls, lines);
    CHECK(half.kind == Verdict::Kind::Contradicts);
    CHECK(half.text == "contradicts in 1 of 2");
}

TEST_CASE("a step against the trend is forgiven within its error, not beyond") {
    const auto bump = [](double error) {
        return std::vector<Point>{at({{"k", 1}}, 4, error), at({{"k", 2}}, 3, error), at({{"k", 3}}, 3.2, error)};
    };
    CHECK(judge(trend(Kind::Falls, "k"), bump(0.1)).kind == Verdict::Kind::TrendHolds);  // 0.2 against 2 x 0.14
    CHECK(judge(trend(Kind::Falls, "k"), bump(0.05)).kind == Verdict::Kind::Contradicts);
    CHECK(judge(trend(Kind::Falls, "k"), bump(kNone)).kind == Verdict::Kind::Contradicts);
}

TEST_CASE("what stays the same neither falls nor rises") {
    const std::vector<Point> level{at({{"k", 1}}, 4), at({{"k", 2}}, 4)};
    CHECK(judge(trend(Kind::Falls, "k"), level).kind == Verdict::Kind::Contradicts);
    CHECK(judge(trend(Kind::Rises, "k"), level).kind == Verdict::Kind::Contradicts);
}

TEST_CASE("independent and linear, to what the table allows") {
    Expected flat = trend(Kind::Independent, "m");
    flat.matches = 0.1;
    CHECK(judge(flat, {at({{"m", 60}}, 3.7), at({{"m", 100}}, 3.4)}).kind == Verdict::Kind::TrendHolds);
    CHECK(judge(flat, {at({{"m", 60}}, 3.7), at({{"m", 100}}, 3.2)}).kind == Verdict::Kind::Contradicts);
    Expected line = trend(Kind::Linear, "t");
    const std::vector<Point> straight{at({{"t", 1}}, 2), at({{"t", 2}}, 4.1), at({{"t", 4}}, 8)};
    const std::vector<Point> bent{at({{"t", 1}}, 2), at({{"t", 2}}, 6), at({{"t", 4}}, 8)};
    CHECK(judge(line, straight).kind == Verdict::Kind::TrendHolds);
    CHECK(judge(line, bent).kind == Verdict::Kind::Contradicts);
}

TEST_CASE("one point along the key is no trend") {
    CHECK(judge(trend(Kind::Falls, "k"), {at({{"k", 1}}, 4)}).kind == Verdict::Kind::NotRun);
    CHECK(judge(trend(Kind::Falls, "k"), {at({{"j", 1}}, 4), at({{"j", 2}}, 3)}).kind == Verdict::Kind::NotRun);
}

TEST_CASE("a trend says how many of its points have the quantity, and three make a line") {
    const std::vector<Point> half{at({{"k", 1}}, kNone), at({{"k", 2}}, 4), at({{"k", 3}}, 3)};
    const Verdict v = judge(trend(Kind::Falls, "k"), half);
    CHECK(v.kind == Verdict::Kind::TrendHolds);
    CHECK(v.found == "4 g to 3 g (2 of 3 points have it)");
    CHECK(judge(trend(Kind::Linear, "k"), half).kind == Verdict::Kind::NotRun);
}

TEST_CASE("the cumulative mass after a dose is a quantity too") {
    Expected e = value(12);
    e.quantity = "cumulative_mass_kg";
    e.dose = 3;
    Point p;
    p.cumulative = {4e-3, 8e-3, 12e-3};
    CHECK(judge(e, {p}).kind == Verdict::Kind::Matches);
    e.dose = 4;
    CHECK(judge(e, {p}).kind == Verdict::Kind::NotRun);
}

TEST_CASE("faults of a table are told, all at once") {
    const Sandbox box;
    const auto file =
        box.write("e.toml",
                  "[[expected]]\nid = \"S1\"\nwhat = \"x\"\nsection = \"y\"\nkind = \"valeu\"\n"
                  "[[expected]]\nid = \"S2\"\nwhat = \"x\"\nsection = \"y\"\nkind = \"falls\"\nquantity = \"betta\"\n"
                  "speed = 2\nwhere = { gravity = [0, 1, 0], coil.at = [0, 1] }\n");
    try {
        readExpected(file);
        FAIL("accepted");
    } catch (const CaseError& e) {
        REQUIRE(e.faults().size() == 6);
        CHECK_THAT(e.faults()[0].text(),
                   Catch::Contains("e.toml:5: kind = \"valeu\": is not known; known: value, at most"));
        CHECK_THAT(e.faults()[1].text(), Catch::Contains("e.toml:12: speed = 2"));
        CHECK_THAT(e.faults()[3].text(), Catch::Contains("e.toml:13: where.gravity = [0, 1, 0]"));
        CHECK_THAT(e.faults()[2].text(), Catch::Contains("where.coil.at = [0, 1]"));
        CHECK_THAT(e.faults()[4].text(), Catch::Contains("e.toml:11: quantity = \"betta\": is no column"));
        CHECK_THAT(e.faults()[5].text(), Catch::Contains("along"));
    }
    CHECK_THROWS_AS(readExpected(box / "none.toml"), CaseError);
    CHECK_THROWS_AS(readExpected(box.write("f.toml", "[[expected\n")), CaseError);
}
