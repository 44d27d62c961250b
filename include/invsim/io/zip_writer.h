// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_IO_ZIP_WRITER_H_
#define INVSIM_IO_ZIP_WRITER_H_

// Writing zip archives that zip.h, and anything else, reads.

#include <string>
#include <vector>

namespace invsim {

struct ZipMember {
  std::string name;
  std::string bytes;
};

struct ZipOptions {
  // Stored members are larger but can be mapped into memory by others.
  bool deflate = true;
  // 64-bit records are written where a size or offset needs them; this writes
  // them everywhere.
  bool always_zip64 = false;
};

// The bytes of an archive of the members, in their order. No dates are
// written, so that equal members give equal bytes.
std::string BuildZip(const std::vector<ZipMember>& members,
                     const ZipOptions& options = {});

}  // namespace invsim

#endif  // INVSIM_IO_ZIP_WRITER_H_
