// PLY, as ASCII and binary of either byte order. The header names elements and their properties. Points are x, y and z
// of the element "vertex", faces the list "vertex_indices" (or "vertex_index") of the element "face". Anything else is
// stepped over.

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <unordered_map>

#include "geometry/mesh_formats.h"

namespace vkdose::geometry {

namespace {

struct Type {
    std::string_view name;
    int bytes;
    char kind;  ///< 'i' signed, 'u' unsigned, 'f' floating
};
constexpr Type kTypes[] = {{"char", 1, 'i'},  {"uchar", 1, 'u'},  {"short", 2, 'i'},   {"ushort", 2, 'u'},
                           {"int", 4, 'i'},   {"uint", 4, 'u'},   {"float", 4, 'f'},   {"double", 8, 'f'},
                           {"int8", 1, 'i'},  {"uint8", 1, 'u'},  {"int16", 2, 'i'},   {"uint16", 2, 'u'},
                           {"int32", 4, 'i'}, {"uint32", 4, 'u'}, {"float32", 4, 'f'}, {"float64", 8, 'f'}};

struct Property {
    std::string name;
    const Type* count = nullptr;  ///< of a list; null for a single value
    const Type* value = nullptr;
};

struct Element {
    std::string name;
    std::uint64_t count = 0;
    std::uint64_t line = 0;
    std::vector<Property> properties;
    std::unordered_map<std::string, int> places = {};  ///< of the properties, by name

    /// Index of the property of that name, or -1.
    int find(const std::string& property) const {
        const auto found = places.find(property);
        return found == places.end() ? -1 : found->second;
    }
};

enum class Form { None, Ascii, Little, Big };

class Ply {
  public:
    Ply(std::string_view content, const std::string& name, double metresPerUnit)
        : content_(content), name_(name), scale_(metresPerUnit), lines_(content), soup_(name, metresPerUnit, true) {}

    TriangleSoup read() {
        header();
        const Element* vertex = element("vertex");
        const Element* face = element("face");
        if (!vertex || !face || element("tristrips"))
            soup_.fail(1, "the header must announce the elements 'vertex' and 'face'; export the mesh as triangles");
        for (int d = 0; d < 3; ++d) {
            coordinates_[d] = vertex->find(std::string(1, "xyz"[d]));
            if (coordinates_[d] < 0 || vertex->properties[coordinates_[d]].count)
                soup_.fail(vertex->line, "'vertex' must have the properties x, y and z");
        }
        indices_ = std::max(face->find("vertex_indices"), face->find("vertex_index"));
        if (indices_ < 0 || !face->properties[indices_].count || face->properties[indices_].value->kind == 'f')
            soup_.fail(face->line, "'face' must have a list of whole numbers 'vertex_indices'");
        if (vertex > face) soup_.fail(face->line, "the element 'vertex' must stand before 'face'");
        for (const Element& e : elements_)
            if (e.properties.empty())
                soup_.fail(e.line, fmt::format("the element {} has no property", inQuotes(e.name)));
        // From here on a place is a byte if the data are binary.
        if (form_ != Form::Ascii) soup_ = SoupBuilder(name_, scale_, false);
        for (const Element& e : elements_) body(e);
        if (form_ == Form::Ascii) {
            while (token_.empty() && lines_.nextLine()) token_ = lines_.word();
            if (!token_.empty()) soup_.fail(lines_.line(), "there is more than the header announces");
        } else if (withoutPadding(content_).size() > at_) {
            soup_.fail(at_, fmt::format("the data should end here, and {} bytes follow", content_.size() - at_));
        }
        return soup_.finish();
    }

  private:
    const Element* element(const std::string& name) const {
        const auto found = elementPlaces_.find(name);
        return found == elementPlaces_.end() ? nullptr : &elements_[found->second];
    }

    const Type* type(std::string_view name) {
        for (const Type& t : kTypes)
            if (t.name == name) return &t;
        soup_.fail(lines_.line(), fmt::format("{} is not a type of PLY", inQuotes(name)));
    }

    void header() {
        if (!lines_.nextLine() || lines_.text() != "ply") soup_.fail(1, "a PLY file begins with a line 'ply'");
        while (lines_.nextLine()) {
            const std::string_view word = lines_.word();
            if (word == "end_header") {
                if (form_ == Form::None) soup_.fail(lines_.line(), "the header has no line 'format'");
                at_ = static_cast<std::uint64_t>(lines_.text().data() - content_.data()) + lines_.text().size();
                // A carriage return alone ends the line only where it ends the others, or a byte of the data is lost.
                const bool alone = content_.substr(3, 1) == "\r" && content_.substr(4, 1) != "\n";
                if (content_.substr(at_, 1) == "\r") ++at_;
                if (content_.substr(at_, 1) == "\n" && !alone) ++at_;
                return;
            }
            if (word == "comment" || word == "obj_info") continue;
            if (word == "format")
                format();
            else if (word == "element")
                newElement();
            else if (word == "property")
                newProperty();
            else
                soup_.fail(lines_.line(), fmt::format("{} has no place in the header of a PLY file", inQuotes(word)));
        }
        soup_.fail(lines_.line(), "the file ends before 'end_header'");
    }

    void format() {
        const std::string_view name = lines_.word(), version = lines_.word();
        form_ = name == "ascii"                  ? Form::Ascii
                : name == "binary_little_endian" ? Form::Little
                : name == "binary_big_endian"    ? Form::Big
                                                 : Form::None;
        if (form_ == Form::None || version != "1.0")
            soup_.fail(lines_.line(),
                       "the format must be ascii, binary_little_endian or binary_big_endian, version 1.0");
    }

