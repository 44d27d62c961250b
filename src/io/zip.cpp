// SPDX-License-Identifier: Apache-2.0
#include "invsim/io/zip.h"

#include <zlib.h>

#include <algorithm>
#include <optional>
#include <unordered_set>

#include "invsim/base/error.h"
#include "invsim/io/text_scanner.h"
#include "zip_format.h"

namespace invsim {
namespace {

constexpr std::size_t kEndOfDirectorySize = 22;
constexpr std::size_t kZip64LocatorSize = 20;
constexpr int kEncryptedFlag = 1;
// Deflate packs at most 258 bytes into 2 bits; a larger claim is a lie.
constexpr std::uint64_t kLargestRatio = 1032;

// Little-endian numbers from a piece of the file; past its end is an error.
class Cursor {
 public:
  Cursor(std::string_view bytes, std::uint64_t offset, const std::string& name)
      : bytes_(bytes), offset_(offset), name_(name) {
    if (offset > bytes.size()) Truncated();
  }

  std::string_view Take(std::uint64_t count) {
    if (count > bytes_.size() - offset_) Truncated();
    const std::string_view piece = bytes_.substr(offset_, count);
    offset_ += count;
    return piece;
  }
  std::uint64_t Number(int size) {
    const std::string_view piece = Take(size);
    std::uint64_t value = 0;
    for (int i = size; i-- > 0;) {
      value = value << 8 | static_cast<unsigned char>(piece[i]);
    }
    return value;
  }
  std::uint64_t offset() const { return offset_; }

 private:
  [[noreturn]] void Truncated() const {
    throw InputError(
        name_ + ": zip archive is cut short or damaged at byte " +
        std::to_string(std::min<std::uint64_t>(offset_, bytes_.size())) +
        " of " + std::to_string(bytes_.size()));
  }

  std::string_view bytes_;
  std::uint64_t offset_;
  const std::string& name_;
};

struct Directory {
  std::uint64_t offset;
  std::uint64_t count;
};

// The end record is the last thing in the file but for a comment of at most
// 65535 bytes.
std::uint64_t FindEndOfDirectory(std::string_view bytes,
                                 const std::string& name) {
  const char signature[] = {'P', 'K', 5, 6};
  const std::size_t at = bytes.rfind(std::string_view(signature, 4));
  if (at == std::string_view::npos || bytes.size() - at < kEndOfDirectorySize) {
    throw InputError(name + (bytes.empty()
                                 ? ": is empty: expected a zip archive (npz)"
                                 : ": not a complete zip archive (npz): its "
                                   "directory is missing"));
  }
  return at;
}

Directory FindDirectory(std::string_view bytes, const std::string& name) {
  const std::uint64_t end = FindEndOfDirectory(bytes, name);
  Cursor in(bytes, end + 4, name);
  const std::uint64_t disk = in.Number(2);
  in.Take(4);
  Directory directory{};
  directory.count = in.Number(2);
  in.Take(4);
  directory.offset = in.Number(4);
  if (disk != 0 && disk != kMax16) {
    throw InputError(name + ": is a part of a split zip archive");
  }
  if (directory.count != kMax16 && directory.offset != kMax32) {
    return directory;
  }
  if (end < kZip64LocatorSize) return directory;
  Cursor locator(bytes, end - kZip64LocatorSize, name);
  if (locator.Number(4) != kZip64Locator) return directory;
  locator.Take(4);
  Cursor zip64(bytes, locator.Number(8), name);
  if (zip64.Number(4) != kZip64End) {
    throw InputError(name + ": damaged zip archive: no 64-bit end record");
  }
  zip64.Take(20);
  zip64.Take(8);  // entries on this disk
  directory.count = zip64.Number(8);
  zip64.Take(8);  // size of the directory
  directory.offset = zip64.Number(8);
  return directory;
}

// Replaces the sizes and the offset that do not fit 32 bits, in this order, by
// those of the zip64 extra field.
void ReadZip64Extra(std::string_view extra,
                    const std::string& name,
                    std::uint64_t* size,
                    std::uint64_t* packed_size,
                    std::uint64_t* offset) {
  Cursor in(extra, 0, name);
  while (extra.size() - in.offset() >= 4) {
    const std::uint64_t id = in.Number(2);
    const std::string_view field = in.Take(in.Number(2));
    if (id != kZip64Extra) continue;
    Cursor values(field, 0, name);
    for (std::uint64_t* value : {size, packed_size, offset}) {
      if (*value == kMax32) *value = values.Number(8);
    }
    return;
  }
}

// Raw deflate to exactly `size` bytes; nothing if that is not what it holds.
std::optional<std::string> Inflate(std::string_view packed,
                                   std::uint64_t size) {
  std::string out(size, '\0');
  z_stream stream{};
  if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) return std::nullopt;
  std::uint64_t in_done = 0;
  std::uint64_t out_done = 0;
  int status = Z_OK;
  do {
    stream.next_in = MutableBytes(packed) + in_done;
    stream.avail_in = Piece(packed.size() - in_done);
    stream.next_out = MutableBytes(out) + out_done;
    stream.avail_out = Piece(size - out_done);
    const uInt in_offered = stream.avail_in;
    const uInt out_offered = stream.avail_out;
    status = inflate(&stream, Z_NO_FLUSH);
    in_done += in_offered - stream.avail_in;
    out_done += out_offered - stream.avail_out;
  } while (status == Z_OK);
  inflateEnd(&stream);
  if (status != Z_STREAM_END || out_done != size) return std::nullopt;
  return out;
}

}  // namespace

