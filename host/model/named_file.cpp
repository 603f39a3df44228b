#include "host/model/named_file.h"

#include "host/core/file.h"

namespace vkdose {

bool requireFile(CaseReader& reader, const std::string& path, const std::filesystem::path& file,
                 const std::string& remedy) {
    try {
        if (InputFile::open(file)) return true;
        reader.fault(path, unreadable(file), remedy);
    } catch (const ReadError& error) {
        reader.fault(path, error.what(), remedy);
    }
    return false;
}

}  // namespace vkdose
