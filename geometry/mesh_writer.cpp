#include "geometry/mesh_writer.h"

#include <bit>
#include <cmath>
#include <cstdint>

namespace vkdose::geometry {

namespace {

constexpr std::size_t kTitle = 80;

void put(std::string& bytes, std::uint32_t word) {
    for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(word >> shift & 255u);
}

void put(std::string& bytes, const Vec3& x) {
    for (int k = 0; k < 3; ++k) {
        const auto value = static_cast<float>(x[k]);
        if (!std::isfinite(value)) throw MeshError("a coordinate is too large for an STL file");
        put(bytes, std::bit_cast<std::uint32_t>(value));
    }
}

}  // namespace

std::string stlBytes(const std::vector<Triangle>& mesh, const std::string& title, double metresPerUnit) {
    std::string bytes = title.substr(0, kTitle);
    bytes.resize(kTitle, ' ');
    put(bytes, static_cast<std::uint32_t>(mesh.size()));
    for (const Triangle& t : mesh) {
        const Vec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
        const double length = glm::length(normal);
        put(bytes, length > 0 ? normal / length : Vec3(0));
        for (const Vec3& corner : t) put(bytes, corner / metresPerUnit);
        bytes.append(2, '\0');
    }
    return bytes;
}

}  // namespace vkdose::geometry
