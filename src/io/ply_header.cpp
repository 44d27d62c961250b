// SPDX-License-Identifier: Apache-2.0
#include "invsim/io/ply_header.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <sstream>

#include "invsim/base/error.h"
#include "invsim/io/text_scanner.h"

namespace invsim {
namespace {

struct TypeRow {
  PlyType type;
  int size;
  const char* name;
  const char* sized_name;  // the other spelling in use
};

constexpr std::array<TypeRow, 8> kTypes = {{
    {PlyType::kInt8, 1, "char", "int8"},
    {PlyType::kUint8, 1, "uchar", "uint8"},
    {PlyType::kInt16, 2, "short", "int16"},
    {PlyType::kUint16, 2, "ushort", "uint16"},
    {PlyType::kInt32, 4, "int", "int32"},
    {PlyType::kUint32, 4, "uint", "uint32"},
    {PlyType::kFloat32, 4, "float", "float32"},
    {PlyType::kFloat64, 8, "double", "float64"},
}};

const TypeRow& Row(PlyType type) {
  return kTypes[static_cast<std::size_t>(type)];
}

class HeaderParser {
 public:
  HeaderParser(std::string_view bytes, const std::string& name)
      : bytes_(bytes), name_(name) {}

  PlyHeader Parse() {
    ParseMagic();
    bool has_format = false;
    while (true) {
      NextLine();
      const std::string& keyword = words_.empty() ? line_ : words_[0];
      if (keyword.empty() || keyword == "comment" || keyword == "obj_info") {
        continue;
      }
      if (keyword == "format" && !has_format) {
        ParseFormat();
        has_format = true;
      } else if (!has_format) {
        Fail(Quoted(line_), "expected 'format ascii 1.0' or the like");
      } else if (keyword == "element") {
        ParseElement();
      } else if (keyword == "property") {
        ParseProperty();
      } else if (keyword == "end_header") {
        break;
      } else {
        Fail(Quoted(line_), "expected element, property or end_header");
      }
    }
    header_.size = at_;
    header_.num_lines = line_number_;
    return std::move(header_);
  }

 private:
  // The end of the first line settles how lines end: in a binary file the
  // byte after end_header's own end may look like one more.
  void ParseMagic() {
    if (bytes_.substr(0, 3) != "ply") {
      throw InputError(name_ + ": starts with " + Quoted(bytes_.substr(0, 3)) +
                       ": expected a PLY file");
    }
    const std::string_view end = bytes_.substr(3, 2);
    end_of_line_ = end == "\r\n"                         ? "\r\n"
                   : !end.empty() && end.front() == '\r' ? "\r"
                                                         : "\n";
    NextLine();
    if (words_.size() != 1 || words_[0] != "ply") {
      Fail(Quoted(line_), "expected 'ply' and the end of the line");
    }
  }

  void NextLine() {
    const std::size_t end = bytes_.find(end_of_line_, at_);
    if (end == std::string_view::npos) {
      throw InputError(name_ + ": " + std::to_string(bytes_.size()) +
                       " bytes without end_header: expected a whole PLY file");
    }
    ++line_number_;
    line_ = bytes_.substr(at_, end - at_);
    at_ = end + end_of_line_.size();
    std::istringstream stream(line_);
    words_.clear();
    for (std::string word; stream >> word;) words_.push_back(word);
    if (words_.empty()) line_.clear();
  }

  void ParseFormat() {
    const std::string format = words_.size() > 1 ? words_[1] : "";
    if (words_.size() != 3 || words_[2] != "1.0") {
      Fail(Quoted(line_), "expected 'format NAME 1.0'");
    }
    if (format == "ascii") {
      header_.format = PlyFormat::kAscii;
    } else if (format == "binary_little_endian") {
      header_.format = PlyFormat::kBinaryLittleEndian;
    } else if (format == "binary_big_endian") {
      header_.format = PlyFormat::kBinaryBigEndian;
    } else {
      Fail(Quoted(format),
           "expected ascii, binary_little_endian or binary_big_endian");
    }
  }

