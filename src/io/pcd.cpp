// SPDX-License-Identifier: Apache-2.0
#include "invsim/io/pcd.h"

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include "invsim/base/error.h"
#include "invsim/io/lzf.h"
#include "invsim/io/text_scanner.h"

namespace invsim {
namespace {

static_assert(std::endian::native == std::endian::little);

struct Field {
  std::string name;
  char type = 'F';  // I, U or F
  std::int64_t size = 4;
  std::int64_t count = 1;

  std::int64_t bytes() const { return size * count; }
  // Padding: in the rows of `binary`, not in the blocks of the compressed.
  bool is_padding() const { return name == "_"; }
};

// One value of type `kind` ('I', 'U' or 'F') and `size` bytes.
double Value(const char* bytes, char kind, std::int64_t size) {
  const auto as = [bytes](auto value) {
    std::memcpy(&value, bytes, sizeof(value));
    return static_cast<double>(value);
  };
  if (kind == 'F') return size == 4 ? as(float{}) : as(double{});
  const bool is_signed = kind == 'I';
  switch (size) {
    case 1:
      return is_signed ? as(std::int8_t{}) : as(std::uint8_t{});
    case 2:
      return is_signed ? as(std::int16_t{}) : as(std::uint16_t{});
    case 4:
      return is_signed ? as(std::int32_t{}) : as(std::uint32_t{});
    default:
      return is_signed ? as(std::int64_t{}) : as(std::uint64_t{});
  }
}

class PcdParser {
 public:
  PcdParser(std::string_view bytes, const std::string& name)
      : name_(name), scanner_(bytes, name, '#') {}

  Points Parse() {
    const std::string format = ParseHeader();
    FindAxes();
    if (format == "ascii") return ParseAscii();
    if (format == "binary") return ParseBinary();
    if (format == "binary_compressed") return ParseCompressed();
    scanner_.Fail(Quoted(format),
                  "expected ascii, binary or binary_compressed");
  }

 private:
  // Returns what follows DATA.
  std::string ParseHeader() {
    while (scanner_.NextLine()) {
      const std::string keyword(scanner_.Word());
      if (keyword == "FIELDS" || keyword == "COLUMNS") {
        ParseFields();
      } else if (keyword == "SIZE") {
        for (Field& field : fields_) field.size = Whole(keyword, 8);
      } else if (keyword == "TYPE") {
        for (Field& field : fields_) field.type = Type();
      } else if (keyword == "COUNT") {
        for (Field& field : fields_) field.count = Whole(keyword, kMost);
      } else if (keyword == "WIDTH") {
        width_ = Whole(keyword, kMost);
      } else if (keyword == "HEIGHT") {
        height_ = Whole(keyword, kMost);
      } else if (keyword == "POINTS") {
        points_ = Whole(keyword, kMost);
      } else if (keyword == "DATA") {
        const std::string format(scanner_.Word());
        scanner_.EndRow();
        return format;
      } else if (keyword == "VERSION" || keyword == "VIEWPOINT") {
        continue;
      } else {
        scanner_.Fail(Quoted(keyword), "expected a line of a PCD header");
      }
      scanner_.EndRow();
    }
    throw InputError(name_ + ": no line DATA: expected a PCD file");
  }

  void ParseFields() {
    fields_.clear();
    while (true) {
      const std::string_view word = scanner_.Word();
      if (word.empty()) break;
      if (fields_.size() >= 1000) {
        scanner_.Fail("field " + Quoted(word), "expected at most 1000");
      }
      fields_.push_back({std::string(word)});
    }
  }

  std::int64_t Whole(const std::string& keyword, std::int64_t most) {
    const std::string_view word = scanner_.Word();
    const std::int64_t value = scanner_.ToInteger(word, keyword.c_str());
    if (value < 0 || value > most) {
      scanner_.Fail(Quoted(word), "expected 0 to " + std::to_string(most));
    }
    return value;
  }

  char Type() {
    const std::string_view word = scanner_.Word();
    if (word != "I" && word != "U" && word != "F") {
      scanner_.Fail(Quoted(word), "expected a TYPE I, U or F for each field");
    }
    return word[0];
  }

  void FindAxes() {
    if (height_ < 0) height_ = 1;
    if (points_ < 0) points_ = width_ * height_;
    if (width_ < 0) width_ = points_;
    if (points_ < 0 || width_ * height_ != points_) {
      throw InputError(name_ + ": POINTS " + std::to_string(points_) +
                       ": expected WIDTH " + std::to_string(width_) +
                       " times HEIGHT " + std::to_string(height_));
    }
    for (int axis = 0; axis < 3; ++axis) {
      const std::string wanted(1, static_cast<char>('x' + axis));
      axes_[axis] = -1;
      for (std::size_t i = 0; i < fields_.size(); ++i) {
        if (fields_[i].name == wanted) axes_[axis] = static_cast<int>(i);
      }
      if (axes_[axis] < 0) {
        throw InputError(name_ + ": no field " + wanted +
                         ": expected FIELDS x y z");
      }
      const Field& field = fields_[axes_[axis]];
      const bool readable =
          field.type == 'F'
              ? field.size == 4 || field.size == 8
              : std::has_single_bit(static_cast<std::uint64_t>(field.size));
      if (field.count != 1 || !readable) {
        throw InputError(name_ + ": field " + wanted + " of type " +
                         field.type + ", size " + std::to_string(field.size) +
                         ", count " + std::to_string(field.count) +
                         ": expected one number");
      }
    }
  }

