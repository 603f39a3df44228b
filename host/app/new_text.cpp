// A new case as commented TOML.
#include <fmt/format.h>

#include <sstream>

#include "host/app/measures.h"
#include "host/app/new_design.h"
#include "host/core/vec.h"
#include "host/model/size_distribution.h"

namespace vkdose {

namespace {

constexpr std::size_t kComment = 30;  // column of the comments
constexpr std::size_t kWidth = 118;

std::string withSuffix(const Reasoned& value, const char* suffix) {
    return value.why + suffix;
}

/// Lines of a case, each with its reason behind it.
class CaseText {
  public:
    void table(const std::string& name) { text_ += fmt::format("\n[{}]\n", name); }
    void list(const std::string& name) { text_ += fmt::format("\n[[{}]]\n", name); }
    void remark(const std::string& text) { wrapped("", text); }
    void line(const std::string& key, const std::string& value, const std::string& why) {
        const std::string setting = key + " = " + value;
        if (why.empty())
            text_ += setting + "\n";
        else
            wrapped(fmt::format("{:<{}} ", setting, kComment - 1), why);
    }
    /// A value, in the unit of its key: `perSI` of them are one in SI.
    void line(const std::string& key, const Reasoned& v, double perSI) {
        line(key, figureText(v.value * perSI, 6), v.why);
    }
    void flag(const std::string& key, bool value, const std::string& why) { line(key, value ? "true" : "false", why); }
    void word(const std::string& key, const std::string& value, const std::string& why) {
        std::string quoted = "\"";
        for (const char c : value) quoted += c == '"' || c == '\\' ? std::string{'\\', c} : std::string{c};
        line(key, quoted + "\"", why);
    }
    const std::string& text() const { return text_; }

  private:
    /// `text` as a comment behind `front`, in as many lines as it takes.
    void wrapped(const std::string& front, const std::string& text) {
        std::string row = front + "#";
        const std::string indent(front.size(), ' ');
        std::istringstream words(text);
        for (std::string word; words >> word;) {
            if (row.size() + 1 + word.size() > kWidth) {
                text_ += row + "\n";
                row = indent + "#";
            }
            row += " " + word;
        }
        text_ += row + "\n";
    }