  void ParseElement() {
    PlyElementHeader element;
    if (words_.size() != 3) Fail(Quoted(line_), "expected 'element NAME N'");
    element.name = words_[1];
    const std::string& count = words_[2];
    const char* end = count.data() + count.size();
    const auto [stop, error] =
        std::from_chars(count.data(), end, element.count);
    if (error != std::errc() || stop != end || element.count < 0) {
      Fail(Quoted(count), "expected a count of 0 or more");
    }
    CheckNumber(header_.elements.size());
    for (const PlyElementHeader& other : header_.elements) {
      if (other.name == element.name) {
        Fail(Quoted(line_), "expected each element once");
      }
    }
    header_.elements.push_back(std::move(element));
  }

  void ParseProperty() {
    if (header_.elements.empty()) {
      Fail(Quoted(line_), "expected an element before its properties");
    }
    PlyElementHeader& element = header_.elements.back();
    PlyPropertyHeader property;
    property.is_list = words_.size() > 1 && words_[1] == "list";
    if (words_.size() != (property.is_list ? 5 : 3)) {
      Fail(Quoted(line_),
           "expected 'property TYPE NAME' or 'property list TYPE TYPE NAME'");
    }
    CheckNumber(element.properties.size());
    property.name = words_.back();
    property.type = ToType(words_[words_.size() - 2]);
    if (property.is_list) {
      property.count_type = ToType(words_[2]);
      if (!IsInteger(property.count_type)) {
        Fail(Quoted(words_[2]), "expected an integer type for a list's length");
      }
    }
    if (!IsPlyWord(property.name)) {
      Fail(Quoted(property.name), "expected a name without control characters");
    }
    if (element.Find(property.name) >= 0) {
      Fail(Quoted(property.name), "expected each property of an element once");
    }
    element.properties.push_back(std::move(property));
  }

  // Far beyond any real file; keeps the search for doubles short.
  void CheckNumber(std::size_t number) const {
    constexpr std::size_t kMost = 1000;
    if (number >= kMost) {
      Fail(Quoted(line_), "expected at most 1000 of a kind");
    }
  }

  PlyType ToType(const std::string& word) const {
    for (const TypeRow& row : kTypes) {
      if (word == row.name || word == row.sized_name) return row.type;
    }
    Fail(Quoted(word),
         "expected a type: char uchar short ushort int uint float double");
  }

  [[noreturn]] void Fail(const std::string& value,
                         const std::string& expectation) const {
    throw InputError(name_ + ":" + std::to_string(line_number_) + ": " + value +
                     ": " + expectation);
  }

  std::string_view bytes_;
  const std::string& name_;
  std::string_view end_of_line_ = "\n";
  std::size_t at_ = 0;
  int line_number_ = 0;
  std::string line_;
  std::vector<std::string> words_;
  PlyHeader header_;
};

}  // namespace

int PlySize(PlyType type) { return Row(type).size; }

const char* PlyName(PlyType type) { return Row(type).name; }

bool IsInteger(PlyType type) {
  return type != PlyType::kFloat32 && type != PlyType::kFloat64;
}

bool IsPlyWord(std::string_view name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return static_cast<unsigned char>(c) > ' ' && c != 0x7f;
  });
}

int PlyElementHeader::Find(std::string_view property) const {
  for (std::size_t i = 0; i < properties.size(); ++i) {
    if (properties[i].name == property) return static_cast<int>(i);
  }
  return -1;
}

std::int64_t PlyElementHeader::SmallestRow() const {
  std::int64_t size = 0;
  for (const PlyPropertyHeader& property : properties) {
    size += PlySize(property.is_list ? property.count_type : property.type);
  }
  return size;
}

PlyHeader ParsePlyHeader(std::string_view bytes, const std::string& name) {
  return HeaderParser(bytes, name).Parse();
}

}  // namespace invsim
