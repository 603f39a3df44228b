// How a body moves: [body.motion].
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/core/closest_word.h"
#include "host/core/csv_table.h"
#include "host/core/printable.h"
#include "host/model/case_sections.h"
#include "host/model/named_file.h"

namespace vkdose {
namespace {

using geometry::Shape;

/// The rows of the CSV that `file` names: the time, and of `columns` some. `make` makes a row from a function that
/// gives the number in a column, 0 in one that is left out. `remedy` tells the columns.
template <class Row, class Make>
std::vector<Row> readRows(CaseReader& reader, Section& s, const std::vector<std::string>& columns,
                          const std::string& remedy, Make make) {
    const std::string name = s.string("file");
    if (!s.isString("file")) return {};
    const std::filesystem::path file = reader.folderOf(s.path("file")) / name;
    if (!requireFile(reader, s.path("file"), file, "give the path of a CSV, relative to the case file")) return {};
    s.record("file", std::filesystem::absolute(file).lexically_normal().string());
    std::vector<Row> rows;
    try {
        const Table table = Table::read(file, LastLine::Whole);
        for (const std::string& column : table.names())
            if (column != "time_s" && std::find(columns.begin(), columns.end(), column) == columns.end())
                reader.fault(s.path("file"), fmt::format("has a column \"{}\"", printable(column)), remedy);
        if (table.names().size() < 2)
            reader.fault(s.path("file"), "has no column but the time, so that the body would stand", remedy);
        for (std::size_t i = 0; i < table.rows(); ++i)
            rows.push_back(make(table.number(i, "time_s"),
                                [&](const char* column) { return table.has(column) ? table.number(i, column) : 0.0; }));
    } catch (const CaseError& e) {
        for (const Diagnostic& d : e.faults()) reader.add(d);
    }
    return rows;
}

std::vector<geometry::Table::Row> readMotionTable(CaseReader& reader, Section& s) {
    return readRows<geometry::Table::Row>(
        reader, s, {"angle_deg", "x", "y", "z"}, "name the columns time_s, angle_deg, x, y, z; lengths in m",
        [](double time, auto in) -> geometry::Table::Row {
            return {time, in("angle_deg") / kDegree.perSI, {in("x"), in("y"), in("z")}};
        });
}

enum class MotionKind { Turn, Swing, Shake, Slide, Table, Free, Hinge };

/// What drives a body that moves freely: a steady value of `key`, or the rows of a file, which `readTable` reads.
template <class Row, class ReadTable>
std::vector<Row> readDrive(CaseReader& reader, Section& s, const char* key, ReadTable readTable) {
    if (!s.has("file")) {
        s.know("file");
        const double steady = s.number(key);
        return steady != 0 ? std::vector<Row>{{0, steady}} : std::vector<Row>{};
    }
    if (s.has(key))
        reader.fault(s.path(key), "stands beside file, which says the same otherwise", "give one of the two");
    s.know(key);
    return readTable();
}

std::vector<geometry::Free::Row> readForces(CaseReader& reader, Section& s) {
    using Row = geometry::Free::Row;
    return readDrive<Row>(reader, s, "force_N", [&] {
        return readRows<Row>(reader, s, {"force_N", "angle_deg"}, "name the columns time_s, force_N, angle_deg",
                             [](double time, auto in) -> Row {
                                 return {time, in("force_N"), in("angle_deg") / kDegree.perSI};
                             });
    });
}

std::vector<geometry::Hinge::Row> readTorques(CaseReader& reader, Section& s) {
    using Row = geometry::Hinge::Row;
    return readDrive<Row>(reader, s, "torque_mNm", [&] {
        return readRows<Row>(reader, s, {"torque_mNm"}, "name the columns time_s, torque_mNm",
                             [](double time, auto in) -> Row {
                                 return {time, in("torque_mNm") / 1e3};
                             });
    });
}

/// The way of a body that moves freely from its start to a stop, along its line [m] or about its hinge [rad].
double readStop(Section& s, const char* key, double none) {
    s.know(key);
    return s.has(key) ? s.number(key) : none;
}

/// `at`: where the body starts.
geometry::Free readFree(CaseReader& reader, Section& s, const Vec3& at) {
    geometry::Free free{s.number("mass_g"), s.vector("velocity", Vec3(0)), {}};
    free.damping = s.number("damping_kg_s");
    if (!s.has("along")) {
        s.know("along");
        for (const char* key : {"force_N", "file", "lowest_mm", "highest_mm"}) {
            if (s.has(key))
                reader.fault(s.path(key), "needs a line on which the body is guided",
                             "add along, the direction of that line");
            s.know(key);
        }
        return free;
    }
    free.line = readDirection(reader, s, "along");
    free.through = at;
    free.rows = readForces(reader, s);
    free.low = readStop(s, "lowest_mm", -geometry::kNoStop);
    free.high = readStop(s, "highest_mm", geometry::kNoStop);
    if (glm::length(glm::cross(*free.line, free.velocity)) > 1e-9 * glm::length(free.velocity))
        reader.fault(s.path("velocity"), "leads off the line of along",
                     "give a velocity along that line, or leave out along");
    if (!reader.faulty())
        if (const std::string why = geometry::motionFault(free); !why.empty())
            reader.fault(s.path("kind"), why, "mend the motion");
    return free;
}

geometry::Hinge readHinge(CaseReader& reader, Section& s) {
    geometry::Hinge hinge{readDirection(reader, s, "axis"), s.vector("through"), s.number("inertia_g_mm2")};
    hinge.rate = s.number("speed_rpm", 0.0);
    if (s.has("mass_g")) {
        hinge.mass = s.number("mass_g");
        hinge.centre = s.vector("centre");
    } else {
        if (s.has("centre")) reader.fault(s.path("centre"), "is of no mass", "add mass_g, or leave it out");
        s.know("mass_g");
        s.know("centre");
    }
    hinge.rows = readTorques(reader, s);
    hinge.low = readStop(s, "lowest_deg", -geometry::kNoStop);
    hinge.high = readStop(s, "highest_deg", geometry::kNoStop);
    hinge.damping = s.number("damping_mNm_s");
    if (!reader.faulty())
        if (const std::string why = geometry::motionFault(hinge); !why.empty())
            reader.fault(s.path("kind"), why, "mend the motion");
    return hinge;
}

geometry::Motion readMotionOf(CaseReader& reader, Section& s, MotionKind kind, Clock clock) {
    switch (kind) {
        case MotionKind::Turn: {
            const Vec3 axis = readDirection(reader, s, "axis"), through = s.vector("through");
            return geometry::Turn{axis, through,
                                  clock == Clock::Drive ? s.number("turns_per_turn") : s.number("speed_rpm")};
        }
        case MotionKind::Swing: {
            const Vec3 axis = readDirection(reader, s, "axis"), through = s.vector("through");
            const double amplitude = s.number("amplitude_deg"), frequency = s.number("frequency_hz");
            return geometry::Swing{axis, through, amplitude, frequency, s.number("phase_deg")};
        }
        case MotionKind::Shake: {
            const Vec3 axis = readDirection(reader, s, "axis");
            const double amplitude = s.number("amplitude_mm"), frequency = s.number("frequency_hz");
            return geometry::Shake{axis, amplitude, frequency, s.number("phase_deg")};
        }
        case MotionKind::Slide:
            return geometry::Slide{s.vector("velocity")};
        case MotionKind::Table: {
            const Vec3 axis = readDirection(reader, s, "axis"), through = s.vector("through");
            return geometry::Table{axis, through, readMotionTable(reader, s)};
        }
        case MotionKind::Free:
        case MotionKind::Hinge:
            break;  // readFreeBody
    }
    return geometry::Rest{};
}

/// The phases that `during` names.
std::vector<Phase> readPhases(CaseReader& reader, Section& s) {
    const std::string text = s.string("during");
    if (!s.isString("during")) return {};
    const std::vector<std::string> known(Words<Phase>::kNames.begin(), Words<Phase>::kNames.end());
    const std::string remedy = "give some of settle, rotate, reverse, rest, separated by blanks";
    std::vector<Phase> phases;
    for (const std::string& word : wordsOf(text)) {
        const auto found = std::find(known.begin(), known.end(), word);
        const auto phase = static_cast<Phase>(found - known.begin());
        if (found == known.end()) {
            const std::string meant = closestWord(word, known);
            reader.fault(s.path("during"), fmt::format("there is no phase \"{}\"", printable(word)),
                         meant.empty() ? remedy : fmt::format("did you mean \"{}\"?", meant));
        } else if (std::find(phases.begin(), phases.end(), phase) != phases.end()) {
            reader.fault(s.path("during"), fmt::format("names {} twice", word), "name each phase once");
        } else {
            phases.push_back(phase);
        }
    }
    if (wordsOf(text).empty()) reader.fault(s.path("during"), "names no phase", remedy);
    for (const char* key : {"from_s", "to_s"})
        if (s.has(key))
            reader.fault(s.path(key), "does not go with during, by which the body moves in phases",
                         "give one of the two");
    s.know("from_s");
    s.know("to_s");
    return phases;
}

/// Whether a body that follows the table is at its end where it is at its beginning.
bool closes(const geometry::Table& table) {
    const geometry::Table::Row &first = table.rows.front(), &last = table.rows.back();
    const double turns = (last.angle - first.angle) / (2 * kPi);
    return std::abs(turns - std::round(turns)) < 1e-9 && glm::length(last.shift - first.shift) < 1e-12;
}

/// When a body moves that moves by time.
void readTimes(CaseReader& reader, Section& s, RigidBody& made) {
    if (s.has("during")) {
        made.clock = Clock::Phases;
        made.phases = readPhases(reader, s);
        const auto* table = std::get_if<geometry::Table>(&made.course.motion);
        if (table == nullptr) return;
        made.anew = s.boolean("anew");
        if (made.anew && !table->rows.empty() && !closes(*table))
            reader.fault(s.path("anew"), "would let the body jump, for the table ends in another place than it begins",
                         "let its last row be the place of its first, or write anew = false");
        return;
    }
    s.know("during");
    if (s.has("anew")) reader.fault(s.path("anew"), "goes with during", "name the phases in which the table goes on");
    s.know("anew");
    const double from = s.number("from_s");
    const double to = s.has("to_s") ? s.number("to_s") : geometry::kEndless;
    s.know("to_s");
    if (to <= from) reader.fault(s.path("to_s"), "is not later than from_s", "give a later time");
    if (from > 0 || to < geometry::kEndless) made.course.schedule.intervals = {{from, to}};
}

/// Of a body that moves freely, whether more than gravity and the particles drives it.
bool isDriven(const geometry::Motion& motion) {
    if (const auto* hinge = std::get_if<geometry::Hinge>(&motion)) return !hinge->rows.empty();
    return !std::get<geometry::Free>(motion).rows.empty();
}

/// A body that moves freely, from a time on.
void readFreeBody(CaseReader& reader, Section& s, MotionKind kind, RigidBody& made) {
    const bool hinged = kind == MotionKind::Hinge;
    if (hinged)
        made.course.motion = readHinge(reader, s);
    else
        made.course.motion = readFree(reader, s, made.course.start.origin);
    for (const char* key : {"to_s", "anew"}) {
        if (s.has(key))
            reader.fault(s.path(key),
                         fmt::format("does not go with kind = \"{}\": once it is free, the body follows its forces",
                                     hinged ? "hinge" : "free"),
                         "leave it out; from_s says when it is free");
        s.know(key);
    }
    if (made.clock == Clock::Drive) reader.fault(s.path("follows"), "only a turn can follow the drive", "leave it out");
    made.clock = Clock::Forces;
    if (s.has("during")) {
        if (!isDriven(made.course.motion))
            reader.fault(s.path("during"),
                         fmt::format("stands beside neither {} nor file, and a free body moves in all phases",
                                     hinged ? "torque_mNm" : "force_N"),
                         "leave it out; from_s says when it is free");
        made.phases = readPhases(reader, s);
    } else {
        s.know("during");
        const double from = s.number("from_s");
        if (from > 0) made.course.schedule.intervals = {{from, geometry::kEndless}};
    }
    const auto endless = [](const Shape& shape) {
        return std::holds_alternative<geometry::Plane>(shape) || std::holds_alternative<geometry::Trough>(shape);
    };
    if (std::any_of(made.shapes.begin(), made.shapes.end(), endless))
        reader.fault(s.path("kind"), "is not for a plane or a trough, which have no end",
                     "give the body another shape, such as a box or a disc");
}

}  // namespace

void readMotion(CaseReader& reader, Section& body, RigidBody& made) {
    if (!body.has("motion")) {
        body.know("motion");
        return;
    }
    Section& s = body.table("motion");
    const auto kind = s.choice("kind");
    const auto follows = s.choice("follows");
    if (!kind || !follows) return s.abandon();
    made.clock = static_cast<Clock>(*follows);
    const auto motion = static_cast<MotionKind>(*kind);
    if (motion == MotionKind::Free || motion == MotionKind::Hinge) return readFreeBody(reader, s, motion, made);
    if (made.clock == Clock::Drive && motion != MotionKind::Turn) {
        reader.fault(s.path("follows"), "only a turn can follow the drive",
                     "write kind = \"turn\", or follows = \"time\"");
        return s.abandon();
    }
    made.course.motion = readMotionOf(reader, s, motion, made.clock);
    if (motion == MotionKind::Turn) {
        if (s.has("pockets")) made.pockets = static_cast<int>(s.integer("pockets"));
        s.know("pockets");
    }
    if (made.clock == Clock::Drive && s.has("during")) {
        reader.fault(s.path("during"), "does not go with follows = \"drive\": such a body moves when the drive turns",
                     "leave it out, or write follows = \"time\" and a speed");
        s.know("during");
    }
    if (made.clock == Clock::Time) readTimes(reader, s, made);
    if (reader.faulty()) return;
    if (const std::string why = geometry::motionFault(made.course.motion); !why.empty())
        reader.fault(s.path("kind"), why, "mend the motion");
}

}  // namespace vkdose
