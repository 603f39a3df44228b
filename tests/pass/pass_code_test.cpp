// The passes that are compiled at run time.
#include "host/backend/vulkan/pass_code.h"

#include "spirv/sources.h"
#include "tests/support/catch.h"

using namespace vkdose;

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
