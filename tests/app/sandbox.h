#pragma once
// A folder of its own for a test, gone afterwards, and the program run as a user would.

#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/folder.h"
#include "tests/support/places.h"

namespace vkdose::test {

class Sandbox : public Folder {
  public:
    struct Outcome {
        int code;
        std::string out;
        std::string err;
    };

    /// Runs the program in the sandbox with these arguments (shell syntax); `before` is shell in front of it ("A=b ",
    /// "ulimit -f 9; ").
    Outcome vkdose(const std::string& arguments, const std::string& before = "") const {
        const std::string command = "cd '" + path().string() + "' && " + before + "'" + programFile() + "' " +
                                    arguments + " > stdout.txt 2> stderr.txt < /dev/null";
        const int status = std::system(command.c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, readText(path() / "stdout.txt"),
                readText(path() / "stderr.txt")};
    }

    /// The files in the sandbox beside the captured output.
    std::vector<std::string> files() const {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(path())) {
            const std::string name = entry.path().filename().string();
            if (name != "stdout.txt" && name != "stderr.txt") names.push_back(name);
        }
        return names;
    }

    /// Starts the program in the sandbox without waiting for it, its output thrown away. Returns its process.
    pid_t start(const std::vector<std::string>& arguments) const {
        const pid_t child = fork();
        if (child != 0) return child;
        std::vector<std::string> words{programFile()};
        words.insert(words.end(), arguments.begin(), arguments.end());
        std::vector<char*> argv;
        for (std::string& word : words) argv.push_back(word.data());
        argv.push_back(nullptr);
        const bool ready = chdir(path().c_str()) == 0 && std::freopen("/dev/null", "w", stdout) != nullptr &&
                           std::freopen("/dev/null", "w", stderr) != nullptr;
        if (ready) execv(argv[0], argv.data());
        _exit(127);
    }
};

}  // namespace vkdose::test
