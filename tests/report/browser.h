#pragma once
// Pages in a headless Chromium.

#include <cstdlib>
#include <set>

#include "host/report/page.h"
#include "host/report/source_hash.h"
#include "tests/app/sandbox.h"
#include "tests/support/catch.h"

namespace vkdose::test {

inline bool browserMissing() {
    if (std::system("command -v chromium > /dev/null 2>&1") == 0) return false;
    WARN("skipped: chromium is not installed (tools/packages-second-driver)");
    return true;
}

/// Flags under which it draws pictures in WebGL on the processor, and under which it has no WebGL at all.
inline constexpr const char* kWebGl = "--use-angle=swiftshader --enable-unsafe-swiftshader";
inline constexpr const char* kNoWebGl = "--disable-gpu --disable-3d-apis";

/// Leave for a further script of this text to run in the page.
inline void allow(std::string& html, const std::string& script) {
    const std::string mark = "script-src ";
    html.insert(html.find(mark) + mark.size(), report::sourceHash(script) + " ");
}

/// The document as the browser leaves it once the scripts have run. What they wait for comes at once: the page's clock
/// runs ahead to the next event. What the page's policy refused is counted in `data-refused` of the root element.
inline std::string opened(const Sandbox& box, std::string html, const std::string& flags = kNoWebGl) {
    const std::string watch =
        "document.addEventListener('securitypolicyviolation', e => {"
        "document.documentElement.dataset.refused = (document.documentElement.dataset.refused || '') + "
        "e.effectiveDirective + ' '; });";
    allow(html, watch);
    html.insert(html.find("<title>"), "<script>" + watch + "</script>\n");
    const auto file = box.write("page.html", html);
    const std::string command = "timeout 120 chromium --headless --no-sandbox " + flags +
                                " --window-size=1280,900 --virtual-time-budget=60000 --user-data-dir='" +
                                (box / "profile").string() + "' --dump-dom 'file://" + file.string() + "' > '" +
                                (box / "dom.html").string() + "' 2> /dev/null";
    REQUIRE(std::system(command.c_str()) == 0);
    return readText(box / "dom.html");
}

/// The page of these data, of which the policy refused nothing; `script` is a further one at its end.
inline std::string drawn(const Sandbox& box, const report::Json& data, const std::string& flags = kNoWebGl,
                         const std::string& script = "") {
    std::string html = report::page(data);
    allow(html, script);
    html.insert(html.rfind("</body>"), "<script>" + script + "</script>\n");
    std::string dom = opened(box, html, flags);
    CHECK(dom.find("data-refused") == std::string::npos);
    return dom;
}

/// A script of this folder that says what to look for, with what runs it.
inline std::string readProbe(const std::string& name) {
    const std::string folder = VKDOSE_SOURCE_DIR "/tests/report/";
    return readText(folder + "probe.js") + readText(folder + name);
}

/// The findings of the probe.
inline report::Json probed(const std::string& dom) {
    const std::string mark = "<pre id=\"probe\">";
    const std::size_t begin = dom.find(mark) + mark.size();
    REQUIRE(begin > mark.size());
    return report::Json::parse(dom.substr(begin, dom.find("</pre>", begin) - begin));
}

inline std::size_t count(const std::string& text, const std::string& part) {
    std::size_t n = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
    return n;
}

}  // namespace vkdose::test
