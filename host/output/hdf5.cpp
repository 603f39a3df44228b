#include "host/output/hdf5.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <numeric>
#include <utility>

#include "host/core/memory_limit.h"

namespace vkdose::hdf5 {

namespace {

constexpr std::size_t kIncrement = 1 << 20;  // by which a file in memory grows [bytes]

/// HDF5 does not tell why. Where memory is limited, want of it is the likeliest reason.
[[noreturn]] void fail(const std::string& what) {
    throw Error("HDF5 failed at " + what + memoryLimitText());
}

void check(herr_t status, const std::string& what) {
    if (status < 0) fail(what);
}

template <class T>
hid_t typeOf();
template <>
hid_t typeOf<double>() {
    return H5T_NATIVE_DOUBLE;
}
template <>
hid_t typeOf<float>() {
    return H5T_NATIVE_FLOAT;
}
template <>
hid_t typeOf<std::int64_t>() {
    return H5T_NATIVE_INT64;
}
template <>
hid_t typeOf<std::uint8_t>() {
    return H5T_NATIVE_UINT8;
}
template <>
hid_t typeOf<std::uint64_t>() {
    return H5T_NATIVE_UINT64;
}
template <>
hid_t typeOf<std::uint32_t>() {
    return H5T_NATIVE_UINT32;
}

Handle inMemory() {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // errors are told by exceptions
    Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "file access");
    check(H5Pset_fapl_core(access, kIncrement, 0), "file access");
    return access;
}

/// Names for files in memory. HDF5 takes two files of one name for the same file, even where there is no file; and
/// several threads write at once.
std::string freshName() {
    static std::atomic<std::uint64_t> count{0};
    return "memory" + std::to_string(count++);
}

/// Properties for creating something, of class `kind`. They leave out the time of day, so that the same data make the
/// same bytes.
Handle timeless(hid_t kind) {
    Handle how(H5Pcreate(kind), H5Pclose, "creation properties");
    check(H5Pset_obj_track_times(how, false), "creation properties");
    return how;
}

Handle created() {
    const Handle access = inMemory(), how = timeless(H5P_FILE_CREATE);
    check(H5Pset_istore_k(how, 1), "file creation");  // a short index for each data set, which has few chunks
    return {H5Fcreate(freshName().c_str(), H5F_ACC_TRUNC, how, access), H5Fclose, "creating a file"};
}

Handle opened(std::string& image) {
    const Handle access = inMemory();
    check(H5Pset_file_image(access, image.data(), image.size()), "reading a file");
    return {H5Fopen(freshName().c_str(), H5F_ACC_RDONLY, access), H5Fclose, "opening a file"};
}

Handle openDataset(hid_t file, const std::string& path) {
    return {H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose, path};
}

/// The number of elements of a data set. Throws if the data set claims more elements than its part of the file can
/// hold, before memory is taken for them.
std::size_t length(hid_t dataset, const std::string& path) {
    const Handle space(H5Dget_space(dataset), H5Sclose, path);
    const hssize_t count = H5Sget_simple_extent_npoints(space);
    if (count < 0) fail(path);
    constexpr double kMostPacked = 1032;  // bytes that deflate makes of one, at most
    const Handle type(H5Dget_type(dataset), H5Tclose, path), file(H5Iget_file_id(dataset), H5Fclose, path);
    hsize_t whole = 0;
    check(H5Fget_filesize(file, &whole), path);
    const auto claimed = static_cast<double>(count) * static_cast<double>(H5Tget_size(type));
    const hsize_t held = H5Dget_storage_size(dataset);
    if (held > whole || claimed > kMostPacked * static_cast<double>(held))
        throw Error(path + " claims " + std::to_string(count) + " elements of " + std::to_string(H5Tget_size(type)) +
                    " bytes, more than the file can hold");
    return static_cast<std::size_t>(count);
}

template <class T>
std::vector<T> read(hid_t dataset, const std::string& path) {
    std::vector<T> values(length(dataset, path));
    if (!values.empty()) check(H5Dread(dataset, typeOf<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), path);
    return values;
}

/// Of a text of fixed length.
Handle textType(std::size_t length, const std::string& path) {
    Handle type(H5Tcopy(H5T_C_S1), H5Tclose, path);
    check(H5Tset_size(type, std::max<std::size_t>(length, 1)), path);
    check(H5Tset_strpad(type, H5T_STR_NULLPAD), path);
    return type;
}

std::string atLeastOne(std::string_view value) {
    return value.empty() ? std::string(1, '\0') : std::string(value);
}

}  // namespace

