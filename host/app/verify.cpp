#include <fmt/format.h>

#include <chrono>
#include <cstdio>

#include "host/app/commands.h"
#include "host/app/exit_code.h"
#include "host/app/interrupt.h"
#include "host/app/tell.h"
#include "host/core/file.h"
#include "host/core/printable.h"
#include "host/verify/findings_table.h"
#include "host/verify/suite.h"

namespace vkdose {

namespace {

std::vector<verify::Scene> chosenScenes(const std::string& only) {
    std::vector<verify::Scene> scenes = verify::scenesNamed(only);
    if (!scenes.empty()) return scenes;
    std::string known;
    for (const verify::Scene& scene : verify::scenes()) known += "\n  " + scene.name;
    throw UsageError("--only " + only + ": no case has this in its name; the cases are" + known);
}

}  // namespace

int verifyCommand(const VerifyOptions& options) {
    const std::vector<verify::Scene> scenes = chosenScenes(options.only);
    if (options.list) {
        for (const verify::Scene& scene : scenes) tell("{:<28} {}\n", scene.name, scene.what);
        return kOk;
    }
    const std::unique_ptr<Backend> backend = makeBackend(options.backend, 1);
    createFolder(options.out);

    using clock = std::chrono::steady_clock;
    const std::atomic<bool>& stop = watchInterrupts();
    const auto start = clock::now();
    std::vector<verify::Check> checks;
    tell("on {}\n\n{}\n", backend->description(), verify::headLine());
    for (const verify::Scene& scene : scenes) {
        if (stop) break;
        sendText(stdout);
        for (const verify::Check& check : verify::play(scene, *backend)) {
            tell("{}\n", verify::tableLine(check));
            checks.push_back(check);
        }
    }
    const verify::Setting setting{backend->description(), std::chrono::duration<double>(clock::now() - start).count()};
    replaceFile(options.out / "verify.json", verify::jsonTable(checks, setting));
    replaceFile(options.out / "verify.md", verify::markdownTable(checks, setting));
    tell("\n{}, in {:.0f} s; {} and verify.json say the same\n", verify::tally(checks), setting.seconds,
         printable((options.out / "verify.md").string()));
    if (stop) return kInterrupted;
    if (!validationClean(options.backend, *backend)) return kDeviceError;
    return verify::failures(checks) == 0 ? kOk : kDisagree;
}

}  // namespace vkdose
