// SPDX-License-Identifier: Apache-2.0
#include "mend_zip.h"

#include <zlib.h>

#include <cstdint>
#include <string_view>

namespace invsim {
namespace {

constexpr std::string_view kEntry("PK\x01\x02", 4);
constexpr std::string_view kHeader("PK\x03\x04", 4);
constexpr std::size_t kEntrySize = 46;
constexpr std::size_t kHeaderSize = 30;

std::size_t Number(std::string_view bytes, std::size_t at, int size) {
  std::size_t value = 0;
  for (int i = size; i-- > 0;) {
    value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  }
  return value;
}

// The stored bytes of the member with the directory entry at `at`; none if
// they are not where it says.
std::string_view Member(std::string_view bytes, std::size_t at) {
  if (Number(bytes, at + 10, 2) != 0) return {};  // not stored
  const std::size_t size = Number(bytes, at + 20, 4);
  const std::size_t header = Number(bytes, at + 42, 4);
  if (header + kHeaderSize > bytes.size() ||
      bytes.substr(header, 4) != kHeader) {
    return {};
  }
  const std::size_t data = header + kHeaderSize +
                           Number(bytes, header + 26, 2) +
                           Number(bytes, header + 28, 2);
  if (data > bytes.size() || size > bytes.size() - data) return {};
  return bytes.substr(data, size);
}

}  // namespace

void MendZip(std::string* bytes) {
  for (std::size_t at = bytes->find(kEntry);
       at != std::string::npos && at + kEntrySize <= bytes->size();
       at = bytes->find(kEntry, at + 4)) {
    const std::string_view member = Member(*bytes, at);
    if (member.empty()) continue;
    const std::uint32_t crc = static_cast<std::uint32_t>(crc32_z(
        0, reinterpret_cast<const Bytef*>(member.data()), member.size()));
    for (int i = 0; i < 4; ++i) {
      (*bytes)[at + 16 + i] = static_cast<char>(crc >> (8 * i) & 0xff);
    }
  }
}

}  // namespace invsim