    void newElement() {
        const std::string name(lines_.word());
        const std::string_view word = lines_.word();
        const auto count = integer(word);
        if (name.empty() || !count || *count < 0)
            soup_.fail(lines_.line(), fmt::format("{} is not a number of elements", inQuotes(word)));
        if (element(name)) soup_.fail(lines_.line(), fmt::format("the element {} is announced twice", inQuotes(name)));
        // Whatever it is, an element takes a byte or more, so a larger number is a lie.
        if (static_cast<std::uint64_t>(*count) > content_.size())
            soup_.fail(lines_.line(),
                       fmt::format("{} elements are announced in a file of {} bytes", *count, content_.size()));
        elementPlaces_[name] = elements_.size();
        elements_.push_back({name, static_cast<std::uint64_t>(*count), lines_.line(), {}});
    }

    void newProperty() {
        if (elements_.empty()) soup_.fail(lines_.line(), "a property stands before the first element");
        Property p;
        std::string_view word = lines_.word();
        if (word == "list") {
            p.count = type(lines_.word());
            if (p.count->kind == 'f') soup_.fail(lines_.line(), "the length of a list must be a whole number");
            word = lines_.word();
        }
        p.value = type(word);
        p.name = lines_.word();
        if (p.name.empty()) soup_.fail(lines_.line(), "a property has no name");
        Element& e = elements_.back();
        if (!e.places.emplace(p.name, int(e.properties.size())).second)
            soup_.fail(lines_.line(), fmt::format("the property {} is announced twice", inQuotes(p.name)));
        e.properties.push_back(std::move(p));
    }

    std::uint64_t place() const { return form_ == Form::Ascii ? lines_.line() : at_; }

    double value(const Type& t) { return form_ == Form::Ascii ? asciiValue(t) : binaryValue(t); }

    double asciiValue(const Type& t) {
        while (token_.empty()) {
            if (!lines_.nextLine()) soup_.fail(lines_.line(), "the file ends before the announced data");
            token_ = lines_.word();
        }
        const std::string_view word = token_;
        token_ = lines_.word();
        const auto found = number(word);
        if (!found) soup_.fail(lines_.line(), fmt::format("{} is not a number", inQuotes(word)));
        if (t.kind != 'f' && *found != std::floor(*found))
            soup_.fail(lines_.line(), fmt::format("{} is not a whole number", inQuotes(word)));
        return *found;
    }

    double binaryValue(const Type& t) {
        const auto size = static_cast<std::uint64_t>(t.bytes);
        if (content_.size() - at_ < size) soup_.fail(content_.size(), "the file ends before the announced data");
        std::uint64_t bits = 0;
        for (std::uint64_t i = 0; i < size; ++i) {
            const std::uint64_t shift = 8 * (form_ == Form::Little ? i : size - 1 - i);
            bits |= std::uint64_t(static_cast<unsigned char>(content_[at_ + i])) << shift;
        }
        at_ += size;
        if (t.kind == 'f')
            return size == 8 ? std::bit_cast<double>(bits) : std::bit_cast<float>(static_cast<std::uint32_t>(bits));
        if (t.kind == 'i') {
            const std::uint64_t unused = 64 - 8 * size;
            return static_cast<double>(static_cast<std::int64_t>(bits << unused) >> unused);
        }
        return static_cast<double>(bits);
    }

    void body(const Element& e) {
        const bool isVertex = e.name == "vertex", isFace = e.name == "face";
        std::vector<std::uint32_t> corners;
        for (std::uint64_t n = 0; n < e.count; ++n) {
            Vec3 point(0);
            corners.clear();
            // The line of the first value, which `place` gives only once it has been read, names the element.
            std::uint64_t where = place();
            for (std::size_t i = 0; i < e.properties.size(); ++i) {
                const Property& p = e.properties[i];
                const double first = value(p.count ? *p.count : *p.value);
                if (i == 0 && form_ == Form::Ascii) where = lines_.line();
                if (!p.count) {
                    for (int d = 0; d < 3; ++d)
                        if (isVertex && coordinates_[d] == int(i)) point[d] = first;
                    continue;
                }
                if (!(first >= 0 && first <= double(content_.size())))
                    soup_.fail(where,
                               fmt::format("a list of {} entries in a file of {} bytes", first, content_.size()));
                for (auto left = static_cast<std::uint64_t>(first); left > 0; --left) {
                    const double entry = value(*p.value);
                    if (!isFace || indices_ != int(i)) continue;
                    if (!(entry >= 0 && entry < double(soup_.points())))
                        soup_.fail(where, fmt::format("a face names point {} (counted from 0), and there are {}", entry,
                                                      soup_.points()));
                    corners.push_back(static_cast<std::uint32_t>(entry));
                }
            }
            if (isVertex) soup_.addPoint(point, where);
            if (isFace) soup_.addPolygon(corners, where);
        }
    }

    std::string_view content_;
    std::string name_;
    double scale_;
    TextLines lines_;
    SoupBuilder soup_;
    Form form_ = Form::None;
    std::vector<Element> elements_;
    std::unordered_map<std::string, std::size_t> elementPlaces_;  ///< by name
    int coordinates_[3] = {-1, -1, -1};
    int indices_ = -1;
    std::uint64_t at_ = 0;    ///< the next byte of binary data
    std::string_view token_;  ///< the next word of ASCII data, if its line has more
};

}  // namespace

TriangleSoup readPly(std::string_view content, const std::string& name, double metresPerUnit) {
    return Ply(content, name, metresPerUnit).read();
}

}  // namespace vkdose::geometry
