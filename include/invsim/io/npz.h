// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_IO_NPZ_H_
#define INVSIM_IO_NPZ_H_

// NumPy's .npz: a zip archive whose members NAME.npy are arrays (npy.h). It is
// how bodies (SMPL layout), motions (AMASS layout) and results are kept.

#include <string>
#include <utility>
#include <vector>

#include "invsim/io/npy.h"
#include "invsim/io/zip.h"
#include "invsim/io/zip_writer.h"

namespace invsim {

class Npz {
 public:
  // Keeps the bytes; `name` is the file named in errors. A Python pickle
  // (.pkl, as SMPL is handed out) is refused with the remedy. Throws
  // InputError.
  static Npz Parse(std::string bytes, const std::string& name);

  const std::string& name() const { return name_; }
  // Array names, without ".npy".
  std::vector<std::string> Names() const;
  bool Has(const std::string& array) const;
  // Unpacks one array: those not asked for cost nothing and may be damaged or
  // pickled. Throws InputError; a missing array is named with those there are.
  NpyArray Array(const std::string& array) const;

  // The values of an array of exactly this shape; -1 stands for any length.
  std::vector<double> Doubles(const std::string& array,
                              const NpyArray::Shape& shape) const;
  std::vector<std::int64_t> Integers(const std::string& array,
                                     const NpyArray::Shape& shape) const;

 private:
  std::string name_;
  ZipArchive zip_;
};

Npz ReadNpz(const std::string& path);

using NpzArrays = std::vector<std::pair<std::string, NpyArray>>;

std::string FormatNpz(const NpzArrays& arrays, const ZipOptions& options = {});
// Writes beside `path` and renames. Throws InputError.
void WriteNpz(const std::string& path,
              const NpzArrays& arrays,
              const ZipOptions& options = {});

}  // namespace invsim

#endif  // INVSIM_IO_NPZ_H_
