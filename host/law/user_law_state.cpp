#include "host/law/user_law_state.h"

#include <fmt/format.h>

#include <cstdint>

#include "host/core/fnv.h"

namespace vkdose {
namespace {

constexpr const char* kName = "user_law";

}  // namespace

void putLaw(const std::shared_ptr<const UserLaw>& law, Record& record) {
    if (law) record.putOne(kName, fnv1a(law->text));
}

void requireLaw(const std::shared_ptr<const UserLaw>& law, const Record& record) {
    const auto before = record.arrays().contains(kName) ? record.one<std::uint64_t>(kName) : 0;
    if (before != (law ? fnv1a(law->text) : 0))
        throw RecordError(fmt::format("it was made under another law than {}", law ? law->name : "that of the case"));
}

}  // namespace vkdose
