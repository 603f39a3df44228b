// The bodies: [[body]] with its shape (body_shapes.h), its place and [body.motion].
#include <fmt/format.h>

#include <set>
#include <utility>

#include "host/model/body_shapes.h"
#include "host/model/case_sections.h"

namespace vkdose {
namespace {

geometry::Pose readPlace(const BodyReader& b) {
    Section& s = b.section;
    const Vec3 at = s.vector("at"), axis = readDirection(b.reader, s, "rotation_axis");
    return {glm::angleAxis(s.number("rotation_deg"), axis), at};
}

/// The motion of another body, which it shares.
void readCompany(const BodyReader& b, RigidBody& body) {
    const std::string name = b.section.string("moves_with");
    if (!b.section.isString("moves_with")) return;
    if (b.section.has("motion"))
        return b.fault("moves_with", "stands beside [body.motion], which says another motion", "give one of the two");
    const auto place = placeOfBody(b.reader, b.section.path("moves_with"), name, b.read.bodies);
    if (!place) return;
    const RigidBody& leader = b.read.bodies[*place];
    if (leader.movesFreely())
        return b.fault("moves_with", "names a body that forces move, and these move it alone",
                       "make one body of the two, as one mesh");
    body.course.motion = leader.course.motion;
    body.course.schedule = leader.course.schedule;
    body.clock = leader.clock;
    body.phases = leader.phases;
    body.anew = leader.anew;
}

}  // namespace

BodiesRead readBodies(CaseReader& reader, Section& root, const std::vector<Material>& materials,
                      std::optional<double> meshReach) {
    BodiesRead read;
    std::set<std::string> names;
    for (Section* section : root.tables("body")) {
        const BodyReader b{reader, *section, meshReach, read};
        RigidBody body;
        body.name = readName(reader, *section, "body", names);
        if (body.name == kCoilName && root.has("coil"))
            reader.fault(section->path("name"), "is the name of [coil]", "give the body a name of its own");
        if (const auto word = section->choice("shape")) {
            BodyShape shape = readShape(b, *word);
            body.shapes = std::move(shape.shapes);
            body.curvature = shape.curvature;
        } else {
            section->abandon();
        }
        if (section->has("material") && section->has("contact"))
            b.fault("contact", "stands beside material, which says the same otherwise", "give one of the two");
        if (section->has("material")) section->know("contact");
        const bool asCoil = !section->has("material") && section->choice("contact") == std::size_t{1};
        body.material = readMaterialName(reader, *section, materials, asCoil ? kCoilMaterial : kWallMaterial);
        body.course.start = readPlace(b);
        readMotion(reader, *section, body);
        if (section->has("moves_with")) readCompany(b, body);
        section->know("moves_with");
        read.bodies.push_back(std::move(body));
    }
    if (read.bodies.size() > kMaxBodies)
        reader.fault("body", fmt::format("there are {}", read.bodies.size()),
                     fmt::format("give at most {}; one mesh may hold several parts that move together", kMaxBodies));
    return read;
}

void alignWithDrive(const std::optional<geometry::Coil>& coil, std::vector<RigidBody>& bodies) {
    if (!coil || geometry::conveyingRate(*coil, 1.0) > 0) return;
    for (RigidBody& body : bodies)
        if (auto* turn = std::get_if<geometry::Turn>(&body.course.motion); turn && body.clock == Clock::Drive)
            turn->rate = -turn->rate;
}

}  // namespace vkdose
