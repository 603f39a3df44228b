#include "host/report/page.h"

#include <array>
#include <string_view>
#include <utility>

#include "host/core/printable.h"
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

/// What its texts say, with every character in sight.
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

/// The player's library and scripts, for pages with frames: they are many times the rest of the page.
std::string playerScripts() {
    std::string html = std::string("<script>\n") + parts::kThree + "\n</script>\n<script>\n";
    for (const char* part : {parts::kPlayerFrames, parts::kPlayerColours, parts::kPlayerScene, parts::kPlayer})
        html += part;
    return html + "</script>";
}

std::string threeLicence() {
    return "<p>Particles drawn with three.js, which is part of this file.</p>\n"
           "<details><summary>Licence of three.js</summary><pre>" +
           escaped(parts::kThreeLicence) + "</pre></details>";
}

}  // namespace

std::string page(const Json& data) {
    const bool player = data.contains("player") && !data["player"].is_null();
    const std::array<std::pair<std::string_view, std::string>, 16> parts{{
        {"title", escaped(printable(data.value("name", std::string("report"))))},
        {"style", parts::kStyle},
        {"version", VKDOSE_VERSION},
        {"licence", escaped(parts::kLicence)},
        {"data", scriptData(data)},
        {"three-licence", player ? threeLicence() : std::string()},
        {"d3", parts::kD3},
        {"player", player ? playerScripts() : std::string()},
        {"charts", parts::kCharts},
        {"ramp", parts::kRamp},
        {"controls", parts::kControls},
        {"stream", parts::kStream},
        {"fields", parts::kFields},
        {"run", parts::kRun},
        {"study", parts::kStudy},
        {"main", parts::kMain},
    }};
    // One pass from front to back, so that nothing put in is looked through for marks again.
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
