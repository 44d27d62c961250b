// SPDX-License-Identifier: Apache-2.0
#include "invsim/io/file.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "invsim/base/error.h"

namespace invsim {

std::string ReadFileBytes(const std::string& path) {
  std::error_code status;
  if (std::filesystem::is_directory(path, status)) {
    throw InputError(path + ": is a directory: expected a file");
  }
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    throw InputError(path + ": cannot be opened: " + std::strerror(errno));
  }
  // In pieces, not by the size the file system states: a pipe has none.
  std::string bytes;
  constexpr std::size_t kPiece = std::size_t{1} << 20;
  while (file) {
    const std::size_t old_size = bytes.size();
    bytes.resize(old_size + kPiece);
    file.read(bytes.data() + old_size, kPiece);
    bytes.resize(old_size + static_cast<std::size_t>(file.gcount()));
  }
  if (file.bad()) {
    throw InputError(path + ": cannot be read: " + std::strerror(errno));
  }
  return bytes;
}

void WriteFileBytes(const std::string& path, std::string_view bytes) {
  const std::string partial = path + ".partial" + std::to_string(::getpid());
  errno = 0;
  std::ofstream file(partial, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file || std::rename(partial.c_str(), path.c_str()) != 0) {
    const std::string reason = std::strerror(errno);
    std::remove(partial.c_str());
    throw InputError(path + ": cannot be written: " + reason);
  }
}

std::string LowerExtension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  if (!extension.empty()) extension.erase(0, 1);
  std::transform(extension.begin(),
                 extension.end(),
                 extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return extension;
}

}  // namespace invsim
