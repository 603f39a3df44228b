// A user's law in double precision: each part of the language gives what GLSL says.

#include "host/law/law_program.h"

#include <fmt/format.h>

#include <cmath>

#include "host/law/law_checks.h"
#include "tests/support/catch.h"

using namespace vkdose;

namespace {

UserLaw lawOf(const std::string& text) {
    const LawReading reading = readLaw("test.glsl", text);
    for (const LawFault& fault : reading.faults) FAIL_CHECK(fault.line << ": " << fault.problem);
    REQUIRE(reading.faults.empty());
    return reading.law;
}

const std::string kStiffness = "float stiffness(Contact c) { return 1.0; }\n";
const LawContact kContact{2, 3, 5, 7};

/// What `force` returns that has this body.
double forceOf(const std::string& body, const std::string& before = "") {
    LawProgram program(lawOf(before + "float force(Contact c) { " + body + " }\n" + kStiffness));
    LawProgram::Memory memory{};
    return program.answer({}, kContact, memory).force;
}

/// The value of an expression that is a number.
double valueOf(const std::string& expression) {
    return forceOf("return float(" + expression + ");");
}

}  // namespace

TEST_CASE("law program: the fields of a contact, the parameters and the functions that a law has") {
    LawProgram program(
        lawOf("parameter float a, b;\n"
              "float force(Contact c) { return c.overlap + 10.0 * c.speed + a; }\n"
              "float stiffness(Contact c) { return c.radius * b; }\n"
              "float pull(Contact c) { return c.mass; }\n"
              "float reach(Contact c) { return c.radius + c.mass + c.overlap; }\n"));
    LawProgram::Memory memory{};
    const LawAnswer answer = program.answer({100, 1000}, kContact, memory);
    CHECK(answer.force == 132);
    CHECK(answer.stiffness == 5000);
    CHECK(answer.pull == 7);
    CHECK(answer.damping == 0);
    CHECK(answer.energy == 0);
    CHECK(program.reach({100, 1000}, 0.25) == 0.25);
    CHECK(program.work() > 10);
}

TEST_CASE("law program: force changes the memory, and the other functions see it so") {
    LawProgram program(
        lawOf("memory float last, count;\n"
              "float force(Contact c) { count += 1.0; last = c.overlap; return count; }\n"
              "float stiffness(Contact c) { return last; }\n"
              "float energy(Contact c) { return count; }\n"));
    LawProgram::Memory memory{};
    for (int k = 1; k <= 3; ++k) {
        const LawAnswer answer = program.answer({}, {0.5 * k, 0, 1, 1}, memory);
        CHECK(answer.force == k);
        CHECK(answer.stiffness == 0.5 * k);
        CHECK(answer.energy == k);
    }
    CHECK(memory[0] == 1.5);
    CHECK(memory[1] == 3);
    memory = {};
    CHECK(program.answer({}, kContact, memory).force == 1);  // of another contact
}

TEST_CASE("law program: signs bind as in GLSL") {
    struct Expected {
        const char* expression;
        double value;
    };
    for (const Expected& e : {Expected{"1.0 + 2.0 * 3.0", 7},
                              {"(1.0 + 2.0) * 3.0", 9},
                              {"7.0 - 2.0 - 1.0", 4},
                              {"8.0 / 2.0 / 2.0", 2},
                              {"-2.0 * -3.0", 6},
                              {"- -2.0", 2},
                              {"1 + 2 << 1", 6},
                              {"1 | 2 ^ 3 & 2", 1 | (2 ^ (3 & 2))},
                              {"5 % 3", 2},
                              {"-5 % 3", -2},
                              {"7 / 2", 3},
                              {"-7 / 2", -3},
                              {"7 / 0", 7},
                              {"7 % 0", 0},
                              {"(-2147483647 - 1) / -1", -2147483648.0},
                              {"2147483647 + 1", -2147483648.0},
                              {"65536 * 65536 + 3", 3},
                              {"0u - 1u", 4294967295.0},
                              {"~0", -1},
                              {"~0u", 4294967295.0},
                              {"-8 >> 1", -4},
                              {"0x1F + 010", 39},
                              {"1 < 2 ? 3.0 : 4.0", 3},
                              {"1.0 == 1.0 && 2.0 != 3.0", 1},
                              {"true ^^ true", 0},
                              {"false || !false", 1},
                              {"1.5e1 + .5 + 2.f", 17.5},
                              {"int(-2.7)", -2},
                              {"float(true) + float(3u)", 4},
                              {"(1.0, 2.0)", 2}}) {
        CAPTURE(e.expression);
        CHECK(valueOf(e.expression) == e.value);
    }
}

