#include "host/app/new_answers.h"

#include <fmt/format.h>

#include <cctype>

#include "geometry/mesh_file.h"
#include "host/app/backends.h"
#include "host/app/find_case.h"
#include "host/app/measures.h"
#include "host/core/number.h"
#include "host/core/printable.h"

namespace vkdose {

namespace {

constexpr const char* kCanister = "80x30x100mm (length along the coil, width, height)";
constexpr const char* kCoil = "6x5mm (six turns of 5 mm pitch), 5mm (the pitch alone) or 6turns";
constexpr const char* kSizes = "90um (the median diameter) or 60/90/130um (d10, d50 and d90, diameters by volume)";

std::string lower(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

/// "80 x 30 × 100 mm" with the separator x.
std::string withPlainCrosses(std::string text) {
    for (std::size_t at = 0; (at = text.find("\u00d7", at)) != std::string::npos;) text.replace(at, 2, "x");
    for (char& c : text)
        if (c == 'X' || c == '*') c = 'x';
    return text;
}

void takeCanister(NewAnswers& a, const NewQuestion& q, const std::string& text) {
    const auto lengths = measuresOf(Measure::Length, q.option, withPlainCrosses(text), 'x', kCanister);
    if (lengths.size() != 3)
        throw UsageError(fmt::format("{} {}: it is not clear which lengths these are; give all three: {}", q.option,
                                     printable(text), kCanister));
    a.canister = {lengths[0], lengths[1], lengths[2]};
}

/// "6x5mm" is turns by pitch, "5mm" a pitch, "6turns" a number of turns; a bare number could be either.
void takeCoil(NewAnswers& a, const NewQuestion& q, const std::string& text) {
    std::string plain;
    for (const char c : lower(withPlainCrosses(text)))
        if (c != ' ') plain += c;
    const auto count = [&](const std::string& number) {
        const double turns = numberOf(number).value_or(0);
        if (!(turns > 0) || turns > 250)
            throw UsageError(fmt::format("{} {}: {} is no number of turns up to 250; write {}", q.option,
                                         printable(text), number.empty() ? "that" : printable(number), kCoil));
        return turns;
    };
    a.turns.reset();
    a.pitch.reset();
    const std::size_t cross = plain.find('x');
    const std::size_t word = plain.find("turn");
    if (cross != std::string::npos) {
        a.turns = count(plain.substr(0, cross));
        a.pitch = measureOf(Measure::Length, q.option, plain.substr(cross + 1), kCoil);
    } else if (word != std::string::npos) {
        a.turns = count(plain.substr(0, word));
    } else if (plain.find_first_not_of("0123456789.") == std::string::npos) {
        throw UsageError(fmt::format("{} {}: could be turns or a pitch; write {}", q.option, printable(text), kCoil));
    } else {
        a.pitch = measureOf(Measure::Length, q.option, plain, kCoil);
    }
}

void takeSizes(NewAnswers& a, const NewQuestion& q, const std::string& text) {
    const auto sizes = measuresOf(Measure::Length, q.option, text, '/', kSizes);
    if (sizes.size() != 1 && sizes.size() != 3)
        throw UsageError(fmt::format("{} {}: give one diameter or three: {}", q.option, printable(text), kSizes));
    if (sizes.size() == 3 && !(sizes[0] < sizes[1] && sizes[1] < sizes[2]))
        throw UsageError(
            fmt::format("{} {}: d10, d50 and d90 must increase; write {}", q.option, printable(text), kSizes));
    a.sizes = sizes;
}

void takeFlow(NewAnswers& a, const NewQuestion& q, const std::string& text) {
    const std::string word = lower(text);
    if (word == "free")
        a.flow = Flow::Free;
    else if (word == "easy")
        a.flow = Flow::Easy;
    else if (word == "cohesive")
        a.flow = Flow::Cohesive;
    else
        throw UsageError(
            fmt::format("{} {}: is none of the kinds; write free, easy or cohesive", q.option, printable(text)));
}

void takeFloor(NewAnswers& a, const NewQuestion& q, const std::string& text) {
    const std::string word = lower(text);
    if (word != "trough" && word != "flat")
        throw UsageError(fmt::format("{} {}: is no floor; write trough or flat", q.option, printable(text)));
    a.flatFloor = word == "flat";
}

void takeUnit(NewAnswers& a, const NewQuestion& q, const std::string& text) {
    const std::string word = lower(text);
    if (!geometry::metresIn(word))
        throw UsageError(fmt::format("{} {}: is no unit of length; give one of {}", q.option, printable(text),
                                     geometry::lengthUnits()));
    a.meshUnit = word;
}

template <std::optional<double> NewAnswers::*member, Measure kind>
void take(NewAnswers& answers, const NewQuestion& q, const std::string& text) {
    answers.*member = measureOf(kind, q.option, text, q.example);
}

constexpr std::array kQuestions{
    NewQuestion{"--canister", "LxWxHmm", "inside of the canister: length along the coil, width and height", nullptr,
                "80x30x100mm", true, takeCanister},
    NewQuestion{"--coil", "TURNSxPITCHmm",
                "coil: turns and pitch (6x5mm), the pitch alone (5mm) or the turns alone (6turns) of one from wall to "
                "throat",
                nullptr, "6x5mm", true, takeCoil},
    NewQuestion{"--mesh", "FILE",
                "in place of a coil: a screw or spring as an STL, OBJ or PLY, which turns along the canister", "a coil",
                "auger.stl", false, [](NewAnswers& a, const NewQuestion&, const std::string& text) { a.mesh = text; }},
    NewQuestion{"--unit", "UNIT", "of the lengths in the mesh's file, which does not tell it: m, cm, mm, um, inch",
                "none; a mesh needs it", "mm", false, takeUnit},
    NewQuestion{"--outlet", "LENGTH", "diameter of the outlet", "the canister's width", "20mm", true,
                take<&NewAnswers::outlet, Measure::Length>},
    NewQuestion{"--throat", "LENGTH", "length of the throat behind the outlet; powder that passes it is dosed",
                "as far as the coil reaches, or a pitch", "10mm", false, take<&NewAnswers::throat, Measure::Length>},
    NewQuestion{"--floor", "trough|flat", "floor of the canister: a half-cylinder around the coil, or flat", "trough",
                "flat", false, takeFloor},
    NewQuestion{"--wire", "LENGTH", "thickness of the coil's wire", "a fifth of the pitch", "1.5mm", true,
                take<&NewAnswers::wire, Measure::Length>},
    NewQuestion{"--clearance", "LENGTH", "gap between the wire and the wall", "2 % of the outlet's diameter", "0.5mm",
                false, take<&NewAnswers::clearance, Measure::Length>},
    NewQuestion{"--fill", "MASS", "mass of the powder in the canister",
                "a bed up to half a coil over the coil, or 0.7 of the height", "48g", true,
                take<&NewAnswers::fill, Measure::Mass>},
    NewQuestion{"--powder", "FILE",
                "a powder that is known: a powder file (TOML), or a name that `vkdose powders` lists",
                "none; the powder's figures are asked for", "glass-beads", true,
                [](NewAnswers& a, const NewQuestion&, const std::string& text) { a.powder = findPowder(text); }},
    NewQuestion{"--bulk-density", "DENSITY", "density of the settled powder", "500 kg/m3", "471kg/m3", true,
                take<&NewAnswers::bulkDensity, Measure::Density>, true},
    NewQuestion{"--density", "DENSITY", "density of the spheres", "that with which their bed has the bulk density",
                "1427kg/m3", false, take<&NewAnswers::density, Measure::Density>, true},
    NewQuestion{"--sizes", "D50|D10/D50/D90",
                "diameters of the powder by volume; they are enlarged to what can be "
                "simulated",
                "as the sphere budget says", "60/90/130um", true, takeSizes, true},
    NewQuestion{"--flow", "free|easy|cohesive",
                "how the powder flows: free (ffc above 10), easy (from 4 to 10) or cohesive (below)", "easy",
                "cohesive", true, takeFlow, true},
    NewQuestion{"--speed", "SPEED", "speed of the coil in a dose", "60 rpm, less for a large coil", "90rpm", true,
                take<&NewAnswers::speed, Measure::Speed>},
    NewQuestion{"--rotate", "TIME", "time that the coil turns in a dose", "two turns, at most a quarter of the fill",
                "2s", true, take<&NewAnswers::rotate, Measure::Time>},
    NewQuestion{"--dose", "MASS", "mass to dose to, in place of a time: the coil stops when it is out", "by time",
                "2mg", false, take<&NewAnswers::dose, Measure::Mass>},
    NewQuestion{"--doses", "INT", "doses after which the run ends", "3", "10", true,
                [](NewAnswers& a, const NewQuestion& q, const std::string& text) {
                    a.doses = countOf(q.option, text, 1000000, "10");
                }},
    NewQuestion{"--spheres", "INT", "spheres that the fill may take; more are slower and finer", "3000", "10000", true,
                [](NewAnswers& a, const NewQuestion& q, const std::string& text) {
                    a.spheres = countOf(q.option, text, 4000000, "3000");
                }},
};

}  // namespace

std::span<const NewQuestion> newQuestions() {
    return kQuestions;
}

}  // namespace vkdose