    std::string text_;
};

void writeOverlap(CaseText& out, const NewDesign& d) {
    if (d.mesh)
        out.line("max_overlap_ratio", "0.95", "a sphere pressed in deeper than its radius would pass through the mesh");
    else
        out.line("max_overlap_ratio", "1", "spheres are wedged between coil and wall; the report tells how deep");
}

/// The sizes of a powder's file, in the spheres of this case.
void writeScale(CaseText& out, const NewDesign& d) {
    const SizeDistribution &s = d.size, &own = d.powder->spheres.size;
    // Where the bounds are of the spheres, not of the grains, those of the file would stay.
    const bool bounds = byVolume(s);
    if (s.scaleUp == own.scaleUp && !(bounds && s.radiusMin > own.radiusMin)) return;
    out.table("particles.size");
    out.line("scale_up", figureText(s.scaleUp, 6), d.sizeWhy);
    if (bounds) {
        out.line("radius_min_mm", figureText(roundedUp(s.radiusMin * 1e3, 3)), "at least a third of the largest");
        out.line("radius_max_mm", figureText(roundedDown(s.radiusMax * 1e3, 6), 6), "");
    }
}

void writePowder(CaseText& out, const NewDesign& d) {
    out.table("particles");
    out.line("mass_g", d.fill, 1e3);
    writeScale(out, d);
    out.table("contact");
    writeOverlap(out, d);
}

void writeParticles(CaseText& out, const NewDesign& d) {
    out.table("particles");
    out.line("density", d.density, 1);
    out.line("mass_g", d.fill, 1e3);
    out.table("particles.size");
    const SizeDistribution& s = d.size;
    if (s.kind == SizeDistribution::Kind::Uniform) {
        const bool enlarged = s.scaleUp != 1;
        out.word("distribution", "uniform", "diameters spread by a fifth, against a crystal");
        out.line("radius_min_mm", figureText(s.radiusMin / s.scaleUp * 1e3), enlarged ? "given" : d.sizeWhy);
        out.line("radius_max_mm", figureText(s.radiusMax / s.scaleUp * 1e3), "");
        if (enlarged) out.line("scale_up", figureText(s.scaleUp), d.sizeWhy);
        return;
    }
    out.word("distribution", "quantiles", "");
    out.line("d10_um", figureText(2e6 * s.r10 / s.scaleUp, 6), "given; diameters by volume");
    out.line("d50_um", figureText(2e6 * s.r50 / s.scaleUp, 6), "");
    out.line("d90_um", figureText(2e6 * s.r90 / s.scaleUp, 6), "");
    out.line("scale_up", figureText(s.scaleUp), d.sizeWhy);
    if (s.radiusMin > finestRadius(s))
        out.line(
            "radius_min_mm", figureText(roundedUp(s.radiusMin * 1e3, 3)),
            fmt::format("a third of the largest: finer spheres would be most of them; {} % of the mass are finer and "
                        "become coarser ones",
                        figureText(100 * finerVolume(s, s.radiusMin), 2)));
}

void writeContacts(CaseText& out, const NewDesign& d) {
    const bool free = d.flow == Flow::Free;
    out.table("contact");
    out.remark(
        fmt::format("{} powder that flows {}: start values. Calibrate friction and adhesion with a measured dose "
                    "or heap (vkdose calibrate).",
                    d.flowGiven ? "Given: a" : "Assumed: a",
                    free                   ? "freely"
                    : d.flow == Flow::Easy ? "easily"
                                           : "badly (cohesive)"));
    const double scale = d.size.scaleUp;
    if (scale == 1) {
        out.line("k", figureText(d.stiffness.value), d.stiffness.why);
    } else {
        out.word("scaling", "stress", "k and bond_number are of the grains; the contacts of larger spheres follow");
        out.line("k", figureText(d.stiffness.value / scale),
                 fmt::format("that of the spheres is {} {}", figureText(d.stiffness.value), d.stiffness.why));
    }
    out.line("k1_over_k", figureText(d.k1OverK),
             free ? "elastic" : "loading is plastic, which keeps contacts together");
    if (!free) out.line("plasticity_depth", "0.05", "of the radius");
    if (d.bond == 0)
        out.line("kc_over_k", "0", "no adhesion");
    else
        out.line("bond_number", figureText(d.bond * scale),
                 scale == 1 ? "a contact pressed hard holds so many weights of a mean sphere"
                            : fmt::format("a contact pressed hard holds so many weights of a mean grain, or {} of a "
                                          "mean sphere",
                                          figureText(d.bond)));
    out.line("restitution", "0.5", "of mean spheres, at slow impacts; it gives the damping");
    out.line("friction", figureText(d.friction), "assumed; between particles");
    out.line("rolling_friction", figureText(d.rollingFriction), "assumed; stands for the shape of the grains");
    out.word("coulomb_limit", "absolute", "friction of the force that a contact bears");
    writeOverlap(out, d);
    out.table("contact.wall");
    out.line("friction", "0.3",
             fmt::format("assumed; of the powder on the wall and, as there is no [contact.coil], on the {}",
                         d.mesh ? "mesh" : "coil"));
}

std::string vectorText(const Vec3& v) {
    return fmt::format("[{}, {}, {}]", figureText(v.x, 6), figureText(v.y, 6), figureText(v.z, 6));
}

std::string advanceText(const NewMesh& m) {
    return m.first == m.last ? lengthText(m.advance) : fmt::format("{} in the mean", lengthText(m.advance));
}

void writeMesh(CaseText& out, const NewDesign& d) {
    const NewMesh& m = *d.mesh;
    out.list("body");
    out.word("name", "mesh", "in messages and tables");
    out.word("mesh", m.file.generic_string(), "given; relative to this file");
    out.word("unit", m.unit, "given; of the file's lengths");
    out.line("at", vectorText(m.at), "m; its axis on that of the canister, its end at the throat's end");
    if (m.rotation != 0) {
        out.line("rotation_axis", vectorText(m.rotationAxis), "lays its longest direction along the canister");
        out.line("rotation_deg", figureText(m.rotation), "");
    }
    out.word("contact", "coil", "of the contact parameters those of [contact.coil], or else of the wall");
    out.table("body.motion");
    out.word("kind", "turn", "");
    out.word("follows", "drive", "it turns while powder is dosed");
    out.line("axis", "[0, 0, 1]", "the canister's axis; z points to the outlet");
    out.line("turns_per_turn", figureText(m.turnsPerTurn),
             m.advance > 0 ? fmt::format("the sense in which its form conveys to the outlet, {} a turn", advanceText(m))
                           : "assumed; its form conveys nothing along the axis");
}

void writeDevice(CaseText& out, const NewDesign& d) {
    out.table("canister");
    out.line("length_mm", d.length, 1e3);
    out.line("width_mm", d.width, 1e3);
    out.line("height_mm", d.height, 1e3);
    out.word("floor", d.flatFloor ? "flat" : "trough", d.flatFloor ? "given" : "a half-cylinder around the coil");
    out.line("outlet_diameter_mm", d.outlet, 1e3);
    out.line("throat_length_mm", d.throat, 1e3);
    out.flag("lid", true, "keeps a sphere inside that the coil flings up");
    if (d.mesh) return writeMesh(out, d);
    out.table("coil");
    out.line("pitch_mm", d.pitch, 1e3);
    out.line("length_mm", d.coilLength, 1e3);
    out.line("z_start_mm", d.coilStart, 1e3);
    out.line("wire_diameter_mm", d.wire, 1e3);
    out.line("clearance_mm", d.clearance, 1e3);
    out.line("speed_rpm", d.speed, 60 / (2 * kPi));
}

void writeSchedule(CaseText& out, const NewDesign& d) {
    out.table("settle");
    out.flag("until_rest", true, "dose 1 begins when the bed rests");
    out.line("time_s", d.settle, 1);
    out.table("dose");
    if (d.mesh) out.line("speed_rpm", d.speed, 60 / (2 * kPi));
    if (d.target > 0) {
        out.line("mass_g", figureText(d.target * 1e3), "given; the coil stops when it is out");
        out.line("max_rotate_s", d.rotate, 1);
    } else
        out.line("rotate_s",
                 Reasoned{d.rotate.value,
                          withSuffix(d.rotate,
                                     fmt::format("; by the closed form {} a dose", massText(d.massPerDose)).c_str())},
                 1);
    out.line("rest_s", d.rest, 1);
    out.table("stop");
    out.word("rule", "experiment", "ends also when 3 doses together give no more than threshold_g");
    out.line("threshold_g", figureText(1e3 * rounded(0.03 * d.massPerDose, 1)), "a hundredth of three doses");
    out.line("max_doses", fmt::format("{}", d.doses), "dose 1 also fills the throat, so that it gives less");
    out.table("time");
    out.word("step_s", "auto", "as long as the stiffest contact allows");
    out.table("sensors");
    const double interval = rounded(d.expectedTurning / 100, 1);
    out.line("interval_s", figureText(interval),
             d.target > 0 ? "a hundredth of the expected rotation, which the coil ends at such an interval"
                          : "a hundredth of a rotation");
    out.table("frames");
    out.line("interval_s", figureText(10 * interval), "the report's player shows these; 0 keeps none");
}

}  // namespace

std::string newCaseText(const NewDesign& d) {
    CaseText out;
    out.remark(
        "Written by `vkdose new`. Behind each value stands its reason: \"given\", a rule, or \"assumed\" where you "
        "should put what you know. The keys name their units; what has none is in SI. `vkdose manual keys` explains "
        "every key, `vkdose check` what the case implies.");
    for (const std::string& note : d.notes) out.remark(note);
    out.word("reason",
             fmt::format("A canister of {} x {} x {} with {} {}, filled with {}; written by vkdose new",
                         lengthText(d.length.value), lengthText(d.width.value), lengthText(d.height.value),
                         d.mesh ? "the mesh" : "a coil of pitch",
                         d.mesh ? d.mesh->file.filename().string() : lengthText(d.pitch.value), massText(d.fill.value)),
             "");
    out.line("seed", "1", "another seed is another filling of the same powder");
    if (!d.accepted.empty()) {
        std::string names;
        for (const std::string& name : d.accepted) names += (names.empty() ? "" : " ") + name;
        out.word("accepted_warnings", names, "of vkdose check: what it warns of was given");
    }
    if (d.powder) out.word("powder_file", d.powder->file.generic_string(), "given; " + d.powder->title);
    if (!d.powder || !d.powder->spheres.bulkDensity)
        out.line("bulk_density", Reasoned{d.bulkDensity.value, "kg/m3; " + d.bulkDensity.why}, 1);
    if (d.powder) {
        writePowder(out, d);
    } else {
        writeParticles(out, d);
        writeContacts(out, d);
    }
    writeDevice(out, d);
    writeSchedule(out, d);
    return out.text();
}

}  // namespace vkdose
