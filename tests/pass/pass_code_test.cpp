// The passes that are compiled at run time.
#include "host/backend/vulkan/pass_code.h"

#include "host/law/user_law.h"
#include "spirv/sources.h"
#include "tests/support/catch.h"

using namespace vkdose;

namespace {

/// What the compiler has against a law with this line in its force, the second of the text.
std::vector<LawFault> faultsOf(const std::string& line) {
    const LawReading reading = readLaw("test.glsl", "float force(Contact c) {\n" + line +
                                                        "\nreturn c.overlap;\n}\n"
                                                        "float stiffness(Contact c) { return 1.0; }\n");
    REQUIRE(reading.faults.empty());
    try {
        compiledNow("law/trial.comp", &reading.law, {});
    } catch (const LawError& error) {
        return error.faults;
    }
    FAIL("it compiles");
    return {};
}

}  // namespace

TEST_CASE("every pass compiles with tables that are reached by address") {
    int passes = 0;
    for (const auto& [name, text] : spirv::kSources) {
        const std::string file = name;
        if (!file.starts_with("pass/") || !file.ends_with(".comp") || file == "pass/store_trial.comp") continue;
        ++passes;
        for (const std::vector<std::string>& macros :
             {std::vector<std::string>{"ADDRESSED"}, {"ADDRESSED", "TEXEL_READS", "ENERGY_BOOK", "WITH_BODIES"}}) {
            CAPTURE(file, macros);
            CHECK_NOTHROW(compiledNow(file, nullptr, macros));
            CHECK_FALSE(compiledNow(file, nullptr, macros).empty());
        }
    }
    CHECK(passes > 15);
}

TEST_CASE("the compiler's messages on a law are told once, and in the law's words") {
    const auto field = faultsOf("float x = 2.0 * c.overlp;");
    REQUIRE(field.size() == 1);
    CHECK(field[0].line == 2);
    CHECK_THAT(field[0].problem, Catch::Contains("overlp"));

    const auto octal = faultsOf("int i = 09;");  // after it the compiler misses an #endif that is there
    REQUIRE(octal.size() == 1);
    CHECK(octal[0].line == 2);
    CHECK_THAT(octal[0].problem, Catch::Contains("octal"));

    const auto product = faultsOf("float x = 2.0 * c;");
    REQUIRE(product.size() == 1);
    CHECK_THAT(product[0].problem, Catch::Contains("'Contact'") && Catch::Contains("'float'"));
    CHECK_THAT(product[0].problem, !Catch::Contains("structure") && !Catch::Contains("highp"));
}
