// A hundred broken laws, and some more: each is refused in the user's own file and line, with the reason.

#include <set>

#include "tests/scene/broken_laws.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

std::string many(const char* kind, int count) {
    std::string text = kind + std::string(" float a0");
    for (int k = 1; k < count; ++k) text += fmt::format(", a{}", k);
    return text + ";";
}

const std::vector<Broken>& forbidden() {
    static const std::vector<Broken> laws{
        {"version", atTop("#version 450"), 2, "directives"},
        {"include", atTop("#include \"shared/buffers.glsl\""), 2, "directives"},
        {"define", atTop("#define force 1.0"), 2, "directives"},
        {"pragma", atTop("#pragma optimize(off)"), 2, "directives"},
        {"extension", atTop("#extension all : enable"), 2, "directives"},
        {"indented directive", inForce("   #if 1"), 4, "directives"},
        {"invocation", inForce("uint i = gl_GlobalInvocationID.x;"), 4, "gl_"},
        {"group", inForce("uint i = gl_WorkGroupID.x;"), 4, "gl_"},
        {"groups", inForce("uint i = gl_NumWorkGroups.x;"), 4, "gl_"},
        {"a name of one's own with gl_", inForce("float gl_mine = 1.0;"), 4, "gl_"},
        {"atomic add", inForce("atomicAdd(k, 1.0);"), 4, "atomicAdd"},
        {"atomic min", inForce("atomicMin(k, 1.0);"), 4, "atomicMin"},
        {"atomic exchange", inForce("atomicExchange(k, 1.0);"), 4, "atomicExchange"},
        {"atomic swap", inForce("atomicCompSwap(k, 1.0, 2.0);"), 4, "atomicCompSwap"},
        {"discard", inForce("discard;"), 4, "discard"},
        {"barrier", inForce("barrier();"), 4, "barrier"},
        {"memory barrier", inForce("memoryBarrier();"), 4, "memoryBarrier"},
        {"barrier of shared memory", inForce("memoryBarrierShared();"), 4, "memoryBarrierShared"},
        {"group barrier", inForce("groupMemoryBarrier();"), 4, "groupMemoryBarrier"},
        {"subgroup", inForce("float s = subgroupAdd(k);"), 4, "subgroupAdd"},
        {"layout", atTop("layout(binding = 0) buffer B { float b[]; };"), 2, "layout"},
        {"layout of the group", atTop("layout(local_size_x = 1) in;"), 2, "layout"},
        {"uniform", atTop("uniform float u;"), 2, "uniform"},
        {"buffer", atTop("buffer B { float b[]; };"), 2, "buffer"},
        {"shared", atTop("shared float s;"), 2, "shared"},
        {"readonly", atTop("readonly float s;"), 2, "readonly"},
        {"coherent", atTop("coherent float s;"), 2, "coherent"},
        {"volatile", inForce("volatile float s;"), 4, "volatile"},
        {"sampler", atTop("sampler2D s;"), 2, "sampler2D"},
        {"sampler of a buffer", atTop("samplerBuffer s;"), 2, "samplerBuffer"},
        {"image", atTop("image2D s;"), 2, "image2D"},
        {"store to an image", inForce("imageStore(k, 1, vec4(0.0));"), 4, "imageStore"},
        {"texture", inForce("texture(k, vec2(0.0));"), 4, "texture"},
        {"fetch", inForce("vec4 v = texelFetch(k, 0);"), 4, "texelFetch"},
        {"switch", inForce("switch (1) { default: break; }"), 4, "switch"},
        {"goto", inForce("goto end;"), 4, "goto"},
        {"structure", atTop("struct S { float x; };"), 2, "struct"},
        {"out", atTop("void f(out float x) { x = 1.0; }"), 2, "out"},
        {"inout", atTop("void f(inout float x) { x = 1.0; }"), 2, "inout"},
        {"double", inForce("double d = 1.0;"), 4, "double"},
        {"vector of doubles", inForce("dvec2 d;"), 4, "dvec2"},
        {"precision", atTop("precision highp float;"), 2, "precision"},
        {"invariant", atTop("invariant float x;"), 2, "invariant"},
        {"subroutine", atTop("subroutine float f(float x);"), 2, "subroutine"},
        {"two underscores", inForce("float a__b = 1.0;"), 4, "underscores"},
        {"a name behind a number", inForce("uint u = 0X0E+gl_WorkGroupID.x;"), 4, "gl_"},
        {"a name in a number", inForce("float x = 1.0E+k;"), 4, "is no number"},
    };
    return laws;
}

