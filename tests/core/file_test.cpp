#include "host/core/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "host/core/error.h"
#include "host/core/folder_lock.h"
#include "host/core/memory_limit.h"
#include "tests/app/sandbox.h"
#include "tests/support/catch.h"
#include "tests/support/limited_memory.h"

using namespace vkdose;
using vkdose::test::LimitedMemory;
using vkdose::test::Sandbox;
namespace fs = std::filesystem;

TEST_CASE("the bytes of a file come whole, of an empty one none, of what is no file nothing") {
    const Sandbox box;
    const std::string bytes("a\r\n\0\xff", 5);
    CHECK(fileContent(box.write("some", bytes)) == bytes);
    CHECK(fileContent(box.write("none", "")) == "");
    CHECK_FALSE(fileContent(box / "missing"));
    CHECK_FALSE(fileContent(box.path()));
    CHECK(readFault(box / "missing") == "there is no such file");
    CHECK(readFault(box.path()) == "cannot be read: it is a folder, not a file");
    CHECK(unreadable(box / "missing") == "there is no file " + (box / "missing").string());
    const std::filesystem::path tooLong = box / std::string(300, 'a');
    CHECK_FALSE(fileContent(tooLong));
    CHECK_THAT(unreadable(tooLong), Catch::StartsWith("there is no file ") && Catch::EndsWith("so long"));
}

TEST_CASE("the first and the last bytes of a file are read alone, and no more than there are") {
    const Sandbox box;
    const std::string text = "0123456789";
    const fs::path file = box.write("f", text);
    CHECK(fileStart(file, 0) == "");
    CHECK(fileStart(file, 3) == "012");
    CHECK(fileStart(file, 10) == text);
    CHECK(fileStart(file, 11) == text);
    CHECK(fileEnd(file, 3) == "789");
    CHECK(fileEnd(file, 10) == text);
    CHECK(fileEnd(file, 4096) == text);
    CHECK(fileEnd(box.write("none", ""), 4096) == "");
    CHECK_FALSE(fileStart(box / "missing", 3));
    CHECK_FALSE(fileEnd(box / "missing", 3));
    const std::string large(300001, 'x');
    CHECK(fileContent(box.write("large", large)) == large);

    auto parts = InputFile::open(file);
    std::string got(8, ' ');
    REQUIRE(parts);
    CHECK(parts->read(got.data(), 8) == 8);
    CHECK(got == "01234567");
    CHECK(parts->rest() == "89");
    CHECK(parts->read(got.data(), 8) == 0);
}

TEST_CASE("a file whose size the system does not tell is read whole") {
    const std::string text = fileContent("/proc/self/status").value_or("");
    CHECK_THAT(text, Catch::StartsWith("Name:") && Catch::EndsWith("\n"));
}

TEST_CASE("a file that the system does not read is told with the place and the reason, and is not taken for its end") {
    // The memory of this process looks like a file, but there is nothing at its beginning.
    CHECK_THROWS_WITH(fileContent("/proc/self/mem"),
                      "/proc/self/mem cannot be read from byte 0 on: Input/output error");
    CHECK_THROWS_AS(fileStart("/proc/self/mem", 1), ReadError);
    const Sandbox box;
    fs::create_symlink("round", box / "round");
    CHECK_THROWS_WITH(fileContent(box / "round"),
                      Catch::EndsWith("round cannot be read: Too many levels of symbolic links"));
    CHECK_THROWS_WITH(entriesOf(box / "round"), Catch::Contains("round cannot be listed: Too many levels"));
    CHECK_FALSE(fileContent(box.write("f", "") / "below"));
}

TEST_CASE("want of memory is told with the limit on it, and other faults without") {
    CHECK(faultText(ENOMEM) == std::strerror(ENOMEM) + memoryLimitText());
    const LimitedMemory limited;
    CHECK_THAT(faultText(ENOMEM), Catch::StartsWith(std::strerror(ENOMEM)) && Catch::EndsWith("(ulimit -v)"));
    CHECK(faultText(ENOENT) == std::strerror(ENOENT));
}

TEST_CASE("a folder is listed whole, and what is no folder holds nothing") {
    const Sandbox box;
    createFolder(box / "a");
    const fs::path file = box.write("b", "");
    std::vector<fs::path> entries = entriesOf(box.path());
    std::sort(entries.begin(), entries.end());
    CHECK(entries == std::vector<fs::path>{box / "a", file});
    CHECK(entriesOf(box / "a").empty());
    CHECK(entriesOf(file).empty());
    CHECK(entriesOf(box / "none").empty());
}

TEST_CASE("a pipe is neither waited for nor read, even if somebody writes into it") {
    const Sandbox box;
    const fs::path pipe = box / "pipe";
    REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
    CHECK_FALSE(fileContent(pipe));
    CHECK(unreadable(pipe) == pipe.string() + " cannot be read: it is a pipe, not a file");
    fs::create_symlink("pipe", box / "link");
    CHECK_FALSE(InputFile::open(box / "link"));
    CHECK_THROWS_WITH(replaceFile(pipe, "x"), Catch::Contains("a pipe") && Catch::Contains("nobody reads"));
    CHECK_THROWS_WITH(openOutput(pipe, O_WRONLY | O_CREAT | O_TRUNC), Catch::Contains("nobody reads"));
    CHECK_THROWS_WITH(requireReplaceable(pipe), Catch::Contains("it is a pipe; name a file"));
    CHECK(fs::is_fifo(pipe));
    CHECK(box.files().size() == 2);
}

