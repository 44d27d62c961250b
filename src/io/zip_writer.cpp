// SPDX-License-Identifier: Apache-2.0
#include "invsim/io/zip_writer.h"

#include "invsim/base/error.h"
#include "zip_format.h"

namespace invsim {
namespace {

std::string Deflate(std::string_view bytes) {
  z_stream stream{};
  if (deflateInit2(&stream,
                   Z_DEFAULT_COMPRESSION,
                   Z_DEFLATED,
                   -MAX_WBITS,
                   8,
                   Z_DEFAULT_STRATEGY) != Z_OK) {
    throw Error(ErrorKind::kInternal, "zlib cannot be initialised");
  }
  std::string out;
  std::string buffer(std::size_t{1} << 16, '\0');
  std::uint64_t in_done = 0;
  int status = Z_OK;
  do {
    stream.next_in = MutableBytes(bytes) + in_done;
    stream.avail_in = Piece(bytes.size() - in_done);
    stream.next_out = MutableBytes(buffer);
    stream.avail_out = static_cast<uInt>(buffer.size());
    const uInt offered = stream.avail_in;
    const bool last = in_done + offered == bytes.size();
    status = deflate(&stream, last ? Z_FINISH : Z_NO_FLUSH);
    in_done += offered - stream.avail_in;
    out.append(buffer, 0, buffer.size() - stream.avail_out);
  } while (status == Z_OK);
  deflateEnd(&stream);
  if (status != Z_STREAM_END) {
    throw Error(ErrorKind::kInternal, "zlib failed to compress");
  }
  return out;
}

void AppendNumber(int size, std::uint64_t value, std::string* out) {
  for (int i = 0; i < size; ++i) {
    out->push_back(static_cast<char>(value >> (8 * i) & 0xff));
  }
}

struct Record {
  std::string name;
  int method;
  std::uint32_t crc;
  std::uint64_t packed_size;
  std::uint64_t size;
  std::uint64_t offset;
};

// The fields that a local header and a directory entry share. The date is the
// format's first day, 1980-01-01.
void AppendCommonFields(const Record& r, bool zip64, std::string* out) {
  AppendNumber(2, zip64 ? 45 : 20, out);  // version needed
  AppendNumber(2, 0, out);                // flags
  AppendNumber(2, r.method, out);
  AppendNumber(2, 0, out);     // time
  AppendNumber(2, 0x21, out);  // date
  AppendNumber(4, r.crc, out);
  AppendNumber(4, zip64 ? kMax32 : r.packed_size, out);
  AppendNumber(4, zip64 ? kMax32 : r.size, out);
  AppendNumber(2, r.name.size(), out);
}

bool NeedsZip64(const Record& r, const ZipOptions& options) {
  return options.always_zip64 ||
         std::max({r.packed_size, r.size, r.offset}) >= kMax32;
}

void AppendLocalHeader(const Record& r, bool zip64, std::string* out) {
  AppendNumber(4, kLocalHeader, out);
  AppendCommonFields(r, zip64, out);
  AppendNumber(2, zip64 ? 20 : 0, out);  // extra length
  out->append(r.name);
  if (zip64) {
    AppendNumber(2, kZip64Extra, out);
    AppendNumber(2, 16, out);
    AppendNumber(8, r.size, out);
    AppendNumber(8, r.packed_size, out);
  }
}

void AppendDirectoryEntry(const Record& r, bool zip64, std::string* out) {
  AppendNumber(4, kDirectoryEntry, out);
  AppendNumber(2, zip64 ? 45 : 20, out);  // version made by
  AppendCommonFields(r, zip64, out);
  AppendNumber(2, zip64 ? 28 : 0, out);  // extra length
  AppendNumber(2, 0, out);               // comment length
  AppendNumber(2, 0, out);               // disk
  AppendNumber(2, 0, out);               // internal attributes
  AppendNumber(4, 0, out);               // external attributes
  AppendNumber(4, zip64 ? kMax32 : r.offset, out);
  out->append(r.name);
  if (zip64) {
    AppendNumber(2, kZip64Extra, out);
    AppendNumber(2, 24, out);
    AppendNumber(8, r.size, out);
    AppendNumber(8, r.packed_size, out);
    AppendNumber(8, r.offset, out);
  }
}

void AppendZip64End(std::uint64_t count,
                    std::uint64_t directory,
                    std::uint64_t directory_size,
                    std::string* out) {
  const std::uint64_t record = out->size();
  AppendNumber(4, kZip64End, out);
  AppendNumber(8, 44, out);  // size of what follows
  AppendNumber(2, 45, out);  // version made by
  AppendNumber(2, 45, out);  // version needed
  AppendNumber(4, 0, out);   // this disk
  AppendNumber(4, 0, out);   // disk of the directory
  AppendNumber(8, count, out);
  AppendNumber(8, count, out);
  AppendNumber(8, directory_size, out);
  AppendNumber(8, directory, out);
  AppendNumber(4, kZip64Locator, out);
  AppendNumber(4, 0, out);
  AppendNumber(8, record, out);
  AppendNumber(4, 1, out);  // number of disks
}

void AppendEnd(const std::vector<Record>& records,
               const ZipOptions& options,
               std::string* out) {
  const std::uint64_t directory = out->size();
  for (const Record& r : records) {
    AppendDirectoryEntry(r, NeedsZip64(r, options), out);
  }
  const std::uint64_t directory_size = out->size() - directory;
  const bool zip64 = options.always_zip64 || records.size() >= kMax16 ||
                     std::max(directory, directory_size) >= kMax32;
  if (zip64) {
    AppendZip64End(records.size(), directory, directory_size, out);
  }
  AppendNumber(4, kEndOfDirectory, out);
  AppendNumber(4, 0, out);  // disks
  AppendNumber(2, zip64 ? kMax16 : records.size(), out);
  AppendNumber(2, zip64 ? kMax16 : records.size(), out);
  AppendNumber(4, zip64 ? kMax32 : directory_size, out);
  AppendNumber(4, zip64 ? kMax32 : directory, out);
  AppendNumber(2, 0, out);  // comment length
}

}  // namespace

std::string BuildZip(const std::vector<ZipMember>& members,
                     const ZipOptions& options) {
  std::string out;
  std::vector<Record> records;
  for (const ZipMember& member : members) {
    const std::string packed =
        options.deflate ? Deflate(member.bytes) : member.bytes;
    const Record record{member.name,
                        options.deflate ? kDeflated : kStored,
                        Crc(member.bytes),
                        packed.size(),
                        member.bytes.size(),
                        out.size()};
    AppendLocalHeader(record, NeedsZip64(record, options), &out);
    out += packed;
    records.push_back(record);
  }
  AppendEnd(records, options, &out);
  return out;
}

}  // namespace invsim
