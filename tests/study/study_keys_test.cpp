// The declarations of a study's keys are those that its readers read by, as tests/model/keys_test.cpp says of a case.
#include "host/study/study_keys.h"

#include <algorithm>

#include "tests/study/study_files.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;

TEST_CASE("every declared key of a study is read: a date for its value is a fault of that key") {
    const std::string axis = "base = \"good.toml\"\n[[axis]]\n";
    const std::string grid = axis + "key = \"contact.kc_over_k\"\nvalues = [0.2, 0.5]\n[calibrate]\n";
    const std::string search =
        "base = \"good.toml\"\n[calibrate]\nmethod = \"surrogate\"\ntarget_g_per_dose = 1\n"
        "tolerance_g = 0.1\n";
    const std::string date = " = 1979-05-27\n";
    int keys = 0;
    for (const KeyTable& table : studyKeys()) {
        for (const Key& key : table.keys) {
            const std::string name(key.name);
            if (table.paths == "set") continue;  // any key of a case
            std::string text = name + date + (name == "base" ? "" : "base = \"good.toml\"\n");
            if (table.paths == "axis[]") text = axis + name + date;
            if (table.paths == "calibrate")
                text = (name == "max_runs" || name == "first_points" ? search : grid) + name + date;
            if (table.paths.starts_with("calibrate.parameter[]"))
                text = search + "[[calibrate.parameter]]\n" + name + date;
            if (table.paths == "design") text = "base = \"good.toml\"\n[design]\n" + name + date;
            if (table.paths == "design.goal[]") text = "base = \"good.toml\"\n[[design.goal]]\n" + name + date;
            if (table.paths == "calibrate.target[]")
                text =
                    "base = \"good.toml\"\n[calibrate]\nmethod = \"surrogate\"\n[[calibrate.target]]\n" + name + date;
            CAPTURE(text);
            const StudyFolder folder;
            const std::vector<Diagnostic> faults = faultsOf(folder, text);
            const auto fault = std::find_if(faults.begin(), faults.end(), [&](const Diagnostic& d) {
                return d.key.find(name) != std::string::npos || (d.key.rfind("axis", 0) == 0 && d.line > 0);
            });
            REQUIRE(fault != faults.end());
            for (const Diagnostic& d : faults) CHECK_THAT(d.problem, !Catch::Contains("unknown"));
            ++keys;
        }
    }
    CHECK(keys > 15);
}
