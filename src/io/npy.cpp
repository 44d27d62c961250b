// SPDX-License-Identifier: Apache-2.0
#include "invsim/io/npy.h"

#include <Eigen/Core>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

#include "invsim/base/error.h"
#include "invsim/io/file.h"
#include "npy_header.h"

namespace invsim {

static_assert(std::endian::native == std::endian::little,
              "npy arrays are held little-endian");

const char* const kPickleRemedy =
    "convert it once, where you trust its source: python3 -c \"import pickle, "
    "numpy as n; d = pickle.load(open('in.pkl', 'rb'), encoding='latin1'); "
    "n.savez('out.npz', **{k: n.array(v.todense() if hasattr(v, 'todense') "
    "else v) for k, v in d.items()})\"";

namespace {

// The product of a shape whose values take item_size bytes each, or -1 if it
// is more than memory can hold.
std::int64_t CountValues(const NpyArray::Shape& shape, std::size_t item_size) {
  std::int64_t count = 1;
  bool too_large = false;
  for (const std::int64_t n : shape) {
    if (n == 0) return 0;
    too_large |= __builtin_mul_overflow(count, n, &count);
  }
  std::int64_t bytes = 0;
  too_large |= __builtin_mul_overflow(
      count, static_cast<std::int64_t>(item_size), &bytes);
  return too_large ? -1 : count;
}

// Values from the first-index-fastest order to C order.
std::string FromFortranOrder(std::string_view data,
                             const NpyArray::Shape& shape,
                             std::size_t item_size) {
  const std::size_t dims = shape.size();
  std::vector<std::size_t> stride(dims, item_size);
  for (std::size_t d = 1; d < dims; ++d) {
    stride[d] = stride[d - 1] * static_cast<std::size_t>(shape[d - 1]);
  }
  std::string out(data.size(), '\0');
  std::vector<std::int64_t> index(dims, 0);
  std::size_t from = 0;
  for (std::size_t to = 0; to < out.size(); to += item_size) {
    std::memcpy(out.data() + to, data.data() + from, item_size);
    for (std::size_t d = dims; d-- > 0;) {
      from += stride[d];
      if (++index[d] < shape[d]) break;
      from -= stride[d] * static_cast<std::size_t>(shape[d]);
      index[d] = 0;
    }
  }
  return out;
}

void SwapBytes(std::size_t unit, std::string* data) {
  for (std::size_t i = 0; i + unit <= data->size(); i += unit) {
    std::reverse(data->begin() + i, data->begin() + i + unit);
  }
}

template <typename T>
T Load(const char* at) {
  T value;
  std::memcpy(&value, at, sizeof(T));
  return value;
}

// Calls visit(T()) with the C++ type of a number or bool array.
template <typename Visitor>
void VisitType(NpyType type, std::size_t item_size, const Visitor& visit) {
  switch (type) {
    case NpyType::kBool:
      return visit(std::uint8_t());
    case NpyType::kInt:
      if (item_size == 1) return visit(std::int8_t());
      if (item_size == 2) return visit(std::int16_t());
      if (item_size == 4) return visit(std::int32_t());
      return visit(std::int64_t());
    case NpyType::kUint:
      if (item_size == 1) return visit(std::uint8_t());
      if (item_size == 2) return visit(std::uint16_t());
      if (item_size == 4) return visit(std::uint32_t());
      return visit(std::uint64_t());
    case NpyType::kFloat:
      if (item_size == 2) return visit(Eigen::half());
      if (item_size == 4) return visit(float());
      return visit(double());
    case NpyType::kBytes:
    case NpyType::kText:
      return;
  }
}

bool IsNumeric(NpyType type) {
  return type != NpyType::kBytes && type != NpyType::kText;
}

void AppendUtf8(std::uint32_t code, std::string* out) {
  if (code < 0x80) {
    out->push_back(static_cast<char>(code));
    return;
  }
  const int tail = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
  const std::uint32_t lead[] = {0, 0xc0, 0xe0, 0xf0};
  out->push_back(static_cast<char>(lead[tail] | code >> (6 * tail)));
  for (int i = tail; i-- > 0;) {
    out->push_back(static_cast<char>(0x80 | (code >> (6 * i) & 0x3f)));
  }
}

// A malformed sequence (cut short, or longer than its code point needs) gives
// its bytes as code points, as Latin-1 would.
std::u32string FromUtf8(const std::string& text) {
  std::u32string out;
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i]);
    const int tail = lead >= 0xf0 ? 3 : lead >= 0xe0 ? 2 : lead >= 0xc0 ? 1 : 0;
    std::uint32_t code = tail == 0 ? lead : lead & (0x3f >> tail);
    int read = 0;
    while (read < tail && i + 1 + read < text.size() &&
           (text[i + 1 + read] & 0xc0) == 0x80) {
      code = code << 6 | (text[i + 1 + read] & 0x3f);
      ++read;
    }
    constexpr std::uint32_t kSmallest[] = {0, 0x80, 0x800, 0x10000};
    const bool well_formed = read == tail && code >= kSmallest[tail];
    out.push_back(well_formed ? code : lead);
    i += well_formed ? 1 + tail : 1;
  }
  return out;
}

