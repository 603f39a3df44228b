#include "host/studio/own_law.h"

#include <vector>

#include "host/core/error.h"
#include "host/core/file.h"
#include "host/model/case_tree.h"

namespace vkdose::studio {

std::optional<OwnLaw> ownLawOf(const std::filesystem::path& caseFile) {
    try {
        std::vector<std::filesystem::path> files;
        const Node tree = readTree(caseFile, files);
        const Node* contact = tree.child("contact");
        const Node* law = contact == nullptr ? nullptr : contact->child("law");
        if (law == nullptr || !law->string.ends_with(".glsl")) return std::nullopt;
        const std::filesystem::path file = std::filesystem::path(law->file).parent_path() / law->string;
        const auto text = fileContent(file);
        if (!text) return std::nullopt;
        return OwnLaw{law->string, *text};
    } catch (const std::exception&) {
        return std::nullopt;
    }
}

void AllowedLaws::allow(const std::string& text) {
    const std::lock_guard lock(mutex_);
    texts_.insert(text);
}

bool AllowedLaws::has(const std::string& text) const {
    const std::lock_guard lock(mutex_);
    return texts_.contains(text);
}

}  // namespace vkdose::studio
