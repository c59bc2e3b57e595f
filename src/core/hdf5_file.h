// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// HDF5 files by name and value: handles that close themselves, types and shapes checked before
// anything is read, errors as exceptions and never on the terminal.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace ltc {

// An open HDF5 object, closed by the function that its kind asks for.
class Hdf5Handle {
 public:
  using Id = std::int64_t;  // hid_t
  Hdf5Handle() = default;
  Hdf5Handle(Id id, int (*close)(Id)) : id_(id), close_(close) {}
  Hdf5Handle(Hdf5Handle&& other) noexcept
      : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Hdf5Handle() {
    if (id_ >= 0)
      close_(id_);
  }
  bool valid() const { return id_ >= 0; }
  Id id() const { return id_; }
  // Closes now; false if that failed, as it does when the last bytes do not reach the disk.
  bool close() { return id_ >= 0 && close_(std::exchange(id_, -1)) >= 0; }

 private:
  Id id_ = -1;
  int (*close_)(Id) = nullptr;
};

// Reads. An object is a path in the file ("/", "axis/alpha"). Throws IoError for a file that cannot
// be opened, InputError naming file and object for one that is no HDF5 file, or for an object that
// is missing, damaged, or of another type or shape than asked for. Takes no more memory for an
// object than the file has bytes, or 16 MiB for a text; opens no other file.
class Hdf5Input {
 public:
  explicit Hdf5Input(const std::filesystem::path& path);

  bool has_attribute(const std::string& object, const std::string& attribute) const;
  // A string attribute, of variable or fixed length.
  std::string text(const std::string& object, const std::string& attribute) const;
  // Scalar attributes: exactly f64; exactly u64; an integer of any size.
  double real(const std::string& object, const std::string& attribute) const;
  std::uint64_t natural(const std::string& object, const std::string& attribute) const;
  std::int64_t integer(const std::string& object, const std::string& attribute) const;

  std::vector<std::size_t> shape(const std::string& dataset) const;
  // All values in C order. T: float, double, std::uint8_t, std::uint16_t, std::int32_t, exactly the
  // file's.
  template <class T>
  std::vector<T> values(const std::string& dataset, const std::vector<std::size_t>& shape) const;

 private:
  Hdf5Handle open_attribute(const std::string& object, const std::string& attribute) const;
  Hdf5Handle open_dataset(const std::string& dataset) const;
  template <class T>
  T scalar(const std::string& object, const std::string& attribute, bool any_size) const;
  [[noreturn]] void refuse(const std::string& what) const;

  std::string name_;
  std::uintmax_t bytes_ = 0;
  Hdf5Handle file_;
};

// Makes the bytes of a new file; the same calls give the same bytes, for no time is recorded. In
// memory: what a full disk refuses is then one write like any other, whereas the library, once it
// could not write, neither says why nor can be closed in order. Throws IoError naming `shown_as`.
class Hdf5Output {
 public:
  // `expected_bytes`, about: with what room for them is taken at once.
  explicit Hdf5Output(std::string shown_as, std::size_t expected_bytes = 0);

  void text(const std::string& object, const std::string& attribute, const std::string& value);
  // T: double, std::int32_t, std::uint64_t.
  template <class T>
  void number(const std::string& object, const std::string& attribute, T value);
  void group(const std::string& name);
  // T: float, double, std::uint8_t, std::uint16_t, std::int32_t; as many values as the shape says.
  template <class T>
  void values(const std::string& dataset, const std::vector<std::size_t>& shape,
              std::span<const T> values);
  // The bytes of the file; must be called last.
  std::string finish();

 private:
  void check(bool ok, const std::string& what) const;
  Hdf5Handle checked(Hdf5Handle handle, const std::string& what) const;

  std::string name_;
  std::unique_ptr<std::string> image_;  // the library writes to it as long as the file is open
  Hdf5Handle file_;
};

}  // namespace ltc
