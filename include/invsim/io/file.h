// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_IO_FILE_H_
#define INVSIM_IO_FILE_H_

// Whole files in memory. Every reader of this layer is a pair
//
//   X ParseX(std::string_view bytes, const std::string& name);
//   X ReadX(const std::string& path);   // ParseX of the file's bytes
//
// so that the parser can be tested and fuzzed without a disk. Parsers trust
// nothing: memory grows with the bytes given, never with a number read.

#include <string>
#include <string_view>

namespace invsim {

// The bytes of a file. Throws InputError naming the path and the reason: it
// does not exist, is a directory, cannot be read.
std::string ReadFileBytes(const std::string& path);

// Writes beside `path` and renames, so that the file appears complete or not
// at all. Throws InputError naming the path and the reason.
void WriteFileBytes(const std::string& path, std::string_view bytes);

// The extension of a path in lower case without the dot: "a/B.PLY" -> "ply".
std::string LowerExtension(const std::string& path);

}  // namespace invsim

#endif  // INVSIM_IO_FILE_H_
