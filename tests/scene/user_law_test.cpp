// A law that a user wrote, on the device: it does what the program's own law does whose text it repeats, to the bit.

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <set>
#include <thread>

#include "host/core/file.h"
#include "host/law/hertz.h"
#include "host/law/user_law.h"
#include "host/sim/energy_ledger.h"
#include "tests/scene/beds.h"
#include "tests/support/places.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

std::shared_ptr<const UserLaw> lawOf(const std::string& text) {
    const LawReading reading = readLaw("test.glsl", text);
    for (const LawFault& fault : reading.faults) FAIL_CHECK(fault.line << ": " << fault.problem);
    REQUIRE(reading.faults.empty());
    return std::make_shared<const UserLaw>(reading.law);
}

std::shared_ptr<const UserLaw> shippedLaw(const std::string& name) {
    return lawOf(*fileContent(std::filesystem::path(sourceDir()) / "cases/laws" / name));
}

/// The law of `p`, whose springs are ratios of the user's stiffness already.
ContactParameters userOf(const ContactParameters& p, const UserLaw& law, const std::map<std::string, double>& values) {
    ContactParameters own = p;
    own.law = NormalLaw::User;
    REQUIRE(law.parameters.size() == values.size());
    for (std::size_t k = 0; k < law.parameters.size(); ++k) own.own[k] = values.at(law.parameters[k]);
    return own;
}

/// Three spheres over a floor and a body: pairs, surfaces and a body are touched, again and again.
RuledWorld bowl() {
    RuledWorld w = emptyWorld();
    w.walls = {geometry::Plane{{0, -2e-3, 0}, {0, 1, 0}}};
    RigidBody block;
    block.name = "block";
    block.shapes = {geometry::Block{Vec3(1.4e-3, -2e-3, -4e-3), Vec3(9e-3, 0, 4e-3)}};
    w.bodies = {block};
    return w;
}

Particles threeSpheres() {
    Particles p;
    p.add({0, -0.7e-3, 0}, single(1.3005e-3), {0.3, -0.3, 0.1}, {70, -40, 90});
    p.add({0.2e-3, 1.2e-3 + 0.7e-3, 0.1e-3}, single(1.1e-3), {-0.1, -0.5, 0.05}, {-80, 10, 40});
    p.add({-2.6e-3, -0.9e-3, 0}, single(1.0e-3), {0.6, -0.2, 0}, {0, 0, 0});
    return p;
}

/// The bowl under the law that repeats luding, and the law of the program that it repeats.
struct Twins {
    RuledWorld own, users;
};

Twins ludingTwins(const RuledWorld& world = bowl()) {
    Twins t{world, world};
    t.own.law = t.users.law = paperLaw(0.3);
    const int materials = int(world.materials.size());
    t.own.law.pairs.resize(materials);
    t.users.law.pairs.resize(materials);
    t.users.law.user = shippedLaw("luding.glsl");
    for (const MaterialPair& pair : occurringPairs(world)) {
        ContactParameters& p = t.own.law.of(pair) = t.own.law.between(0, std::min(pair.b, 2));
        // Powers of two, so that ratio times stiffness is the stiffness in single precision. The program's dashpots of
        // sliding act while it slips too, those of a user's law do not.
        const double stiffer = pair.a == pair.b && pair.a > 0 ? 2 : 1;  // the second powder's own contacts
        p.k2Max = 16384 * stiffer, p.k1 = 4096 + 300 * pair.b, p.kc = 5000;
        p.kt = p.kr = p.kTo = 4096 * stiffer;
        p.gammaT = p.gammaR = p.gammaTo = 0;
        ContactParameters ratios = p;
        ratios.kt = ratios.kr = ratios.kTo = 0.25;
        t.users.law.of(pair) =
            userOf(ratios, *t.users.law.user,
                   {{"k1", p.k1}, {"k", p.k2Max}, {"kc", p.kc}, {"depth", p.plasticityDepth}, {"gamma", p.gamma}});
    }
    return t;
}

Twins hertzTwins() {
    Twins t{bowl(), bowl()};
    const auto text = shippedLaw("hertz-mindlin.glsl");
    ContactParameters elastic =
        hertzMindlin({2e6, 0.25}, {2e7, 0.3}, 0.7, t.own.law.of(ContactClass::ParticleParticle));
    elastic.kr = elastic.kTo = 0.3;
    elastic.gammaR = elastic.gammaTo = 0.2;
    t.own.law.pairs.fill(elastic);
    t.users.law.user = text;
    t.users.law.pairs.fill(userOf(
        elastic, *text, {{"modulus_Pa", elastic.modulus}, {"damping_ratio", kHertzDamping * elastic.dampingShare}}));
    return t;
}

