#include "host/backend/vulkan/pass_code.h"

#include <fmt/format.h>

#include <map>
#include <mutex>
#include <regex>
#include <sstream>
#include <stdexcept>

#include "host/glsl/compile.h"
#include "host/glsl/whole_division.h"
#include "spirv/passes.h"
#include "spirv/sources.h"

namespace vkdose {
namespace {

constexpr std::string_view kUserText = "law/user_text.glsl";

std::string_view sourceOf(std::string_view file) {
    for (const auto& [name, text] : spirv::kSources)
        if (file == name) return text;
    throw std::logic_error(fmt::format("the program carries no shader source {}", file));
}

/// The text with each file that it includes in its place.
std::string expanded(std::string_view text, const UserLaw* law) {
    constexpr std::string_view kInclude = "#include \"";
    std::string out;
    std::istringstream lines{std::string(text)};
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with(kInclude)) {
            out += line + "\n";
            continue;
        }
        const std::string file = line.substr(kInclude.size(), line.rfind('"') - kInclude.size());
        if (file == kUserText)
            out += law != nullptr ? law->shader : "";
        else  // beside tables.h and field_tables.h, files name what they include from the folder of shaders
            out += expanded(sourceOf(file.find('/') == std::string::npos ? "shared/" + file : file), law);
    }
    return out;
}

/// A message without the prefix, and with types as a law has them: the compiler tells a Contact by all its fields.
std::string inUsersWords(const std::string& text) {
    static const std::regex kPrefixed(fmt::format("\\b{}([A-Za-z_])", kUserPrefix));
    static const std::regex kContact(R"(structure ?\{[^}]*\})");
    static const std::regex kType(R"(' ?(?:(?:global|temp|const|in|inout|out|smooth|flat|highp|mediump|lowp) )+)");
    std::string told = std::regex_replace(text, kPrefixed, "$1");
    told = std::regex_replace(told, kContact, "Contact");
    return std::regex_replace(told, kType, "'");
}

/// Whether a message only follows from those before it: the compiler goes on after the first of a line.
bool follows(const GlslFault& fault, const GlslFault* before) {
    if (fault.text.starts_with("'' : compilation terminated") || fault.text.starts_with("'' : missing #endif"))
        return true;
    return before != nullptr && before->source == fault.source && before->line == fault.line &&
           fault.text.find("structure{") != std::string::npos;
}

/// The compiler's faults, in the user's words. One outside of the user's text is told with the text's first line.
LawError told(const std::vector<GlslFault>& faults) {
    constexpr std::size_t kMost = 5;
    LawError error;
    const GlslFault* before = nullptr;
    for (const GlslFault& f : faults) {
        if (error.faults.size() == kMost) break;
        if (follows(f, before) && (before != nullptr || faults.size() > 1)) continue;
        before = &f;
        const bool ofUser = f.source == 1;
        error.faults.push_back({ofUser ? f.line : 1, inUsersWords(f.text),
                                ofUser ? "the law must be valid GLSL" : "outside of the law's own text"});
    }
    return error;
}

}  // namespace

std::span<const std::uint32_t> compiledNow(const std::string& file, const UserLaw* law,
                                           const std::vector<std::string>& macros) {
    static std::mutex mutex;
    static std::map<std::string, std::vector<std::uint32_t>> made;
    std::string defines = law != nullptr ? "#define USER_LAW\n" : "";
    if (law != nullptr && !law->properties.empty()) defines += "#define OWN_PROPERTIES\n";
    for (const std::string& macro : macros) defines += fmt::format("#define {}\n", macro);
    const std::lock_guard lock(mutex);
    const auto [place, added] = made.try_emplace(file + "\n" + defines + (law != nullptr ? law->shader : ""));
    if (!added) return place->second;
    std::string source = expanded(sourceOf(file), law);
    source.insert(source.find('\n') + 1, defines);
    GlslResult result = compileGlsl(source);
    if (!result.faults.empty()) {
        made.erase(place);
        if (law != nullptr) throw told(result.faults);
        throw std::logic_error(fmt::format("shaders/{} does not compile: {}", file, result.faults.front().text));
    }
    if (law != nullptr) guardWholeDivisions(result.spirv);
    place->second = std::move(result.spirv);
    return place->second;
}

std::span<const std::uint32_t> passCode(const std::string& name, std::span<const vk::Variant> variants,
                                        const CodeWish& wish) {
    const vk::Variant& chosen = vk::best(variants, wish.macros);
    if (wish.law == nullptr && !wish.addressed) return chosen.code;
    std::vector<std::string> macros;
    for (const auto& [bit, macro] : spirv::kMacros)
        if ((chosen.macros & bit) != 0) macros.emplace_back(macro);
    if (wish.addressed) macros.emplace_back("ADDRESSED");
    return compiledNow("pass/" + name + ".comp", wish.law, macros);
}

}  // namespace vkdose
