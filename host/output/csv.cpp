#include "host/output/csv.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <utility>

#include "host/core/error.h"
#include "host/core/file.h"

namespace vkdose {

namespace {

std::uint32_t crcOf(std::uint32_t before, std::string_view text) {
    return static_cast<std::uint32_t>(crc32_z(before, reinterpret_cast<const Bytef*>(text.data()), text.size()));
}

}  // namespace

CsvFile::CsvFile(std::filesystem::path path, std::string_view header)
    : path_(std::move(path)), file_(::fdopen(openOutput(path_, O_WRONLY | O_CREAT | O_TRUNC), "w")) {
    if (!file_) fail();
    line(std::string(header));
    flush();
}

CsvFile::CsvFile(std::filesystem::path path, const CsvMark& mark)
    : path_(std::move(path)), file_(::fdopen(openOutput(path_, O_RDWR), "r+")) {
    if (!file_) fail();
    std::error_code error;
    const std::uint64_t size = std::filesystem::file_size(path_, error);
    if (error || size < mark.bytes)
        throw OutputError(fmt::format("{} has {} bytes; it had {} when the checkpoint was written", path_.string(),
                                      error ? 0 : size, mark.bytes));
    requireSame(mark);
    cut_ = size > mark.bytes;
}

/// Reads up to the mark and stops there. Throws OutputError if the checksum differs.
void CsvFile::requireSame(const CsvMark& mark) {
    std::array<char, 1U << 16> block{};
    for (std::uint64_t left = mark.bytes; left > 0;) {
        const std::size_t n = std::fread(block.data(), 1, std::min<std::uint64_t>(left, block.size()), file_.get());
        if (n == 0) throw OutputError(fmt::format("{} cannot be read", path_.string()));
        checksum_ = crcOf(checksum_, {block.data(), n});
        left -= n;
    }
    if (mark.checksum && *mark.checksum != checksum_)
        throw OutputError(
            fmt::format("{} has been changed since the checkpoint was written: its first {} bytes are no "
                        "longer what they were; put the file back as it was, or start the run again",
                        path_.string(), mark.bytes));
    // C requires a seek between reading and writing.
    if (std::fseek(file_.get(), static_cast<long>(mark.bytes), SEEK_SET) != 0) fail();
}

/// What stood behind the mark is of a course that the run does not take again.
void CsvFile::cut() {
    if (cut_ && ::ftruncate(fileno(file_.get()), std::ftell(file_.get())) != 0) fail();
    cut_ = false;
}

void CsvFile::line(const std::string& fields) {
    cut();
    if (std::fputs(fields.c_str(), file_.get()) < 0 || std::fputc('\n', file_.get()) < 0) fail();
    checksum_ = crcOf(crcOf(checksum_, fields), "\n");
}

void CsvFile::flush() {
    if (std::fflush(file_.get()) != 0) fail();
    if (!isWhereItWas())
        throw OutputError(fmt::format("cannot write {}: it has been removed or moved away", path_.string()));
}

bool CsvFile::isWhereItWas() const {
    struct stat named {
    }, ours{};
    return ::stat(path_.c_str(), &named) == 0 && ::fstat(fileno(file_.get()), &ours) == 0 &&
           named.st_dev == ours.st_dev && named.st_ino == ours.st_ino;
}

CsvMark CsvFile::store() {
    cut();
    flush();
    if (::fsync(fileno(file_.get())) != 0) fail();
    const long at = std::ftell(file_.get());
    if (at < 0) fail();
    return {static_cast<std::uint64_t>(at), checksum_};
}

void CsvFile::fail() const {
    throw OutputError(writeFault(path_));
}

}  // namespace vkdose
