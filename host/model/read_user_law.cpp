#include "host/model/read_user_law.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <utility>

#include "host/core/error.h"
#include "host/core/file.h"
#include "host/model/named_file.h"

namespace vkdose {
namespace {

/// Longest text of a law. It becomes a part of the case, which may not be much longer.
constexpr std::size_t kMostBytes = 64U << 10U;

/// What keeps a text from being a part of a case, which is text in UTF-8. Absent if it can be one.
std::optional<LawFault> unwritable(const std::string& text) {
    if (text.size() > kMostBytes)
        return LawFault{0, fmt::format("has {} KiB", text.size() >> 10U),
                        fmt::format("a law may have {} KiB", kMostBytes >> 10U)};
    if (isUtf8(text)) return {};
    int line = 1;
    for (std::size_t begin = 0; begin < text.size(); ++line) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        if (!isUtf8(std::string_view(text).substr(begin, end - begin))) break;
        begin = end + 1;
    }
    return LawFault{line, "is not UTF-8", "save the file as UTF-8"};
}

}  // namespace

std::shared_ptr<const UserLaw> readUserLaw(CaseReader& reader, Section& contact) {
    const std::string name = contact.string("law");
    std::filesystem::path file = reader.folderOf("contact.law") / name;
    std::optional<std::string> text;
    const bool within = contact.has("law_text");
    if (within) {
        text = contact.string("law_text");
        file = name;
    } else if (requireFile(reader, "contact.law", file,
                           "give luding, hertz-mindlin, eepa, jkr, or the path of a law of your own")) {
        text = fileContent(file);
    }
    if (!text) return nullptr;
    if (contact.has("law_hash") && contact.string("law_hash") != lawHash(*text)) {
        if (within)
            reader.fault("contact.law_text", fmt::format("is not the text of {} that law_hash was made of", name),
                         "put the text back, or run the case that names the file");
        else
            reader.fault("contact.law", fmt::format("{} is not the law that law_hash was made of", file.string()),
                         "put its text back, or leave out law_hash");
        return nullptr;
    }
    if (const auto fault = unwritable(*text)) {
        reader.add({file.string(), fault->line, "", "", fault->problem, fault->remedy});
        return nullptr;
    }
    LawReading reading = readLaw(name, *text);
    reading.law.file = file.string();
    for (const LawFault& fault : reading.faults)
        reader.add({reading.law.file, fault.line, "", "", fault.problem, fault.remedy});
    contact.record("law_text", *text);
    contact.record("law_hash", reading.law.hash);
    if (!reading.faults.empty()) return nullptr;
    return std::make_shared<const UserLaw>(std::move(reading.law));
}

namespace {

/// The numbers of a table under the names that a law declares. What it does not state comes from `above`, where it is a
/// number; null: all must be stated.
template <std::size_t n>
std::array<double, n> readNamed(CaseReader& reader, Section& section, const char* key, const UserLaw& law,
                                const std::vector<std::string>& names, const char* kind,
                                const std::array<double, n>* above) {
    std::array<double, n> own{};
    Section& table = section.table(key);
    const Node* stated = section.node(key);
    for (std::size_t k = 0; stated != nullptr && k < stated->children.size(); ++k) {
        const std::string& name = stated->children[k].key;
        if (std::ranges::find(names, name) != names.end()) continue;
        std::string known;
        for (const std::string& other : names) known += (known.empty() ? "" : ", ") + other;
        table.know(name);
        reader.fault(table.path(name), fmt::format("is no {} of {}", kind, law.name),
                     known.empty() ? "remove it: the law declares none" : fmt::format("it declares {}", known));
    }
    for (std::size_t k = 0; k < names.size(); ++k) {
        const std::string& name = names[k];
        const Node* node = table.node(name);
        const auto single = [](double x) {  // beyond these a device holds an infinite number, or none
            return x == 0 || (std::abs(x) <= std::numeric_limits<float>::max() &&
                              std::abs(x) >= std::numeric_limits<float>::min());
        };
        if (node != nullptr && !(node->isNumber() && single(node->number)))
            reader.fault(table.path(name), "is not a number that a device holds", "give a number");
        else if (node == nullptr && above == nullptr)
            reader.fault(table.path(name), fmt::format("is missing: {} declares it", law.name), "give a number");
        else if (node == nullptr && std::isnan((*above)[k]))
            reader.fault(table.path(name), "is missing: the two powders differ in it, and no rule says how it mixes",
                         "give a number");
        if (above != nullptr) own[k] = (*above)[k];
        if (node != nullptr && node->isNumber()) own[k] = node->number;
        table.record(name, own[k]);
    }
    return own;
}

}  // namespace

std::array<double, kMostLawParameters> readOwn(CaseReader& reader, Section& section, const UserLaw& law,
                                               const std::array<double, kMostLawParameters>* above) {
    return readNamed(reader, section, "parameters", law, law.parameters, "parameter", above);
}

LawProperties readProperties(CaseReader& reader, Section& section, const UserLaw& law, const LawProperties* usual) {
    return readNamed(reader, section, "properties", law, law.properties, "property of particles", usual);
}

std::vector<std::string> propertiesOfLaw(const CaseReader& reader, Section& root) {
    const Node* contact = root.node("contact");
    const auto textAt = [&](const char* key) {
        const Node* node = contact != nullptr ? contact->child(key) : nullptr;
        return node != nullptr && node->kind == Node::Kind::String ? std::optional(node->string) : std::nullopt;
    };
    const std::optional<std::string> name = textAt("law");
    if (!name || !name->ends_with(".glsl")) return {};
    std::optional<std::string> text = textAt("law_text");
    if (!text) text = fileContent(reader.folderOf("contact.law") / *name);
    return text && !unwritable(*text) ? readLaw(*name, *text).law.properties : std::vector<std::string>();
}

void refuseUserLaw(CaseReader& reader, std::span<Section* const> sections) {
    constexpr const char* kRemedy = "remove it, or name the file of a law in contact.law";
    for (const char* key : {"law_text", "law_hash"}) {
        sections.front()->know(key);
        if (sections.front()->has(key)) reader.fault(sections.front()->path(key), "is of a law of your own", kRemedy);
    }
    for (Section* section : sections)
        for (const std::string table : {"parameters", "properties"}) {
            const Node* stated = section->node(table);
            if (stated == nullptr) continue;
            reader.fault(section->path(table), "is of a law of your own", kRemedy);
            for (const Node& child : stated->children)
                reader.fault(section->path(table + "." + child.key), "is of a law of your own", kRemedy);
        }
}

}  // namespace vkdose
