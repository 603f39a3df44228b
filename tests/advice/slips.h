#pragma once
// Slips that a person makes in a case, and the warning that each is to have. Every warning needs one.

#include <string>
#include <vector>

namespace vkdose::test {

struct Slip {
    std::vector<std::string> overrides;
    std::string name;
    std::vector<std::string> says;  ///< words of the warning's line
    bool alone = true;              ///< no other warning follows from the slip
};

/// Slips in plain.toml, which has no warnings.
inline const std::vector<Slip> kSlips{
    {{"particles.density=1.5", "particles.mass_g=0.013"}, "density", {"1.5 g/cm3 is 1500"}, false},
    {{"particles.density=2500"}, "bulk-density", {"bulk_density = 471", "2500", "about 1.15e+03"}},
    {{"bulk_density=200"}, "bulk-density", {"is 0.14 of", "656"}},
    {{"gravity=[0, 9.81, 0]"}, "gravity", {"upwards"}},
    {{"gravity=[0, 0, -9.81]"}, "gravity", {"the coil's axis"}},
    {{"gravity=[0, -9810, 0]"}, "gravity", {"1e+03 times the earth's", "m/s2"}, false},
    {{"gravity=[0, -0.00981, 0]"}, "gravity", {"hardly moves"}, false},
    {{"canister.length_mm=40000", "coil.length_mm=50000"},
     "canister-size",
     {"canister.length_mm = 40000", "40 m large", "give 40 if it is 40 mm"},
     false},
    {{"particles.mass_g=1.5"}, "few-spheres", {"55 spheres"}, false},
    {{"particles.size.radius_min_mm=0.3"}, "size-ratio", {"7.31 times"}, false},
    {{"particles.size={distribution = \"sieve\", openings_um = [1600, 2000, 2400, 2800, 3200], "
      "retained = [100, 70, 30, 10, 0]}"},
     "sieve-cumulative",
     {"particles.size.retained", "up to 100 on the finest", "passing_percent"},
     false},
    {{"material=[{name = \"steel\"}]"}, "unused-material", {"nothing is made of \"steel\"", "or remove it"}},
    {{"contact.friction=30"}, "friction", {"contact.friction = 30", "30 degrees are 0.577"}},
    {{"contact.wall.friction=22"}, "friction", {"contact.wall.friction = 22", "0.404"}},
    {{"contact.rolling_friction=25"}, "friction", {"contact.rolling_friction = 25"}},
    {{"contact.damping=0.9"}, "overdamped", {"contact.damping = 0.9", "restitution of 0.9"}},
    {{"contact.damping=0.45"}, "restitution", {"contact.damping = 0.45", "of the smallest 0", "restitution of 0.45"}},
    // The cure is in the numbers of the file, before they are softened.
    {{"contact.damping=0.45", "contact.soften=4"},
     "restitution",
     {"contact.damping = 0.225 (softened 4 times)", "0.133 gives mean spheres a restitution of 0.45"}},
    {{"contact.k=20", "contact.damping=0.004243", "contact.soften=2"}, "overlap-weight", {"give at least 53"}, false},
    {{"contact.damping=0", "contact.k1_over_k=1"}, "restitution", {"a restitution of 1", "restitution of 0.5"}, false},
    {{"contact.k=10", "contact.damping=0.003"}, "overlap-weight", {"contact.k = 10", "give at least"}, false},
    {{"contact.k=100", "contact.damping=0.01"}, "overlap-fall", {"contact.k = 100", "m/s"}},
    {{"coil.pitch_mm=5"}, "coil-gap", {"coil.pitch_mm = 5", "2.99 mm", "0.68 of the largest"}},
    {{"coil.turns=10"}, "coil-gap", {"coil.turns = 10"}},
    {{"contact.max_overlap_ratio=0.2"}, "pinch", {"0.1 mm", "every sphere"}},
    {{"coil.length_mm=30", "coil.pitch_mm=12.5"}, "coil-end", {"ends 10 mm before the front wall", "40", "50"}},
    {{"coil.z_start_mm=20", "coil.length_mm=30"}, "coil-start", {"begins 20 mm", "stays there"}},
    {{"coil.z_start_mm=60", "coil.length_mm=30"}, "coil-start", {"beyond the front wall"}},
    {{"coil.z_start_mm=-10"}, "coil-rear", {"10 mm behind the rear wall"}},
    {{"coil.speed_rpm=0"}, "coil-rest", {"does not turn"}},
    {{"coil.speed_rpm=400"}, "coil-speed", {"1.9 times gravity", "293 rpm"}},
    {{"canister.outlet_diameter_mm=10", "coil.radius_mm=3.5", "dose.rotate_s=6"}, "outlet", {"2.3 of the largest"}},
    {{"contact.kc_over_k=0"}, "throat", {"Bond number at most 0", "degrees", "give a throat of"}, false},
    {{"dose.rotate_s=0.05", "coil.speed_rpm=60"}, "throat-empty", {"doses fill the throat"}, false},
    {{"dose.mass_g=3", "dose.max_rotate_s=1", "coil.speed_rpm=30"},
     "dose-time",
     {"dose.max_rotate_s = 1", "by the closed form 3 g take", "give at least"},
     false},
    {{"particles.mass_g=3"}, "fill-low", {"particles.mass_g = 3", "below the coil's axis"}},
    {{"domain.low=[-0.02, -0.005, -0.01]", "domain.high=[0.02, 0.2, 0.06]"}, "domain", {"is lost"}},
    {{"region=[{name = \"moon\", kind = \"beyond\", deletes = false, point = [0, 100, 0], normal = [0, 1, 0]}]"},
     "region",
     {"region.moon: no sphere can reach it", "widen [domain]"}},
    {{"region=[{name = \"pan\", kind = \"box\", deletes = false, low = [-1, -1, -1], high = [1, 0, -1e-5]}]"},
     "region",
     {"region.pan: no sphere can reach it", "behind the walls of the canister", "beyond its outlet"}},
    {{"settle.time_s=0.05"}, "settle-time", {"settle.time_s = 0.05", "43.8 mm", "0.094 s", "at least 0.24"}},
    {{"dose.rotate_s=1e9"}, "dose-length", {"more than the fill of 13 g"}, false},
    {{"dose.rotate_s=0.1"}, "dose-spheres", {"spheres, so that one sphere is"}, false},
    {{"stop.threshold_g=5"}, "stop-threshold", {"stop.threshold_g = 5", "7.2 g"}},
    {{"refill=[{name = \"late\", mass_g = 1, time_s = 2.5}]"},
     "refill",
     {"refill[0].time_s", "refill \"late\" never comes", "after 2.4 s"}},
    {{"refill=[{name = \"late\", mass_g = 1, before_dose = 3}]"}, "refill", {"never comes", "after 2 doses"}},
    {{"refill=[{name = \"more\", mass_g = 10, time_s = 1}]", "dose.rotate_s=100"},
     "dose-length",
     {"fill and its refills"},
     false},
    {{"refill=[{name = \"late\", mass_g = 1, below_g = 500}]"},
     "refill",
     {"refill[0].below_g", "never above its mark"}},
    {{"frames.interval_s=10"}, "frames", {"2.4 s"}},
    {{"sensors.interval_s=0.5"}, "sensors", {"a rotation of 0.8 s"}},
    {{"sensors.rate_window_s=10"}, "rate-window", {"works for 1.6 s", "give about 0.08"}},
    {{"time.step_s=1e-7"}, "time-step", {"times as long", "\"auto\""}},
    {{"time.step_s=1e-12", "sensors.interval_s=1e-4"},
     "resolution",
     {"time.step_s = 1e-12", "m from the origin", "--backend reference"},
     false},
    {{"dose.rotate_s=1e9"}, "run-length", {"dose.rotate_s = 1000000000", "days"}, false},
    {{"accepted_warnings=pinsh"}, "accepted", {"there is no warning pinsh", "did you mean pinch?"}},
};

/// A slip in a text of the shipped device with a mesh, which has no warnings but those it accepts.
struct BodySlip {
    std::string from, to, name;
    std::vector<std::string> says;
};

/// A box at rest, in the text of a case.
inline std::string part(const std::string& name, const std::string& size, const std::string& at) {
    return "[[body]]\nname = \"" + name + "\"\nshape = \"box\"\nsize_mm = [" + size + "]\nat = [" + at + "]\n";
}

inline const std::string kOwnTurn = "[body.motion]\nkind = \"turn\"\nspeed_rpm = 60\n";

inline const std::vector<BodySlip> kBodySlips{
    {"turns_per_turn = -1", "turns_per_turn = 1", "body-backwards", {"to the rear wall", "by 5 mm a turn", "give -1"}},
    {"at = [0, 0, 0]", "at = [0.001, 0, 0]", "body-wall", {"\"spring\" turns through the", "0.7 mm"}},
    {"at = [0, 0, 0]", "at = [0, 0, -0.006]", "body-end", {"ends 1 mm before the front wall", "by 1 mm along z"}},
    {"unit = \"mm\"", "unit = \"um\"", "body-size", {"0.035 mm long", "\"mm\""}},
    {"[settle]",
     "[[body]]\nname = \"pin\"\nshape = \"box\"\nsize_mm = [0.8, 0.8, 0.8]\nat = [0, -0.0052, 0.015]\n[settle]",
     "body-cross",
     {"\"spring\" turns through body \"pin\""}},
    {"[settle]",
     part("pin", "1, 1, 1", "0, -20, 15") + "[settle]",
     "body-place",
     {"no sphere can touch body \"pin\"", "outside of the domain", "if those are mm, give [0, -0.02, 0.015]"}},
    // By its own clock: in the way of another that turns, of one at rest, of one that is pushed on to it; through a
    // wall.
    {"[settle]",
     part("arm", "0.6, 10.4, 0.6", "0, 0, 0.015") + kOwnTurn + "axis = [0, 0, 1]\n[settle]",
     "body-cross",
     {"\"spring\" turns through body \"arm\""}},
    {"[settle]",
     part("arm", "0.6, 8, 0.6", "0, 0, 0.015") + kOwnTurn + "axis = [0, 0, 1]\n" +
         part("pin", "0.8, 0.8, 0.8", "0.003, 0, 0.015") + "[settle]",
     "body-cross",
     {"\"arm\" turns through body \"pin\""}},
    {"[settle]",
     part("pusher", "0.6, 0.6, 0.6", "0, -0.004, 0.010") +
         "[body.motion]\nkind = \"slide\"\nvelocity = [0, 0, 0.05]\n" +
         part("pin", "0.8, 0.8, 0.8", "0, -0.004, 0.015") + "[settle]",
     "body-cross",
     {"\"pusher\" moves through body \"pin\""}},
    {"[settle]",
     part("bar", "9, 0.6, 0.6", "0, -0.003, 0.003") + kOwnTurn +
         "axis = [0, 1, 0]\nthrough = [0, -0.003, 0.003]\n[settle]",
     "body-wall",
     {"\"bar\" moves through the wall of the canister, by 1.5"}},
    // The spring itself is closed.
    {"max_overlap_ratio = 0.95",
     "max_overlap_ratio = 1\n[[body]]\nname = \"fin\"\nshape = \"disc\"\nradius_mm = 1\nat = [0, 0, 0.015]\n",
     "body-thin",
     {"contact.max_overlap_ratio = 1", "body \"fin\"", "the other side", "0.95"}},
    {"[settle]",
     part("arm", "1, 1, 1", "0, 20, 15") + kOwnTurn + "axis = [0, 0, 1]\n[settle]",
     "body-place",
     {"body[1].at", "stands at (0, 20, 15) m, far from all powder", "if those are mm, give [0, 0.02, 0.015]"}},
    {"[settle]",
     part("arm", "0.6, 0.6, 0.6", "0, 0.001, 0.015") + kOwnTurn + "axis = [0, 0, 1]\nthrough = [0, 20, 15]\n[settle]",
     "body-place",
     {"body[1].motion.through", "through (0, 20, 15) m", "give [0, 0.02, 0.015]"}},
    // 10 m/s would do; the end of the bar goes at 200 m/s.
    {"[settle]",
     part("pusher", "0.6, 0.6, 0.6", "0, -0.004, 0.010") +
         "[body.motion]\nkind = \"slide\"\nvelocity = [0, 0, 50]\n[settle]",
     "body-speed",
     {"body \"pusher\" moves at up to 50 m/s"}},
    {"[settle]",
     part("bar", "4, 0.6, 0.6", "0, 0, 0.003") + "[body.motion]\nkind = \"turn\"\nspeed_rpm = 1e6\naxis = [0, 0, 1]\n" +
         "[settle]",
     "body-speed",
     {"body \"bar\" moves at up to"}},
    {"[settle]",
     part("lid", "0.6, 0.6, 0.6", "0, -0.004, 0.010") +
         "[body.motion]\nkind = \"free\"\nmass_g = 1\nvelocity = [0, 0, 50]\n[settle]",
     "body-speed",
     {"body \"lid\" moves at up to 50 m/s"}},
    {"[settle]",
     part("hammer", "0.6, 0.6, 0.6", "0, -0.004, 0.010") +
         "[body.motion]\nkind = \"shake\"\naxis = [0, 0, 1]\namplitude_mm = 0.01\nfrequency_hz = 160\n[settle]",
     "sensors-alias",
     {"periods of body \"hammer\", which moves at 160 Hz", "0.00156 or less, or whole periods: 0.01875"}}};

}  // namespace vkdose::test