TEST_CASE("law program: && and || look at no more than they must") {
    CHECK(forceOf("int n = 0; bool b = false && ++n > 0 && ++n > 0; return float(n);") == 0);
    CHECK(forceOf("int n = 0; bool b = true || ++n > 0 || ++n > 0; return float(n);") == 0);
    CHECK(forceOf("int n = 0; bool b = true && ++n > 0 && ++n > 1; return b ? float(n) : 0.0;") == 2);
}

TEST_CASE("law program: vectors, their parts, and matrices") {
    struct Expected {
        const char* expression;
        double value;
    };
    for (const Expected& e : {Expected{"dot(vec3(1.0, 2.0, 3.0), vec3(4.0, 5.0, 6.0))", 32},
                              {"vec2(3.0, 4.0).y", 4},
                              {"vec4(1.0, 2.0, 3.0, 4.0).wzyx.x", 4},
                              {"length(vec2(3.0, 4.0))", 5},
                              {"distance(vec2(1.0, 1.0), vec2(4.0, 5.0))", 5},
                              {"cross(vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0)).z", 1},
                              {"normalize(vec2(3.0, 4.0)).x", 0.6},
                              {"(vec2(1.0, 2.0) * 3.0 + 1.0).y", 7},
                              {"vec3(vec2(1.0, 2.0), 3.0).z", 3},
                              {"vec3(5.0).z", 5},
                              {"vec2(vec3(7.0, 8.0, 9.0)).y", 8},
                              {"ivec2(1.9, -1.9).y", -1},
                              {"(mat2(1.0, 2.0, 3.0, 4.0) * vec2(1.0, 10.0)).x", 31},
                              {"(vec2(1.0, 10.0) * mat2(1.0, 2.0, 3.0, 4.0)).x", 21},
                              {"(mat2(1.0, 2.0, 3.0, 4.0) * mat2(2.0) * vec2(1.0, 0.0)).y", 4},
                              {"vec2(1.0, 2.0) == vec2(1.0, 2.0)", 1},
                              {"any(lessThan(vec2(1.0, 5.0), vec2(2.0, 2.0)))", 1},
                              {"all(lessThan(vec2(1.0, 5.0), vec2(2.0, 2.0)))", 0},
                              {"mix(vec2(1.0, 2.0), vec2(3.0, 6.0), 0.25).y", 3},
                              {"mix(1.0, 2.0, true)", 2}}) {
        CAPTURE(e.expression);
        CHECK(valueOf(e.expression) == Approx(e.value).margin(1e-15));
    }
    CHECK(forceOf("vec4 v = vec4(0.0); v.xz = vec2(1.0, 2.0); v.y += 5.0; v.zx.x *= 10.0; return dot(v, vec4(1.0));") ==
          26);
}

