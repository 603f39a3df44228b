#include "host/output/hdf5.h"

#include <algorithm>
#include <atomic>
#include <utility>

namespace vkdose::hdf5 {

namespace {

constexpr std::size_t kIncrement = 1 << 20;  // by which a file in memory grows [bytes]

void check(herr_t status, const std::string& what) {
    if (status < 0) throw Error("HDF5 failed at " + what);
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

/// HDF5 takes two files of one name for the same file, even where there is none; several threads write at once.
std::string freshName() {
    static std::atomic<std::uint64_t> count{0};
    return "memory" + std::to_string(count++);
}

Handle created() {
    const Handle access = inMemory();
    return {H5Fcreate(freshName().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose, "creating a file"};
}

Handle opened(std::string& image) {
    const Handle access = inMemory();
    check(H5Pset_file_image(access, image.data(), image.size()), "reading a file");
    return {H5Fopen(freshName().c_str(), H5F_ACC_RDONLY, access), H5Fclose, "opening a file"};
}

Handle openDataset(hid_t file, const std::string& path) {
    return {H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose, path};
}

std::size_t length(hid_t dataset, const std::string& path) {
    const Handle space(H5Dget_space(dataset), H5Sclose, path);
    const hssize_t count = H5Sget_simple_extent_npoints(space);
    if (count < 0) throw Error("HDF5 failed at " + path);
    return static_cast<std::size_t>(count);
}

template <class T>
void read(hid_t dataset, const std::string& path, const std::string& name, Record& record) {
    std::vector<T> values(length(dataset, path));
    if (!values.empty()) check(H5Dread(dataset, typeOf<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), path);
    record.put(name, std::move(values));
}

}  // namespace

bool threadSafe() {
    hbool_t safe = 0;
    return H5is_library_threadsafe(&safe) >= 0 && safe != 0;
}

Handle::Handle(hid_t id, herr_t (*close)(hid_t), const std::string& what) : id_(id), close_(close) {
    if (id < 0) throw Error("HDF5 failed at " + what);
}

Handle::~Handle() {
    if (id_ >= 0) close_(id_);
}

Handle::Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}

Writer::Writer() : file_(created()) {}

void Writer::group(const std::string& path) {
    const Handle group(H5Gcreate2(file_, path.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, path);
}

void Writer::text(const std::string& path, std::string_view value) {
    const Handle type(H5Tcopy(H5T_C_S1), H5Tclose, path);
    check(H5Tset_size(type, std::max<std::size_t>(value.size(), 1)), path);
    check(H5Tset_strpad(type, H5T_STR_NULLPAD), path);
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose, path);
    const Handle set(H5Dcreate2(file_, path.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose,
                     path);
    const std::string padded = value.empty() ? std::string(1, '\0') : std::string(value);
    check(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, padded.data()), path);
}

void Writer::dataset(const std::string& path, hid_t type, std::size_t count, const void* data) {
    const hsize_t size = count;
    const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose, path);
    const Handle how(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, path);
    if (count > 0) {
        const hsize_t chunk = std::min<hsize_t>(size, 1 << 18);
        check(H5Pset_chunk(how, 1, &chunk), path);
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
                dataset(full, typeOf<T>(), values.size(), values.data());
            },
            array);
    }
}

std::string Writer::image() {
    check(H5Fflush(file_, H5F_SCOPE_GLOBAL), "flushing");
    const ssize_t size = H5Fget_file_image(file_, nullptr, 0);
    if (size < 0) throw Error("HDF5 failed at the file's image");
    std::string bytes(static_cast<std::size_t>(size), '\0');
    if (H5Fget_file_image(file_, bytes.data(), bytes.size()) < 0) throw Error("HDF5 failed at the file's image");
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
        if (size < 0) throw Error("HDF5 failed at " + path);
        std::string name(static_cast<std::size_t>(size) + 1, '\0');
        nameOf(name.data(), name.size());
        name.pop_back();
        const std::string full = path + "/" + name;
        const Handle set = openDataset(file_, full);
        const Handle type(H5Dget_type(set), H5Tclose, full);
        const bool real = H5Tget_class(type) == H5T_FLOAT, wide = H5Tget_size(type) == 8;
        if (!real && H5Tget_class(type) != H5T_INTEGER) throw Error(full + " is not an array of numbers");
        if (real && wide)
            read<double>(set, full, name, record);
        else if (real)
            read<float>(set, full, name, record);
        else if (wide)
            read<std::uint64_t>(set, full, name, record);
        else
            read<std::uint32_t>(set, full, name, record);
    }
    return record;
}

}  // namespace vkdose::hdf5
