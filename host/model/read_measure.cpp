// The tables [[measure]]: element tests, whose figures are taken when a run is over.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "host/model/case_sections.h"

namespace vkdose {
namespace {

using Kind = ElementTest::Kind;
using geometry::Rest;
using geometry::Turn;

/// The bodies that `body` names, the first `most` of them.
std::vector<std::size_t> readBodyNames(CaseReader& reader, Section& s, std::size_t most,
                                       const std::vector<RigidBody>& bodies) {
    std::vector<std::size_t> places;
    const std::string text = s.string("body");
    if (!s.isString("body")) return places;
    const std::vector<std::string> names = wordsOf(text);
    if (names.empty() || names.size() > most)
        reader.fault(s.path("body"), fmt::format("names {} bodies", names.size()),
                     most == 1 ? "name one" : "name the lid and what is fixed to it");
    for (const std::string& name : names)
        if (const auto place = placeOfBody(reader, s.path("body"), name, bodies)) places.push_back(*place);
    return places;
}

/// A time, or a list of times [s]; empty after a fault.
std::vector<double> readTimes(CaseReader& reader, Section& s, const char* key, bool required) {
    const Node* node = s.node(key);
    const auto refuse = [&](const std::string& problem) {
        reader.fault(s.path(key), problem, "give a time in s, or a list of them: [0.4, 0.7]");
        return std::vector<double>();
    };
    if (node == nullptr) return required ? refuse("is missing") : std::vector<double>();
    std::vector<double> times;
    const std::vector<Node> single{*node};
    for (const Node& item : node->kind == Node::Kind::Array ? node->children : single) {
        if (!item.isNumber() || !(item.number >= 0) || item.number > kLargestNumber) return refuse("is no time");
        times.push_back(item.number);
    }
    if (times.empty()) return refuse("is empty");
    s.record(key, times);
    return times;
}

struct WindowKeys {
    const char *from = "from_s", *to = "to_s";
};

/// Windows between the times of two keys; of a kind with one window, which may end with the run, `several` is false.
std::vector<ElementTest::Window> readWindows(CaseReader& reader, Section& s, bool several, WindowKeys keys = {}) {
    const bool endRequired = several;
    const std::vector<double> from = readTimes(reader, s, keys.from, true),
                              to = readTimes(reader, s, keys.to, endRequired);
    std::vector<ElementTest::Window> windows;
    for (const auto& [key, times] : {std::pair(keys.from, &from), std::pair(keys.to, &to)})
        if (!several && times->size() > 1)
            reader.fault(s.path(key), fmt::format("has {} times, and this measure has one window", times->size()),
                         "give one time, and a [[measure]] for each window");
    if (!endRequired && to.empty() && !from.empty()) return {{from.front(), geometry::kEndless}};
    if (!from.empty() && !to.empty() && from.size() != to.size())
        reader.fault(s.path(keys.to), fmt::format("has {} times, {} {}", to.size(), keys.from, from.size()),
                     "give each window a beginning and an end");
    for (std::size_t i = 0; i < std::min(from.size(), to.size()); ++i) {
        if (to[i] <= from[i])
            reader.fault(s.path(keys.to), fmt::format("{} is not later than {}", to[i], keys.from),
                         "give a later time");
        windows.push_back({from[i], to[i]});
    }
    return windows;
}

/// The steady flows before the points of a shear test, if it has them.
void readPreShears(CaseReader& reader, Section& s, ElementTest& m) {
    constexpr WindowKeys kKeys{"pre_shear_from_s", "pre_shear_to_s"};
    if (!s.has(kKeys.from) && !s.has(kKeys.to)) {
        s.know(kKeys.from);
        s.know(kKeys.to);
        return;
    }
    m.preShears = readWindows(reader, s, true, kKeys);
    if (!m.preShears.empty() && !m.windows.empty() && m.preShears.size() != m.windows.size())
        reader.fault(s.path(kKeys.from), fmt::format("has {} times, from_s {}", m.preShears.size(), m.windows.size()),
                     "give each point a pre-shear");
}

bool isGuided(const geometry::Motion& motion) {
    const auto* free = std::get_if<geometry::Free>(&motion);
    return free != nullptr && free->line.has_value();
}

/// Whether a motion is about a line, which says along which direction and about what the loads of a body count.
bool hasAxis(const geometry::Motion& motion) {
    return std::holds_alternative<Turn>(motion) || std::holds_alternative<geometry::Swing>(motion) ||
           std::holds_alternative<geometry::Table>(motion) || std::holds_alternative<geometry::Hinge>(motion) ||
           isGuided(motion);
}

/// A state before the end of the run is that of a frame.
void requireFrames(CaseReader& reader, Section& s, const char* key, const FrameStorage& frames) {
    if (frames.interval > 0) return;
    reader.fault(s.path(key), "looks at frames, and the run keeps none", "add [frames] with interval_s");
}

/// Whether the surface is looked at by a camera, from where `camera` says; else all of the powder counts.
bool readCamera(CaseReader& reader, Section& s, ElementTest::View camera, ElementTest& m) {
    const std::optional<std::size_t> view = s.choice("view");
    if (!view) return false;
    m.view = static_cast<ElementTest::View>(*view);
    if (m.view != ElementTest::View::Bulk && m.view != camera)
        reader.fault(s.path("view"), "is no view of this kind of measure",
                     fmt::format("give \"{}\", or \"bulk\"", wordsOf(ElementTest::kViews).at(std::size_t(camera))));
    return m.view == camera;
}

/// Of a drum made of a cylinder [m]; endless if it has another form.
double largestRadius(const RigidBody& drum) {
    double radius = 0;
    for (const geometry::Shape& shape : drum.shapes)
        if (const auto* round = std::get_if<geometry::Cone>(&shape))
            radius = std::max({radius, round->baseRadius, round->endRadius});
    return radius > 0 ? radius : geometry::kEndless;
}

void readFrontView(CaseReader& reader, Section& s, const World& world, ElementTest& m) {
    constexpr const char* kWindow = "window_mm";
    if (!readCamera(reader, s, ElementTest::View::Front, m)) {
        s.know(kWindow);
        if (s.has(kWindow) && m.view == ElementTest::View::Bulk)
            reader.fault(s.path(kWindow), "belongs to a view through the glass",
                         "add view = \"front\", or leave it out");
        return;
    }
    if (!s.has(kWindow)) {
        reader.fault(
            s.path(kWindow), "is missing",
            "give the distance from the drum's axis up to which the line is fitted, half of the drum's radius say");
        return;
    }
    m.halfWidth = s.number(kWindow);
    for (const std::size_t body : m.bodies)
        if (const double radius = largestRadius(world.bodies[body]); m.halfWidth >= radius)
            reader.fault(s.path(kWindow),
                         fmt::format("reaches beyond the drum, whose radius is {:.6g} mm", radius * 1e3),
                         "give less: it counts from the axis to either side");
}

void readKind(CaseReader& reader, Section& s, Kind kind, const World& world, const FrameStorage& frames,
              ElementTest& m) {
    switch (kind) {
        case Kind::AngleOfRepose:
        case Kind::BulkDensity:
            m.at = s.vector("at");
            if (kind == Kind::AngleOfRepose) readCamera(reader, s, ElementTest::View::Side, m);
            if (kind == Kind::BulkDensity) m.radius = s.number("radius_mm");
            if (s.has("time_s")) {
                m.time = s.number("time_s");
                requireFrames(reader, s, "time_s", frames);
            }
            s.know("time_s");
            return;
        case Kind::DrumAngle:
            m.bodies = readBodyNames(reader, s, 1, world.bodies);
            for (const std::size_t body : m.bodies)
                if (!std::holds_alternative<Turn>(world.bodies[body].course.motion))
                    reader.fault(s.path("body"), "does not turn", "name a body with [body.motion] kind = \"turn\"");
            readFrontView(reader, s, world, m);
            m.windows = readWindows(reader, s, false);
            requireFrames(reader, s, "from_s", frames);
            return;
        case Kind::Compression:
            m.bodies = readBodyNames(reader, s, 1, world.bodies);
            for (const std::size_t body : m.bodies)
                if (std::holds_alternative<Rest>(world.bodies[body].course.motion))
                    reader.fault(s.path("body"), "does not move",
                                 "give the piston a [body.motion], for example kind = \"table\"");
                else if (world.bodies[body].hinge() != nullptr)
                    reader.fault(s.path("body"), "turns on a hinge, and a piston goes along a line",
                                 "give the piston a line: kind = \"free\" with along");
                else if (world.bodies[body].clock != Clock::Time && !world.bodies[body].movesFreely())
                    reader.fault(
                        s.path("body"), "does not move by time, so that its way is not known",
                        "let the piston move by from_s and to_s, by the times of a table, or freely under a force");
            m.area = s.number("area_mm2");
            m.height = s.number("height_mm");
            m.axis = readDirection(reader, s, "axis");
            return;
        case Kind::Shear:
            m.bodies = readBodyNames(reader, s, kMaxBodies, world.bodies);
            for (const std::size_t body : m.bodies)
                if (!hasAxis(world.bodies[body].course.motion))
                    reader.fault(
                        s.path("body"), "has no axis, so that its load is no pressure and no torque",
                        "let the lid turn, swing, follow a table or move freely along a line, and the base stand");
            m.radius = s.number("radius_mm");
            m.innerRadius = s.number("inner_radius_mm");
            if (m.innerRadius >= m.radius)
                reader.fault(s.path("inner_radius_mm"), "is no smaller than the outer radius",
                             "give less than radius_mm");
            m.windows = readWindows(reader, s, true);
            readPreShears(reader, s, m);
            return;
        case Kind::Discharge:
            m.region = readRegionName(reader, s, world.regions);
            if (s.has("hole_mm")) m.hole = s.number("hole_mm");
            s.know("hole_mm");
            m.windows = readWindows(reader, s, false);
            return;
        case Kind::Content:
            m.region = readRegionName(reader, s, world.regions);
            m.windows = readWindows(reader, s, false);
            return;
    }
}

}  // namespace

std::vector<ElementTest> readMeasures(CaseReader& reader, Section& root, const World& world,
                                      const FrameStorage& frames) {
    std::vector<ElementTest> measures;
    std::set<std::string> names;
    for (Section* section : root.tables("measure")) {
        const auto kind = section->choice("kind");
        if (!kind) {
            section->abandon();
            continue;
        }
        ElementTest m;
        m.kind = static_cast<Kind>(*kind);
        m.name = readName(reader, *section, "measure", names, section->node("kind")->string);
        readKind(reader, *section, m.kind, world, frames, m);
        measures.push_back(std::move(m));
    }
    if (!measures.empty() && !(glm::length(world.gravity) > 0) && !reader.faulty())
        reader.fault("gravity", "is zero, so that no direction is upright",
                     "give a gravity to a case with a [[measure]]");
    return measures;
}

}  // namespace vkdose