const std::vector<Broken>& loops() {
    static const std::vector<Broken> laws{
        {"while", inForce("while (true) {}"), 4, "no constant bound"},
        {"do", inForce("do {} while (true);"), 4, "no constant bound"},
        {"for ever", inForce("for (;;) {}"), 4, "no constant bound"},
        {"no bound", inForce("for (int i = 0; ; ++i) {}"), 4, "no constant bound"},
        {"a bound from the case", inForce("for (int i = 0; i < int(k); ++i) {}"), 4, "no constant bound"},
        {"a bound that varies", inForce("int n = 5; for (int i = 0; i < n; ++i) { n += 1; }"), 4, "no constant bound"},
        {"a counter of floats", inForce("for (float x = 0.0; x < 1.0; x += 0.1) {}"), 4, "no constant bound"},
        {"a counter from outside", inForce("int i = 0; for (i = 0; i < 3; ++i) {}"), 4, "no constant bound"},
        {"no step", inForce("for (int i = 0; i < 3; ) {}"), 4, "no constant bound"},
        {"a step of nothing", inForce("for (int i = 0; i < 3; i += 0) {}"), 4, "no constant bound"},
        {"the wrong way", inForce("for (int i = 0; i < 3; --i) {}"), 4, "no constant bound"},
        {"unequal", inForce("for (int i = 0; i != 3; ++i) {}"), 4, "no constant bound"},
        {"another condition", inForce("for (int i = 0; k < 3.0; ++i) {}"), 4, "no constant bound"},
        {"a counter that is set back", inForce("for (int i = 0; i < 3; ++i) { i = 0; }"), 4, "changes its counter"},
        {"a counter that is counted down", inForce("for (int i = 0; i < 3; ++i) i--;"), 4, "changes its counter"},
        {"a bound beyond 32 bits", inForce("for (int i = 2147483640; i <= 2147483647; ++i) {}"), 4, "may count to"},
        {"a step beyond 32 bits", inForce("for (int i = 0; i < 5; i += 2000000000) {}"), 4, "may count to"},
        {"too many trips", inForce("for (int i = 0; i < 1000000; ++i) {}"), 4, "trips"},
        {"too many in a nest", inForce("for (int i = 0; i < 999; ++i) for (int j = 0; j < 999; ++j) {}"), 4, "trips"},
        {"too many by a call",
         atTop("float f(float x) { for (int i = 0; i < 999; ++i) x += 1.0; return x; }\n"
               "float g(float x) { for (int i = 0; i < 999; ++i) x += f(x); return x; }"),
         3, "trips"},
        {"a constant in the shade",
         atTop("const int n = 3;\nfloat f(int n) { for (int i = 0; i < n; ++i) {} return 1.0; }"), 3,
         "constant already"},
        {"a constant in the shade of a sum",
         atTop("const int n = 3;\nfloat f() { const int n = 3 * 100000; for (int i = 0; i < n; ++i) {} return 1.0; }"),
         3, "constant already"},
        {"a constant in the shade of a precise number",
         atTop("const int n = 3;\nfloat f() { precise int n = 30000; for (int i = 0; i < n; ++i) {} return 1.0; }"), 3,
         "constant already"},
        {"a constant whose block has ended",
         atTop("const int n = 3 * 100000;\nfloat f() { { const int n = 3; } for (int i = 0; i < n; ++i) {} return 1.0; "
               "}"),
         3, "no constant bound"},
        {"a number to the base of eight", inForce("for (int i = 0777770; i < 777771; ++i) {}"), 4, "no constant bound"},
        {"too many by two answers",
         "float f(float x) { for (int i = 0; i < 6000; ++i) x += 1.0; return x; }\n"
         "float force(Contact c) { return f(1.0); }\nfloat stiffness(Contact c) { return f(1.0); }\n",
         3, "trips"},
        {"recursion", atTop("float f(float x) { return f(x - 1.0); }"), 2, "calls itself"},
    };
    return laws;
}

