// The reference backend against traces of another program (tests/oracle): the same law, the same integrator, written by
// other people. Both work in double precision and the tables carry ten digits, so that agreement is close: differences
// grow from 1e-10 only where a contact slips or parts.

#include "host/backend/reference/contact.h"
#include "tests/law/setups.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"
#include "tests/support/table.h"

using namespace vkdose;
using namespace vkdose::test;
using namespace vkdose::reference;

namespace {

double overlapOfPair(const Particles& p) {
    return 2 * kRadius - glm::length(p.position[0] - p.position[1]);
}

Stepper headOn(double kcRatio, double speed, double dt) {
    Particles two;
    two.add(Vec3(0), kRadius, Vec3(speed / 2, 0, 0));
    two.add(Vec3(2 * kRadius, 0, 0), kRadius, Vec3(-speed / 2, 0, 0));
    return Stepper(freeWorld(paperParameters(kcRatio), dt), two);
}

}  // namespace

TEST_CASE("oracle: head-on trace of overlap, force, history and velocity") {
    for (const double kcRatio : {0.0, 0.873}) {
        const double speed = 0.2, dt = 1e-7;
        Stepper run = headOn(kcRatio, speed, dt);
        double peakOverlap = 0, peakForce = 0;
        const std::vector<TableRow> rows =
            oracleTable(kcRatio > 0 ? "head_on_trace_kc0.873_v0.20.csv" : "head_on_trace_kc0.000_v0.20.csv");
        for (const TableRow& row : rows) {
            peakOverlap = std::max(peakOverlap, row.at("overlap_m"));
            peakForce = std::max(peakForce, row.at("normal_force_N"));
        }
        for (const TableRow& row : rows) {
            const int target = static_cast<int>(std::lround(row.at("time_s") / dt));
            while (run.steps() <= target) run.step();  // `full` is now the state at the row's time
            CAPTURE(kcRatio, row.at("time_s"));
            CHECK(near(overlapOfPair(run.full()), row.at("overlap_m"), peakOverlap, 1e-8));
            const double rate = run.full().velocity[0].x - run.full().velocity[1].x;
            CHECK(near(rate, row.at("rel_velocity_m_s"), speed, 1e-8));
            const double force = -run.kick().x / (target == 0 ? dt / 2 : dt) * massOf(kRadius);
            CHECK(near(force, row.at("normal_force_N"), peakForce, 1e-8));
            const std::vector<Contact> contacts = run.backend().contacts();
            if (row.at("overlap_m") > 0) {
                REQUIRE(contacts.size() == 1);
                CHECK(near(contacts[0].maxOverlap, row.at("history_max_overlap_m"), peakOverlap, 1e-8));
            } else {
                CHECK(contacts.empty());
            }
        }
    }
}

TEST_CASE("oracle: head-on summary of peak, rebound and sticking") {
    for (const TableRow& row : oracleTable("head_on_summary.csv")) {
        const double speed = row.at("impact_speed_m_s"), dt = row.at("dt_s");
        Stepper run = headOn(row.at("kc_over_k"), speed, dt);
        const int steps = static_cast<int>(std::lround(row.at("t_end_s") / dt));
        CAPTURE(row.at("kc_over_k"), speed, dt);
        // The row that sticks runs for 4 ms; 1e-8 s steps would only repeat it.
        if (steps > 100000) continue;
        double peak = 0, strongest = 0, weakest = 0;
        while (run.steps() <= steps) {
            run.step();
            const double force = -run.kick().x / (run.steps() == 1 ? dt / 2 : dt) * massOf(kRadius);
            peak = std::max(peak, overlapOfPair(run.full()));
            strongest = std::max(strongest, force);
            weakest = std::min(weakest, force);
        }
        CHECK(near(peak, row.at("peak_overlap_m"), row.at("peak_overlap_m"), 1e-8));
        CHECK(near(strongest, row.at("peak_force_N"), row.at("peak_force_N"), 1e-8));
        CHECK(near(weakest, row.at("min_force_N"), row.at("peak_force_N"), 1e-8));
        CHECK(near(overlapOfPair(run.full()), row.at("overlap_at_end_m"), row.at("peak_overlap_m"), 1e-8));
        const double rebound = run.full().velocity[1].x - run.full().velocity[0].x;
        CHECK(near(rebound, row.at("rebound_rel_speed_m_s"), speed, 1e-8));
        CHECK(run.touching() == (row.at("separated") == 0));
    }
}

