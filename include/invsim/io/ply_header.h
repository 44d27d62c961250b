// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_IO_PLY_HEADER_H_
#define INVSIM_IO_PLY_HEADER_H_

// What a PLY file says it holds: a format and a list of elements (vertex,
// face, ...), each with a count and properties. A property is one number, or
// a list: its length, then that many numbers.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace invsim {

enum class PlyFormat { kAscii, kBinaryLittleEndian, kBinaryBigEndian };

enum class PlyType {
  kInt8,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kFloat32,
  kFloat64,
};

// Bytes of one value.
int PlySize(PlyType type);
// The name written: char uchar short ushort int uint float double.
const char* PlyName(PlyType type);
bool IsInteger(PlyType type);
// Whether a property may be called so: no blanks, no controls.
bool IsPlyWord(std::string_view name);

struct PlyPropertyHeader {
  std::string name;
  PlyType type;  // of the value, or of the list's items
  bool is_list = false;
  PlyType count_type = PlyType::kUint8;  // of a list's length
};

struct PlyElementHeader {
  std::string name;
  std::int64_t count = 0;  // as stated; not to be trusted
  std::vector<PlyPropertyHeader> properties;

  // The place of a property in a row; -1 if there is none of that name.
  int Find(std::string_view property) const;
  // Bytes of a row of a binary file, all lists being empty.
  std::int64_t SmallestRow() const;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::kAscii;
  std::vector<PlyElementHeader> elements;
  std::size_t size = 0;  // bytes up to and with the end of `end_header`
  int num_lines = 0;     // lines up to and with `end_header`
};

// Lines end the way the first one does: \n, \r\n or \r. Comments and obj_info
// are passed over. Throws InputError naming file, line and value: not a PLY
// file, unknown format or type, a name used twice, no end_header.
PlyHeader ParsePlyHeader(std::string_view bytes, const std::string& name);

}  // namespace invsim

#endif  // INVSIM_IO_PLY_HEADER_H_
