#pragma once
// The few things of HDF5 that are needed, with owners and errors. Files are built and read in memory. Other code
// decides how they reach the disk (in one move, checked).

#include <fmt/format.h>
#include <hdf5.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "host/core/error.h"
#include "host/core/record.h"

namespace vkdose::hdf5 {

/// HDF5 refused. The text says in which operation.
class Error : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Whether several threads may write and read at once, each files of its own.
bool threadSafe();

/// An HDF5 handle, and the function that closes it.
class Handle {
  public:
    Handle(hid_t id, herr_t (*close)(hid_t), const std::string& what);
    ~Handle();
    Handle(Handle&& other) noexcept;
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    Handle& operator=(Handle&&) = delete;
    operator hid_t() const { return id_; }

  private:
    hid_t id_;
    herr_t (*close_)(hid_t);
};

/// A file in memory that is being written.
class Writer {
  public:
    Writer();
    void group(const std::string& path);
    /// A text of any length, as a fixed-length string data set.
    void text(const std::string& path, std::string_view value);
    /// Every array of the record as a compressed data set `path`/name.
    void record(const std::string& path, const Record& record);
    /// A compressed data set of any number of dimensions, the last one fastest. T: double, float, std::int64_t, or
    /// an unsigned integer of 8, 32 or 64 bits.
    template <class T>
    void array(const std::string& path, const std::vector<T>& values, const std::vector<std::size_t>& shape);
    /// An attribute of a group or data set: a text, or a row of numbers (T as above).
    void attribute(const std::string& path, const std::string& name, std::string_view value);
    template <class T>
    void attribute(const std::string& path, const std::string& name, const std::vector<T>& values);
    /// The file's bytes. Nothing may be added afterwards.
    std::string image();

  private:
    void dataset(const std::string& path, hid_t type, const std::vector<std::size_t>& shape, const void* data);
    void attribute(const std::string& path, const std::string& name, hid_t type, hid_t space, const void* data);

    Handle file_;
};

/// The bytes of a file, which `make` makes. Throws OutputError, which names the file, if HDF5 refuses.
template <class Make>
std::string made(const std::filesystem::path& file, const Make& make) {
    try {
        return make();
    } catch (const Error& e) {
        throw OutputError(fmt::format("cannot make {}: {}", file.string(), e.what()));
    }
}

/// A file in memory that is being read. Throws Error where something is missing.
class Reader {
  public:
    explicit Reader(std::string image);
    std::string text(const std::string& path) const;
    Record record(const std::string& path) const;
    bool has(const std::string& path) const;  ///< a data set or a group whose parent is there
    /// A data set of any shape, converted to T: double, float, or an unsigned integer of 32 or 64 bits.
    template <class T>
    std::vector<T> array(const std::string& path) const;

  private:
    std::string image_;
    Handle file_;
};

}  // namespace vkdose::hdf5
