// The tables that the passes bind, against the lists that they come from (shaders/shared/tables.h, field_tables.h), and
// the page that explains them.

#include <spirv_cross/spirv_cross_c.h>

#include <fstream>
#include <map>
#include <set>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "host/backend/vulkan/tables.h"
#include "shaders/shared/layout.h"
#include "spirv/passes.h"
#include "tests/support/catch.h"
#include "tests/support/folder.h"

using namespace vkdose;
using test::readText;

namespace {

struct Listed {
    unsigned binding;
    std::string name, element, title;
};

const std::vector<Listed> kListed{
#define TABLE(binding, name, element, count, title) {binding, #name, #element, #title},
#include "shaders/shared/tables.h"
};
const std::vector<Listed> kBodyListed{
#define TABLE(binding, name, element, count, title) {binding, #name, #element, #title},
#include "shaders/shared/body_tables.h"
};
const std::vector<Listed> kFieldListed{
#define TABLE(binding, name, element, count, title) {binding, #name, #element, #title},
#include "shaders/shared/field_tables.h"
};

struct Part {
    std::string table, function;
    std::uint64_t first, elements;
};

/// The parts of the tables, in the order of the list.
struct Parts : TableCounts {
    explicit Parts(const TableSizes& sizes) : TableCounts(sizes) {}

    std::vector<Part> all() const {
        using namespace gpu;
        return {
#define TABLE(binding, name, element, count, title)
#define ROW(table, function, first, length) {#table, #function, function(0), length},
#define ROWS(table, function, first, rows, length) {#table, #function, function(0, 0), (rows) * (length)},
#include "shaders/shared/tables.h"
        };
    }
};

struct FieldParts {
    std::uint64_t particles, forceEntries, points;

