// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "core/hdf5_file.h"

#include <hdf5.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <new>
#include <numeric>
#include <string_view>
#include <type_traits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.h"
#include "core/file.h"
#include "core/hdf5_heap.h"

namespace ltc {
namespace {

static_assert(std::is_same_v<hid_t, Hdf5Handle::Id>);
static_assert(std::is_same_v<herr_t, int>);

// A configuration may be long; nothing else is.
constexpr std::size_t max_text_bytes = std::size_t{16} << 20;

// How a C++ type is called in memory, in files (little-endian) and in messages.
template <class T>
struct TypeOf;
template <>
struct TypeOf<float> {
  static hid_t memory() { return H5T_NATIVE_FLOAT; }
  static hid_t file() { return H5T_IEEE_F32LE; }
  static constexpr const char* name = "f32";
};
template <>
struct TypeOf<double> {
  static hid_t memory() { return H5T_NATIVE_DOUBLE; }
  static hid_t file() { return H5T_IEEE_F64LE; }
  static constexpr const char* name = "f64";
};
template <>
struct TypeOf<std::uint8_t> {
  static hid_t memory() { return H5T_NATIVE_UINT8; }
  static hid_t file() { return H5T_STD_U8LE; }
  static constexpr const char* name = "u8";
};
template <>
struct TypeOf<std::uint16_t> {
  static hid_t memory() { return H5T_NATIVE_UINT16; }
  static hid_t file() { return H5T_STD_U16LE; }
  static constexpr const char* name = "u16";
};
template <>
struct TypeOf<std::uint64_t> {
  static hid_t memory() { return H5T_NATIVE_UINT64; }
  static hid_t file() { return H5T_STD_U64LE; }
  static constexpr const char* name = "u64";
};
template <>
struct TypeOf<std::int32_t> {
  static hid_t memory() { return H5T_NATIVE_INT32; }
  static hid_t file() { return H5T_STD_I32LE; }
  static constexpr const char* name = "i32";
};
template <>
struct TypeOf<std::int64_t> {
  static hid_t memory() { return H5T_NATIVE_INT64; }
  static hid_t file() { return H5T_STD_I64LE; }
  static constexpr const char* name = "integer";
};

// Whether a file's type holds T's values, and with any_size other widths of the same kind too. Byte
// order is the library's business.
template <class T>
bool holds(hid_t type, bool any_size) {
  const H5T_class_t kind = H5Tget_class(type);
  if constexpr (std::is_floating_point_v<T>)
    return kind == H5T_FLOAT && H5Tget_size(type) == sizeof(T);
  if (kind != H5T_INTEGER)
    return false;
  if (any_size)
    return H5Tget_size(type) <= sizeof(T);
  return H5Tget_size(type) == sizeof(T) &&
         H5Tget_sign(type) == (std::is_signed_v<T> ? H5T_SGN_2 : H5T_SGN_NONE);
}

std::size_t product(const std::vector<std::size_t>& shape) {
  return std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
}

// For good, not for the time of a call: after a damaged file the library complains of itself once
// more when the program ends.
void keep_library_errors_off_the_terminal() {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Hdf5Handle dataspace_of(const std::vector<std::size_t>& shape) {
  const std::vector<hsize_t> extent(shape.begin(), shape.end());
  return {H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr), H5Sclose};
}

// Whether every step of the path is a link into the same file. Links by name can form circles or
// open any file of the system.
bool linked_within_the_file(hid_t file, const std::string& object) {
  for (std::size_t end = 0; end < object.size();) {
    end = std::min(object.find('/', end + 1), object.size());
    H5L_info_t link;
    const std::string step = object.substr(0, end);
    if (step != "/" &&
        (H5Lget_info(file, step.c_str(), &link, H5P_DEFAULT) < 0 || link.type != H5L_TYPE_HARD))
      return false;
  }
  return true;
}

// What is wrong with how a dataset of so many bytes lies in its file; empty if nothing is. Only
// values that the file really holds, one after the other, are read: then no header can ask for more
// memory than the file has bytes, name another file to read from, or bring in a filter.
std::string storage_fault(hid_t dataset, std::size_t bytes, std::uintmax_t file_bytes) {
  const Hdf5Handle creation(H5Dget_create_plist(dataset), H5Pclose);
  const H5D_layout_t layout = H5Pget_layout(creation.id());
  if (layout != H5D_CONTIGUOUS && layout != H5D_COMPACT)
    return "is stored in chunks or elsewhere; expected: contiguous (h5repack -l CONTI writes it "
           "so)";
  if (H5Pget_external_count(creation.id()) != 0)
    return "lies in another file; expected: in this one";
  const std::uintmax_t stored = H5Dget_storage_size(dataset);
  if (stored != bytes || stored > file_bytes)
    return fmt::format("has {} bytes in a file of {}; its shape asks for {}", stored, file_bytes,
                       bytes);
  return {};
}

std::string text_of_variable_length(hid_t attribute, hid_t type, bool& ok) {
  char* raw = nullptr;
  ok = H5Aread(attribute, type, static_cast<void*>(&raw)) >= 0;
  const std::unique_ptr<char, herr_t (*)(void*)> owned(raw, H5free_memory);
  return ok && raw ? std::string(raw) : std::string();
}

std::string text_of_fixed_length(hid_t attribute, hid_t type, bool& ok) {
  const std::size_t size = H5Tget_size(type);
  ok = size > 0 && size <= max_text_bytes;
  std::string text(ok ? size : 0, '\0');
  ok = ok && H5Aread(attribute, type, text.data()) >= 0;
  text.resize(std::min(text.size(), text.find('\0')));
  if (H5Tget_strpad(type) == H5T_STR_SPACEPAD)
    text.resize(text.find_last_not_of(' ') + 1);
  return text;
}

// The library's memory for a file is this string, which outlives the file: the library has a
// function that copies the bytes of an open file, but in many versions with a wrong checksum.
H5FD_file_image_callbacks_t image_callbacks(std::string& image) {
  H5FD_file_image_callbacks_t callbacks{};
  callbacks.image_realloc = [](void*, std::size_t size, H5FD_file_image_op_t,
                               void* user) noexcept -> void* {
    try {
      std::string& bytes = *static_cast<std::string*>(user);
      bytes.resize(size);
      return bytes.data();
    } catch (const std::bad_alloc&) {
      return nullptr;
    }
  };
  callbacks.image_free = [](void*, H5FD_file_image_op_t, void*) noexcept -> herr_t { return 0; };
  callbacks.udata_copy = [](void* user) noexcept { return user; };
  callbacks.udata_free = [](void*) noexcept -> herr_t { return 0; };
  callbacks.udata = &image;
  return callbacks;
}

// Where a file of superblock version 2 or 3 ends (HDF5 File Format Specification 3.0, II.A); the
// library takes memory in larger pieces. 0 if the image has no superblock.
std::size_t end_of_file_address(std::string_view image) {
  constexpr std::size_t offset = 28, bytes = 8;
  std::size_t address = 0;
  if (image.size() >= offset + bytes)
    for (std::size_t i = bytes; i-- > 0;)
      address = address << 8 | static_cast<unsigned char>(image[offset + i]);
  return address;
}

}  // namespace

Hdf5Input::Hdf5Input(const std::filesystem::path& path) : name_(path.string()) {
  keep_library_errors_off_the_terminal();
  bytes_ = require_readable(path);
  if (!global_heaps_are_sound(path))
    refuse("the texts of the file are damaged");
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  // Tables are renamed into place whole, so a reader needs no lock, and some file systems have
  // none.
  H5Pset_file_locking(access.id(), false, true);
  file_ = Hdf5Handle(H5Fopen(name_.c_str(), H5F_ACC_RDONLY, access.id()), H5Fclose);
  if (!file_.valid())
    refuse("no HDF5 file, or a damaged one");
}

void Hdf5Input::refuse(const std::string& what) const {
  throw InputError(fmt::format("{}: {}", name_, what));
}

Hdf5Handle Hdf5Input::open_attribute(const std::string& object,
                                     const std::string& attribute) const {
  if (!linked_within_the_file(file_.id(), object))
    refuse(fmt::format("{} is missing, or no plain link", object));
  Hdf5Handle handle(
      H5Aopen_by_name(file_.id(), object.c_str(), attribute.c_str(), H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose);
  if (!handle.valid())
    refuse(fmt::format("attribute {} of {} is missing", attribute, object));
  const Hdf5Handle space(H5Aget_space(handle.id()), H5Sclose);
  if (H5Sget_simple_extent_npoints(space.id()) != 1)
    refuse(fmt::format("attribute {} of {} is not a single value", attribute, object));
  return handle;
}

bool Hdf5Input::has_attribute(const std::string& object, const std::string& attribute) const {
  return linked_within_the_file(file_.id(), object) &&
         H5Aexists_by_name(file_.id(), object.c_str(), attribute.c_str(), H5P_DEFAULT) > 0;
}

std::string Hdf5Input::text(const std::string& object, const std::string& attribute) const {
  const Hdf5Handle handle = open_attribute(object, attribute);
  const Hdf5Handle type(H5Aget_type(handle.id()), H5Tclose);
  if (H5Tget_class(type.id()) != H5T_STRING)
    refuse(fmt::format("attribute {} of {} is no string", attribute, object));
  bool ok = false;
  std::string text = H5Tis_variable_str(type.id()) > 0
                         ? text_of_variable_length(handle.id(), type.id(), ok)
                         : text_of_fixed_length(handle.id(), type.id(), ok);
  if (!ok)
    refuse(fmt::format("attribute {} of {} cannot be read", attribute, object));
  return text;
}

template <class T>
T Hdf5Input::scalar(const std::string& object, const std::string& attribute, bool any_size) const {
  const Hdf5Handle handle = open_attribute(object, attribute);
  const Hdf5Handle type(H5Aget_type(handle.id()), H5Tclose);
  if (!holds<T>(type.id(), any_size))
    refuse(fmt::format("attribute {} of {} has another type than {}", attribute, object,
                       TypeOf<T>::name));
  T value{};
  if (H5Aread(handle.id(), TypeOf<T>::memory(), &value) < 0)
    refuse(fmt::format("attribute {} of {} cannot be read", attribute, object));
  return value;
}

double Hdf5Input::real(const std::string& object, const std::string& attribute) const {
  return scalar<double>(object, attribute, false);
}

std::uint64_t Hdf5Input::natural(const std::string& object, const std::string& attribute) const {
  return scalar<std::uint64_t>(object, attribute, false);
}

std::int64_t Hdf5Input::integer(const std::string& object, const std::string& attribute) const {
  return scalar<std::int64_t>(object, attribute, true);
}

Hdf5Handle Hdf5Input::open_dataset(const std::string& dataset) const {
  if (!linked_within_the_file(file_.id(), dataset))
    refuse(fmt::format("dataset {} is missing, or no plain link", dataset));
  Hdf5Handle handle(H5Dopen2(file_.id(), dataset.c_str(), H5P_DEFAULT), H5Dclose);
  if (!handle.valid())
    refuse(fmt::format("dataset {} is missing", dataset));
  return handle;
}

std::vector<std::size_t> Hdf5Input::shape(const std::string& dataset) const {
  const Hdf5Handle handle = open_dataset(dataset);
  const Hdf5Handle space(H5Dget_space(handle.id()), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space.id());
  if (H5Sget_simple_extent_type(space.id()) == H5S_NULL || rank < 0)
    refuse(fmt::format("dataset {} has no shape", dataset));
  std::vector<hsize_t> extent(static_cast<std::size_t>(rank));
  if (rank > 0)
    H5Sget_simple_extent_dims(space.id(), extent.data(), nullptr);
  return {extent.begin(), extent.end()};
}

template <class T>
std::vector<T> Hdf5Input::values(const std::string& dataset,
                                 const std::vector<std::size_t>& expected) const {
  const Hdf5Handle handle = open_dataset(dataset);
  const Hdf5Handle type(H5Dget_type(handle.id()), H5Tclose);
  if (!holds<T>(type.id(), false))
    refuse(fmt::format("dataset {} has another type than {}", dataset, TypeOf<T>::name));
  const std::vector<std::size_t> found = shape(dataset);
  if (found != expected)
    refuse(fmt::format("dataset {} has shape ({}); expected: ({})", dataset, fmt::join(found, ", "),
                       fmt::join(expected, ", ")));
  if (const std::string fault = storage_fault(handle.id(), product(found) * sizeof(T), bytes_);
      !fault.empty())
    refuse(fmt::format("dataset {} {}", dataset, fault));
  std::vector<T> values(product(found));
  if (H5Dread(handle.id(), TypeOf<T>::memory(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    refuse(fmt::format("dataset {} cannot be read", dataset));
  return values;
}

Hdf5Output::Hdf5Output(std::string shown_as, std::size_t expected_bytes)
    : name_(std::move(shown_as)), image_(std::make_unique<std::string>()) {
  try {
    image_->reserve(expected_bytes);
  } catch (const std::bad_alloc&) {
    // As it comes, then: what the library cannot have it says.
  }
  keep_library_errors_off_the_terminal();
  const Hdf5Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation.id(), false);
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  constexpr std::size_t increment = std::size_t{1} << 20;  // that memory is taken in
  constexpr bool on_disk_too = false;
  H5Pset_fapl_core(access.id(), increment, on_disk_too);
  H5FD_file_image_callbacks_t callbacks = image_callbacks(*image_);
  H5Pset_file_image_callbacks(access.id(), &callbacks);
  // The format of HDF5 1.8, which every reader of today knows: its metadata carry checksums.
  H5Pset_libver_bounds(access.id(), H5F_LIBVER_V18, H5F_LIBVER_V18);
  // A name that no file can have: of a file that is there, the library would first read all bytes,
  // into memory that it expects these callbacks to free.
  const std::string no_file = name_ + "/";
  file_ = checked({H5Fcreate(no_file.c_str(), H5F_ACC_TRUNC, creation.id(), access.id()), H5Fclose},
                  "the file cannot be created");
}

void Hdf5Output::check(bool ok, const std::string& what) const {
  if (!ok)
    throw IoError(fmt::format("cannot write {}: {}", name_, what));
}

Hdf5Handle Hdf5Output::checked(Hdf5Handle handle, const std::string& what) const {
  check(handle.valid(), what);
  return handle;
}

void Hdf5Output::text(const std::string& object, const std::string& attribute,
                      const std::string& value) {
  check(value.find('\0') == std::string::npos, "attribute " + attribute + " holds a NUL");
  const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.id(), H5T_VARIABLE);
  H5Tset_cset(type.id(), H5T_CSET_UTF8);
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Handle handle =
      checked({H5Acreate_by_name(file_.id(), object.c_str(), attribute.c_str(), type.id(),
                                 space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
               H5Aclose},
              "attribute " + attribute);
  const char* raw = value.c_str();
  check(H5Awrite(handle.id(), type.id(), static_cast<const void*>(&raw)) >= 0,
        "attribute " + attribute);
}

template <class T>
void Hdf5Output::number(const std::string& object, const std::string& attribute, T value) {
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Handle handle =
      checked({H5Acreate_by_name(file_.id(), object.c_str(), attribute.c_str(), TypeOf<T>::file(),
                                 space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
               H5Aclose},
              "attribute " + attribute);
  check(H5Awrite(handle.id(), TypeOf<T>::memory(), &value) >= 0, "attribute " + attribute);
}

void Hdf5Output::group(const std::string& name) {
  const Hdf5Handle creation(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation.id(), false);
  checked({H5Gcreate2(file_.id(), name.c_str(), H5P_DEFAULT, creation.id(), H5P_DEFAULT), H5Gclose},
          "group " + name);
}

template <class T>
void Hdf5Output::values(const std::string& dataset, const std::vector<std::size_t>& shape,
                        std::span<const T> values) {
  check(values.size() == product(shape), "dataset " + dataset + ": values do not fill the shape");
  const Hdf5Handle space = dataspace_of(shape);
  const Hdf5Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation.id(), false);
  const Hdf5Handle handle =
      checked({H5Dcreate2(file_.id(), dataset.c_str(), TypeOf<T>::file(), space.id(), H5P_DEFAULT,
                          creation.id(), H5P_DEFAULT),
               H5Dclose},
              "dataset " + dataset);
  check(
      H5Dwrite(handle.id(), TypeOf<T>::memory(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0,
      "dataset " + dataset);
}

std::string Hdf5Output::finish() {
  check(file_.close(), "the file cannot be closed");
  const std::size_t size = end_of_file_address(*image_);
  check(size > 0 && size <= image_->size(), "the library left no file");
  image_->resize(size);
  return std::move(*image_);
}

template std::vector<float> Hdf5Input::values(const std::string&,
                                              const std::vector<std::size_t>&) const;
template std::vector<double> Hdf5Input::values(const std::string&,
                                               const std::vector<std::size_t>&) const;
template std::vector<std::uint8_t> Hdf5Input::values(const std::string&,
                                                     const std::vector<std::size_t>&) const;
template std::vector<std::uint16_t> Hdf5Input::values(const std::string&,
                                                      const std::vector<std::size_t>&) const;
template std::vector<std::int32_t> Hdf5Input::values(const std::string&,
                                                     const std::vector<std::size_t>&) const;
template void Hdf5Output::number(const std::string&, const std::string&, double);
template void Hdf5Output::number(const std::string&, const std::string&, std::int32_t);
template void Hdf5Output::number(const std::string&, const std::string&, std::uint64_t);
template void Hdf5Output::values(const std::string&, const std::vector<std::size_t>&,
                                 std::span<const float>);
template void Hdf5Output::values(const std::string&, const std::vector<std::size_t>&,
                                 std::span<const double>);
template void Hdf5Output::values(const std::string&, const std::vector<std::size_t>&,
                                 std::span<const std::uint8_t>);
template void Hdf5Output::values(const std::string&, const std::vector<std::size_t>&,
                                 std::span<const std::uint16_t>);
template void Hdf5Output::values(const std::string&, const std::vector<std::size_t>&,
                                 std::span<const std::int32_t>);

}  // namespace ltc
