// Laws that would hang or crash a compiler or a device, or change behind the trial's back.

#include "tests/scene/broken_laws.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

/// Ways to change the counter of a loop.
const std::vector<Broken>& countersThatChange() {
    static const std::vector<Broken> laws = [] {
        std::vector<Broken> all;
        for (const char* change : {"(i) = 0", "i ^= i", "(i)--", "((i))++", "--(i)", "++i", "i <<= 1", "i >>= 1",
                                   "i |= 1", "i &= 1", "i %= 2", "i /= 2", "i.x = 0", "(i).x -= 1", "int i = 0"})
            all.push_back({change, inForce(fmt::format("for (int i = 0; i < 10; ++i) {{ {}; }}", change)), 4,
                           "changes its counter"});
        return all;
    }();
    return laws;
}

/// What outlives a call may not change in it: the trial and a run would see different laws.
const std::vector<Broken>& changes() {
    static const std::vector<Broken> laws{
        {"a parameter", inForce("k = 2.0;"), 4, "k is a parameter"},
        {"a parameter by a factor", inForce("if (c.speed < 0.0) k *= 1.2;"), 4, "k is a parameter"},
        {"a parameter in brackets", inForce("(k) += 1.0;"), 4, "k is a parameter"},
        {"a parameter by its part", inForce("k.x = 1.0;"), 4, "k is a parameter"},
        {"a parameter that is counted", inForce("float x = k++;"), 4, "k is a parameter"},
        {"a parameter in a function", atTop("float f() { return k = 2.0; }"), 2, "k is a parameter"},
        {"memory in damping", atTop("memory float m;\nfloat damping(Contact c) { m = 7.0; return 0.0; }"), 3,
         "m is a memory"},
        {"memory in a function", atTop("memory float m;\nfloat f() { ++m; return 0.0; }"), 3, "m is a memory"},
    };
    return laws;
}

/// What compilers and devices choke on.
const std::vector<Broken>& limits() {
    static const std::vector<Broken> laws{
        {"an array", inForce("float a[4];"), 4, "arrays"},
        {"a huge array", inForce("float a[2000000000]; a[0] = 1.0;"), 4, "arrays"},
        {"an array of constants", atTop("const float t[2] = float[2](1.0, 2.0);"), 2, "arrays"},
        {"an index beyond a vector", inForce("vec2 v = vec2(k); k * v[int(k)];"), 4, "indices"},
        {"a long sum", inForce("float x = k" + repeated("+k", 30000) + ";"), 4, "words and signs"},
        {"a long function that is called often",
         atTop("float f(float x) { return x" + repeated(" + x", 300) + "; }\nfloat g(float x) { return f(x)" +
               repeated(" + f(x)", 300) + "; }"),
         3, "words and signs"},
        {"deep brackets", inForce("float x = " + repeated("(", 65) + "k" + repeated(")", 65) + ";"), 4, "deep"},
        {"deep brackets of a constant", atTop("const float x = " + repeated("(", 65) + "1.0" + repeated(")", 65) + ";"),
         2, "deep"},
        {"deep braces", inForce(repeated("{", 65) + repeated("}", 65)), 4, "deep"},
        {"deep choices", inForce(repeated("if (true) ", 65) + ";"), 4, "deep"},
        {"a long chain of choices", inForce("if (true) ;" + repeated(" else if (true) ;", 65)), 4, "deep"},
        {"deep loops", inForce(repeated("for (int i = 0; i < 0; ++i) ", 65) + ";"), 4, "deep"},
        {"many minus signs", inForce("float x = " + repeated("- ", 65) + "k;"), 4, "deep"},
    };
    return laws;
}

}  // namespace

TEST_CASE("a law without a fault is taken") {
    const Folder folder;
    CHECK_NOTHROW(loadWith(folder, inForce("float x = 1.0; for (int i = 0; i < 3; ++i) x *= 2.0;")));
    CHECK_NOTHROW(loadWith(folder, answers("force", "k * c.overlap")));
    // What is just not refused: reads of a counter and of a parameter, as deep as allowed.
    CHECK_NOTHROW(loadWith(folder, inForce("int n = 0; for (int i = 0; i < 3; ++i) { n = (i) + (i << 1); n = -(i); "
                                           "if (n == i && k >= 1.0) ++n; }")));
    CHECK_NOTHROW(loadWith(folder, inForce("float x = " + repeated("(", 60) + "k" + repeated(")", 60) + ";")));
    CHECK_NOTHROW(loadWith(folder, atTop("memory float m;\nfloat f(Contact c) { float x = m; x += 1.0; return x; }\n"
                                         "float damping(Contact c) { return f(c); }")));
    CHECK_NOTHROW(loadWith(folder, "\xef\xbb\xbf" + answers("force", "k * c.overlap")));
}

TEST_CASE("a law with as many trips as allowed is tried to its end") {
    const std::string loop = "float x = k; for (int i = 0; i < 9000; ++i) x += 1e-9 * sin(x); if (x < 0.0) return x;";
    const Folder folder;
    CHECK_NOTHROW(loadWith(folder, inForce(loop)));
    // A fault at the end of the loadings.
    CHECK_THROWS_WITH(loadWith(folder, inForce(loop + "if (c.speed < -0.5 && c.overlap < 1e-8) return 1.0 / (k - k);")),
                      Catch::Contains("force answers"));
}

TEST_CASE("a loop that changes its counter in any way is refused") {
    refuseAll(countersThatChange());
}
TEST_CASE("a law that is too long or too deep for a compiler is refused") {
    refuseAll(limits());
}
TEST_CASE("a law that changes a parameter, or memory outside of force, is refused") {
    refuseAll(changes());
}
