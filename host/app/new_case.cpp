#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <iostream>

#include "host/advice/advice.h"
#include "host/app/commands.h"
#include "host/app/exit_code.h"
#include "host/app/inputs.h"
#include "host/app/measures.h"
#include "host/app/new_answers.h"
#include "host/app/new_design.h"
#include "host/app/new_file.h"
#include "host/app/new_study.h"
#include "host/app/new_template.h"
#include "host/app/speed.h"
#include "host/app/tell.h"
#include "host/app/text.h"
#include "host/core/file.h"
#include "host/core/printable.h"
#include "host/model/size_distribution.h"

namespace vkdose {

namespace {

constexpr const char* kExample = "vkdose new my.toml --canister 80x30x100mm --coil 6x5mm --fill 48g";

/// Asks until the answer can be understood; an empty one takes what holds without.
void ask(const NewQuestion& q, NewAnswers& answers) {
    for (;;) {
        tell("{}\n  ", q.meaning);
        if (q.standard == nullptr)
            tell("(such as {}): ", q.example);
        else
            tell("(such as {}; empty: {}): ", q.example, q.standard);
        sendText(stdout);
        std::string line;
        if (!std::getline(std::cin, line) && std::ferror(stdin) != 0)
            throw ReadError(fmt::format("new: the answers cannot be read: {}", std::strerror(errno)));
        if (!std::cin) throw UsageError(fmt::format("new: the answers end before {}; nothing was written", q.option));
        const bool empty = line.find_first_not_of(" \t\r") == std::string::npos;
        if (empty && q.standard != nullptr) return;
        if (empty) continue;
        try {
            q.take(answers, q, line);
            return;
        } catch (const UsageError& e) {
            tell("  {}\n", e.what());
        }
    }
}

NewAnswers answersTo(const NewOptions& options) {
    const auto questions = newQuestions();
    NewAnswers answers;
    bool any = false;
    for (std::size_t i = 0; i < questions.size(); ++i) {
        if (options.answers[i].empty()) continue;
        questions[i].take(answers, questions[i], options.answers[i]);
        any = true;
    }
    if (options.ask || (!any && ::isatty(STDIN_FILENO) == 1)) {
        tell("A device and its powder, in a few questions; units are written with the numbers.\n\n");
        for (std::size_t i = 0; i < questions.size(); ++i)
            if (questions[i].asked && options.answers[i].empty() && (!questions[i].ofPowder || answers.powder.empty()))
                ask(questions[i], answers);
        tell("\n");
    }
    for (std::size_t i = 0; i < questions.size(); ++i)
        if (!answers.powder.empty() && questions[i].ofPowder && !options.answers[i].empty())
            throw UsageError(
                fmt::format("new: {} is told by the file of --powder; give one or the other", questions[i].option));
    if (!answers.canister) throw UsageError(fmt::format("new: --canister is needed: `{}`, or --ask", kExample));
    if (answers.mesh.empty() != answers.meshUnit.empty())
        throw UsageError(answers.mesh.empty() ? "new: --unit is that of a mesh; give --mesh FILE too"
                                              : "new: a mesh does not tell its unit; give --unit too, as a rule mm");
    if (!answers.mesh.empty() && (answers.turns || answers.pitch || answers.wire || answers.clearance))
        throw UsageError("new: --mesh stands in place of --coil, --wire and --clearance; give one or the other");
    if (answers.dose && answers.rotate)
        throw UsageError("new: --dose turns until the mass is out, --rotate for a time; give one or the other");
    if (answers.mesh.empty() && !answers.turns && !answers.pitch)
        throw UsageError(fmt::format("new: --coil or --mesh is needed: `{}`, or --ask", kExample));
    return answers;
}

/// What is written as it is: a device or a study. Both null if neither was asked for.
struct Ready {
    const DeviceTemplate* device = nullptr;
    const StudyTemplate* study = nullptr;
    std::filesystem::path base;  ///< of the study
};

/// Throws UsageError if something else was given too.
Ready readyOf(const NewOptions& options) {
    Ready ready;
    std::string name, given = options.ask ? "--ask" : "";
    const auto take = [&](const char* option) {
        if (!name.empty()) given = "--" + name;
        name = option;
    };
    const auto questions = newQuestions();
    for (std::size_t i = 0; i < questions.size(); ++i)
        if (!options.answers[i].empty()) given = questions[i].option;
    for (std::size_t i = 0; i < kDeviceTemplates.size(); ++i) {
        if (!options.devices[i]) continue;
        ready.device = &kDeviceTemplates[i];
        take(ready.device->name);
    }
    for (std::size_t i = 0; i < kStudyTemplates.size(); ++i) {
        if (options.studies[i].empty()) continue;
        ready.study = &kStudyTemplates[i];
        ready.base = options.studies[i];
        take(ready.study->command);
    }
    if (!name.empty() && !given.empty())
        throw UsageError(fmt::format("new: --{} and {}: what is ready is changed in its file; give it alone{}", name,
                                     given, given == "--powder" ? ", and the powder to `vkdose run`" : ""));
    return ready;
}

void tellDesign(const NewDesign& d, const Case& c, const std::filesystem::path& file) {
    const Insertion filled = insertParticles(c);
    tell("wrote      {}\n", printable(file.string()));
    tell("canister   {} along the coil, {} wide, {} high; outlet {}, throat {}\n", lengthText(d.length.value),
         lengthText(d.width.value), lengthText(d.height.value), lengthText(d.outlet.value), lengthText(d.throat.value));
    if (d.mesh)
        tell("mesh       {}, from {} to {} behind the rear wall\n", printable(d.mesh->file.string()),
             lengthText(d.coilStart.value), lengthText(d.coilStart.value + d.coilLength.value));
    else
        tell("coil       {} turns of {}, from {} to {} behind the rear wall, wire {}\n",
             figureText(d.coilLength.value / d.pitch.value, 4), lengthText(d.pitch.value),
             lengthText(d.coilStart.value), lengthText(d.coilStart.value + d.coilLength.value),
             lengthText(d.wire.value));
    if (d.powder) tell("powder     {} ({})\n", printable(d.powder->title), printable(d.powder->file.string()));
    tell("{:<10} {} in {} spheres of {} to {}\n", d.powder ? "" : "powder", massText(filled.mass),
         filled.particles.size(), lengthText(2 * smallestRadius(d.size)), lengthText(2 * largestRadius(d.size)));
    tellRunTime(c, filled);
    std::string assumed;
    for (const std::string& what : d.assumed) assumed += (assumed.empty() ? "" : ", ") + what;
    if (!assumed.empty()) tell("assumed    {}\n", assumed);
    for (const std::string& note : d.notes) tell("note       {}\n", note);
    tellNext(c, filled, file);
}

}  // namespace

Case caseOf(const NewDesign& design, const std::filesystem::path& file) {
    try {
        return loadResolvedCase(newCaseText(design), file);
    } catch (const CaseError& e) {
        std::string text = "new: these do not fit together, and nothing was written";
        for (const Diagnostic& d : e.faults())
            text += fmt::format("\n{}{}{}: {}; {}", printable(d.key), d.value.empty() ? "" : " = ", printable(d.value),
                                printable(d.problem), printable(d.remedy));
        throw UsageError(text);
    }
}

int newCommand(const NewOptions& options) {
    requireNewFile(options.file);
    const Ready ready = readyOf(options);
    if (ready.device != nullptr) {
        writeTemplate(*ready.device, options.file);
        return kOk;
    }
    if (ready.study != nullptr) {
        writeStudy(*ready.study, ready.base, options.file);
        return kOk;
    }
    NewDesign design = designOf(answersTo(options), options.file);
    fitContacts(design, caseOf(trialOf(design), options.file));
    const Case c = caseOf(design, options.file);
    writeNew(options.file, newCaseText(design));
    tellDesign(design, c, options.file);
    return kOk;
}

}  // namespace vkdose
