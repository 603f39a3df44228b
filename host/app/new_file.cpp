#include "host/app/new_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "host/advice/advice.h"
#include "host/app/speed.h"
#include "host/app/tell.h"
#include "host/app/text.h"
#include "host/core/error.h"
#include "host/core/file.h"
#include "host/core/printable.h"

namespace vkdose {

void requireAbsent(const std::filesystem::path& file) {
    std::error_code code;
    if (std::filesystem::exists(std::filesystem::symlink_status(file, code)))
        throw UsageError(fmt::format("new: {} is there already; give another name", printable(file.string())));
}

void requireNewFile(const std::filesystem::path& file) {
    requireAbsent(file);
    const std::string suffix = file.extension().string();
    if (suffix != ".toml" || !file.has_filename())
        throw UsageError(fmt::format("new {}: a case is a TOML file; give a name that ends in .toml, such as my.toml",
                                     printable(file.string())));
}

void writeNew(const std::filesystem::path& file, const std::string& text) {
    ::close(openOutput(file, O_WRONLY | O_CREAT | O_EXCL));
    try {
        replaceFile(file, text);
    } catch (const OutputError&) {
        ::unlink(file.c_str());
        throw;
    }
}

void tellRunTime(const Case& c, const Insertion& filled) {
    const Derived derived = derive(c, filled);
    tell("{}", workText(derived));
    sendText(stdout);
    const Speed speed = speedOf(c, filled, {}, false);
    if (speed.measured)
        tell("{}", runTimeText(derived, speed));
    else
        tell("run time   not known, because the device could not be measured: {}\n",
             printable(speed.told.substr(0, speed.told.find('\n'))));
}

void tellNext(const Case& c, const Insertion& filled, const std::filesystem::path& file) {
    for (const Warning& w : warningsOf(c, filled))
        if (!w.accepted) tell("warning    {}\n", w.line());
    const std::string word = shellWord(file.string());
    tell(
        "next       vkdose check {0}   (what it implies, and how long it takes)\n"
        "           vkdose render {0}   (a picture of the device and its powder)\n"
        "           vkdose run {0}\n",
        word);
}

}  // namespace vkdose