bool threadSafe() {
    hbool_t safe = 0;
    return H5is_library_threadsafe(&safe) >= 0 && safe != 0;
}

Handle::Handle(hid_t id, herr_t (*close)(hid_t), const std::string& what) : id_(id), close_(close) {
    if (id < 0) fail(what);
}

Handle::~Handle() {
    if (id_ >= 0) close_(id_);
}

Handle::Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}

Writer::Writer() : file_(created()) {}

void Writer::group(const std::string& path) {
    const Handle how = timeless(H5P_GROUP_CREATE);
    const Handle group(H5Gcreate2(file_, path.c_str(), H5P_DEFAULT, how, H5P_DEFAULT), H5Gclose, path);
}

void Writer::text(const std::string& path, std::string_view value) {
    const Handle type = textType(value.size(), path);
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose, path);
    const Handle how = timeless(H5P_DATASET_CREATE);
    const Handle set(H5Dcreate2(file_, path.c_str(), type, space, H5P_DEFAULT, how, H5P_DEFAULT), H5Dclose, path);
    check(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, atLeastOne(value).data()), path);
}

void Writer::dataset(const std::string& path, hid_t type, const std::vector<std::size_t>& shape, const void* data) {
    std::vector<hsize_t> size(shape.begin(), shape.end());
    const int rank = static_cast<int>(size.size());
    const Handle space(H5Screate_simple(rank, size.data(), nullptr), H5Sclose, path);
    const Handle how = timeless(H5P_DATASET_CREATE);
    const std::size_t count = std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
    if (count > 0) {
        // Whole rows of the other dimensions, as many as make a chunk of about this many numbers.
        constexpr std::size_t kChunk = 1 << 18;
        size[0] = std::clamp<std::size_t>(kChunk * shape[0] / count, 1, shape[0]);
        check(H5Pset_chunk(how, rank, size.data()), path);
        check(H5Pset_shuffle(how), path);
        check(H5Pset_deflate(how, 1), path);
    }
    const Handle set(H5Dcreate2(file_, path.c_str(), type, space, H5P_DEFAULT, how, H5P_DEFAULT), H5Dclose, path);
    if (count > 0) check(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), path);
}

void Writer::record(const std::string& path, const Record& record) {
    group(path);
    for (const auto& [name, array] : record.arrays()) {
        const std::string full = path + "/" + name;
        std::visit(
            [&](const auto& values) {
                using T = typename std::decay_t<decltype(values)>::value_type;
                dataset(full, typeOf<T>(), {values.size()}, values.data());
            },
            array);
    }
}

template <class T>
void Writer::array(const std::string& path, const std::vector<T>& values, const std::vector<std::size_t>& shape) {
    dataset(path, typeOf<T>(), shape, values.data());
}
template void Writer::array(const std::string&, const std::vector<double>&, const std::vector<std::size_t>&);
template void Writer::array(const std::string&, const std::vector<float>&, const std::vector<std::size_t>&);
template void Writer::array(const std::string&, const std::vector<std::int64_t>&, const std::vector<std::size_t>&);
template void Writer::array(const std::string&, const std::vector<std::uint32_t>&, const std::vector<std::size_t>&);
template void Writer::array(const std::string&, const std::vector<std::uint8_t>&, const std::vector<std::size_t>&);

