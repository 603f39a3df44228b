#pragma once
// What every shape tells of itself, so that nobody else has to know which shape it is. A shape is a struct with these
// members:
//
//   Closest closest(const Vec3& q) const                        if it has a single closest point, or
//   std::vector<Feature> places(const Vec3& centre, double radius) const
//                                                               every local minimum of the distance below the radius,
//                                                               with a key that tells the minima apart
//   ShapeForm form() const
//   void cut(Tessellator& into) const                           its surface as triangles (tessellator.h)
//   ShapeRecord record() const                                  if a device has no tables of its own for it

#include <array>
#include <cstdint>
#include <optional>

#include "host/core/vec.h"

namespace vkdose::geometry {

/// What pictures, checks and closed forms ask of a shape.
struct ShapeForm {
    /// It goes on for ever, as a plane does.
    bool endless = false;
    /// Its triangles enclose matter. Those of a wall without thickness do not.
    bool solid = false;
    /// The radius by which it is curved most visibly [m]; of flat shapes any number.
    double curve = 1;
    /// Sides of triangles that follow it to some hundredths of that radius [m]. 0: an endless shape, or one so slender
    /// that its triangles would fill the memory.
    double facet = 0;
    /// How much nearer to a point its surface can come when it turns about the z axis of its frame [m per radian]. A
    /// surface of revolution comes no nearer. A wire comes as near as if it went along the axis; its two ends, which
    /// come nearer, do not count. None for shapes that do not say.
    std::optional<double> approach{};
};

/// ShapeForm::facet of a shape with this radius and length [m].
double roundFacet(double radius, double length);
/// ShapeForm::approach of a surface that revolves about the z axis, or does not.
std::optional<double> unmovedIf(bool revolves);
/// Whether a point lies on the z axis, or a direction goes along it.
bool onZ(const Vec3& v);
/// Pieces of a round shape's circumference, for `ShapeForm::facet`.
inline constexpr double kPiecesAround = 48;
/// A shape with more turns, or so many times as long as wide, is no device.
inline constexpr double kMostSlender = 1000;

/// A sphere around a part of a body, in the body's frame [m].
struct Around {
    Vec3 centre{0};
    double radius = 0;
};

enum class ShapeKind : std::uint32_t {
#define SHAPE(number, Name, kind, overlap) Name = (number),
#include "shaders/shared/shapes.h"
    Room = 7
};

/// What a device is given of a shape: the numbers of its record (shaders/law/shape.glsl says what they mean), and a
/// sphere around it.
struct ShapeRecord {
    /// High parts in one vector of the record, low parts in the next.
    struct Pair {
        Vec3 vector{0};
        double last = 0;
    };
    ShapeKind kind = ShapeKind::Plane;
    Pair first{}, second{};                 ///< vectors 2 and 3, 4 and 5
    std::array<double, 2> sizes{}, more{};  ///< vectors 6 and 7, each number as a high and a low part
    std::optional<Around> around{};         ///< none: the shape is endless, or spheres live inside of it
    std::uint32_t places = 1;               ///< most places in which a sphere touches it
};

}  // namespace vkdose::geometry
