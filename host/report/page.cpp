#include "host/report/page.h"

#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "host/core/printable.h"
#include "host/report/source_hash.h"
#include "report/parts.h"

namespace vkdose::report {

namespace {

/// `text` as it has to stand in HTML to be read as text.
std::string escaped(std::string_view text) {
    std::string html;
    for (const char c : text) {
        if (c == '&')
            html += "&amp;";
        else if (c == '<')
            html += "&lt;";
        else if (c == '>')
            html += "&gt;";
        else
            html += c;
    }
    return html;
}

/// The texts in `data`, with every character made visible.
Json shown(Json data) {
    if (data.is_string()) return printableLines(data.get_ref<const std::string&>());
    if (data.is_structured())
        for (auto& [key, value] : data.items()) value = shown(std::move(value));
    return data;
}

/// The data inside a <script>. A "<" occurs in JSON only within texts; written as an escape it can end no element.
std::string scriptData(const Json& data) {
    std::string text;
    for (const char c : shown(data).dump(-1, ' ', false, Json::error_handler_t::replace)) {
        if (c == '<')
            text += "\\u003c";
        else
            text += c;
    }
    return text;
}

/// The scripts of the page, each the text of an element. The scripts of the player are many times larger than the rest,
/// so only pages with frames have them.
std::vector<std::string> scriptsOf(bool player) {
    std::vector<std::string> scripts{parts::kD3};
    if (player) {
        scripts.emplace_back(parts::kThree);
        scripts.push_back(std::string(parts::kPlayerFrames) + parts::kPlayerColours + parts::kPlayerBodies +
                          parts::kPlayerScene + parts::kPlayer);
    }
    scripts.push_back(std::string(parts::kCharts) + parts::kRamp + parts::kControls + parts::kStream + parts::kFields +
                      parts::kRun + parts::kRuns + parts::kStudy + parts::kValidation + parts::kMain);
    return scripts;
}

/// Only the page's own scripts and style take effect, and nothing is asked of a network or sent to it. So text that
/// gets into the page in spite of the escapes does nothing. Styles that scripts set through the DOM need no permission.
std::string policy(const std::vector<std::string>& scripts) {
    std::string hashes;
    for (const std::string& script : scripts) hashes += " " + sourceHash(script);
    return "default-src 'none'; script-src" + hashes + "; style-src " + sourceHash(parts::kStyle) +
           "; base-uri 'none'; form-action 'none'";
}

std::string elements(const std::vector<std::string>& scripts) {
    std::string html;
    for (const std::string& script : scripts) html += "<script>" + script + "</script>\n";
    return html;
}

std::string threeLicence() {
    return "<p>Particles drawn with three.js, which is part of this file.</p>\n"
           "<details><summary>Licence of three.js</summary><pre>" +
           escaped(parts::kThreeLicence) + "</pre></details>";
}

}  // namespace

std::string page(const Json& data) {
    const bool player = data.contains("player") && !data["player"].is_null();
    const std::vector<std::string> scripts = scriptsOf(player);
    const std::array<std::pair<std::string_view, std::string>, 8> parts{{
        {"policy", policy(scripts)},
        {"title", escaped(printable(data.value("name", std::string("report"))))},
        {"style", parts::kStyle},
        {"version", VKDOSE_VERSION},
        {"licence", escaped(parts::kLicence)},
        {"data", scriptData(data)},
        {"three-licence", player ? threeLicence() : std::string()},
        {"scripts", elements(scripts)},
    }};
    // One pass from front to back, so that inserted text is not searched for marks again.
    std::string html;
    std::string_view left = parts::kPage;
    while (true) {
        const std::size_t begin = left.find("@@"), end = left.find("@@", begin + 2);
        if (begin == std::string_view::npos || end == std::string_view::npos) return html.append(left);
        html += left.substr(0, begin);
        const std::string_view name = left.substr(begin + 2, end - begin - 2);
        for (const auto& [known, text] : parts)
            if (known == name) html += text;
        left.remove_prefix(end + 2);
    }
}

}  // namespace vkdose::report