TEST_CASE("a file is replaced whole or not at all") {
    const Sandbox box;
    const auto file = box.write("f", "old and long");
    replaceFile(file, "new");
    CHECK(fileContent(file) == "new");
    CHECK(box.files() == std::vector<std::string>{"f"});  // and nothing is left beside it

    fs::create_directory(box / "folder");
    CHECK_THROWS_AS(replaceFile(box / "folder", "new"), OutputError);
    CHECK_THROWS_WITH(
        replaceFile(box / "nowhere" / "f", "new"),
        Catch::Contains("nowhere/f: No such file or directory; there is no folder") && Catch::EndsWith("nowhere"));
    CHECK(fs::is_directory(box / "folder"));
    CHECK(box.files().size() == 2);
}

TEST_CASE("a pipe that is read and a device are written into and stay what they are") {
    const Sandbox box;
    const fs::path pipe = box / "pipe";
    REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
    const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    REQUIRE(reader >= 0);
    replaceFile(pipe, "through");
    std::string got(20, '\0');
    got.resize(std::size_t(std::max<ssize_t>(0, ::read(reader, got.data(), got.size()))));
    ::close(reader);
    CHECK(got == "through");
    CHECK(fs::is_fifo(pipe));

    // A device that is always full, our own. Making one takes a privilege; without it the pipe has to do.
    const fs::path full = box / "full";
    if (mknod(full.c_str(), S_IFCHR | 0666, makedev(1, 7)) == 0) {
        CHECK_THROWS_AS(replaceFile(full, "x"), OutputError);
        CHECK(fs::is_character_file(full));
    }
    CHECK_FALSE(fs::exists(box / "full.new"));
    CHECK_FALSE(fs::exists(box / "pipe.new"));
}

TEST_CASE("of a link the file it leads to is replaced, and the link stays") {
    const Sandbox box;
    fs::create_directory(box / "far");
    box.write("far/file", "old");
    fs::create_symlink("far/file", box / "near");
    fs::create_symlink(box / "near", box / "nearer");
    replaceFile(box / "nearer", "new");
    CHECK(fs::is_symlink(box / "nearer"));
    CHECK(fs::is_symlink(box / "near"));
    CHECK(fileContent(box / "far/file") == "new");

    fs::create_symlink("far/fresh", box / "ahead");  // leads to what is not there yet
    replaceFile(box / "ahead", "made");
    CHECK(fs::is_symlink(box / "ahead"));
    CHECK(fileContent(box / "far/fresh") == "made");

    fs::create_symlink("round", box / "round");
    CHECK_THROWS_WITH(replaceFile(box / "round", "x"), Catch::Contains("round: Too many levels"));
    CHECK(fs::is_symlink(box / "round"));
}

TEST_CASE("a link in the place where a file is first written is not followed") {
    const Sandbox box;
    box.write("mine", "precious");
    fs::create_symlink("mine", box / "file.new");
    CHECK_THROWS_WITH(replaceFile(box / "file", "x"), Catch::Contains("file.new, which is a link; remove that"));
    CHECK(fileContent(box / "mine") == "precious");
    CHECK_FALSE(fs::exists(box / "file"));
}

TEST_CASE("a file that is read and to be written is found under any name") {
    const Sandbox box;
    const fs::path a = box.write("a", "");
    const fs::path b = box.write("b", "");
    fs::create_symlink("a", box / "link");
    fs::create_directory(box / "sub");
    CHECK_FALSE(readAndWritten({a}, {b, box / "none", ""}));
    CHECK(readAndWritten({b, a}, {box / "link"}) == box / "link");
    CHECK(readAndWritten({a}, {box / "sub" / ".." / "a"}));
    CHECK_FALSE(readAndWritten({box / "none"}, {box / "none"}));
}

TEST_CASE("a folder is made with those it is in, and where it is already nothing happens") {
    const Sandbox box;
    for (int time = 0; time < 2; ++time) {
        createFolder(box / "a" / "b");
        CHECK(fs::is_directory(box / "a" / "b"));
    }
    CHECK_THROWS_WITH(createFolder(box.write("f", "") / "c"), Catch::Contains("f/c: Not a directory"));
}

TEST_CASE("an empty folder is removed, and neither a full one nor a file in its place") {
    const Sandbox box;
    createFolder(box / "empty");
    createFolder(box / "full" / "inner");
    const fs::path file = box.write("file", "a user's");
    for (const char* name : {"empty", "full", "file", "none"}) removeEmptyFolder(box / name);
    CHECK_FALSE(fs::exists(box / "empty"));
    CHECK(fs::exists(box / "full" / "inner"));
    CHECK(fileContent(file) == "a user's");
}

TEST_CASE("a folder is one process's, whatever becomes of the files in it, until its lock is gone") {
    const Sandbox box;
    {
        const auto lock = FolderLock::take(box.path());
        REQUIRE(lock);
        fs::remove(box.write("f", ""));
        CHECK_FALSE(FolderLock::take(box.path()));
        CHECK(FolderLock::isTaken(box.path()));
        CHECK_FALSE(FolderLock::await(box.path(), [] { return true; }));
    }
    CHECK_FALSE(FolderLock::isTaken(box.path()));
    CHECK(FolderLock::await(box.path(), [] { return true; }));
    CHECK(FolderLock::take(box.path()));
    CHECK_FALSE(FolderLock::isTaken(box / "none"));
    CHECK_THROWS_AS(FolderLock::take(box / "none"), OutputError);
}