namespace {

/// A touch deeper than the rounding of 1.25 mm and far below all else: the oracle's spheres start in contact.
Body aboutToTouch(const TableRow& row) {
    const Vec3 velocity(row.at("vt_in_m_s"), row.at("vn_in_m_s"), 0);
    return {Vec3(0, kRadius * (1 - 1e-12), 0), velocity, Vec3(0), kRadius};
}

ContactParameters parametersOf(const TableRow& row) {
    return paperParameters(row.at("kc_over_k"), row.at("mu"), row.at("mu_r"));
}

struct Impact {
    Body out;  ///< at the full step
    double peak = 0;
    bool touching = false;
};

/// The contact law alone in a velocity Verlet loop that, like the oracle's, advances the springs in the very first
/// evaluation too. (backend.h leaves them at rest there, which is half a step nearer the truth.)
Impact oracleLoop(const TableRow& row) {
    const double dt = row.at("dt_s"), m = massOf(kRadius), inertia = 0.4 * m * kRadius * kRadius;
    const ContactLaw law = lawOf(parametersOf(row));
    const int steps = static_cast<int>(std::lround(row.at("t_end_s") / dt));
    Impact impact{aboutToTouch(row)};
    Body& b = impact.out;
    History history;
    const auto halfKick = [&](const Response& r) {
        b.velocity += dt / 2 / m * r.force;
        b.spin += dt / 2 / inertia * r.torqueI;
    };
    const auto response = [&]() {
        const auto touch = touchWall(b, Vec3(0, 1, 0), b.position.y, geometry::Moving{});
        impact.touching = touch.has_value();
        impact.peak = std::max(impact.peak, kRadius - b.position.y);
        if (touch) return contactResponse(law, pairOf(ContactClass::ParticleWall), *touch, dt, history);
        history = {};
        return Response{Vec3(0), Vec3(0), Vec3(0), Vec3(0)};
    };
    Response r = response();
    for (int n = 0; n < steps; ++n) {
        halfKick(r);
        b.position += dt * b.velocity;
        r = response();
        halfKick(r);
    }
    return impact;
}

}  // namespace

TEST_CASE("oracle: oblique impacts on a plane, the law in the oracle's own loop") {
    for (const TableRow& row : oracleTable("oblique_wall.csv")) {
        const Impact impact = oracleLoop(row);
        const Body& b = impact.out;
        CAPTURE(row.at("dt_s"), row.at("kc_over_k"), row.at("mu"), row.at("mu_r"), row.at("angle_from_normal_deg"));
        CHECK(impact.touching == (row.at("separated") == 0));
        CHECK(near(impact.peak, row.at("peak_overlap_m"), row.at("peak_overlap_m"), 1e-8));
        CHECK(near(b.velocity.x, row.at("vt_out_m_s"), 1, 1e-8));
        CHECK(near(b.velocity.y, row.at("vn_out_m_s"), 1, 1e-8));
        CHECK(near(b.spin.z * kRadius, row.at("omega_out_rad_s") * kRadius, 1, 1e-8));
        CHECK(near(b.position.x, row.at("tangential_shift_m"), impact.peak, 1e-7));
    }
}

namespace {

/// The backend about to make the row's first step, with the oracle's first spring advance, v_t dt, in its contact: the
/// backend's own springs begin at rest. At the larger time step an allowance for that, v_t dt sqrt(7/2 k_t/m) in
/// surface speed, would exceed the spin itself in 14 of 24 rows: no friction at all would pass.
Stepper oracleStart(const TableRow& row, const ContactParameters& p) {
    const Body start = aboutToTouch(row);
    Particles one;
    one.add(start.position, kRadius, start.velocity);
    Stepper run(planeWorld(p, row.at("dt_s")), one);
    const Record before = run.backend().snapshot();
    run.backend().advance(1, 0);  // makes the contact
    Record record = run.backend().snapshot();
    std::vector<double> history = record.get<double>("contact_numbers");
    const Vec3 spring(row.at("vt_in_m_s") * row.at("dt_s"), 0, 0);
    history.at(1) = spring.x;  // after delta_max; the next line but two makes sure
    for (const char* name : {"position", "velocity", "spin"}) record.put(name, before.get<double>(name));
    record.putOne("steps", before.one<std::uint64_t>("steps"));
    record.put("contact_numbers", std::move(history));
    run.backend().restore(record);
    REQUIRE(run.backend().contacts().size() == 1);
    REQUIRE(run.backend().contacts()[0].sliding == spring);
    return run;
}

/// The sphere at the row's end, at the full step.
Body afterImpact(const TableRow& row, const ContactParameters& p) {
    Stepper run = oracleStart(row, p);
    const int steps = static_cast<int>(std::lround(row.at("t_end_s") / row.at("dt_s")));
    while (run.steps() <= steps) run.step();
    return {run.full().position[0], run.full().velocity[0], run.full().spin[0], kRadius};
}

/// Both make the same steps, so that what is left is the tables' tenth digit: of the 400 rad/s that friction can give
/// it is 4e-8 rad/s, half a millionth of the spin in the row where rolling friction leaves least of it, 0.09 rad/s.
Verdict spinsLike(const TableRow& row, const Body& b) {
    return nearRelative(b.spin.z, row.at("omega_out_rad_s"), 1e-6);
}

}  // namespace

