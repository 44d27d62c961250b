// SPDX-License-Identifier: Apache-2.0
#include "fuzz_target.h"
#include "invsim/io/npz.h"
#include "mend_zip.h"
#include "npy_checks.h"

namespace invsim {
namespace {

// An archive is only ever kept in memory; replay_main.cpp looks that no file
// appears.
void Read(std::string_view bytes) {
  const auto npz =
      ReadOrRefuse([&] { return Npz::Parse(std::string(bytes), kFuzzName); });
  if (!npz) return;
  NpzArrays arrays;
  for (const std::string& name : npz->Names()) {
    Require(npz->Has(name), "an archive has what it names");
    const auto array = ReadOrRefuse([&] { return npz->Array(name); });
    if (!array) continue;
    CheckArray(*array);
    arrays.emplace_back(name, *array);
  }
  for (const bool deflate : {false, true}) {
    const Npz again = MustRead([&] {
      return Npz::Parse(FormatNpz(arrays, {.deflate = deflate}), kFuzzName);
    });
    Require(again.Names().size() == arrays.size(), "as many arrays");
    for (const auto& [name, array] : arrays) {
      const auto read = MustRead([&, &key = name] { return again.Array(key); });
      Require(FormatNpy(read) == FormatNpy(array),
              "an archive written is read back as it was");
    }
  }
}

}  // namespace

const FuzzTarget kFuzzTarget = {Read, MendZip};

}  // namespace invsim