std::string StringAt(const char* at, NpyType type, std::size_t item_size) {
  std::u32string code_points;
  if (type == NpyType::kBytes) {
    code_points = FromUtf8(std::string(at, item_size));
  } else {
    for (std::size_t i = 0; i < item_size; i += 4) {
      code_points.push_back(Load<char32_t>(at + i) & 0x1fffff);
    }
  }
  code_points.resize(code_points.find_last_not_of(U'\0') + 1);
  std::string text;
  for (const char32_t code : code_points) AppendUtf8(code, &text);
  return text;
}

void RequireCount(std::int64_t expected, std::size_t values) {
  if (expected < 0 || static_cast<std::size_t>(expected) != values) {
    throw Error(ErrorKind::kInternal,
                "npy array of " + std::to_string(values) +
                    " values, but its shape holds " + std::to_string(expected));
  }
}

}  // namespace

template <typename T, typename Values>
NpyArray NpyArray::Make(NpyType type, Shape shape, const Values& values) {
  NpyArray array;
  array.type_ = type;
  array.item_size_ = sizeof(T);
  RequireCount(CountValues(shape, sizeof(T)), values.size());
  array.shape_ = std::move(shape);
  array.size_ = values.size();
  array.data_.resize(values.size() * sizeof(T));
  char* at = array.data_.data();
  for (const auto value : values) {
    const T item = static_cast<T>(value);
    std::memcpy(at, &item, sizeof(T));
    at += sizeof(T);
  }
  return array;
}

NpyArray NpyArray::Doubles(Shape shape, const std::vector<double>& values) {
  return Make<double>(NpyType::kFloat, std::move(shape), values);
}
NpyArray NpyArray::Floats(Shape shape, const std::vector<double>& values) {
  return Make<float>(NpyType::kFloat, std::move(shape), values);
}
NpyArray NpyArray::Ints(Shape shape, const std::vector<std::int32_t>& values) {
  return Make<std::int32_t>(NpyType::kInt, std::move(shape), values);
}
NpyArray NpyArray::Longs(Shape shape, const std::vector<std::int64_t>& values) {
  return Make<std::int64_t>(NpyType::kInt, std::move(shape), values);
}
NpyArray NpyArray::Uints(Shape shape,
                         const std::vector<std::uint32_t>& values) {
  return Make<std::uint32_t>(NpyType::kUint, std::move(shape), values);
}
NpyArray NpyArray::Ulongs(Shape shape,
                          const std::vector<std::uint64_t>& values) {
  return Make<std::uint64_t>(NpyType::kUint, std::move(shape), values);
}
NpyArray NpyArray::Bools(Shape shape, const std::vector<bool>& values) {
  return Make<std::uint8_t>(NpyType::kBool, std::move(shape), values);
}

