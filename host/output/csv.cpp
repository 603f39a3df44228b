#include "host/output/csv.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <utility>

#include "host/core/error.h"
#include "host/core/file.h"

namespace vkdose {

CsvFile::CsvFile(std::filesystem::path path, std::string_view header)
    : path_(std::move(path)), file_(::fdopen(openOutput(path_, O_WRONLY | O_CREAT | O_TRUNC), "w")) {
    if (!file_) fail();
    line(std::string(header));
    flush();
}

CsvFile::CsvFile(std::filesystem::path path, std::uint64_t bytes)
    : path_(std::move(path)), file_(::fdopen(openOutput(path_, O_RDWR), "r+")) {
    if (!file_) fail();
    std::error_code error;
    const std::uint64_t size = std::filesystem::file_size(path_, error);
    if (error || size < bytes)
        throw OutputError(fmt::format("{} has {} bytes; it had {} when the checkpoint was written", path_.string(),
                                      error ? 0 : size, bytes));
    if (std::fseek(file_.get(), static_cast<long>(bytes), SEEK_SET) != 0) fail();
    cut_ = size > bytes;
}

void CsvFile::line(const std::string& fields) {
    if (cut_ && ::ftruncate(fileno(file_.get()), std::ftell(file_.get())) != 0) fail();
    cut_ = false;
    if (std::fputs(fields.c_str(), file_.get()) < 0 || std::fputc('\n', file_.get()) < 0) fail();
}

void CsvFile::flush() {
    if (std::fflush(file_.get()) != 0) fail();
}

std::uint64_t CsvFile::store() {
    flush();
    if (::fsync(fileno(file_.get())) != 0) fail();
    const long at = std::ftell(file_.get());
    if (at < 0) fail();
    return static_cast<std::uint64_t>(at);
}

void CsvFile::fail() const {
    throw OutputError(writeFault(path_));
}

}  // namespace vkdose