ZipArchive ZipArchive::Parse(std::string bytes, const std::string& name) {
  ZipArchive archive;
  archive.bytes_ = std::move(bytes);
  archive.name_ = name;
  const Directory directory = FindDirectory(archive.bytes_, name);
  Cursor in(archive.bytes_, directory.offset, name);
  std::unordered_set<std::string> seen;
  for (std::uint64_t i = 0; i < directory.count; ++i) {
    if (in.Number(4) != kDirectoryEntry) {
      throw InputError(name + ": damaged zip archive: directory entry " +
                       std::to_string(i) + " of " +
                       std::to_string(directory.count) + " is missing");
    }
    Entry e;
    in.Take(4);
    e.flags = static_cast<int>(in.Number(2));
    e.method = static_cast<int>(in.Number(2));
    in.Take(4);
    e.crc = static_cast<std::uint32_t>(in.Number(4));
    e.packed_size = in.Number(4);
    e.size = in.Number(4);
    const std::uint64_t name_size = in.Number(2);
    const std::uint64_t extra_size = in.Number(2);
    const std::uint64_t comment_size = in.Number(2);
    in.Take(8);
    e.header_offset = in.Number(4);
    e.name = in.Take(name_size);
    ReadZip64Extra(
        in.Take(extra_size), name, &e.size, &e.packed_size, &e.header_offset);
    in.Take(comment_size);
    if (!seen.insert(e.name).second) {
      throw InputError(name + ": zip archive holds two members named " +
                       Quoted(e.name));
    }
    archive.entries_.push_back(std::move(e));
  }
  return archive;
}

std::vector<std::string> ZipArchive::Names() const {
  std::vector<std::string> names;
  for (const Entry& e : entries_) names.push_back(e.name);
  return names;
}

bool ZipArchive::Has(const std::string& member) const {
  return Find(member) != nullptr;
}

const ZipArchive::Entry* ZipArchive::Find(const std::string& member) const {
  const auto it =
      std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) {
        return e.name == member;
      });
  return it == entries_.end() ? nullptr : &*it;
}

// The local header repeats the name and may have other extra fields than the
// directory; only the lengths of these two matter.
std::string_view ZipArchive::PackedBytes(const Entry& entry) const {
  Cursor in(bytes_, entry.header_offset, name_);
  if (in.Number(4) != kLocalHeader) {
    throw InputError(name_ + ": damaged zip archive: no header of " +
                     Printable(entry.name));
  }
  in.Take(22);
  const std::uint64_t name_size = in.Number(2);
  const std::uint64_t extra_size = in.Number(2);
  in.Take(name_size);
  in.Take(extra_size);
  return in.Take(entry.packed_size);
}

std::string ZipArchive::Extract(const std::string& member) const {
  const Entry* entry = Find(member);
  if (!entry) throw InputError(name_ + ": has no member " + Printable(member));
  const std::string where = name_ + ": " + Printable(member) + ": ";
  if (entry->flags & kEncryptedFlag) {
    throw InputError(where + "is encrypted, which is not supported");
  }
  const std::string_view packed = PackedBytes(*entry);
  std::optional<std::string> bytes;
  if (entry->method == kStored) {
    if (entry->size == packed.size()) bytes = std::string(packed);
  } else if (entry->method == kDeflated) {
    if (entry->size / kLargestRatio <= packed.size()) {
      bytes = Inflate(packed, entry->size);
    }
  } else {
    throw InputError(where + "is packed by method " +
                     std::to_string(entry->method) +
                     ": expected stored (0) or deflate (8)");
  }
  if (!bytes) {
    throw InputError(where + "damaged: does not unpack to the " +
                     std::to_string(entry->size) + " bytes stated");
  }
  if (Crc(*bytes) != entry->crc) {
    throw InputError(where + "damaged: its CRC-32 does not match");
  }
  return std::move(*bytes);
}

}  // namespace invsim
