#include "host/output/csv.h"

#include <fcntl.h>
#include <fmt/format.h>
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
    : path_(std::move(path)), file_(path_, O_WRONLY | O_CREAT | O_TRUNC) {
    line(std::string(header));
    flush();
}

CsvFile::CsvFile(std::filesystem::path path, const CsvMark& mark)
    : path_(std::move(path)), file_(path_, O_WRONLY), at_(mark.bytes) {
    std::error_code error;
    const std::uint64_t size = std::filesystem::file_size(path_, error);
    if (error || size < mark.bytes)
        throw OutputError(fmt::format("{} has {} bytes; it had {} when the checkpoint was written", path_.string(),
                                      error ? 0 : size, mark.bytes));
    requireSame(mark);
    file_.goTo(mark.bytes);
    cut_ = size > mark.bytes;
}

/// Throws OutputError if the content up to the mark has another checksum.
void CsvFile::requireSame(const CsvMark& mark) {
    std::array<char, 1U << 16> block{};
    std::optional<InputFile> content = InputFile::open(path_);
    if (!content) throw OutputError(unreadable(path_));
    for (std::uint64_t left = mark.bytes; left > 0;) {
        const std::size_t n = content->read(block.data(), std::min<std::uint64_t>(left, block.size()));
        if (n == 0) throw OutputError(fmt::format("{} has become shorter", path_.string()));
        checksum_ = crcOf(checksum_, {block.data(), n});
        left -= n;
    }
    if (mark.checksum && *mark.checksum != checksum_)
        throw OutputError(
            fmt::format("{} has been changed since the checkpoint was written: its first {} bytes are no "
                        "longer what they were; put the file back as it was, or start the run again",
                        path_.string(), mark.bytes));
}

/// What stood behind the mark is of a course that the run does not take again.
void CsvFile::cut() {
    if (cut_) file_.cutAt(at_);
    cut_ = false;
}

void CsvFile::hold(std::string_view text) {
    held_ += text;
    at_ += text.size();
    checksum_ = crcOf(checksum_, text);
}

void CsvFile::write() {
    const std::string lines = std::exchange(held_, "");
    file_.write(lines);
}

void CsvFile::line(const std::string& fields) {
    constexpr std::size_t kMost = 1U << 16;
    cut();
    hold(fields);
    hold("\n");
    if (held_.size() > kMost) write();
}

void CsvFile::flush() {
    write();
    if (!file_.isWhereItWas())
        throw OutputError(fmt::format("cannot write {}: it has been removed or moved away", path_.string()));
}

CsvMark CsvFile::store() {
    cut();
    flush();
    file_.sync();
    return {at_, checksum_};
}

}  // namespace vkdose