void Writer::attribute(const std::string& path, const std::string& name, hid_t type, hid_t space, const void* data) {
    const Handle owner(H5Oopen(file_, path.c_str(), H5P_DEFAULT), H5Oclose, path);
    const Handle attribute(H5Acreate2(owner, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, name);
    check(H5Awrite(attribute, type, data), name);
}

void Writer::attribute(const std::string& path, const std::string& name, std::string_view value) {
    const Handle type = textType(value.size(), name);
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose, name);
    attribute(path, name, type, space, atLeastOne(value).data());
}

template <class T>
void Writer::attribute(const std::string& path, const std::string& name, const std::vector<T>& values) {
    const hsize_t size = values.size();
    const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose, name);
    attribute(path, name, typeOf<T>(), space, values.data());
}
template void Writer::attribute(const std::string&, const std::string&, const std::vector<double>&);
template void Writer::attribute(const std::string&, const std::string&, const std::vector<std::int64_t>&);

std::string Writer::image() {
    check(H5Fflush(file_, H5F_SCOPE_GLOBAL), "flushing");
    const ssize_t size = H5Fget_file_image(file_, nullptr, 0);
    if (size < 0) fail("the file's image");
    std::string bytes(static_cast<std::size_t>(size), '\0');
    if (H5Fget_file_image(file_, bytes.data(), bytes.size()) < 0) fail("the file's image");
    return bytes;
}

Reader::Reader(std::string image) : image_(std::move(image)), file_(opened(image_)) {}

std::string Reader::text(const std::string& path) const {
    const Handle set = openDataset(file_, path);
    const Handle type(H5Dget_type(set), H5Tclose, path);
    if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0 || length(set, path) != 1)
        throw Error(path + " is not a text");
    std::string value(H5Tget_size(type), '\0');
    check(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, value.data()), path);
    if (value == std::string(1, '\0')) value.clear();
    return value;
}

Record Reader::record(const std::string& path) const {
    const Handle group(H5Gopen2(file_, path.c_str(), H5P_DEFAULT), H5Gclose, path);
    H5G_info_t info{};
    check(H5Gget_info(group, &info), path);
    Record record;
    for (hsize_t i = 0; i < info.nlinks; ++i) {
        const auto nameOf = [&](char* to, std::size_t size) {
            return H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, i, to, size, H5P_DEFAULT);
        };
        const ssize_t size = nameOf(nullptr, 0);
        if (size < 0) fail(path);
        std::string name(static_cast<std::size_t>(size) + 1, '\0');
        nameOf(name.data(), name.size());
        name.pop_back();
        const std::string full = path + "/" + name;
        const Handle set = openDataset(file_, full);
        const Handle type(H5Dget_type(set), H5Tclose, full);
        const bool real = H5Tget_class(type) == H5T_FLOAT, wide = H5Tget_size(type) == 8;
        if (!real && H5Tget_class(type) != H5T_INTEGER) throw Error(full + " is not an array of numbers");
        if (real && wide)
            record.put(name, read<double>(set, full));
        else if (real)
            record.put(name, read<float>(set, full));
        else if (wide)
            record.put(name, read<std::uint64_t>(set, full));
        else
            record.put(name, read<std::uint32_t>(set, full));
    }
    return record;
}

bool Reader::has(const std::string& path) const {
    return H5Lexists(file_, path.c_str(), H5P_DEFAULT) > 0;
}

template <class T>
std::vector<T> Reader::array(const std::string& path) const {
    const Handle set = openDataset(file_, path);
    return read<T>(set, path);
}
template std::vector<double> Reader::array(const std::string&) const;
template std::vector<float> Reader::array(const std::string&) const;
template std::vector<std::uint64_t> Reader::array(const std::string&) const;
template std::vector<std::uint32_t> Reader::array(const std::string&) const;

}  // namespace vkdose::hdf5