const std::vector<Broken>& engine() {
    static const std::vector<Broken> laws{
        {"state", inForce("vec4 s = state;"), 4, "'state' : undeclared"},
        {"history", inForce("history = vec4(0.0);"), 4, "'history' : undeclared"},
        {"forces", inForce("forces = vec4(0.0);"), 4, "'forces' : undeclared"},
        {"member", inForce("vec4 g = member.gravity;"), 4, "'member' : undeclared"},
        {"members", inForce("vec4 g = members.gravity;"), 4, "'members' : undeclared"},
        {"control", inForce("uint s = control.steps.x;"), 4, "'control' : undeclared"},
        {"push", inForce("uint s = push.share;"), 4, "'push' : undeclared"},
        {"source", inForce("uint s = source;"), 4, "'source' : undeclared"},
        {"self", inForce("uint s = self;"), 4, "'self' : undeclared"},
        {"readState", inForce("vec4 s = readState(0u, 0u, 0u);"), 4, "'readState' : no matching"},
        {"report", inForce("report(0u, 0u);"), 4, "'report' : no matching"},
        {"gravity", inForce("vec4 g = gravity();"), 4, "'gravity' : no matching"},
        {"parameters of the engine", inForce("ContactParams p;"), 4, "'ContactParams' : undeclared"},
        {"constant of the engine", inForce("uint w = kParticleWall;"), 4, "'kParticleWall' : undeclared"},
        {"glue of the engine", inForce("userStored = 1.0;"), 4, "'userStored' : undeclared"},
    };
    return laws;
}

const std::vector<Broken>& wrongForms() {
    static const std::vector<Broken> laws{
        {"no force", "float stiffness(Contact c) { return 1.0; }\n", 1, "force is missing"},
        {"no stiffness", "float force(Contact c) { return 1.0; }\n", 1, "stiffness is missing"},
        {"nothing", "", 1, "force is missing"},
        {"a comment", "// nothing\n", 1, "force is missing"},
        {"a comment without an end", atTop("/* float damping(Contact c) { return 1.0; }"), 2, "no end"},
        {"a slip in damping", atTop("float dampning(Contact c) { return 1.0; }"), 2,
         "nobody calls the function dampning"},
        {"a slip in force", "float Force(Contact c) { return 1.0; }\nfloat stiffness(Contact c) { return 1.0; }\n", 1,
         "nobody calls the function Force"},
        {"a parameter inside", inForce("parameter float q;"), 4, "inside of force"},
        {"force of nothing", answers("stiffness", "k") + "float damping() { return 1.0; }\n", 4, "signature"},
        {"pull of a number", atTop("float pull(float x) { return x; }"), 2, "signature"},
        {"a vector of force", "vec3 force(Contact c) { return vec3(0.0); }\n", 1, "signature"},
        {"a whole stiffness", "int stiffness(Contact c) { return 1; }\n", 1, "signature"},
        {"force of more", "float force(Contact c, float x) { return x; }\n", 1, "signature"},
        {"energy of two", atTop("float energy(Contact a, Contact b) { return 0.0; }"), 2, "signature"},
        {"reach of nothing", atTop("float reach() { return 0.0; }"), 2, "signature"},
        {"void damping", atTop("void damping(Contact c) {}"), 2, "signature"},
        {"prototype", atTop("float f(float x);"), 2, "no body"},
        {"two parameters of one name", atTop("parameter float k;"), 2, "declared twice"},
        {"two functions of one name", atTop("float f() { return 1.0; }\nfloat f() { return 1.0; }"), 3,
         "declared twice"},
        {"a whole parameter", atTop("parameter int n;"), 2, "float"},
        {"a parameter without a name", atTop("parameter float;"), 2, "no name"},
        {"a vector of memory", atTop("memory vec3 m;"), 2, "float"},
        {"too many parameters", atTop(many("parameter", 16)), 2, "room for 16"},
        {"too many memories", atTop(many("memory", 8)), 2, "room for 7"},
        {"a parameter called force", atTop("parameter float force;"), 2, "name of a function"},
        {"a constant called damping", atTop("const float damping = 0.5;"), 2, "damping is the name of a function"},
        {"a second constant called reach", atTop("const float a = max(1.0, 2.0), reach = 1e-6;"), 2,
         "reach is the name of a function"},
        {"a variable outside", atTop("float x = 1.0;"), 2, "outside of the functions"},
        {"a constant that varies", atTop("const float q = k;"), 2, "'"},
        {"a function of GLSL", atTop("float sqrt(float x) { return x; }"), 2, "function of GLSL"},
        {"a type that is none", atTop("float f(flot x) { return 1.0; }"), 2, "no type"},
        {"a word outside", atTop("hello"), 2, "begins no declaration"},
    };
    return laws;
}

