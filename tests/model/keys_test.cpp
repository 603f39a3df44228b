// The declarations of keys are those that the reader reads by: a key that is declared and never read would stand in the
// manual and do nothing.
#include <algorithm>
#include <sstream>

#include "host/core/error.h"
#include "host/model/case_keys.h"
#include "tests/model/case_files.h"
#include "tests/support/catch.h"

using namespace vkdose;
using test::Folder;
using test::kFreeCase;
using test::kGoodCase;
using test::kSugar;
using test::replaced;

namespace {

/// `text` with `key = value` in the table under `header` ("" for the top), in place of what it says there.
std::string withKey(const std::string& text, const std::string& header, const std::string& key,
                    const std::string& value) {
    std::istringstream lines(text);
    std::string out, section;
    bool found = header.empty();
    if (found) out += key + " = " + value + "\n";
    for (std::string line; std::getline(lines, line);) {
        if (line.front() == '[') section = line;
        if (section == header && line.rfind(key + " =", 0) == 0) continue;
        out += line + "\n";
        if (line != header) continue;
        out += key + " = " + value + "\n";
        found = true;
    }
    if (!found) out += header + "\n" + key + " = " + value + "\n";
    return out;
}

/// A case in which the keys of a table that stands under `header` have a use, of those of several powders.
std::string caseWithPowders(const std::string& header, const std::string& kind) {
    if (header == "[powder.region]")
        return replaced(kFreeCase, "list = \"two.csv\"",
                        "mass_g = 0.1\n[particles.size]\ndistribution = \"fixed\"\nradius_mm = 1") +
               kSugar;
    if (header == "[powder.size]") {
        std::string text = withKey(kGoodCase + kSugar, header, "distribution", "\"" + kind + "\"");
        for (const char* bound : {"radius_min_mm", "radius_max_mm"}) text = withKey(text, header, bound, "1");
        return text;
    }
    return kGoodCase + kSugar;
}

/// A case in which the keys of the table have a use; of the sizes that of distribution `kind`.
std::string caseFor(const KeyTable& table, const std::string& header, const std::string& kind, const Key& key) {
    if (header.find("powder") != std::string::npos) return caseWithPowders(header, kind);
    std::string filled = replaced(kFreeCase, "list = \"two.csv\"",
                                  "mass_g = 0.1\n[particles.size]\ndistribution = \"fixed\"\nradius_mm = 1");
    if (header == "[particles.region]") return filled;
    if (table.paths == "plane[]" || table.paths == "cylinder[]")
        return replaced(filled, "boundaries = \"none\"", "boundaries = \"list\"");
    // A key of some shapes or motions begins its meaning with the first of them.
    const std::string_view meaning = key.meaning;
    const bool ofOne = meaning.starts_with('`') && !meaning.starts_with("`\"");
    const std::string of(ofOne ? meaning.substr(1, meaning.find('`', 1) - 1) : "plane");
    if (table.paths == "body[]" && (key.name == "mesh" || key.name == "unit"))
        return kGoodCase + "[[body]]\nname = \"b\"\nmesh = \"a.stl\"\nunit = \"mm\"\n";
    if (table.paths == "body[]") return kGoodCase + "[[body]]\nname = \"b\"\nshape = \"" + of + "\"\n";
    if (table.paths == "body[].motion")
        return kGoodCase + "[[body]]\nname = \"b\"\nshape = \"plane\"\n[body.motion]\nkind = \"" +
               (ofOne ? of : "turn") + "\"\n" + (key.name == "turns_per_turn" ? "follows = \"drive\"\n" : "");
    if (table.paths == "region[]")
        return kGoodCase + "[[region]]\nname = \"r\"\nkind = \"" + (ofOne ? of : "beyond") + "\"\n";
    if (table.paths == "measure[]") return kGoodCase + "[[measure]]\nkind = \"" + (ofOne ? of : "shear") + "\"\n";
    if (table.paths == "dose" && key.name == "speed_rpm")  // there is no coil
        return filled +
               "[[body]]\nname = \"b\"\nshape = \"plane\"\n[body.motion]\nkind = \"turn\"\n"
               "follows = \"drive\"\n";
    if (table.paths == "field[]") return kGoodCase + "[[field]]\npreset = \"height-profile\"\n";
    if (header != "[particles.size]") return kGoodCase;
    std::string text = withKey(kGoodCase, "[particles.size]", "distribution", "\"" + kind + "\"");
    for (const char* bound : {"radius_min_mm", "radius_max_mm"}) text = withKey(text, "[particles.size]", bound, "1");
    return text;
}

std::vector<std::string> headersOf(const KeyTable& table) {
    if (table.paths.empty()) return {""};
    std::vector<std::string> headers;
    for (const std::string& path : wordsOf(table.paths)) {
        const std::size_t bracket = path.find("[]");
        std::string plain = path;
        if (const std::size_t pair = plain.find(kPairOfNames); pair != std::string::npos)
            plain.replace(pair, kPairOfNames.size(), "powder-sugar");
        if (bracket != std::string::npos) plain.erase(bracket, 2);
        headers.push_back(path.ends_with("[]") ? "[[" + plain + "]]" : "[" + plain + "]");
    }
    return headers;
}

}  // namespace

