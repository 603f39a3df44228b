#include "host/backend/reference/properties.h"

#include <algorithm>

namespace vkdose::reference {

void saveProperties(const Particles& particles, Record& record) {
    if (particles.properties.empty()) return;
    std::vector<double> values;
    for (const LawProperties& of : particles.properties) values.insert(values.end(), of.begin(), of.end());
    record.put("properties", std::move(values));
}

void restoreProperties(const Record& record, Particles& particles) {
    if (particles.properties.empty()) return;
    auto from = record.get<double>("properties", kMostLawProperties * particles.size()).begin();
    for (LawProperties& of : particles.properties) {
        std::copy_n(from, of.size(), of.begin());
        from += std::ptrdiff_t(of.size());
    }
}

}  // namespace vkdose::reference
