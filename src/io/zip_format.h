// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SRC_IO_ZIP_FORMAT_H_
#define INVSIM_SRC_IO_ZIP_FORMAT_H_

// What the reader and the writer of zip archives share.

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <string_view>

namespace invsim {

inline constexpr std::uint32_t kLocalHeader = 0x04034b50;
inline constexpr std::uint32_t kDirectoryEntry = 0x02014b50;
inline constexpr std::uint32_t kEndOfDirectory = 0x06054b50;
inline constexpr std::uint32_t kZip64End = 0x06064b50;
inline constexpr std::uint32_t kZip64Locator = 0x07064b50;
inline constexpr std::uint16_t kZip64Extra = 0x0001;
inline constexpr int kStored = 0;
inline constexpr int kDeflated = 8;
inline constexpr std::uint64_t kMax32 = 0xffffffff;
inline constexpr std::uint64_t kMax16 = 0xffff;

inline std::uint32_t Crc(std::string_view bytes) {
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

// zlib counts in 32 bits; longer buffers go in pieces.
inline uInt Piece(std::uint64_t left) {
  return static_cast<uInt>(std::min<std::uint64_t>(left, 1u << 30));
}

inline Bytef* MutableBytes(std::string_view bytes) {
  return reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
}

}  // namespace invsim

#endif  // INVSIM_SRC_IO_ZIP_FORMAT_H_
