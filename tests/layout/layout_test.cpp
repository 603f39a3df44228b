// The structs of shaders/shared/layout.h as C++ lays them out, against the offsets the compiled passes declare.

#include <spirv_cross/spirv_cross_c.h>

#include <cstddef>
#include <map>
#include <set>
#include <span>
#include <string>

#include "shaders/shared/geometry.h"
#include "shaders/shared/layout.h"
#include "shaders/shared/picture.h"
#include "spirv/passes.h"
#include "tests/support/catch.h"

namespace {

struct Field {
    std::string name;
    std::size_t offset;
    std::size_t size;
};

struct Layout {
    std::vector<Field> fields;
    std::size_t size;
};

#define FIELD(type, name) \
    { #name, offsetof(vkdose::gpu::type, name), sizeof(vkdose::gpu::type::name) }

const std::map<std::string, Layout>& hostLayouts() {
    using namespace vkdose::gpu;
    static const std::map<std::string, Layout> layouts = {
        {"ContactParams",
         {{FIELD(ContactParams, normal), FIELD(ContactParams, springs), FIELD(ContactParams, friction),
           FIELD(ContactParams, damping), FIELD(ContactParams, own)},
          sizeof(ContactParams)}},
        {"SurfaceParams",
         {{FIELD(SurfaceParams, pointHigh), FIELD(SurfaceParams, pointLow), FIELD(SurfaceParams, axis),
           FIELD(SurfaceParams, radius)},
          sizeof(SurfaceParams)}},
        {"Member",
         {{FIELD(Member, contact), FIELD(Member, surface), FIELD(Member, gravity), FIELD(Member, domainLow),
           FIELD(Member, domainHigh), FIELD(Member, numerics), FIELD(Member, choices), FIELD(Member, roster),
           FIELD(Member, bodies), FIELD(Member, outlets), FIELD(Member, densities), FIELD(Member, properties),
           FIELD(Member, period)},
          sizeof(Member)}},
        {"Dispatches",
         {{FIELD(Dispatches, heads), FIELD(Dispatches, particles), FIELD(Dispatches, refresh), FIELD(Dispatches, parts),
           FIELD(Dispatches, settle), FIELD(Dispatches, pairs), FIELD(Dispatches, surfaces), FIELD(Dispatches, bodies),
           FIELD(Dispatches, faces), FIELD(Dispatches, tables)},
          sizeof(Dispatches)}},
        {"Control",
         {{FIELD(Control, wanted), FIELD(Control, steps), FIELD(Control, listed), FIELD(Control, sorted),
           FIELD(Control, coming), FIELD(Control, list), FIELD(Control, drift), FIELD(Control, call),
           FIELD(Control, error)},
          sizeof(Control)}},
        {"SensorRecord",
         {{FIELD(SensorRecord, count), FIELD(SensorRecord, mass), FIELD(SensorRecord, motion),
           FIELD(SensorRecord, extremes)},
          sizeof(SensorRecord)}},
        {"EnergyRecord",
         {{FIELD(EnergyRecord, normal), FIELD(EnergyRecord, sliders), FIELD(EnergyRecord, flow),
           FIELD(EnergyRecord, elastic), FIELD(EnergyRecord, momentum), FIELD(EnergyRecord, angular)},
          sizeof(EnergyRecord)}},
        {"BodyMotion",
         {{FIELD(BodyMotion, toBodyHigh), FIELD(BodyMotion, toBodyLow), FIELD(BodyMotion, velocity),
           FIELD(BodyMotion, spin), FIELD(BodyMotion, centre), FIELD(BodyMotion, free), FIELD(BodyMotion, line),
           FIELD(BodyMotion, way), FIELD(BodyMotion, held), FIELD(BodyMotion, pivot), FIELD(BodyMotion, hinge),
           FIELD(BodyMotion, axisLow), FIELD(BodyMotion, pivotLow)},
          sizeof(BodyMotion)}},
        {"GroupRecord", {{FIELD(GroupRecord, sensors), FIELD(GroupRecord, energy)}, sizeof(GroupRecord)}},
        {"FieldParams",
         {{FIELD(FieldParams, low), FIELD(FieldParams, size), FIELD(FieldParams, cell), FIELD(FieldParams, along),
           FIELD(FieldParams, points), FIELD(FieldParams, tile), FIELD(FieldParams, tiles), FIELD(FieldParams, chosen),
           FIELD(FieldParams, tables)},
          sizeof(FieldParams)}},
        {"StepPush",
         {{FIELD(StepPush, stepInStride), FIELD(StepPush, opening), FIELD(StepPush, firstRow), FIELD(StepPush, live),
           FIELD(StepPush, particles), FIELD(StepPush, share), FIELD(StepPush, cellMask), FIELD(StepPush, rowEntries),
           FIELD(StepPush, linkEntries), FIELD(StepPush, pairSlots), FIELD(StepPush, surfaceSlots),
           FIELD(StepPush, bodySlots), FIELD(StepPush, slice)},
          sizeof(StepPush)}},
        {"PictureParams",
         {{FIELD(PictureParams, right), FIELD(PictureParams, up), FIELD(PictureParams, towards),
           FIELD(PictureParams, target), FIELD(PictureParams, centre), FIELD(PictureParams, light),
           FIELD(PictureParams, cut), FIELD(PictureParams, box), FIELD(PictureParams, wire),
           FIELD(PictureParams, cells), FIELD(PictureParams, size)},
          sizeof(PictureParams)}},
    };
    return layouts;
}

/// Every named struct reachable from the buffers and push constants of a module, checked against the host's.
class Reflection {
  public:
    explicit Reflection(std::span<const std::uint32_t> code) {
        REQUIRE(spvc_context_create(&context_) == SPVC_SUCCESS);
        spvc_parsed_ir ir = nullptr;
        REQUIRE(spvc_context_parse_spirv(context_, code.data(), code.size(), &ir) == SPVC_SUCCESS);
        REQUIRE(spvc_context_create_compiler(context_, SPVC_BACKEND_NONE, ir, SPVC_CAPTURE_MODE_TAKE_OWNERSHIP,
                                             &compiler_) == SPVC_SUCCESS);
    }
    ~Reflection() { spvc_context_destroy(context_); }
    Reflection(const Reflection&) = delete;
    Reflection& operator=(const Reflection&) = delete;

    std::set<std::string> check() {
        spvc_resources resources = nullptr;
        REQUIRE(spvc_compiler_create_shader_resources(compiler_, &resources) == SPVC_SUCCESS);
        for (const spvc_resource_type kind : {SPVC_RESOURCE_TYPE_STORAGE_BUFFER, SPVC_RESOURCE_TYPE_PUSH_CONSTANT}) {
            const spvc_reflected_resource* list = nullptr;
            std::size_t count = 0;
            REQUIRE(spvc_resources_get_resource_list_for_type(resources, kind, &list, &count) == SPVC_SUCCESS);
            for (std::size_t i = 0; i < count; ++i) visit(list[i].base_type_id);
        }
        return seen_;
    }

  private:
    void visit(spvc_type_id id) {
        const spvc_type type = spvc_compiler_get_type_handle(compiler_, id);
        if (spvc_type_get_basetype(type) != SPVC_BASETYPE_STRUCT) return;
        const spvc_type_id base = spvc_type_get_base_type_id(type);
        const std::string name = spvc_compiler_get_name(compiler_, base);
        const unsigned members = spvc_type_get_num_member_types(type);
        const auto host = hostLayouts().find(name);
        if (host != hostLayouts().end() && seen_.insert(name).second) {
            INFO("struct " << name);
            REQUIRE(members == host->second.fields.size());
            for (unsigned m = 0; m < members; ++m) checkField(type, base, m, host->second.fields[m]);
            std::size_t size = 0;
            REQUIRE(spvc_compiler_get_declared_struct_size(compiler_, type, &size) == SPVC_SUCCESS);
            CHECK(size == host->second.size);
        }
        for (unsigned m = 0; m < members; ++m) visit(spvc_type_get_member_type(type, m));
    }

    void checkField(spvc_type type, spvc_type_id base, unsigned m, const Field& field) {
        INFO("member " << field.name);
        CHECK(spvc_compiler_get_member_name(compiler_, base, m) == field.name);
        unsigned offset = 0;
        REQUIRE(spvc_compiler_type_struct_member_offset(compiler_, type, m, &offset) == SPVC_SUCCESS);
        CHECK(offset == field.offset);
        std::size_t size = 0;
        REQUIRE(spvc_compiler_get_declared_struct_member_size(compiler_, type, m, &size) == SPVC_SUCCESS);
        CHECK(size == field.size);
    }

    spvc_context context_ = nullptr;
    spvc_compiler compiler_ = nullptr;
    std::set<std::string> seen_;
};

std::set<std::string> structsOf(std::span<const std::uint32_t> code) {
    return Reflection(code).check();
}

}  // namespace

TEST_CASE("C++ and GLSL see the same structs") {
    std::set<std::string> seen;
    for (const auto& structs :
         {structsOf(pairs_spv), structsOf(pairs_texel_spv), structsOf(surfaces_packed_energy_spv), structsOf(move_spv),
          structsOf(move_texel_energy_spv), structsOf(near_spv), structsOf(near_texel_energy_spv),
          structsOf(commit_lists_spv), structsOf(sense_spv), structsOf(sense_energy_spv), structsOf(neighbours_spv),
          structsOf(field_sums_spv), structsOf(free_bodies_spv), structsOf(cast_spv)})
        seen.insert(structs.begin(), structs.end());
    for (const auto& [name, layout] : hostLayouts()) {
        INFO("struct " << name << " is in no pass: nothing was compared");
        CHECK(seen.count(name) == 1);
    }
}

TEST_CASE("a sum of ways is never below the true one, however small they are") {
    using vkdose::gpu::wayAfter;
    CHECK(wayAfter(3e-5f, 0) == 3e-5f);
    for (const float way : {1e-13f, 3e-12f, 1e-7f}) {
        CAPTURE(way);
        float gone = 7e-6f;
        double whole = gone;
        for (int step = 0; step < 1'000'000; ++step) {
            gone = wayAfter(gone, way);
            whole += way;
        }
        CHECK(gone >= whole);
        // Each sum rounds up, by no more than two units in the last place.
        CHECK(gone <= whole * 1.3);
    }
}
