#include "host/vk/driver_variable.h"

#include <unistd.h>

#include <cstdlib>
#include <set>

namespace vkdose::vk {

namespace {

/// The names of the variables that are set, and not by the user.
std::set<std::string>& ours() {
    static std::set<std::string> names;
    return names;
}

}  // namespace

void setForDriver(const char* variable, const char* value, bool wanted) {
    const bool set = ours().contains(variable);
    if (!set && std::getenv(variable) != nullptr) return;  // the user's
    if (wanted) {
        setenv(variable, value, 1);
        ours().insert(variable);
    } else if (set) {
        unsetenv(variable);
        ours().erase(variable);
    }
}

void keepPassesOfOneLength() {
    setForDriver("MESA_SHADER_CACHE_DISABLE", "true", std::getenv("LP_NATIVE_VECTOR_WIDTH") != nullptr);
}

std::vector<std::string> usersEnvironment() {
    std::vector<std::string> variables;
    for (char** v = environ; *v != nullptr; ++v) {
        std::string variable = *v;
        if (!ours().contains(variable.substr(0, variable.find('=')))) variables.push_back(std::move(variable));
    }
    return variables;
}

}  // namespace vkdose::vk
