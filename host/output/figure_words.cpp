#include "host/output/figure_words.h"

#include <fmt/format.h>

#include <cmath>

#include "host/core/key.h"

namespace vkdose {

namespace {

std::span<const Wording> wordingsOf(ElementTest::Kind kind) {
    switch (kind) {
        case ElementTest::Kind::AngleOfRepose:
            return kHeap;
        case ElementTest::Kind::DrumAngle:
            return kDrum;
        case ElementTest::Kind::Compression:
            return kCompression;
        case ElementTest::Kind::Shear:
            return kShear;
        case ElementTest::Kind::BulkDensity:
            return kBulk;
        case ElementTest::Kind::Discharge:
            return kDischarge;
        case ElementTest::Kind::Content:
            return kContent;
    }
    return {};
}

/// Null for a figure without words.
const Wording* wordingOf(const std::string& name) {
    for (std::size_t kind = 0; kind < wordsOf(ElementTest::kKinds).size(); ++kind)
        for (const Wording& w : wordingsOf(ElementTest::Kind(kind)))
            if (name == w.name) return &w;
    for (const Wording& w : kPreShear)
        if (name == w.name) return &w;
    return nullptr;
}

}  // namespace

std::vector<std::string> figureNames(const ElementTest& m) {
    std::vector<std::string> names;
    const bool throughGlass = m.kind == ElementTest::Kind::DrumAngle && m.view == ElementTest::View::Front;
    for (const Wording& w : throughGlass ? std::span<const Wording>(kDrumFront) : wordingsOf(m.kind))
        names.emplace_back(w.name);
    if (!m.preShears.empty())
        for (const Wording& w : kPreShear) names.emplace_back(w.name);
    if (m.kind == ElementTest::Kind::Shear)
        for (std::size_t i = 1; i <= m.windows.size(); ++i)
            for (const char* name : kShearPoint) names.push_back(fmt::format(fmt::runtime(name), i));
    return names;
}

FigureText figureText(const std::string& name, double value) {
    const Wording* known = wordingOf(name);
    if (!std::isfinite(value)) return {known != nullptr ? known->words : name, "not known"};
    if (known == nullptr) return {name, fmt::format("{:.4g}", value)};
    return {known->words,
            fmt::format("{:.4g}{}{}", value * known->scale, *known->unit != '\0' ? " " : "", known->unit)};
}

}  // namespace vkdose