  Points ParseAscii() {
    std::int64_t words = 0;
    for (const Field& field : fields_) words += field.count;
    const auto left = static_cast<std::int64_t>(scanner_.Rest().size());
    if (points_ > (left + 1) / (2 * words)) FailShort(left, 2 * words);
    Points points(3, points_);
    for (std::int64_t row = 0; row < points_; ++row) {
      if (!scanner_.NextLine()) {
        throw InputError(name_ + ": " + std::to_string(row) +
                         " points: expected POINTS " + std::to_string(points_));
      }
      ParseAsciiRow(points.col(row));
    }
    if (scanner_.NextLine()) {
      scanner_.Fail(Quoted(scanner_.Word()), "expected the end of the file");
    }
    return points;
  }

  void ParseAsciiRow(Eigen::Ref<Vector3d> point) {
    for (int i = 0; i < static_cast<int>(fields_.size()); ++i) {
      for (std::int64_t c = 0; c < fields_[i].count; ++c) {
        const std::string_view word = scanner_.Word();
        const double value = scanner_.ToNumber(word, fields_[i].name.c_str());
        for (int axis = 0; axis < 3; ++axis) {
          if (axes_[axis] == i) point[axis] = value;
        }
      }
    }
    scanner_.EndRow();
  }

  // Rows of all fields, one after the other.
  Points ParseBinary() {
    const std::string_view data = scanner_.Rest();
    std::int64_t row_size = 0;
    std::array<std::int64_t, 3> offsets = {};
    for (int i = 0; i < static_cast<int>(fields_.size()); ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        if (axes_[axis] == i) offsets[axis] = row_size;
      }
      row_size += fields_[i].bytes();
    }
    const auto left = static_cast<std::int64_t>(data.size());
    if (points_ > left / row_size) FailShort(left, row_size);
    return Gather(data, offsets, {row_size, row_size, row_size});
  }

  // Two sizes, then the packed blocks: all x, all y, ...
  Points ParseCompressed() {
    const std::string_view data = scanner_.Rest();
    std::array<std::uint32_t, 2> sizes = {};
    if (data.size() < sizeof(sizes)) {
      throw InputError(name_ + ": " + std::to_string(data.size()) +
                       " bytes after the header: expected 8 or more");
    }
    std::memcpy(sizes.data(), data.data(), sizeof(sizes));
    const std::string_view packed = data.substr(sizeof(sizes));
    if (packed.size() < sizes[0]) {
      throw InputError(name_ + ": " + std::to_string(packed.size()) +
                       " compressed bytes: expected " +
                       std::to_string(sizes[0]));
    }
    std::int64_t row_size = 0;
    for (const Field& field : fields_) {
      if (!field.is_padding()) row_size += field.bytes();
    }
    if (points_ > sizes[1] / row_size || points_ * row_size != sizes[1]) {
      throw InputError(name_ + ": " + std::to_string(sizes[1]) +
                       " uncompressed bytes: expected " +
                       std::to_string(points_) + " points of " +
                       std::to_string(row_size));
    }
    const std::optional<std::string> blocks =
        UnpackLzf(packed.substr(0, sizes[0]), sizes[1]);
    if (!blocks) {
      throw InputError(name_ + ": damaged compressed block: expected LZF of " +
                       std::to_string(sizes[1]) + " bytes");
    }
    return GatherBlocks(*blocks);
  }

  Points GatherBlocks(const std::string& blocks) const {
    std::array<std::int64_t, 3> offsets = {};
    std::array<std::int64_t, 3> strides = {};
    std::int64_t offset = 0;
    for (int i = 0; i < static_cast<int>(fields_.size()); ++i) {
      if (fields_[i].is_padding()) continue;
      for (int axis = 0; axis < 3; ++axis) {
        if (axes_[axis] != i) continue;
        offsets[axis] = offset;
        strides[axis] = fields_[i].size;
      }
      offset += fields_[i].bytes() * points_;
    }
    return Gather(blocks, offsets, strides);
  }

  Points Gather(std::string_view data,
                const std::array<std::int64_t, 3>& offsets,
                const std::array<std::int64_t, 3>& strides) const {
    Points points(3, points_);
    for (int axis = 0; axis < 3; ++axis) {
      const Field& field = fields_[axes_[axis]];
      for (std::int64_t i = 0; i < points_; ++i) {
        // Of no points there may be no data to point into.
        const char* at = data.data() + offsets[axis] + i * strides[axis];
        points(axis, i) = Value(at, field.type, field.size);
      }
    }
    return points;
  }

  [[noreturn]] void FailShort(std::int64_t left, std::int64_t row) const {
    throw InputError(name_ + ": " + std::to_string(left) +
                     " bytes after the header: expected " +
                     std::to_string(points_) + " points of " +
                     std::to_string(row) + " bytes or more");
  }

  static constexpr std::int64_t kMost = std::numeric_limits<int>::max();

  const std::string& name_;
  TextScanner scanner_;
  std::vector<Field> fields_;
  std::int64_t width_ = -1;
  std::int64_t height_ = -1;
  std::int64_t points_ = -1;
  std::array<int, 3> axes_ = {};  // the fields that are x, y and z
};

}  // namespace

Points ParsePcd(std::string_view bytes, const std::string& name) {
  return PcdParser(bytes, name).Parse();
}

}  // namespace invsim
