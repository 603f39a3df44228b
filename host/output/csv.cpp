#include "host/output/csv.h"

#include <fmt/format.h>

#include <utility>

#include "host/core/error.h"

namespace vkdose {

CsvFile::CsvFile(std::filesystem::path path, std::string_view header) : path_(std::move(path)), stream_(path_) {
    line(std::string(header));
    flush();
}

void CsvFile::line(const std::string& fields) {
    stream_ << fields << '\n';
    check();
}

void CsvFile::flush() {
    stream_.flush();
    check();
}

void CsvFile::check() {
    if (!stream_) throw RunError(fmt::format("cannot write {}: is the disk full or the folder gone?", path_.string()));
}

}  // namespace vkdose
