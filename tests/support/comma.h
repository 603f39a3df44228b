#pragma once
// A process with a decimal comma, as it is where somebody has set a locale before using the library.

#include <clocale>
#include <cstdlib>
#include <locale>
#include <string>

#include "tests/support/catch.h"
#include "tests/support/folder.h"

namespace vkdose::test {

/// While it lives, the C library and the streams of C++ write and read a comma for the decimals and points between the
/// thousands. The locale is made here, because a system need not have one; localedef belongs to the C library.
class DecimalComma {
  public:
    DecimalComma() : before_(std::setlocale(LC_NUMERIC, nullptr)) {
        folder_.write("comma", "LC_NUMERIC\ndecimal_point \",\"\nthousands_sep \".\"\ngrouping 3;3\nEND LC_NUMERIC\n");
        folder_.write("characters", "<code_set_name> NONE\n<mb_cur_min> 1\n<mb_cur_max> 1\nCHARMAP\nEND CHARMAP\n");
        // It complains of every other category that there is not, and writes this one.
        const std::string make =
            "cd '" + folder_.path().string() + "' && localedef -c -i ./comma -f ./characters ./de_DE > made.txt 2>&1";
        (void)std::system(make.c_str());
        setenv("LOCPATH", folder_.path().c_str(), 1);
        INFO(readText(folder_ / "made.txt"));
        REQUIRE(std::setlocale(LC_NUMERIC, "de_DE") != nullptr);
        REQUIRE(std::string(std::localeconv()->decimal_point) == ",");
        stream_ = std::locale::global(std::locale(std::locale::classic(), new Comma));
    }
    ~DecimalComma() {
        std::locale::global(stream_);
        std::setlocale(LC_NUMERIC, before_.c_str());
        unsetenv("LOCPATH");
    }
    DecimalComma(const DecimalComma&) = delete;
    DecimalComma& operator=(const DecimalComma&) = delete;

    const Folder& folder() const { return folder_; }

  private:
    struct Comma : std::numpunct<char> {
        char do_decimal_point() const override { return ','; }
        char do_thousands_sep() const override { return '.'; }
        std::string do_grouping() const override { return "\3"; }
    };
    Folder folder_;
    std::string before_;
    std::locale stream_;
};

}  // namespace vkdose::test
