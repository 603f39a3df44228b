#include "host/app/exit_code.h"

#include <fmt/format.h>

#include <filesystem>
#include <new>
#include <system_error>

#include "host/app/backends.h"
#include "host/core/error.h"
#include "host/core/file.h"
#include "host/core/memory_limit.h"
#include "host/core/printable.h"
#include "host/model/case.h"
#include "host/output/run_folder.h"
#include "host/photo/photograph.h"

namespace vkdose {

Refusal refusalOf(const std::exception_ptr& error) {
    const auto because = [](ExitCode code, const std::exception& e) {
        return Refusal{code, "vkdose: " + printableLines(e.what())};
    };
    try {
        std::rethrow_exception(error);
    } catch (const CaseError& e) {
        std::string faults;
        for (const Diagnostic& fault : e.faults()) faults += (faults.empty() ? "" : "\n") + fault.text();
        return {kBadInput, faults};
    } catch (const FolderError& e) {
        return because(kBadInput, e);
    } catch (const ReadError& e) {
        return because(kBadInput, e);
    } catch (const CheckpointError& e) {
        return because(kBadInput, e);
    } catch (const OutputError& e) {
        return because(kOutputError, e);
    } catch (const UsageError& e) {
        return because(kBadInput, e);
    } catch (const photo::PhotoError& e) {
        return because(kBadInput, e);
    } catch (const RunError& e) {
        return because(kRunError, e);
    } catch (const DeviceError& e) {
        return {kDeviceError, "vkdose: " + printableLines(e.what()) + memoryLimitText()};
    } catch (const std::filesystem::filesystem_error& e) {
        // A path that cannot even be looked at: links in a circle, a folder without leave to enter.
        return {kBadInput,
                fmt::format("vkdose: {} cannot be read: {}", printable(e.path1().string()), e.code().message())};
    } catch (const std::bad_alloc&) {
        return {kRunError, "vkdose: out of memory: use fewer particles or end other programs" + memoryLimitText()};
    } catch (const std::system_error& e) {
        if (e.code() == std::errc::resource_unavailable_try_again || e.code() == std::errc::not_enough_memory)
            return {kRunError, fmt::format("vkdose: the system gives this program no more memory or threads: {}{}",
                                           e.code().message(), memoryLimitText())};
        return {kRunError, "vkdose: internal error: " + printableLines(e.what())};
    } catch (const std::exception& e) {
        return {kRunError, "vkdose: internal error: " + printableLines(e.what())};
    }
}

std::string lastSaid(std::string text) {
    while (!text.empty() && text.back() == '\n') text.pop_back();
    text.erase(0, text.rfind('\n') + 1);
    const std::string name = "vkdose: ";
    return text.rfind(name, 0) == 0 ? text.substr(name.size()) : text;
}

}  // namespace vkdose