    std::uint64_t weights() const {
        using namespace gpu;
#define TABLE(binding, name, element, count, title) \
    if (std::string(#name) == "weights") return count;
#include "shaders/shared/field_tables.h"
        return 0;
    }
    std::vector<Part> all() const {
        using namespace gpu;
        return {
#define TABLE(binding, name, element, count, title)
#define ROW(table, function, first, length) {#table, #function, first, length},
#define ROWS(table, function, first, rows, length) {#table, #function, first, (rows) * (length)},
#include "shaders/shared/field_tables.h"
        };
    }
};

/// Sizes of which no two are equal and no sum is another.
TableSizes oddSizes(bool bodies, bool energyBook) {
    TableSizes s;
    s.members = 3;
    s.workgroup = 64;
    s.share = 1024;
    s.cells = 2048;
    s.rowEntries = 10007;
    s.linkEntries = 20011;
    s.pairSlots = 5 * 64;
    s.surfaceSlots = 7 * 64;
    s.bodies = bodies ? 2 : 0;
    s.bodySlots = bodies ? 11 * 64 : 0;
    s.energyBook = energyBook;
    return s;
}

/// The names of the blocks and views that a pass really uses, by binding.
class Used {
  public:
    explicit Used(std::span<const std::uint32_t> code) {
        spvc_context context = nullptr;
        REQUIRE(spvc_context_create(&context) == SPVC_SUCCESS);
        spvc_parsed_ir ir = nullptr;
        REQUIRE(spvc_context_parse_spirv(context, code.data(), code.size(), &ir) == SPVC_SUCCESS);
        spvc_compiler compiler = nullptr;
        REQUIRE(spvc_context_create_compiler(context, SPVC_BACKEND_NONE, ir, SPVC_CAPTURE_MODE_TAKE_OWNERSHIP,
                                             &compiler) == SPVC_SUCCESS);
        spvc_set active = nullptr;
        REQUIRE(spvc_compiler_get_active_interface_variables(compiler, &active) == SPVC_SUCCESS);
        spvc_resources resources = nullptr;
        REQUIRE(spvc_compiler_create_shader_resources_for_active_variables(compiler, &resources, active) ==
                SPVC_SUCCESS);
        for (const spvc_resource_type kind : {SPVC_RESOURCE_TYPE_STORAGE_BUFFER, SPVC_RESOURCE_TYPE_SEPARATE_IMAGE}) {
            const spvc_reflected_resource* list = nullptr;
            std::size_t count = 0;
            REQUIRE(spvc_resources_get_resource_list_for_type(resources, kind, &list, &count) == SPVC_SUCCESS);
            for (std::size_t i = 0; i < count; ++i)
                names[spvc_compiler_get_decoration(compiler, list[i].id, SpvDecorationBinding)].insert(list[i].name);
        }
        spvc_context_destroy(context);
    }

    std::map<unsigned, std::set<std::string>> names;
};

}  // namespace

TEST_CASE("every binding of a pass is that of its table in the list, or of the table's view") {
    std::set<std::string> met, ofBodies;
    for (const auto variants :
         {std::span<const vk::Variant>(spirv::near), std::span<const vk::Variant>(spirv::bodies),
          std::span<const vk::Variant>(spirv::free_bodies), std::span<const vk::Variant>(spirv::link),
          std::span<const vk::Variant>(spirv::pairs), std::span<const vk::Variant>(spirv::surfaces),
          std::span<const vk::Variant>(spirv::move), std::span<const vk::Variant>(spirv::sense),
          std::span<const vk::Variant>(spirv::neighbours)})
        for (const vk::Variant& variant : variants)
            for (const auto& [binding, names] : Used(variant.code).names)
                for (const std::string& name : names) {
                    INFO(name << " at " << binding);
                    const bool view = binding >= gpu::kFirstView;
                    const unsigned number = binding - (view ? gpu::kFirstView : 0);
                    REQUIRE(number < kListed.size());
                    const Listed& table = kListed[number];
                    if (name.rfind("Packed", 0) == 0) continue;  // the same table in other words
                    const auto own = std::find_if(kBodyListed.begin(), kBodyListed.end(), [&](const Listed& t) {
                        return t.binding == number && t.name + (view ? "View" : "Buffer") == name;
                    });
                    if (own != kBodyListed.end()) {
                        // In the place of a table that the pass does not use.
                        CHECK(names.size() == 1);
                        ofBodies.insert(own->name);
                        continue;
                    }
                    CHECK(name == table.name + (view ? "View" : "Buffer"));
                    met.insert(table.name);
                }
    CHECK(ofBodies.size() == kBodyListed.size());
    CHECK(met.size() >= gpu::kTables - 1);  // the energy book's sums are a matter of sense_energy
}

TEST_CASE("the parts of a table follow one another and fill it") {
    for (const bool bodies : {false, true})
        for (const bool energyBook : {false, true}) {
            const Parts parts(oddSizes(bodies, energyBook));
            std::map<std::string, std::uint64_t> end;
            for (const Part& part : parts.all()) {
                INFO(part.function << ", bodies " << bodies << ", energy book " << energyBook);
                if (part.elements > 0) CHECK(part.first == end[part.table]);
                end[part.table] += part.elements;
            }
            CHECK(end.size() == 10);
            const auto shapes = parts.shapes();
            for (std::size_t i = 0; i < kListed.size(); ++i)
                if (end.count(kListed[i].name) == 1) {
                    INFO(kListed[i].name << ", bodies " << bodies << ", energy book " << energyBook);
                    CHECK(std::max<std::uint64_t>(1, end[kListed[i].name]) == shapes[i].elements);
                }
        }
    const FieldParts fields{1024, 333, 4096};
    std::uint64_t end = 0;
    for (const Part& part : fields.all()) {
        INFO(part.function);
        CHECK(part.first == end);
        end += part.elements;
    }
    CHECK(end == fields.weights());
}

TEST_CASE("tables hold a member with no more regions that delete than their pipelines look for") {
    TableSizes none = oddSizes(true, true), two = none;
    two.outlets = 2;
    CHECK(two.holds(none));
    CHECK_FALSE(none.holds(two));
    none.growTo(two);
    CHECK(none.holds(two));
}

TEST_CASE("an element of a table has its place by part, row and column") {
    const Parts at(oddSizes(true, true));
    const std::uint64_t particles = 3ULL * 1024, spring = 3ULL * 12 * 64, bodySlots = 3ULL * 11 * 64;
    const std::uint64_t slots = spring + bodySlots;
    CHECK(at.linkIndex(5) == 3 * 10007 + 5);
    CHECK(at.slotRangeIndex(7) == particles + 7);
    CHECK(at.springIndex(9, 1) == 19);
    CHECK(at.exertedIndex(2, 9) == 4 * spring + 9);
    CHECK(at.bodyHistoryIndex(3, 8) == 5 * spring + 3ULL * gpu::kMaxBodyTouches * 6 + 8);
    CHECK(at.headIndex(2, 4) == 2 * 2048 + 4);
    CHECK(at.nextIndex(4) == 3 * 2048 + 4);
    CHECK(at.listAnchorIndex(4) == particles + 4);
    CHECK(at.speedLowIndex(4, 1) == 2 * particles + 9);
    CHECK(at.comingEntryIndex(4) == slots + 4);
    CHECK(at.bookIndex(2, 4) == 2 * particles + 4);
    CHECK(at.slotBookIndex(1, 4) == gpu::kBookFields * particles + slots + 4);
    CHECK(at.bodyLoadIndex(9, 4) == 9 * particles + 4);
    CHECK(at.bodyForceIndex(5, 1) == slots + 5ULL * gpu::kMaxBodyTouches + 1);
    CHECK(at.torqueIndex(4, 1) == 9);
}

TEST_CASE("a field pass uses no table whose place one of its own takes") {
    std::map<unsigned, std::string> own;
    for (const Listed& table : kFieldListed) own[table.binding] = table.name + "Buffer";
    std::set<std::string> met;
    for (const auto variants :
         {std::span<const vk::Variant>(spirv::field_branches), std::span<const vk::Variant>(spirv::field_weights),
          std::span<const vk::Variant>(spirv::field_sums), std::span<const vk::Variant>(spirv::field_kinetic)})
        for (const auto& [binding, names] : Used(variants[0].code).names) {
            CHECK(names.size() == 1);
            const bool taken = own.count(binding) == 1;
            REQUIRE(binding < kListed.size());
            CHECK(*names.begin() == (taken ? own[binding] : kListed[binding].name + "Buffer"));
            if (taken) met.insert(*names.begin());
        }
    CHECK(met.size() == kFieldListed.size());
}

TEST_CASE("shaders/README.md tells of every table, with its binding and element, and of every pass") {
    const std::string page = readText(VKDOSE_SOURCE_DIR "/shaders/README.md");
    REQUIRE_FALSE(page.empty());
    std::vector<Listed> all = kListed;
    all.insert(all.end(), kFieldListed.begin(), kFieldListed.end());
    all.insert(all.end(), kBodyListed.begin(), kBodyListed.end());
    for (const Listed& t : all) {
        const std::string row = "\n| " + std::to_string(t.binding) + " | `" + t.name + "` | `" + t.element + "` | ";
        INFO("a row that begins" << row);
        CHECK(page.find(row) != std::string::npos);
    }
    std::istringstream cmake(readText(VKDOSE_SOURCE_DIR "/shaders/passes.cmake"));
    std::size_t passes = 0;
    for (std::string line; std::getline(cmake, line);) {
        const std::size_t at = line.find("\"pass/");
        if (at == std::string::npos) continue;
        const std::string name = line.substr(at + 6, line.find_first_of(" \"", at + 6) - at - 6);
        INFO("pass " << name);
        CHECK(page.find("`" + name + "`") != std::string::npos);
        ++passes;
    }
    CHECK(passes >= 17);
}

TEST_CASE("the manual names the number of storage buffers that a device must bind") {
    std::ifstream file(VKDOSE_SOURCE_DIR "/host/app/README.md");
    std::string word, before;
    int named = 0;
    while (file >> word) {
        if (word == "storage") {
            std::string next, last;
            if (file >> next >> last && next == "buffers" && last == "per") {
                CHECK(before == std::to_string(gpu::kTables));
                ++named;
            }
        }
        before = word;
    }
    CHECK(named == 2);
}
