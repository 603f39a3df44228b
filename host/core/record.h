#pragma once
// Named arrays. In this neutral form, parts of the program hand over their state to be stored, and get it back.

#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace vkdose {

/// A record lacks the array that was asked for, or holds it in another shape.
class RecordError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

class Record {
  public:
    using Array =
        std::variant<std::vector<double>, std::vector<float>, std::vector<std::uint64_t>, std::vector<std::uint32_t>>;

    template <class T>
    void put(const std::string& name, std::vector<T> values) {
        arrays_.insert_or_assign(name, Array(std::move(values)));
    }
    template <class T>
    void putOne(const std::string& name, T value) {
        put(name, std::vector<T>{value});
    }

    /// Throws RecordError if there is no array of that name and type.
    template <class T>
    const std::vector<T>& get(const std::string& name) const {
        const auto found = arrays_.find(name);
        if (found == arrays_.end()) throw RecordError("it lacks " + name);
        const auto* values = std::get_if<std::vector<T>>(&found->second);
        if (values == nullptr) throw RecordError(name + " has another type than expected");
        return *values;
    }
    /// Throws RecordError as well if its length is not `size`.
    template <class T>
    const std::vector<T>& get(const std::string& name, std::size_t size) const {
        const std::vector<T>& values = get<T>(name);
        if (values.size() != size)
            throw RecordError(name + " has " + std::to_string(values.size()) + " entries, not " + std::to_string(size));
        return values;
    }
    template <class T>
    T one(const std::string& name) const {
        return get<T>(name, 1).front();
    }

    const std::map<std::string, Array>& arrays() const { return arrays_; }
    bool operator==(const Record&) const = default;

  private:
    std::map<std::string, Array> arrays_;
};

}  // namespace vkdose