bool sameBits(const Backend& a, const Backend& b) {
    const Particles p = a.particles(), q = b.particles();
    return p.position == q.position && p.velocity == q.velocity && p.spin == q.spin;
}

double farthestApart(const Backend& a, const Backend& b) {
    const Particles p = a.particles(), q = b.particles();
    double most = 0;
    for (std::size_t i = 0; i < p.size(); ++i) most = std::max(most, glm::length(p.position[i] - q.position[i]));
    return most;
}

/// Two laws that say the same in other words. Vulkan promises them the same bits nowhere. A software device rounds each
/// operation by itself and gives them; the compiler of a GPU fuses a product and a sum in one of the two only.
void requireSameBits(const RuledWorld& first, const RuledWorld& second, const Particles& spheres = threeSpheres()) {
    const bool fuses = vk::Device(testDevice()).info().isGpu();
    auto a = gpu(), b = gpu();
    a->load(first, spheres);
    b->load(second, spheres);
    bool touchedAll = false;
    for (int batch = 0; batch < 40; ++batch) {
        a->advance(50, 0);
        b->advance(50, 0);
        std::set<ContactClass> kinds;
        for (const Contact& c : a->contacts()) kinds.insert(c.kind);
        touchedAll = touchedAll || kinds.size() >= 2;
        if (!fuses) REQUIRE(sameBits(*a, *b));
        if (fuses) REQUIRE(farthestApart(*a, *b) < 1e-9);
    }
    CHECK(touchedAll);
    CHECK(a->particles().position[0] != spheres.position[0]);
    requireClean(*b);
}

}  // namespace

TEST_CASE("a user's law that repeats luding has luding's bits", "[every-driver]") {
    const Twins t = ludingTwins();
    requireSameBits(t.own, t.users);
}

TEST_CASE("a user's law has the parameters of each pair of materials") {
    constexpr int kSecondPowder = 3, kPlate = 4;
    RuledWorld world = bowl();
    world.materials.push_back({"second", true, 2854});
    world.materials.push_back({"plate", false, 0});
    world.bodies[0].material = kPlate;
    Particles spheres = threeSpheres();
    spheres.material = {kSecondPowder, 0, kSecondPowder};
    const Twins t = ludingTwins(world);
    requireSameBits(t.own, t.users, spheres);
}

TEST_CASE("a user's law that repeats hertz-mindlin has its bits") {
    const Twins t = hertzTwins();
    requireSameBits(t.own, t.users);
}

TEST_CASE("a run under a user's law goes on from a snapshot with the same bits") {
    RuledWorld w = ludingTwins().users;
    w.energyBook = GENERATE(false, true);
    auto whole = gpu(), resumed = gpu(byAddress());
    whole->load(w, threeSpheres());
    whole->advance(400, 0);
    resumed->load(w, threeSpheres());
    const Record record = whole->snapshot();
    CHECK_FALSE(whole->contacts().empty());  // with a memory to be kept
    resumed->restore(record);
    whole->advance(400, 0);
    resumed->advance(400, 0);
    CHECK(sameBits(*whole, *resumed));
    requireClean(*resumed);
}

TEST_CASE("a state of a user's law is refused under another law") {
    const Twins t = ludingTwins();
    auto first = gpu(), second = gpu(), third = gpu();
    first->load(t.users, threeSpheres());
    first->advance(100, 0);
    const Record record = first->snapshot();
    RuledWorld changed = t.users;
    changed.law.user = lawOf(t.users.law.user->text + "// another remark\n");
    second->load(changed, threeSpheres());
    CHECK_THROWS_WITH(second->restore(record), Catch::Contains("test.glsl"));
    third->load(t.own, threeSpheres());
    CHECK_THROWS_AS(third->restore(record), RecordError);
}

TEST_CASE("the energy ledger closes under a user's law") {
    for (const bool stiffens : {false, true}) {  // with the overlap: then the springs of sliding gain as well
        CAPTURE(stiffens);
        RuledWorld w = stiffens ? hertzTwins().users : ludingTwins().users;
        w.energyBook = true;
        auto device = gpu();
        device->load(w, threeSpheres());
        EnergyLedger ledger;
        for (int k = 0; k < 20; ++k) ledger.add(*device->advance(100, 0).energy);
        CHECK(ledger.sum.viscous > 0);
        CHECK(ledger.sum.sliding > 0);
        // The elastic law gives back what it stores.
        if (stiffens) CHECK(near(ledger.sum.plastic, 0, ledger.sum.loaded, 1e-3));
        if (!stiffens) CHECK(ledger.sum.plastic > 0);
        // Single precision, summed over 2000 steps; the scale is the energy that was loaded.
        CHECK(near(ledger.residual(), 0, ledger.sum.loaded, 2e-5));
        requireClean(*device);
    }
}

