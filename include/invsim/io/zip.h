// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_IO_ZIP_H_
#define INVSIM_IO_ZIP_H_

// Reading zip archives, as much as an npz needs (PKWARE APPNOTE 6.3): members
// stored or deflated, 64-bit sizes and offsets, no encryption, one file. Sizes
// come from the central directory and are believed only as far as the bytes at
// hand can bear them out; every member's CRC-32 is checked.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace invsim {

class ZipArchive {
 public:
  // Keeps the bytes; `name` is the file named in errors. Throws InputError.
  static ZipArchive Parse(std::string bytes, const std::string& name);

  // In the order of the archive's directory.
  std::vector<std::string> Names() const;
  bool Has(const std::string& member) const;
  // The unpacked bytes of a member. Throws InputError if there is no such
  // member, its packing is unknown, it is damaged, or its CRC-32 is wrong.
  std::string Extract(const std::string& member) const;

 private:
  struct Entry {
    std::string name;
    int flags = 0;
    int method = 0;
    std::uint32_t crc = 0;
    std::uint64_t packed_size = 0;
    std::uint64_t size = 0;
    std::uint64_t header_offset = 0;
  };
  const Entry* Find(const std::string& member) const;
  std::string_view PackedBytes(const Entry& entry) const;

  std::string bytes_;
  std::string name_;
  std::vector<Entry> entries_;
};

}  // namespace invsim

#endif  // INVSIM_IO_ZIP_H_
