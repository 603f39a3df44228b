// The reference backend's results of cases/mini.toml, as hashes: a change that moves a single bit of them must
// not pass unseen. Where a change means to, renew the hashes: run `build/release/tests/test_law "bits: *"`, paste the
// lines it prints over those of the same name here, and say in the commit message why the results move.
//
// Double precision without contraction (-ffp-contract=off) gives the same bits on every compiler and machine, but for
// the functions of libm, which are not rounded exactly: sin, cos, atan2, acos and hypot, by which the closest points on
// coil and trough are found. Debian 12 (GCC 12, glibc 2.36) and 13 (GCC 14, glibc 2.41) agree on a processor with FMA;
// without FMA, or elsewhere, their last bits differ, and the packing multiplies such a difference by 1e11 until it has
// settled. There the state after the first contacts is compared in rounded numbers instead.

#include <bit>
#include <cmath>

#include "host/backend/reference/reference.h"
#include "host/model/case.h"
#include "host/sim/timeline.h"
#include "tests/support/catch.h"

using namespace vkdose;

namespace {

struct Bits {
    std::uint64_t filled, settled, dosing;
};
constexpr Bits kBits{0x31f89555dbc293f2, 0x19ef1018a469fab, 0x9a03533b5d9ad314};
constexpr std::uint64_t kDigits = 0x5b1b13aa73221c9;
constexpr std::uint64_t kLibm = 0xd133e7b2ee97c30e;

/// FNV-1a of 64-bit words, lowest byte first.
class Hash {
  public:
    void add(std::uint64_t word) {
        for (int shift = 0; shift < 64; shift += 8) {
            value_ ^= (word >> shift) & 0xff;
            value_ *= 1099511628211ULL;
        }
    }
    void add(double x) { add(std::bit_cast<std::uint64_t>(x)); }
    void add(const Vec3& v) {
        add(v.x);
        add(v.y);
        add(v.z);
    }
    /// `x` in whole `unit`s.
    void addRounded(double x, double unit) { add(static_cast<std::uint64_t>(std::llround(x / unit))); }
    void addRounded(const Vec3& v, double unit) {
        addRounded(v.x, unit);
        addRounded(v.y, unit);
        addRounded(v.z, unit);
    }
    std::uint64_t value() const { return value_; }

  private:
    std::uint64_t value_ = 14695981039346656037ULL;
};

/// How this libm rounds the functions that the geometry uses, on arguments like those it is given.
std::uint64_t libm() {
    Hash hash;
    for (int i = 1; i <= 10000; ++i) {
        const double x = 1e-3 * i;
        for (const double value :
             {std::sin(x), std::cos(x), std::atan2(x - 5, 0.7), std::acos(1e-4 * i - 1), std::hypot(x, 0.7)})
            hash.add(value);
    }
    return hash.value();
}

std::uint64_t bitsOf(const Particles& p) {
    Hash hash;
    for (std::size_t i = 0; i < p.size(); ++i) {
        hash.add(p.radius[i]);
        hash.add(p.position[i]);
        hash.add(p.velocity[i]);
        hash.add(p.spin[i]);
        hash.add(static_cast<std::uint64_t>(p.status[i]));
    }
    return hash.value();
}

/// State, contacts with their history, and what the sensors said.
std::uint64_t bitsOf(const Backend& backend, const Sensors& sensors) {
    Hash hash;
    hash.add(bitsOf(backend.particles()));
    for (const Contact& c : backend.contacts()) {
        for (const std::uint64_t word : {static_cast<std::uint64_t>(c.kind), static_cast<std::uint64_t>(c.particle),
                                         static_cast<std::uint64_t>(c.other)})
            hash.add(word);
        hash.add(c.maxOverlap);
        hash.add(c.sliding);
        hash.add(c.rolling);
        hash.add(c.torsion);
        hash.add(c.force);
    }
    for (int r = 0; r < kRegions; ++r) {
        hash.add(sensors.count[r]);
        hash.add(sensors.mass[r]);
    }
    for (const double x : {sensors.kineticEnergy, sensors.rotationalEnergy, sensors.coilTorque, sensors.throatMomentumZ,
                           sensors.maxOverlapRatio, backend.coilAngle()})
        hash.add(x);
    hash.add(sensors.rebuilds);
    return hash.value();
}

/// To six digits of a radius of a millimetre, of a metre a second and of a surface speed of as much; springs to as much
/// of an overlap of a hundredth of a radius.
std::uint64_t digitsOf(const Backend& backend) {
    Hash hash;
    const Particles p = backend.particles();
    for (std::size_t i = 0; i < p.size(); ++i) {
        hash.addRounded(p.position[i], 1e-9);
        hash.addRounded(p.velocity[i], 1e-6);
        hash.addRounded(p.spin[i], 1e-3);
    }
    for (const Contact& c : backend.contacts()) {
        hash.addRounded(c.maxOverlap, 1e-11);
        hash.addRounded(c.sliding, 1e-11);
        hash.addRounded(c.rolling, 1e-11);
    }
    return hash.value();
}

/// The case as `vkdose run` plays it, from the filling.
struct Play {
    Case c = loadCase(VKDOSE_SOURCE_DIR "/cases/mini.toml", {});
    Insertion filled = insertParticles(c);
    Timeline timeline{c};
    std::unique_ptr<Backend> backend = makeReferenceBackend();

    Play() { backend->load(c.world, c.settlingLaw, filled.particles); }
    Sensors advance(std::uint64_t steps, double rate) const {
        return backend->advance(static_cast<std::uint32_t>(steps), rate);
    }
};

}  // namespace

TEST_CASE("bits: the reference's results for the mini case are those of the last commit that meant to change them") {
    if (libm() != kLibm) {
        WARN("skipped: this libm or processor rounds otherwise than the one the hashes are from; libm() = "
             << std::hex << "0x" << libm());
        return;
    }
    Play play;
    Bits found{};
    found.filled = bitsOf(play.filled.particles);
    found.settled = bitsOf(*play.backend, play.advance(play.timeline.settleSteps(), 0));
    play.backend->setLaw(play.c.dosingLaw);
    const Sensors sensors =
        play.advance(play.timeline.rotateSteps() / 2, play.timeline.at(play.timeline.settleSteps()).rate);
    found.dosing = bitsOf(*play.backend, sensors);
    CHECK(sensors.count[static_cast<std::size_t>(Region::Throat)] > 0);
    CHECK(sensors.count[static_cast<std::size_t>(Region::Dosed)] > 0);
    INFO(std::hex << "constexpr Bits kBits{0x" << found.filled << ", 0x" << found.settled << ", 0x" << found.dosing
                  << "};");
    CHECK(found.filled == kBits.filled);
    CHECK(found.settled == kBits.settled);
    CHECK(found.dosing == kBits.dosing);
}

TEST_CASE("bits: on any libm the first contacts of the mini case come out alike to six digits") {
    Play play;
    play.advance(2500, 0);
    REQUIRE(play.backend->contacts().size() > 20);
    INFO(std::hex << "constexpr std::uint64_t kDigits = 0x" << digitsOf(*play.backend) << ";");
    CHECK(digitsOf(*play.backend) == kDigits);
}
