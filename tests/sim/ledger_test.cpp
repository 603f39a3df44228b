#include "host/sim/ledger.h"

#include <limits>

#include "host/core/error.h"
#include "tests/support/catch.h"

using namespace vkdose;

namespace {

Sensors balanced() {
    Sensors s;
    s.count = {70, 20, 10, 0};
    s.mass = {0.7, 0.2, 0.1, 0.0};
    return s;
}

}  // namespace

TEST_CASE("a balanced ledger closes") {
    Ledger ledger(100, 1.0);
    CHECK_NOTHROW(ledger.close(balanced(), 0.5));
    CHECK(ledger.closings() == 1);
    CHECK(ledger.worstMassError() < 1e-15);
}

TEST_CASE("mass may be off by rounding in single precision, not by more") {
    Ledger ledger(100, 1.0);
    Sensors s = balanced();
    s.mass[0] += 0.9e-6;
    CHECK_NOTHROW(ledger.close(s, 0));
    CHECK(ledger.worstMassError() == Approx(0.9e-6).epsilon(1e-6));
    s.mass[0] = 0.7 + 1.1e-6;
    CHECK_THROWS_AS(ledger.close(s, 0), RunError);
    s.mass[0] = 0.7 - 1.1e-6;
    CHECK_THROWS_AS(ledger.close(s, 0), RunError);
}

TEST_CASE("a ledger that does not balance stops the run") {
    Ledger ledger(100, 1.0);
    Sensors s = balanced();
    SECTION("a particle too few") {
        s.count[0] = 69;
    }
    SECTION("a particle too many") {
        s.count[1] = 21;
    }
    SECTION("a lost particle, though everything adds up") {
        s.count = {69, 20, 10, 1};
        s.mass = {0.69, 0.2, 0.1, 0.01};
    }
    SECTION("NaN") {
        s.mass[1] = std::numeric_limits<double>::quiet_NaN();
    }
    SECTION("infinity") {
        s.mass[0] = std::numeric_limits<double>::infinity();
    }
    SECTION("a negative mass that another makes up for") {
        s.mass[0] = 1.0;
        s.mass[1] = -0.1;
    }
    SECTION("a dosed particle comes back") {
        ledger.close(balanced(), 0);
        s.count = {71, 20, 9, 0};
        s.mass = {0.71, 0.2, 0.09, 0.0};
    }
    CHECK_THROWS_AS(ledger.close(s, 1.0), RunError);
}

TEST_CASE("the message names the regions and the time") {
    Ledger ledger(100, 1.0);
    Sensors s = balanced();
    s.count = {69, 20, 10, 1};
    CHECK_THROWS_WITH(ledger.close(s, 1.25), Catch::Contains("1.25 s") && Catch::Contains("1 particle left") &&
                                                 Catch::Contains("throat 20") && Catch::Contains("filled 100"));
}

TEST_CASE("an empty filling balances only when nothing is there") {
    Ledger ledger(0, 0);
    CHECK_NOTHROW(ledger.close(Sensors{}, 0));
    Sensors s;
    s.mass[0] = 1e-9;
    CHECK_THROWS_AS(ledger.close(s, 0), RunError);
}
