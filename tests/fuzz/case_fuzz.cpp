// Fuzz target of the case reader: any bytes load as a case or are refused with clear messages. What loads must load
// again from its resolved form. Bytes after a line "=== list.csv" are the particle list beside the case.
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "host/model/case.h"
#include "tests/model/mutants.h"
#include "tests/support/folder.h"

using namespace vkdose;

namespace {

[[noreturn]] void fail(const std::string& what) {
    std::fprintf(stderr, "case_fuzz: %s\n", what.c_str());
    std::abort();
}

/// One folder for the life of the process, in memory where the system offers that.
const std::filesystem::path& folder() {
    const char* memory = "/dev/shm";
    static const test::Folder theFolder(access(memory, W_OK) == 0 ? memory : std::filesystem::temp_directory_path());
    return theFolder.path();
}

std::filesystem::path write(const char* name, const std::string& text) {
    std::filesystem::path file = folder() / name;
    std::ofstream(file, std::ios::binary) << text;
    return file;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string mark = "\n=== list.csv\n";
    std::string text(reinterpret_cast<const char*>(data), size);
    const std::size_t cut = text.find(mark);
    write("list.csv", cut == std::string::npos ? "x,y,z,r\n0,0,0,1e-3\n" : text.substr(cut + mark.size()));
    const auto file = write("case.toml", text.substr(0, cut));
    std::string resolved;
    try {
        resolved = loadCase(file).resolved;
    } catch (const CaseError& error) {
        if (error.faults().empty()) fail("refused without a fault");
        for (const Diagnostic& fault : error.faults())
            if (const std::string why = test::unclear(fault); !why.empty())
                fail("a message " + why + ": " + fault.text());
        return 0;
    }
    try {
        if (loadCase(write("resolved.toml", resolved)).resolved != resolved)
            fail("resolved twice is not resolved once");
    } catch (const CaseError& error) {
        fail(std::string("the resolved case is refused: ") + error.what());
    }
    return 0;
}
