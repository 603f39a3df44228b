#include "host/analysis/closed_form.h"

#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using vkdose::test::nearRelative;

namespace {

/// Complete doses of these masses, each with this closed form [kg].
std::vector<Dose> dosesOf(const std::vector<double>& masses, double closedForm) {
    std::vector<Dose> doses;
    for (const double m : masses) {
        Dose d;
        d.mass = m;
        d.cumulative = (doses.empty() ? 0 : doses.back().cumulative) + m;
        d.closedForm = closedForm;
        d.complete = true;
        doses.push_back(d);
    }
    return doses;
}

RunResult runOf(const std::vector<double>& masses, double closedForm, double throat) {
    RunResult r;
    r.ledger = Ledger(1000, 0.048);
    r.doses = dosesOf(masses, closedForm);
    double dosed = 0;
    for (const double m : masses) dosed += m;
    auto& mass = r.last.sensors.mass;
    mass[static_cast<std::size_t>(Region::Throat)] = throat;
    mass[static_cast<std::size_t>(Region::Canister)] = 0.048 - dosed - throat;
    return r;
}

Case withCoil() {
    Case c;
    c.world.coil.emplace();
    return c;
}

}  // namespace

TEST_CASE("closed form: a mean within a factor of two is near, one beyond it either way is far") {
    CHECK_FALSE(besideClosedForm(dosesOf({2.01e-3}, 4e-3), 0.048).isFar());
    CHECK_FALSE(besideClosedForm(dosesOf({7.9e-3}, 4e-3), 0.048).isFar());
    CHECK(besideClosedForm(dosesOf({1.99e-3}, 4e-3), 0.048).isFar());
    CHECK(besideClosedForm(dosesOf({8.1e-3}, 4e-3), 0.048).isFar());
    CHECK(besideClosedForm(dosesOf({0}, 4e-3), 0.048).isFar());
    const auto two = besideClosedForm(dosesOf({1e-3, 4e-3}, 4e-3), 0.048);
    CHECK(nearRelative(two.mean, 2.5e-3, 1e-12));
    CHECK_FALSE(two.isFar());
}

TEST_CASE("closed form: only complete doses that have one count, until the canister is empty") {
    std::vector<Dose> doses = dosesOf({4e-3, 4e-3, 2e-3, 0, 0}, 4e-3);
    const auto emptied = besideClosedForm(doses, 0.010);
    CHECK(emptied.doses == 2);  // the third took what was left
    CHECK(nearRelative(emptied.mean, 4e-3, 1e-12));
    CHECK(besideClosedForm(doses, 0.048).doses == 5);
    doses.resize(2);
    doses[1].complete = false;
    CHECK(besideClosedForm(doses, 0.048).doses == 1);
    CHECK(besideClosedForm(dosesOf({4e-3}, 4e-3), 4e-3).doses == 1);  // the first dose is all there is
    CHECK(besideClosedForm(dosesOf({4e-3}, 0), 0.048).doses == 0);
    CHECK_FALSE(besideClosedForm(dosesOf({4e-3}, 0), 0.048).isFar());
    CHECK_FALSE(besideClosedForm({}, 0.048).isFar());
}

TEST_CASE("closed form: the note has both figures, and the reasons that the run's masses point to") {
    const Case c = withCoil();
    CHECK(closedFormNote(c, runOf({3e-3, 3e-3}, 4e-3, 1e-3)).empty());
    CHECK(closedFormNote(c, runOf({3e-3, 3e-3}, 0, 1e-3)).empty());

    const std::string less = closedFormNote(c, runOf({1e-3, 1.5e-3}, 4e-3, 2e-3));
    CHECK_THAT(less, Catch::StartsWith("the mean of 2 doses, 1.250 g, is 0.31 times the 4.000 g of the closed form"));
    CHECK_THAT(less, Catch::Contains("filling the throat took up to 2.000 g") &&
                         Catch::Contains("powder turns with the coil, or passes it by") &&
                         Catch::Contains("an arch keeps powder off the coil") && !Catch::Contains("runs empty"));
    // 0.1 g in the throat are no reason for 5.5 g less.
    CHECK_THAT(closedFormNote(c, runOf({1e-3, 1.5e-3}, 4e-3, 1e-4)), !Catch::Contains("throat"));
    CHECK_THAT(closedFormNote(c, runOf({1e-3}, 4e-3, 0.045)),
               Catch::StartsWith("the dose, 1.000 g,") && Catch::Contains("the canister runs empty, 2.000 g are left"));
    CHECK_THAT(closedFormNote(c, runOf({0, 0, 0}, 4e-3, 0)),
               Catch::Contains("the outlet is blocked from dose 1 on") && !Catch::Contains("arch"));
    CHECK_THAT(closedFormNote({}, runOf({1e-3}, 4e-3, 0)), Catch::Contains("powder turns with the body"));

    RunResult r = runOf({9e-3, 9e-3}, 4e-3, 2e-3);
    const std::string more = closedFormNote(c, r);
    CHECK_THAT(more, Catch::Contains("9.000 g, is 2.2 times the 4.000 g") && Catch::Contains("runs out by itself") &&
                         !Catch::Contains("before the first dose") && !Catch::Contains("arch"));
    r.dosedWhileSettling = 5e-4;
    CHECK_THAT(closedFormNote(c, r), Catch::Contains("and 0.500 g had left before the first dose"));
}
