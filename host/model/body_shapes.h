#pragma once
// The shapes of [[body]]: the keys that they are read from, and what they make. A word of the key `shape` stands for
// one or several shapes of geometry/shape.h.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/core/key.h"
#include "host/model/case_sections.h"

namespace vkdose {

/// Keys of every body, of a mesh, and of the other shapes.
std::span<const Key> bodyKeys();
std::span<const Key> bodyMeshKeys();
std::span<const Key> bodyShapeKeys();

/// What is needed to read one body.
struct BodyReader {
    CaseReader& reader;
    Section& section;
    std::optional<double> meshReach;  ///< [m]; absent while the case is at fault
    BodiesRead& read;                 ///< with the bodies before it

    void fault(std::string_view key, std::string problem, std::string remedy) const {
        reader.fault(section.path(key), std::move(problem), std::move(remedy));
    }
};

struct BodyShape {
    std::vector<geometry::Shape> shapes{};  ///< in the frame of the body; none after a fault
    double curvature = 0;                   ///< RigidBody::curvature [m]
};

/// Reads the keys of the shape. `word` is its place among the words of the key `shape`.
BodyShape readShape(const BodyReader& b, std::size_t word);

}  // namespace vkdose
