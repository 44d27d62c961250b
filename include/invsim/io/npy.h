// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_IO_NPY_H_
#define INVSIM_IO_NPY_H_

// NumPy's .npy: one array of numbers, truth values or text, as described in
// NumPy's "NEP 1: a simple file format for NumPy arrays". Any byte order and
// either index order is read; arrays are held and written little-endian in C
// order (the last index runs fastest).
//
// Arrays of Python objects are refused: they are pickles, and reading a pickle
// runs the program it contains.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace invsim {

enum class NpyType {
  kBool,   // |b1
  kInt,    // i1 i2 i4 i8
  kUint,   // u1 u2 u4 u8
  kFloat,  // f2 f4 f8
  kBytes,  // Sn: n bytes, padded with zeros
  kText,   // Un: n UTF-32 code points, padded with zeros
};

class NpyArray {
 public:
  using Shape = std::vector<std::int64_t>;

  // C order; the number of values must be the product of the shape (an empty
  // shape is a single value, NumPy's 0-d array).
  static NpyArray Doubles(Shape shape, const std::vector<double>& values);
  static NpyArray Floats(Shape shape, const std::vector<double>& values);
  static NpyArray Ints(Shape shape, const std::vector<std::int32_t>& values);
  static NpyArray Longs(Shape shape, const std::vector<std::int64_t>& values);
  static NpyArray Uints(Shape shape, const std::vector<std::uint32_t>& values);
  static NpyArray Ulongs(Shape shape, const std::vector<std::uint64_t>& values);
  static NpyArray Bools(Shape shape, const std::vector<bool>& values);
  // UTF-8 in, written as text (U).
  static NpyArray Text(Shape shape, const std::vector<std::string>& values);

  NpyType type() const { return type_; }
  // Bytes of one value; for text four per code point.
  std::size_t item_size() const { return item_size_; }
  const Shape& shape() const { return shape_; }
  // The number of values, the product of the shape.
  std::size_t size() const { return size_; }
  // "f4 (3400, 3)": how errors name the array.
  std::string Description() const;

  // All values in C order. Every kind of number (and bool) converts to double;
  // only whole numbers convert to integers, and only if they fit. Each throws
  // InputError naming `what` ("FILE: v_template") if the kind does not fit.
  std::vector<double> ToDoubles(const std::string& what) const;
  std::vector<std::int64_t> ToIntegers(const std::string& what) const;
  std::vector<std::string> ToStrings(const std::string& what) const;  // UTF-8

 private:
  friend NpyArray ParseNpy(std::string_view bytes, const std::string& name);
  friend std::string FormatNpy(const NpyArray& array);

  template <typename T, typename Values>
  static NpyArray Make(NpyType type, Shape shape, const Values& values);

  NpyType type_ = NpyType::kFloat;
  std::size_t item_size_ = 8;
  Shape shape_;
  std::size_t size_ = 0;
  std::string data_;  // little-endian, C order
};

// Throws InputError naming `name`: not an npy, cut short, object array,
// structured or unknown type, or a size that does not match the bytes there.
NpyArray ParseNpy(std::string_view bytes, const std::string& name);
NpyArray ReadNpy(const std::string& path);

std::string FormatNpy(const NpyArray& array);
void WriteNpy(const std::string& path, const NpyArray& array);

// How to turn a pickle into an npz that can be read: the end of the error line
// of everything that refuses one.
extern const char* const kPickleRemedy;

}  // namespace invsim

#endif  // INVSIM_IO_NPY_H_
