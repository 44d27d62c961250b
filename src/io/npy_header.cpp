// SPDX-License-Identifier: Apache-2.0
#include "npy_header.h"

#include <algorithm>
#include <charconv>

#include "invsim/base/error.h"
#include "invsim/io/text_scanner.h"

namespace invsim {
namespace {

constexpr std::string_view kNpyMagic("\x93NUMPY", 6);
// NumPy refuses to evaluate longer heads too.
constexpr std::size_t kLongestHeader = 10000;
constexpr std::size_t kMostDimensions = 64;

// A reader of the one Python literal a head consists of.
class LiteralReader {
 public:
  LiteralReader(std::string_view text, const std::string& name)
      : text_(text), name_(name) {}

  bool TryTake(char c) {
    SkipSpace();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  void Expect(char c) {
    if (!TryTake(c)) Fail();
  }
  std::string_view String() {
    SkipSpace();
    if (at_ >= text_.size() || (text_[at_] != '\'' && text_[at_] != '"')) {
      Fail();
    }
    const char quote = text_[at_++];
    const std::size_t end = text_.find(quote, at_);
    if (end == std::string_view::npos) Fail();
    const std::string_view value = text_.substr(at_, end - at_);
    at_ = end + 1;
    return value;
  }
  bool Bool() {
    SkipSpace();
    for (const bool value : {false, true}) {
      const std::string_view word = value ? "True" : "False";
      if (text_.substr(at_, word.size()) == word) {
        at_ += word.size();
        return value;
      }
    }
    Fail();
  }
  NpyArray::Shape Tuple() {
    NpyArray::Shape values;
    Expect('(');
    while (!TryTake(')')) {
      SkipSpace();
      std::int64_t value = 0;
      const char* const begin = text_.data() + at_;
      const auto [end, error] =
          std::from_chars(begin, text_.data() + text_.size(), value);
      if (error != std::errc() || value < 0) Fail();
      at_ += end - begin;
      TryTake('L');  // as Python 2 wrote long numbers
      if (values.size() == kMostDimensions) {
        throw InputError(name_ + ": array of more than " +
                         std::to_string(kMostDimensions) +
                         " dimensions: expected at most as many as NumPy's");
      }
      values.push_back(value);
      if (!TryTake(',')) {
        Expect(')');
        break;
      }
    }
    return values;
  }
  [[noreturn]] void Fail() const {
    throw InputError(name_ + ": damaged npy header at character " +
                     std::to_string(at_));
  }
  bool NextIs(char c) {
    SkipSpace();
    return at_ < text_.size() && text_[at_] == c;
  }

 private:
  void SkipSpace() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\n')) {
      ++at_;
    }
  }

  std::string_view text_;
  std::size_t at_ = 0;
  const std::string& name_;
};

void ParseType(std::string_view descr,
               const std::string& name,
               NpyHeader* header) {
  if (descr.find('O') != std::string_view::npos) {
    throw InputError(name +
                     ": holds Python objects (a pickle, which runs code when "
                     "read): expected plain numbers or text; " +
                     kPickleRemedy);
  }
  const auto unknown = [&]() {
    return InputError(name + ": array type " + Quoted(descr) +
                      " is not supported: expected bool, i1 to i8, u1 to u8, "
                      "f2 to f8, S or U");
  };
  if (descr.size() < 3) throw unknown();
  header->big_endian = descr[0] == '>';
  std::size_t count = 0;
  const char* const end = descr.data() + descr.size();
  const auto [last, error] = std::from_chars(descr.data() + 2, end, count);
  if (error != std::errc() || last != end) throw unknown();
  // Longer values are damage; values of no size would let a shape of any
  // length pass for an empty file.
  if (count == 0 || count > (std::size_t{1} << 31)) throw unknown();
  const bool power = count == 1 || count == 2 || count == 4 || count == 8;
  switch (descr[1]) {
    case 'b':
      header->type = NpyType::kBool;
      if (count != 1) throw unknown();
      break;
    case 'i':
      header->type = NpyType::kInt;
      if (!power) throw unknown();
      break;
    case 'u':
      header->type = NpyType::kUint;
      if (!power) throw unknown();
      break;
    case 'f':
      header->type = NpyType::kFloat;
      if (!power || count == 1) throw unknown();
      break;
    case 'S':
      header->type = NpyType::kBytes;
      break;
    case 'U':
      header->type = NpyType::kText;
      count *= 4;
      break;
    default:
      throw unknown();
  }
  header->item_size = count;
}

// The text between the fixed head and the data; sets header->size.
std::string_view HeaderText(std::string_view bytes,
                            const std::string& name,
                            NpyHeader* header) {
  if (bytes.substr(0, kNpyMagic.size()) != kNpyMagic) {
    throw InputError(name + (bytes.empty() ? ": is empty: expected an npy array"
                                           : ": is not an npy array"));
  }
  const auto byte = [&](std::size_t i) {
    return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0u;
  };
  const unsigned version = byte(6);
  if (version < 1 || version > 3) {
    throw InputError(name + ": npy version " + std::to_string(version) +
                     " is not supported: expected 1 to 3");
  }
  const std::size_t start = version == 1 ? 10 : 12;
  std::size_t length = byte(8) | byte(9) << 8;
  if (version > 1) length |= std::size_t{byte(10)} << 16 | byte(11) << 24;
  if (bytes.size() < start || length > bytes.size() - start) {
    throw InputError(name + ": npy header is cut short");
  }
  if (length > kLongestHeader) {
    throw InputError(name + ": npy header of " + std::to_string(length) +
                     " bytes: expected at most " +
                     std::to_string(kLongestHeader));
  }
  header->size = start + length;
  return bytes.substr(start, length);
}

}  // namespace

