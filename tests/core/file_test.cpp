#include "host/core/file.h"

#include "host/core/error.h"
#include "tests/app/sandbox.h"
#include "tests/support/catch.h"

using namespace vkdose;
using vkdose::test::Sandbox;

TEST_CASE("the bytes of a file come whole, of an empty one none, of what is no file nothing") {
    const Sandbox box;
    const std::string bytes("a\r\n\0\xff", 5);
    CHECK(fileContent(box.write("some", bytes)) == bytes);
    CHECK(fileContent(box.write("none", "")) == "");
    CHECK_FALSE(fileContent(box / "missing"));
    CHECK_FALSE(fileContent(box.path()));
}

TEST_CASE("a file is replaced whole or not at all") {
    const Sandbox box;
    const auto file = box.write("f", "old and long");
    replaceFile(file, "new");
    CHECK(fileContent(file) == "new");
    CHECK(box.files() == std::vector<std::string>{"f"});  // and nothing is left beside it

    std::filesystem::create_directory(box / "folder");
    CHECK_THROWS_AS(replaceFile(box / "folder", "new"), OutputError);
    CHECK_THROWS_WITH(replaceFile(box / "nowhere" / "f", "new"),
                      Catch::Contains("nowhere/f: No such file or directory"));
    CHECK(std::filesystem::is_directory(box / "folder"));
    CHECK(box.files().size() == 2);
}

TEST_CASE("a folder is made with those it is in, and where it is already nothing happens") {
    const Sandbox box;
    for (int time = 0; time < 2; ++time) {
        createFolder(box / "a" / "b");
        CHECK(std::filesystem::is_directory(box / "a" / "b"));
    }
    CHECK_THROWS_WITH(createFolder(box.write("f", "") / "c"), Catch::Contains("f/c: Not a directory"));
}