const std::vector<Broken>& syntax() {
    static const std::vector<Broken> laws{
        {"no semicolon", inForce("float x = 1.0"), 5, "syntax error"},
        {"no parenthesis", inForce("float x = (1.0;"), 6, "no )"},
        {"no brace", "float stiffness(Contact c) { return 1.0; }\nfloat force(Contact c) { return 1.0;\n", 2, "ends"},
        {"no brace before a function",
         "float force(Contact c) { return 1.0;\nfloat stiffness(Contact c) { return 1.0; }\n", 2,
         "begins inside of force"},
        {"a brace too many", "float stiffness(Contact c) { return 1.0; }\nfloat force(Contact c) { return 1.0; }}\n", 2,
         "begins no declaration"},
        {"half a product", inForce("float x = k *;"), 4, "syntax error"},
        {"a misspelt type", inForce("flot x = 1.0;"), 4, "'flot' : undeclared"},
        {"no name", inForce("float = 1.0;"), 4, "syntax error"},
        {"a text", inForce("float x = \"a\";"), 4, "character"},
        {"an at sign", inForce("float x = @;"), 4, "character @"},
        {"a backslash", inForce("float x = \\"), 4, "character"},
        {"a letter that GLSL lacks", inForce("float \xc3\xa4 = 1.0;"), 4, "byte 0xc3"},
        {"half an exponent", inForce("float x = 1.0e;"), 4, "1.0e is no number"},
        {"a fraction of a whole number", inForce("int x = 1.5;"), 4, "cannot convert"},
        {"a vector for a number", inForce("float x = vec2(1.0);"), 4, "cannot convert"},
        {"a number for a choice", inForce("bool b = 1.0;"), 4, "cannot convert"},
        {"a name that is not declared", inForce("x = 1.0;"), 4, "'x' : undeclared"},
        {"a function that is not there", inForce("float x = foo(1.0);"), 4, "'foo' : no matching"},
        {"a number that is called", inForce("float x = k();"), 4, "'k'"},
        {"no answer", inForce("return;"), 4, "return"},
        {"a vector as an answer", inForce("return vec3(0.0);"), 4, "return"},
        {"no return at all", atTop("float damping(Contact c) { float x = 1.0; }"), 2, "without a return"},
        {"a return that may be passed by", atTop("float f(float x) { if (x > 0.0) return x; }"), 2, "without a return"},
        {"one branch without a return", atTop("float f(float x) { if (x > 0.0) return x; else x = 1.0; }"), 2,
         "without a return"},
        {"a return in a loop", atTop("float f() { for (int i = 0; i < 3; ++i) return 1.0; }"), 2, "without a return"},
        {"a variable without a value", inForce("float f; if (k > 0.0) f = 1.0;"), 4, "f is declared without a value"},
        {"a second one", inForce("float e = max(k, 1.0), f;"), 4, "f is declared without a value"},
        {"a contact without a value", inForce("Contact d;"), 4, "d is declared without a value"},
        {"a field that is not there", inForce("float x = c.temperature;"), 4, "temperature"},
        {"two variables of one name", inForce("float x = 1.0; float x = 2.0;"), 4, "redefinition"},
        {"a choice by a number", inForce("if (1.0) return 1.0;"), 4, "boolean"},
        {"a constant that is changed", inForce("const float x = 1.0; x = 2.0;"), 4, "l-value"},
    };
    return laws;
}

