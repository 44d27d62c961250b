// SPDX-License-Identifier: Apache-2.0
#include "invsim/io/ply_body.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "invsim/base/error.h"
#include "invsim/io/text_scanner.h"

namespace invsim {
namespace {

static_assert(std::endian::native == std::endian::little);

// What both formats share: knowing where they are.
class PlaceOfBody : public PlyBody {
 public:
  explicit PlaceOfBody(const std::string& name) : name_(name) {}

  void BeginElement(const PlyElementHeader& element) override {
    element_ = &element;
    row_ = -1;
  }
  void BeginRow() override { ++row_; }

  [[noreturn]] void Fail(const std::string& value,
                         const std::string& expectation) const override {
    throw InputError(name_ + ": element " + Quoted(element_->name) + " row " +
                     std::to_string(row_) + " (from 0) of " +
                     std::to_string(element_->count) + ": " + value + ": " +
                     expectation);
  }

 protected:
  [[noreturn]] void FailShort(std::int64_t bytes_left,
                              std::int64_t smallest_row) const {
    throw InputError(name_ + ": " + std::to_string(bytes_left) +
                     " bytes left: expected " +
                     std::to_string(element_->count) + " rows of at least " +
                     std::to_string(smallest_row) + " bytes of element " +
                     Quoted(element_->name));
  }

  const std::string& name_;

 private:
  const PlyElementHeader* element_ = nullptr;
  std::int64_t row_ = -1;
};

class AsciiBody : public PlaceOfBody {
 public:
  AsciiBody(std::string_view bytes,
            const PlyHeader& header,
            const std::string& name)
      : PlaceOfBody(name),
        size_(static_cast<std::int64_t>(bytes.size())),
        scanner_(bytes, name, 0, 0, header.num_lines + 1) {}

  void BeginElement(const PlyElementHeader& element) override {
    PlaceOfBody::BeginElement(element);
    // A value takes a digit and what parts it from the next, but for the last.
    const auto row = 2 * static_cast<std::int64_t>(element.properties.size());
    if (row > 0 && element.count > (size_ + 1) / row) FailShort(size_, row);
  }
  void BeginRow() override {
    PlaceOfBody::BeginRow();
    if (!scanner_.NextLine()) Fail("the file ends", "expected a line");
  }
  double Real(PlyType type, const std::string& name) override {
    if (IsInteger(type)) return static_cast<double>(Integer(type, name));
    const std::string_view word = scanner_.Word();
    const double value = scanner_.ToNumber(word, name.c_str());
    if (type == PlyType::kFloat32 && std::isfinite(value) &&
        std::abs(value) > std::numeric_limits<float>::max()) {
      FailRange(word, type, name);
    }
    return value;
  }
  std::int64_t Integer(PlyType type, const std::string& name) override {
    const std::string_view word = scanner_.Word();
    const std::int64_t value = scanner_.ToInteger(word, name.c_str());
    const bool is_signed = type == PlyType::kInt8 || type == PlyType::kInt16 ||
                           type == PlyType::kInt32;
    const int bits = 8 * PlySize(type) - (is_signed ? 1 : 0);
    const std::int64_t limit = std::int64_t{1} << bits;
    if (value >= limit || value < (is_signed ? -limit : 0)) {
      FailRange(word, type, name);
    }
    return value;
  }
  void EndRow() override { scanner_.EndRow(); }
  void Finish() override {
    if (!scanner_.NextLine()) return;
    scanner_.Fail(Quoted(scanner_.Word()), "expected the end of the file");
  }

 private:
  [[noreturn]] void FailRange(std::string_view word,
                              PlyType type,
                              const std::string& name) const {
    scanner_.Fail(
        Quoted(word),
        std::string("expected a ") + PlyName(type) + " (" + name + ")");
  }

  std::int64_t size_;
  TextScanner scanner_;
};

class BinaryBody : public PlaceOfBody {
 public:
  BinaryBody(std::string_view bytes,
             const PlyHeader& header,
             const std::string& name)
      : PlaceOfBody(name),
        at_(bytes.data()),
        end_(bytes.data() + bytes.size()),
        swap_(header.format == PlyFormat::kBinaryBigEndian) {}

  void BeginElement(const PlyElementHeader& element) override {
    PlaceOfBody::BeginElement(element);
    const std::int64_t row = element.SmallestRow();
    if (row > 0 && element.count > left() / row) FailShort(left(), row);
  }
  double Real(PlyType type, const std::string& name) override {
    if (type == PlyType::kFloat32) return Take<float>();
    if (type == PlyType::kFloat64) return Take<double>();
    return static_cast<double>(Integer(type, name));
  }
  std::int64_t Integer(PlyType type, const std::string&) override {
    switch (type) {
      case PlyType::kInt8:
        return Take<std::int8_t>();
      case PlyType::kUint8:
        return Take<std::uint8_t>();
      case PlyType::kInt16:
        return Take<std::int16_t>();
      case PlyType::kUint16:
        return Take<std::uint16_t>();
      case PlyType::kInt32:
        return Take<std::int32_t>();
      default:
        return Take<std::uint32_t>();
    }
  }
  void EndRow() override {}
  void Finish() override {
    if (left() == 0) return;
    throw InputError(name_ + ": " + std::to_string(left()) +
                     " bytes after the last element: expected none");
  }

 private:
  std::int64_t left() const { return end_ - at_; }

  template <typename T>
  T Take() {
    constexpr std::size_t kSize = sizeof(T);
    if (left() < static_cast<std::int64_t>(kSize)) {
      Fail(std::to_string(left()) + " bytes left",
           "expected " + std::to_string(kSize) + " or more");
    }
    char bytes[kSize];
    std::memcpy(bytes, at_, kSize);
    at_ += kSize;
    if (swap_) std::reverse(bytes, bytes + kSize);
    T value;
    std::memcpy(&value, bytes, kSize);
    return value;
  }

  const char* at_;
  const char* end_;
  bool swap_;
};

}  // namespace

std::unique_ptr<PlyBody> OpenPlyBody(std::string_view bytes,
                                     const PlyHeader& header,
                                     const std::string& name) {
  bytes.remove_prefix(header.size);
  if (header.format == PlyFormat::kAscii) {
    return std::make_unique<AsciiBody>(bytes, header, name);
  }
  return std::make_unique<BinaryBody>(bytes, header, name);
}

}  // namespace invsim