TEST_CASE("oracle: oblique impacts on a plane, the backend") {
    for (const TableRow& row : oracleTable("oblique_wall.csv")) {
        const Body b = afterImpact(row, parametersOf(row));
        CAPTURE(row.at("dt_s"), row.at("kc_over_k"), row.at("mu"), row.at("mu_r"), row.at("angle_from_normal_deg"));
        CHECK(near(b.velocity.x, row.at("vt_out_m_s"), 1, 1e-8));
        CHECK(near(b.velocity.y, row.at("vn_out_m_s"), 1, 1e-8));
        CHECK(spinsLike(row, b));
    }
}

TEST_CASE("oracle: oblique impacts with the wrong friction are told from those with the right one, row by row") {
    for (const TableRow& row : oracleTable("oblique_wall.csv")) {
        CAPTURE(row.at("dt_s"), row.at("kc_over_k"), row.at("mu"), row.at("mu_r"), row.at("angle_from_normal_deg"));
        ContactParameters none = parametersOf(row), noRolling = parametersOf(row);
        none.mu = 0;
        CHECK_FALSE(spinsLike(row, afterImpact(row, none)));
        if (noRolling.muR == 0) continue;
        noRolling.muR = 0;
        CHECK_FALSE(spinsLike(row, afterImpact(row, noRolling)));
    }
}

TEST_CASE("oracle: a sphere on a tilted plane sticks, slides, rolls or is braked") {
    std::unique_ptr<Stepper> run;
    double running = -1;
    for (const TableRow& row : oracleTable("plane_roll.csv")) {
        const double dt = row.at("dt_s");
        if (row.at("case") != running) {
            running = row.at("case");
            const ContactParameters p = paperParameters(row.at("kc_over_k"), row.at("mu"), row.at("mu_r"));
            const double tilt = row.at("tilt_deg") * kPi / 180;
            RuledWorld world = planeWorld(p, dt);
            world.gravity = kGravity * Vec3(std::sin(tilt), -std::cos(tilt), 0);
            Particles one;
            // The table gives the height with ten digits, too few for an overlap of 2e-8 m: the formula of its README.
            const double sinking = massOf(kRadius) * kGravity * std::cos(tilt) / p.k1;
            one.add(Vec3(0, kRadius - sinking, 0), kRadius, Vec3(row.at("x0dot_m_s"), 0, 0),
                    Vec3(0, 0, row.at("omega_z_rad_s")));
            run = std::make_unique<Stepper>(world, one);
        }
        const int target = static_cast<int>(std::lround(row.at("time_s") / dt));
        while (run->steps() <= target) run->step();
        CAPTURE(running, row.at("time_s"), row.at("mu"), row.at("mu_r"), row.at("tilt_deg"));
        const Particles& now = run->full();
        const double speed = kGravity * 0.05;  // what free fall would reach by the end of the rows
        CHECK(near(now.velocity[0].x, row.at("vx_m_s"), speed, 1e-7));
        CHECK(near(now.velocity[0].y, row.at("vy_m_s"), speed, 1e-7));
        CHECK(near(now.spin[0].z * kRadius, row.at("omega_z_rad_s") * kRadius, speed, 1e-7));
        CHECK(near(now.position[0].x, row.at("x_m"), kRadius, 1e-7));
        CHECK(near(kRadius - now.position[0].y, row.at("overlap_m"), 2e-8, 1e-4));
    }
}
