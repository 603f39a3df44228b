// The workbench in a browser.
#include "host/app/commands.h"
#include "host/app/exit_code.h"
#include "host/app/find_case.h"
#include "host/app/interrupt.h"
#include "host/app/tell.h"
#include "host/core/printable.h"
#include "host/studio/server.h"

namespace vkdose {

int studioCommand(const StudioOptions& options) {
    const auto listening = [&](const std::string& address) {
        tell("studio     {}\nopen       {}\n", printable(options.folder.string()), address);
        tell("           in a browser on this machine; Ctrl-C ends the workbench, and runs keep a checkpoint\n");
        sendText(stdout);
    };
    studio::serve({options.folder, findCase("mini"), options.port}, listening, watchInterrupts());
    return kOk;
}

}  // namespace vkdose