NpyHeader ParseNpyHeader(std::string_view bytes, const std::string& name) {
  NpyHeader header{};
  LiteralReader in(HeaderText(bytes, name, &header), name);
  bool has_type = false;
  bool has_order = false;
  bool has_shape = false;
  in.Expect('{');
  while (!in.TryTake('}')) {
    const std::string_view key = in.String();
    in.Expect(':');
    if (key == "descr") {
      if (in.NextIs('[')) {
        throw InputError(name +
                         ": structured arrays are not supported: "
                         "expected plain numbers or text");
      }
      ParseType(in.String(), name, &header);
      has_type = true;
    } else if (key == "fortran_order") {
      header.fortran_order = in.Bool();
      has_order = true;
    } else if (key == "shape") {
      header.shape = in.Tuple();
      has_shape = true;
    } else {
      in.Fail();
    }
    if (!in.TryTake(',')) {
      in.Expect('}');
      break;
    }
  }
  if (!has_type || !has_order || !has_shape) in.Fail();
  return header;
}

char NpyTypeLetter(NpyType type) {
  switch (type) {
    case NpyType::kBool:
      return 'b';
    case NpyType::kInt:
      return 'i';
    case NpyType::kUint:
      return 'u';
    case NpyType::kFloat:
      return 'f';
    case NpyType::kBytes:
      return 'S';
    case NpyType::kText:
      return 'U';
  }
  return '?';
}

std::string NpyShapeText(const NpyArray::Shape& shape) {
  std::string text = "(";
  for (std::size_t i = 0; i < shape.size(); ++i) {
    text += (i == 0 ? "" : " ") + std::to_string(shape[i]);
    if (i + 1 < shape.size() || shape.size() == 1) text += ",";
  }
  return text + ")";
}

std::string FormatNpyHeader(NpyType type,
                            std::size_t item_size,
                            const NpyArray::Shape& shape) {
  const bool no_order = item_size == 1 || type == NpyType::kBytes;
  const std::size_t count = type == NpyType::kText ? item_size / 4 : item_size;
  std::string text = "{'descr': '";
  text += no_order ? '|' : '<';
  text += NpyTypeLetter(type) + std::to_string(count);
  text += "', 'fortran_order': False, 'shape': " + NpyShapeText(shape) + ", }";
  // The data start at a multiple of 64 bytes, after a newline.
  constexpr std::size_t kFixed = 10;
  text.append(63 - (kFixed + text.size()) % 64, ' ');
  text += '\n';
  std::string head(kNpyMagic);
  head += {1, 0};
  head += static_cast<char>(text.size() & 0xff);
  head += static_cast<char>(text.size() >> 8);
  return head + text;
}

}  // namespace invsim