TEST_CASE("members of an ensemble share a user's law, each with its own parameters") {
    const RuledWorld first = ludingTwins().users;
    RuledWorld second = first;
    for (ContactParameters& p : second.law.pairs) p.own[2] *= 0.5;  // kc
    auto together = gpuEnsemble(2);
    std::thread other([&] {
        together[1]->load(second, threeSpheres());
        together[1]->advance(800, 0);
    });
    together[0]->load(first, threeSpheres());
    together[0]->advance(800, 0);
    other.join();
    for (const std::size_t k : {0, 1}) {
        auto alone = gpu();
        alone->load(k == 0 ? first : second, threeSpheres());
        alone->advance(800, 0);
        CHECK(together[k]->particles().position == alone->particles().position);
    }
    CHECK(together[0]->particles().position != together[1]->particles().position);
}

TEST_CASE("the reference runs a user's law from the same text as the device") {
    const Twins t = GENERATE(0, 1) == 0 ? ludingTwins() : hertzTwins();
    auto own = makeReferenceBackend(), users = makeReferenceBackend(), device = gpu();
    own->load(t.own, threeSpheres());
    users->load(t.users, threeSpheres());
    device->load(t.users, threeSpheres());
    for (int batch = 0; batch < 8; ++batch) {
        for (Backend* backend : {own.get(), users.get(), device.get()}) backend->advance(50, 0);
        CHECK(farthestApart(*own, *users) < 1e-12);
        CHECK(farthestApart(*device, *users) < 1e-8);
    }
    CHECK_FALSE(users->contacts().empty());
    requireClean(*device);
}

TEST_CASE("the reference keeps the memory of a user's law in its state, closes its ledger, and refuses another law") {
    RuledWorld w = GENERATE(0, 1) == 0 ? ludingTwins().users : hertzTwins().users;
    w.energyBook = true;
    auto whole = makeReferenceBackend(), resumed = makeReferenceBackend(), other = makeReferenceBackend();
    whole->load(w, threeSpheres());
    EnergyLedger ledger;
    ledger.add(*whole->advance(400, 0).energy);
    const Record record = whole->snapshot();
    CHECK_FALSE(whole->contacts().empty());
    resumed->load(w, threeSpheres());
    resumed->restore(record);
    ledger.add(*whole->advance(1600, 0).energy);
    resumed->advance(1600, 0);
    CHECK(sameBits(*whole, *resumed));
    CHECK(ledger.sum.sliding > 0);
    CHECK(near(ledger.residual(), 0, ledger.sum.loaded, 1e-12));
    RuledWorld changed = w;
    changed.law.user = lawOf(w.law.user->text + "// another remark\n");
    other->load(changed, threeSpheres());
    CHECK_THROWS_WITH(other->restore(record), Catch::Contains("test.glsl"));
}

TEST_CASE("a run ends at an answer that is no number, and names the law") {
    const std::string force = "float force(Contact c) { return ";
    const std::string spring = "k * c.overlap; }\nfloat stiffness(Contact c) { return k; }\n";
    const std::string text = GENERATE_COPY(
        force + "c.overlap > 1e-6 ? log(-1.0) : " + spring,
        force + spring +
            "particle float heat;\nfloat flow_heat(Contact c) { return c.overlap > 1e-6 ? exp(1e3) : 0.0; }\n");
    RuledWorld w = ludingTwins().users;
    w.law.user = lawOf("parameter float k1, k, kc, depth, gamma;\n" + text);
    w.properties = w.law.user->properties;
    Particles spheres = threeSpheres();
    if (!w.properties.empty()) spheres.properties.resize(spheres.size());
    std::vector<std::unique_ptr<Backend>> runs;
    runs.push_back(makeReferenceBackend());
    runs.push_back(gpu());
    for (const auto& run : runs) {
        run->load(w, spheres);
        CHECK_THROWS_WITH(run->advance(400, 0), Catch::Contains("test.glsl"));
    }
}

namespace {

/// Heat flows where spheres touch, and the warmer they are the stiffer they get.
const char* const kHeat = R"(
parameter float k, h;
particle float heat, age;
float force(Contact c) { return k * (1.0 + heat.x + heat.y) * c.overlap; }
float stiffness(Contact c) { return 4.0 * k; }
float damping(Contact c) { return 0.01; }
float flow_heat(Contact c) { return h * (heat.y - heat.x); }
)";