const std::vector<Broken>& badAnswers() {
    static const std::vector<Broken> laws{
        {"force is no number", answers("force", "sqrt(-c.overlap)"), 2, "force answers"},
        {"force is infinite", answers("force", "1.0 / (c.overlap - c.overlap)"), 2, "force answers"},
        {"force is infinite when fast", answers("force", "c.speed > 0.5 ? 1.0 / (k - k) : k"), 2, "force answers"},
        {"force is infinite when parting", answers("force", "c.speed < -0.5 ? 1.0 / (k - k) : k"), 2, "force answers"},
        {"force is infinite when deep", answers("force", "exp(1.0e9 * c.overlap)"), 2, "force answers"},
        {"force remembers no number",
         "parameter float k; memory float m;\nfloat force(Contact c) { m += sqrt(-1.0 - m); return m; }\n"
         "float stiffness(Contact c) { return 1.0; }\n",
         2, "force answers"},
        {"no stiffness", answers("stiffness", "0.0"), 2, "stiffness answers"},
        {"stiffness below zero", answers("stiffness", "-k"), 2, "stiffness answers"},
        {"stiffness that ends", answers("stiffness", "1.0 - 1.0e6 * c.overlap"), 2, "stiffness answers"},
        {"stiffness is no number", answers("stiffness", "sqrt(-k)"), 2, "stiffness answers"},
        {"damping below zero", answers("damping", "-1.0"), 2, "damping answers"},
        {"damping is no number", answers("damping", "sqrt(-k)"), 2, "damping answers"},
        {"pull below zero", answers("pull", "-1.0"), 2, "pull answers"},
        {"pull is infinite", answers("pull", "1.0 / (k - k)"), 2, "pull answers"},
        {"energy is no number", answers("energy", "sqrt(-k)"), 2, "energy answers"},
        {"reach below zero", answers("reach", "-1.0e-6"), 2, "reach answers"},
        {"reach of a metre", answers("reach", "1.0"), 2, "reach answers"},
        {"reach is no number", answers("reach", "sqrt(-k)"), 2, "reach answers"},
    };
    return laws;
}

}  // namespace

TEST_CASE("what belongs to the program or the device is refused in a law") {
    refuseAll(forbidden());
}
TEST_CASE("loops without a constant bound are refused in a law") {
    refuseAll(loops());
}
TEST_CASE("a law does not reach the engine's names") {
    refuseAll(engine());
}
TEST_CASE("a law must have its functions and declarations in their form") {
    refuseAll(wrongForms());
}
TEST_CASE("errors of GLSL are told in the user's own lines") {
    refuseAll(syntax());
}
TEST_CASE("a law that answers no finite or no positive number is refused") {
    refuseAll(badAnswers());
}

TEST_CASE("at least a hundred broken laws are tried") {
    std::set<std::string> texts;
    for (const auto* laws : {&forbidden(), &loops(), &engine(), &wrongForms(), &syntax(), &badAnswers()})
        for (const Broken& law : *laws) texts.insert(law.text);
    CHECK(texts.size() >= 100);
}
