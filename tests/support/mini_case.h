#pragma once
// cases/mini.toml as it is shipped.

#include "host/model/case.h"
#include "tests/support/places.h"

namespace vkdose::test {

inline Case mini() {
    return loadCase(sourceDir() + "/cases/mini.toml");
}

}  // namespace vkdose::test
