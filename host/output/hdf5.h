#pragma once
// The few things of HDF5 that are needed, with owners and errors. Files are built and read in memory, so that how they
// reach the disk (in one move, checked) is decided elsewhere.

#include <hdf5.h>

#include <string>
#include <string_view>
#include <vector>

#include "host/core/record.h"

namespace vkdose::hdf5 {

/// HDF5 refused; the text says at what.
class Error : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Whether several threads may write and read at once, each files of its own.
bool threadSafe();

/// An HDF5 handle with what closes it.
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
    /// The file's bytes. Nothing may be added afterwards.
    std::string image();

  private:
    void dataset(const std::string& path, hid_t type, std::size_t count, const void* data);

    Handle file_;
};

/// A file in memory that is being read. Throws Error where something is missing.
class Reader {
  public:
    explicit Reader(std::string image);
    std::string text(const std::string& path) const;
    Record record(const std::string& path) const;

  private:
    std::string image_;
    Handle file_;
};

}  // namespace vkdose::hdf5