TEST_CASE("law program: the functions of numbers") {
    struct Expected {
        const char* expression;
        double value;
    };
    for (const Expected& e :
         {Expected{"abs(-2.5) + sign(-3.0) + floor(-1.5) + ceil(1.2)", 2.5 - 1 - 2 + 2},
          {"fract(-0.25) + mod(-1.0, 3.0)", 2.75},
          {"min(2.0, 1.0) + max(2.0, 1.0) + clamp(5.0, 0.0, 3.0)", 6},
          {"step(1.0, 0.5) + step(1.0, 1.5) + smoothstep(0.0, 2.0, 1.0)", 1.5},
          {"sqrt(2.0) * inversesqrt(2.0)", 1},
          {"pow(2.0, 0.5)", std::sqrt(2.0)},
          {"exp(1.0) + log(2.0) + exp2(3.0) + log2(8.0)", std::exp(1.0) + std::log(2.0) + 11},
          {"sin(0.3) + cos(0.4) + tan(0.5)", std::sin(0.3) + std::cos(0.4) + std::tan(0.5)},
          {"asin(0.3) + acos(0.4) + atan(0.5) + atan(1.0, -1.0)",
           std::asin(0.3) + std::acos(0.4) + std::atan(0.5) + std::atan2(1.0, -1.0)},
          {"sinh(0.3) + cosh(0.4) + tanh(0.5)", std::sinh(0.3) + std::cosh(0.4) + std::tanh(0.5)},
          {"asinh(0.3) + acosh(1.4) + atanh(0.5)", std::asinh(0.3) + std::acosh(1.4) + std::atanh(0.5)},
          {"trunc(-1.7) + round(2.5) + radians(180.0) + degrees(3.0)",
           -1 + 2 + 3.14159265358979323846 + 3 * 180 / 3.14159265358979323846},
          {"fma(2.0, 3.0, 4.0)", 10},
          {"isnan(0.0 / 0.0) && isinf(1.0 / 0.0) && !isnan(1.0)", 1},
          {"abs(-3) + min(2, 5)", 5}}) {
        CAPTURE(e.expression);
        CHECK(valueOf(e.expression) == Approx(e.value).epsilon(1e-14));
    }
}

TEST_CASE("law program: statements, functions and constants of its own") {
    CHECK(forceOf("float sum = 0.0; for (int i = 1; i <= 10; ++i) { if (i == 3) continue; if (i > 5) break; sum += "
                  "float(i); } return sum;") == 12);
    CHECK(forceOf("for (int i = 9; i > 0; i -= 3) { for (int k = 0; k < 2; k++) if (i * k == 6) return float(i); } "
                  "return 0.0;") == 6);
    CHECK(forceOf("float a = 1.0; { float a = 2.0; a = 3.0; } return a;") == 1);
    CHECK(forceOf("float a = 1.0, b = a + 1.0; b -= a *= 3.0; return b++ + --b;") == -2);
    CHECK(forceOf("if (c.overlap > 5.0) return 1.0; else if (c.overlap > 1.0) return 2.0; else return 3.0;") == 2);
    const std::string own =
        "const float kTwo = 2.0, kFour = kTwo * kTwo;\nconst int kMany = 3;\n"
        "float powered(float x, const int n) { float p = 1.0; for (int i = 0; i < kMany; ++i) p *= i < n ? x : 1.0; "
        "return p; }\n"
        "vec2 both(float x, vec2 v) { return vec2(x, v.y); }\n"
        "float half_(Contact c) { c.overlap *= 0.5; return c.overlap; }\n";
    CHECK(forceOf("return powered(kFour, 2) + both(1, vec2(0.0, 5.0)).y + half_(c) + c.overlap;", own) ==
          16 + 5 + 1 + 2);
}

TEST_CASE("law program: what is too deep for a processor's stack is refused, and a long sum is not") {
    std::string sum = "1.0", choice = "1.0";
    for (int k = 0; k < 2000; ++k) sum += "+1.0";
    CHECK(valueOf(sum) == 2001);
    for (int k = 0; k < 1000; ++k) choice = "c.mass<0.0?2.0:" + choice;
    const UserLaw law = lawOf("float force(Contact c) { return " + choice + "; }\n" + kStiffness);
    CHECK_THROWS_AS(LawProgram(law), LawRefused);
}