TEST_CASE("every declared key is read: a date for its value is a fault of that key, not an unknown key") {
    const std::vector<std::string> kinds = wordsOf(keysOf(caseKeys(), "particles.size").front()->words);
    std::size_t distribution = 0, keys = 0;
    for (const KeyTable& table : caseKeys()) {
        const std::string kind = table.paths.starts_with("particles.size") ? kinds.at(distribution++) : "";
        for (const std::string& header : headersOf(table)) {
            for (const Key& key : table.keys) {
                const std::string name(key.name);
                const std::string plain = name.starts_with('"') ? name.substr(1, name.size() - 2) : name;
                const Folder folder;
                folder.write("two.csv", "x,y,z,r\n0,0,0,1e-3\n0,5e-3,0,1e-3\n");
                const auto file =
                    folder.write("case.toml", withKey(caseFor(table, header, kind, key), header, name, "1979-05-27"));
                CAPTURE(header, kind, name);
                ++keys;
                try {
                    loadCase(file);
                    FAIL("was not read");
                } catch (const CaseError& error) {
                    CAPTURE(error.what());
                    const auto blamed = [&](const Diagnostic& d) { return d.key.ends_with(plain) && d.line > 0; };
                    const auto fault = std::find_if(error.faults().begin(), error.faults().end(), blamed);
                    REQUIRE(fault != error.faults().end());
                    CHECK_THAT(fault->problem, !Catch::Contains("unknown"));
                }
            }
        }
    }
    CHECK(distribution == kinds.size());
    CHECK(keys > 100);
}

TEST_CASE("a default that is declared is the one that a case gets") {
    const Folder folder;
    const std::string resolved = loadCase(folder.write("case.toml", kGoodCase)).resolved;
    std::istringstream lines(resolved);
    std::string path;
    int compared = 0;
    for (std::string line; std::getline(lines, line);) {
        if (line.empty()) continue;
        if (line.front() == '[') path = line.substr(1, line.size() - 2);
        const std::size_t equals = line.find(" = ");
        if (equals == std::string::npos || kGoodCase.find(line.substr(0, equals + 2)) != std::string::npos) continue;
        if (path == "contact.wall" || path == "contact.coil") continue;  // they inherit
        for (const Key* key : keysOf(caseKeys(), path)) {
            if (key->name != line.substr(0, equals) || key->standard.kind != Default::Kind::Value) continue;
            CAPTURE(path, line);
            const std::string value = line.substr(equals + 3);
            // Intervals are rounded to whole steps.
            if (key->type == Key::Type::Number) CHECK(std::stod(value) == Approx(key->standard.value[0]).epsilon(1e-3));
            if (key->type == Key::Type::Word) CHECK(value == "\"" + std::string(key->standard.text) + "\"");
            if (key->type == Key::Type::Boolean) CHECK(value == (key->standard.value[0] != 0 ? "true" : "false"));
            ++compared;
        }
    }
    CHECK(compared > 20);
}

TEST_CASE("the reference of the keys has a heading for each table and a row for each key") {
    const std::string text = keyReference(caseKeys());
    for (const char* row :
         {"### `[contact]`, `[contact.wall]`, `[contact.coil]`, `[contact.A-B]`\n", "### `[[plane]]`\n",
          "| `density` | kg/m3 | required | > 0 | ", "| `speed_rpm` | rpm | required | ≥ 0 | ",
          "| `gravity` | m/s2 | [0, -9.81, 0] | three numbers | ", "| `lid` |  | `false` | "})
        CHECK_THAT(text, Catch::Contains(row));
    const std::string heading = "### `[particles.size]`, `[powder.size]`\n";
    CHECK(text.find(heading) == text.rfind(heading));  // one for its five kinds
}
