// SPDX-License-Identifier: Apache-2.0
// npy files as bytes, for tests that need one our writer would not write.
#ifndef INVSIM_TESTS_IO_NPY_BYTES_H_
#define INVSIM_TESTS_IO_NPY_BYTES_H_

#include <string>

namespace invsim {

// A version-1 file with the head and data given.
inline std::string NpyBytes(std::string header, const std::string& data) {
  header += '\n';
  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += static_cast<char>(header.size() & 0xff);
  bytes += static_cast<char>(header.size() >> 8);
  return bytes + header + data;
}

inline std::string NpyHead(const std::string& descr,
                           const std::string& shape,
                           bool fortran = false) {
  return "{'descr': '" + descr +
         "', 'fortran_order': " + (fortran ? "True" : "False") +
         ", 'shape': " + shape + ", }";
}

}  // namespace invsim

#endif  // INVSIM_TESTS_IO_NPY_BYTES_H_
