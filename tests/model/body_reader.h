#pragma once
// Cases with bodies that a test writes.

#include "geometry/mesh_writer.h"
#include "geometry/shape.h"
#include "tests/model/case_files.h"

namespace vkdose::test {

/// A folder with cases of these bodies, and a mesh for them.
struct Read {
    Folder folder;
    Case load(const std::string& bodies) const { return loadCase(folder.write("case.toml", withBodies(bodies))); }
    std::string fault(const std::string& bodies) const {
        return faultOf(folder.write("case.toml", withBodies(bodies)));
    }
    void mesh() const {
        folder.write("block.stl", geometry::stlBytes(geometry::tessellated(geometry::Block{Vec3(-10), Vec3(10)}, 5,
                                                                           Vec3(-100), Vec3(100)),
                                                     "block", 1));
    }
};

}  // namespace vkdose::test
