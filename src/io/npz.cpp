// SPDX-License-Identifier: Apache-2.0
#include "invsim/io/npz.h"

#include <string_view>

#include "invsim/base/error.h"
#include "invsim/io/file.h"
#include "invsim/io/text_scanner.h"

namespace invsim {
namespace {

constexpr std::string_view kSuffix = ".npy";

// Binary pickles (protocol 2 and later) begin with 0x80 and the protocol, the
// older text protocol with an opcode that opens a dict, a list or a global.
bool LooksLikePickle(std::string_view bytes) {
  if (bytes.size() > 1 && bytes[0] == '\x80') return bytes[1] <= 5;
  for (const std::string_view start :
       {"(dp", "(lp", "ccopy_reg", "cnumpy", "cchumpy"}) {
    if (bytes.starts_with(start)) return true;
  }
  return false;
}

bool Matches(const NpyArray::Shape& shape, const NpyArray::Shape& expected) {
  if (shape.size() != expected.size()) return false;
  for (std::size_t i = 0; i < shape.size(); ++i) {
    if (expected[i] >= 0 && shape[i] != expected[i]) return false;
  }
  return true;
}

std::string ShapeText(const NpyArray::Shape& shape) {
  std::string text;
  for (const std::int64_t n : shape) {
    text += (text.empty() ? "(" : ", ") + (n < 0 ? "N" : std::to_string(n));
  }
  return (text.empty() ? "(" : text) + ")";
}

NpyArray ArrayOfShape(const Npz& npz,
                      const std::string& name,
                      const NpyArray::Shape& shape) {
  NpyArray array = npz.Array(name);
  if (!Matches(array.shape(), shape)) {
    throw InputError(npz.name() + ": " + name + " is " + array.Description() +
                     ": expected shape " + ShapeText(shape));
  }
  return array;
}

}  // namespace

Npz Npz::Parse(std::string bytes, const std::string& name) {
  if (LooksLikePickle(bytes)) {
    throw InputError(name +
                     ": is a Python pickle, which runs code when read: "
                     "expected an npz; " +
                     kPickleRemedy);
  }
  Npz npz;
  npz.name_ = name;
  npz.zip_ = ZipArchive::Parse(std::move(bytes), name);
  return npz;
}

std::vector<std::string> Npz::Names() const {
  std::vector<std::string> names;
  for (std::string& member : zip_.Names()) {
    if (member.ends_with(kSuffix)) {
      names.push_back(member.substr(0, member.size() - kSuffix.size()));
    }
  }
  return names;
}

bool Npz::Has(const std::string& array) const {
  return zip_.Has(array + std::string(kSuffix));
}

NpyArray Npz::Array(const std::string& array) const {
  if (!Has(array)) {
    std::string there;
    for (const std::string& name : Names()) {
      there += (there.empty() ? "" : ", ") + name;
    }
    throw InputError(
        name_ + ": has no array " + Printable(array) +
        " (it has: " + (there.empty() ? "none" : Printable(there)) + ")");
  }
  return ParseNpy(zip_.Extract(array + std::string(kSuffix)),
                  name_ + ": " + Printable(array));
}

std::vector<double> Npz::Doubles(const std::string& array,
                                 const NpyArray::Shape& shape) const {
  return ArrayOfShape(*this, array, shape).ToDoubles(name_ + ": " + array);
}

std::vector<std::int64_t> Npz::Integers(const std::string& array,
                                        const NpyArray::Shape& shape) const {
  return ArrayOfShape(*this, array, shape).ToIntegers(name_ + ": " + array);
}

Npz ReadNpz(const std::string& path) {
  return Npz::Parse(ReadFileBytes(path), path);
}

std::string FormatNpz(const NpzArrays& arrays, const ZipOptions& options) {
  std::vector<ZipMember> members;
  for (const auto& [name, array] : arrays) {
    members.push_back({name + std::string(kSuffix), FormatNpy(array)});
  }
  return BuildZip(members, options);
}

void WriteNpz(const std::string& path,
              const NpzArrays& arrays,
              const ZipOptions& options) {
  WriteFileBytes(path, FormatNpz(arrays, options));
}

}  // namespace invsim
