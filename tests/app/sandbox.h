#pragma once
// A folder of its own for a test, gone afterwards, and the program run as a user would.

#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace vkdose::test {

inline std::string readText(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

/// The lines of a CSV, split at commas, header first.
inline std::vector<std::vector<std::string>> readCsv(const std::filesystem::path& file) {
    std::vector<std::vector<std::string>> rows;
    std::ifstream stream(file);
    for (std::string line; std::getline(stream, line);) {
        std::vector<std::string> fields;
        std::istringstream split(line);
        for (std::string field; std::getline(split, field, ',');) fields.push_back(field);
        rows.push_back(fields);
    }
    return rows;
}

class Sandbox {
  public:
    Sandbox() {
        static std::atomic<int> count{0};
        path_ = std::filesystem::temp_directory_path() /
                ("vkdose_test_" + std::to_string(getpid()) + "_" + std::to_string(count++));
        std::filesystem::create_directories(path_);
    }
    ~Sandbox() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    Sandbox(const Sandbox&) = delete;
    Sandbox& operator=(const Sandbox&) = delete;

    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

    std::filesystem::path write(const std::string& name, const std::string& text) const {
        std::ofstream(path_ / name) << text;
        return path_ / name;
    }

    struct Outcome {
        int code;
        std::string out;
        std::string err;
    };

    /// Runs the program in the sandbox with these arguments (shell syntax); `before` is shell in front of it ("A=b ",
    /// "ulimit -f 9; ").
    Outcome vkdose(const std::string& arguments, const std::string& before = "") const {
        const std::string command = "cd '" + path_.string() + "' && " + before + "'" VKDOSE_BINARY_DIR "/vkdose' " +
                                    arguments + " > stdout.txt 2> stderr.txt < /dev/null";
        const int status = std::system(command.c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, readText(path_ / "stdout.txt"),
                readText(path_ / "stderr.txt")};
    }

    /// What lies in the sandbox beside the captured output.
    std::vector<std::string> files() const {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(path_)) {
            const std::string name = entry.path().filename().string();
            if (name != "stdout.txt" && name != "stderr.txt") names.push_back(name);
        }
        return names;
    }

    /// Starts the program in the sandbox without waiting for it, its output thrown away. Returns its process.
    pid_t start(const std::vector<std::string>& arguments) const {
        const pid_t child = fork();
        if (child != 0) return child;
        std::vector<std::string> words{VKDOSE_BINARY_DIR "/vkdose"};
        words.insert(words.end(), arguments.begin(), arguments.end());
        std::vector<char*> argv;
        for (std::string& word : words) argv.push_back(word.data());
        argv.push_back(nullptr);
        const bool ready = chdir(path_.c_str()) == 0 && std::freopen("/dev/null", "w", stdout) != nullptr &&
                           std::freopen("/dev/null", "w", stderr) != nullptr;
        if (ready) execv(argv[0], argv.data());
        _exit(127);
    }

  private:
    std::filesystem::path path_;
};

}  // namespace vkdose::test
