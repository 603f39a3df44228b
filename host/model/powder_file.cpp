#include "host/model/powder_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "host/core/printable.h"
#include "host/model/case_keys.h"
#include "host/model/case_reader.h"
#include "host/model/case_sections.h"
#include "host/model/named_file.h"

namespace vkdose {
namespace {

using namespace key;

constexpr Key kTop[] = {
    text("title", kRequired, "what the powder is, for people: `\"Glass beads, 1 mm\"`"),
    text("limits", "", "what it is not known for: sizes, speeds, figures that were missed"),
    text(
        "draws", told("none"),
        "a CSV with a column for each key of a case, `contact.friction`, and a row for each draw from the distribution "
        "of parameters that fit; the path is relative to this file"),
};
constexpr Key kLaboratory[] = {
    text("figure", kRequired, "what was measured: `\"loose bulk density\"`"),
    number("value", kPlain, Bound::Any, kRequired, "its value"),
    number("error", kPlain, kNonNegative, told("none stated"), "its standard error, as the source states it"),
    text("unit", "", "of the value: `\"kg/m3\"`"),
    text("method", "", "the instrument and what was done with it"),
    text("source", kRequired, "who published it, and where"),
    boolean("fitted", false, "whether the draws were chosen by this figure, as `--like` does"),
};
constexpr Key kHeld[] = {
    text("test", kRequired, "the case that the spheres were run in; the path is relative to this file"),
    text("figure", kRequired, "its figure, named as in `summary.json`, or what is made of such: `\"heap.angle_deg\"`"),
    number("measured", kPlain, Bound::Any, kRequired, "by the laboratory, in the unit of the figure"),
    number("measured_error", kPlain, kNonNegative, told("none stated"), "standard error of that"),
    number("simulated", kPlain, Bound::Any, kRequired, "mean over the runs"),
    number("simulated_error", kPlain, kNonNegative, told("none stated"), "standard error of that"),
    boolean("fitted", false, "whether the parameters were chosen by this figure. `false`: it was predicted"),
    text("note", "", "how it was run"),
};
constexpr KeyTable kPowderFileTables[] = {
    {"", kTop,
     "A powder file. Beside these keys it has `[particles]` with `density` and `[particles.size]`, `[contact]` with "
     "`[contact.wall]` and `[contact.coil]`, and `bulk_density`, as a case has them."},
    {"laboratory[]", kLaboratory, "A published figure of the powder, a table for each."},
    {"held[]", kHeld, "A figure that the spheres were held against, a table for each."},
};

/// The keys of a case that a powder states.
constexpr const char* kOfCases[] = {"particles", "contact", "bulk_density"};

std::optional<double> optionalNumber(Section& s, const char* key) {
    if (s.has(key)) return s.number(key);
    s.know(key);
    return {};
}

void readTables(Section& root, PowderFile& powder) {
    for (Section* s : root.tables("laboratory")) {
        PowderFile::Laboratory& l = powder.laboratory.emplace_back();
        l.figure = s->string("figure");
        l.value = s->number("value");
        l.error = optionalNumber(*s, "error");
        l.unit = s->string("unit");
        l.method = s->string("method");
        l.source = s->string("source");
        l.fitted = s->boolean("fitted");
    }
    for (Section* s : root.tables("held")) {
        PowderFile::Held& h = powder.held.emplace_back();
        h.test = s->string("test");
        h.figure = s->string("figure");
        h.measured = s->number("measured");
        h.measuredError = optionalNumber(*s, "measured_error");
        h.simulated = s->number("simulated");
        h.simulatedError = optionalNumber(*s, "simulated_error");
        h.fitted = s->boolean("fitted");
        h.note = s->string("note");
    }
}

/// Drops the powder that `lower` has. What is missing afterwards is missing in the file of `spheres`.
void dropPowder(Node& lower, const Node& spheres) {
    if (Node* particles = lower.child("particles"); particles != nullptr && spheres.child("particles") != nullptr)
        particles->drop("size");
    const Node* laws = spheres.child("contact");
    if (Node* contact = lower.child("contact"); contact != nullptr && laws != nullptr) {
        std::erase_if(contact->children, [](const Node& n) {
            return n.key != "max_overlap_ratio" && n.key.find('-') == std::string::npos;
        });
        contact->file = laws->file;
        contact->line = laws->line;
    }
    if (Node* settle = lower.child("settle"))
        for (const char* key : {"kc_over_k", "wall_kc_over_k", "coil_kc_over_k", "elastic"}) settle->drop(key);
    if (Node* time = lower.child("time")) time->drop("step_s");
}

}  // namespace

std::span<const KeyTable> powderFileKeys() {
    return kPowderFileTables;
}

PowderFile readPowderFile(const std::filesystem::path& file) {
    PowderFile powder;
    powder.file = file;
    Node tree = readTreeAlone(file);
    for (const char* key : kOfCases) {
        Node* node = tree.child(key);
        if (node == nullptr) continue;
        powder.spheres.children.push_back(*node);
        tree.drop(key);
    }
    CaseReader reader(file.string(), std::move(tree), powderFileKeys());
    Section& root = reader.root();
    powder.title = root.string("title");
    powder.limits = root.string("limits");
    root.know("draws");
    for (const char* key : kOfCases) root.know(key);
    if (root.has("draws")) {
        powder.draws = file.parent_path() / root.string("draws");
        if (root.isString("draws"))
            requireFile(reader, "draws", *powder.draws, "give the path of a CSV, relative to the powder's file");
    }
    readTables(root, powder);
    if (powder.spheres.child("contact") == nullptr && !reader.faulty())
        reader.fault("contact", "is missing: this is no powder file", "give [contact], or name a file that has it");
    reader.finish();
    reader.throwIfFaulty();
    return powder;
}

PowderSpheres spheresOf(const PowderFile& powder) {
    CaseReader reader(powder.file.string(), powder.spheres, caseKeys());
    Section& root = reader.root();
    Section& particles = root.requiredTable("particles");
    PowderSpheres spheres;
    spheres.density = particles.number("density");
    Told sieves;  // which is not asked for
    spheres.size = readSize(reader, particles.requiredTable("size"), sieves);
    if (root.has("bulk_density") && !root.isString("bulk_density")) spheres.bulkDensity = root.number("bulk_density");
    const Node* scaling = powder.spheres.child("contact")->child("scaling");
    spheres.stressScaled = scaling != nullptr && scaling->string == "stress";
    reader.throwIfFaulty();
    return spheres;
}

void layOver(Node& lower, Node upper, std::vector<std::filesystem::path>& files) {
    if (const Node* name = upper.child("powder_file")) {
        const char* remedy = "give the path of a powder file, relative to this one";
        if (name->kind != Node::Kind::String)
            throw CaseError({{name->file, name->line, "powder_file", name->text, "must be a string", remedy}});
        const std::filesystem::path folder =
            name->file == kCommandLine ? std::filesystem::path() : std::filesystem::path(name->file).parent_path();
        const std::filesystem::path file = folder / name->string;
        if (!std::filesystem::exists(file))
            throw CaseError({{name->file, name->line, "powder_file", name->text,
                              fmt::format("there is no file {}", printable(file.string())), remedy}});
        PowderFile powder = readPowderFile(file);
        files.push_back(file);
        dropPowder(lower, powder.spheres);
        merge(lower, std::move(powder.spheres));
        upper.drop("powder_file");
    }
    merge(lower, std::move(upper));
}

}  // namespace vkdose