NpyArray NpyArray::Text(Shape shape, const std::vector<std::string>& values) {
  std::vector<std::u32string> texts;
  std::size_t longest = 1;
  for (const std::string& value : values) {
    texts.push_back(FromUtf8(value));
    longest = std::max(longest, texts.back().size());
  }
  NpyArray array;
  array.type_ = NpyType::kText;
  array.item_size_ = 4 * longest;
  RequireCount(CountValues(shape, array.item_size_), values.size());
  array.shape_ = std::move(shape);
  array.size_ = values.size();
  for (std::u32string& text : texts) {
    text.resize(longest, U'\0');
    array.data_.append(reinterpret_cast<const char*>(text.data()),
                       array.item_size_);
  }
  return array;
}

std::string NpyArray::Description() const {
  const std::size_t characters = type_ == NpyType::kText ? 4 : 1;
  return std::string(1, NpyTypeLetter(type_)) +
         std::to_string(item_size_ / characters) + " " + NpyShapeText(shape_);
}

std::vector<double> NpyArray::ToDoubles(const std::string& what) const {
  if (!IsNumeric(type_)) {
    throw InputError(what + " is text (" + Description() +
                     "): expected numbers");
  }
  std::vector<double> out(size_);
  VisitType(type_, item_size_, [&]<typename T>(T) {
    for (std::size_t i = 0; i < size_; ++i) {
      out[i] = static_cast<double>(Load<T>(data_.data() + i * sizeof(T)));
    }
  });
  return out;
}

std::vector<std::int64_t> NpyArray::ToIntegers(const std::string& what) const {
  if (!IsNumeric(type_) || type_ == NpyType::kFloat) {
    throw InputError(what + " is " + Description() +
                     ": expected whole numbers (i1 to i8, u1 to u8)");
  }
  std::vector<std::int64_t> out(size_);
  VisitType(type_, item_size_, [&]<typename T>(T) {
    if constexpr (std::is_integral_v<T>) {
      for (std::size_t i = 0; i < size_; ++i) {
        const T value = Load<T>(data_.data() + i * sizeof(T));
        out[i] = static_cast<std::int64_t>(value);
        if (std::is_unsigned_v<T> && out[i] < 0) {
          throw InputError(what + " holds " + std::to_string(value) +
                           ": expected whole numbers below 2^63");
        }
      }
    }
  });
  return out;
}

std::vector<std::string> NpyArray::ToStrings(const std::string& what) const {
  if (IsNumeric(type_)) {
    throw InputError(what + " is " + Description() + ": expected text");
  }
  std::vector<std::string> out(size_);
  for (std::size_t i = 0; i < size_; ++i) {
    out[i] = StringAt(data_.data() + i * item_size_, type_, item_size_);
  }
  return out;
}

NpyArray ParseNpy(std::string_view bytes, const std::string& name) {
  const NpyHeader header = ParseNpyHeader(bytes, name);
  const std::string_view data = bytes.substr(header.size);
  const std::int64_t count = CountValues(header.shape, header.item_size);
  if (count < 0 || count * header.item_size != data.size()) {
    throw InputError(name + ": array " + NpyShapeText(header.shape) + " of " +
                     std::to_string(header.item_size) +
                     "-byte values does not match the " +
                     std::to_string(data.size()) + " bytes of data there");
  }
  NpyArray array;
  array.type_ = header.type;
  array.item_size_ = header.item_size;
  array.shape_ = header.shape;
  array.size_ = static_cast<std::size_t>(count);
  array.data_ = header.fortran_order && header.shape.size() > 1
                    ? FromFortranOrder(data, header.shape, header.item_size)
                    : std::string(data);
  if (header.big_endian && header.type != NpyType::kBytes) {
    const std::size_t unit =
        header.type == NpyType::kText ? 4 : header.item_size;
    SwapBytes(unit, &array.data_);
  }
  return array;
}

NpyArray ReadNpy(const std::string& path) {
  return ParseNpy(ReadFileBytes(path), path);
}

std::string FormatNpy(const NpyArray& array) {
  return FormatNpyHeader(array.type(), array.item_size(), array.shape()) +
         array.data_;
}

void WriteNpy(const std::string& path, const NpyArray& array) {
  WriteFileBytes(path, FormatNpy(array));
}

}  // namespace invsim
