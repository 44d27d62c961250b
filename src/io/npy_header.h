// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SRC_IO_NPY_HEADER_H_
#define INVSIM_SRC_IO_NPY_HEADER_H_

// The head of an npy file: the magic bytes, the version, and a Python literal
// such as {'descr': '<f4', 'fortran_order': False, 'shape': (3400, 3), }.

#include <string>
#include <string_view>

#include "invsim/io/npy.h"

namespace invsim {

struct NpyHeader {
  NpyType type;
  std::size_t item_size;  // bytes
  bool big_endian;
  bool fortran_order;
  NpyArray::Shape shape;
  std::size_t size;  // bytes before the data
};

NpyHeader ParseNpyHeader(std::string_view bytes, const std::string& name);

std::string FormatNpyHeader(NpyType type,
                            std::size_t item_size,
                            const NpyArray::Shape& shape);

// 'b', 'i', 'u', 'f', 'S' or 'U'.
char NpyTypeLetter(NpyType type);
// As Python writes a tuple: "()", "(3,)", "(2, 3)".
std::string NpyShapeText(const NpyArray::Shape& shape);

}  // namespace invsim

#endif  // INVSIM_SRC_IO_NPY_HEADER_H_