RuledWorld warmBowl() {
    RuledWorld w = bowl();
    w.law = paperLaw(0.3);
    w.law.user = lawOf(kHeat);
    for (ContactParameters& p : w.law.pairs) p = userOf(p, *w.law.user, {{"k", 4000}, {"h", 40}});
    for (ContactParameters& p : w.law.pairs) p.kt = p.kr = p.kTo = 0.25, p.gammaT = p.gammaR = p.gammaTo = 0;
    w.properties = w.law.user->properties;
    w.materials[kWallMaterial].properties = {0.25, 0};
    return w;
}

Particles warmSpheres() {
    Particles p = threeSpheres();
    p.properties = {{1, 5}, {0.1, 6}, {0.5, 7}};
    return p;
}

}  // namespace

TEST_CASE("the properties of particles are smeared out into fields alike on device and reference") {
    const RuledWorld w = warmBowl();
    const auto device = gpu(), reference = makeReferenceBackend();
    FieldRequest r;
    r.grid = {Vec3(-6e-3), Vec3(6e-3), {3, 4, 5}};
    r.width = 4e-3;
    for (Backend* b : {device.get(), reference.get()}) {
        b->load(w, warmSpheres());
        b->advance(100, 0);
    }
    const FieldPoints got = device->fields(r), expected = reference->fields(r);
    std::size_t filled = 0;
    for (std::size_t n = 0; n < got.size(); ++n) {
        if (!(expected[n].density > 0)) continue;
        ++filled;
        for (const std::size_t k : {0U, 1U}) CHECK(near(got[n].property(k), expected[n].property(k), 5, 1e-4));
        CHECK(got[n].properties[2] == 0);
    }
    CHECK(filled > 10);
    requireClean(*device);
}

TEST_CASE("what flows between particles by a user's law is the same on device and reference, and what does not stays") {
    const RuledWorld w = warmBowl();
    auto device = gpu(), reference = makeReferenceBackend();
    device->load(w, warmSpheres());
    reference->load(w, warmSpheres());
    for (int batch = 0; batch < 8; ++batch) {
        device->advance(50, 0);
        reference->advance(50, 0);
        const Particles p = device->particles(), q = reference->particles();
        CHECK(farthestApart(*device, *reference) < 1e-8);
        for (std::size_t i = 0; i < p.size(); ++i) {
            CHECK(near(p.properties[i][0], q.properties[i][0], 1, 1e-5));
            CHECK(p.properties[i][1] == q.properties[i][1]);
        }
    }
    const Particles p = device->particles();
    CHECK(p.properties[0][0] < 0.99);
    CHECK(p.properties[1][0] > 0.101);
    CHECK(p.properties[2][1] == 7);
    requireClean(*device);
}

TEST_CASE("the heat that one sphere loses another has, and walls give and take") {
    RuledWorld w = warmBowl();
    w.walls.clear();
    w.bodies.clear();
    Particles pair;
    pair.add({0, 0, 0}, single(1e-3), {0.05, 0, 0});
    pair.add({single(1.99e-3), 0, 0}, single(1e-3));
    pair.properties = {{1, 0}, {0, 0}};
    auto device = gpu();
    device->load(w, pair);
    device->advance(20, 0);
    const Particles now = device->particles();
    CHECK(now.properties[1][0] > 1e-3);
    CHECK(near(now.properties[0][0] + now.properties[1][0], 1, 1, 1e-13));  // two floats keep what one would round
    requireClean(*device);
}

TEST_CASE("a run whose particles have properties goes on from a snapshot, and in an ensemble, with the same bits") {
    RuledWorld w = warmBowl();
    w.energyBook = GENERATE(false, true);
    auto whole = gpu(), resumed = gpu(byAddress());
    whole->load(w, warmSpheres());
    whole->advance(400, 0);
    resumed->load(w, warmSpheres());
    resumed->restore(whole->snapshot());
    auto reference = makeReferenceBackend(), again = makeReferenceBackend();
    reference->load(w, warmSpheres());
    reference->advance(400, 0);
    again->load(w, warmSpheres());
    again->restore(reference->snapshot());
    for (Backend* backend : {whole.get(), resumed.get(), reference.get(), again.get()}) backend->advance(400, 0);
    CHECK(sameBits(*whole, *resumed));
    CHECK(whole->particles().properties == resumed->particles().properties);
    CHECK(reference->particles().properties == again->particles().properties);
    auto together = gpuEnsemble(2);
    std::thread other([&] {
        Particles cold = warmSpheres();
        for (LawProperties& own : cold.properties) own = {};
        together[1]->load(w, cold);
        together[1]->advance(800, 0);
    });
    together[0]->load(w, warmSpheres());
    together[0]->advance(800, 0);
    other.join();
    CHECK(together[0]->particles().properties == whole->particles().properties);
    CHECK(together[1]->particles().properties != whole->particles().properties);
    requireClean(*resumed);
}
