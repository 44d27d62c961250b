// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "fuzz_target.h"
#include "invsim/io/json_record.h"

namespace invsim {
namespace {

void Read(std::string_view bytes) {
  const auto record =
      ReadOrRefuse([&] { return JsonRecord::Parse(bytes, kFuzzName); });
  if (!record) return;
  for (const char* key : {"body", "garment"}) {
    const auto text = ReadOrRefuse([&] { return record->Text(key); });
    Require(!text || text->empty() || record->Has(key), "no text out of nil");
  }
  ReadOrRefuse([&] { return record->Texts("arguments"); });
  ReadOrRefuse([&] { return record->Integer("exit_code", 0); });
  const auto friction =
      ReadOrRefuse([&] { return record->Number("inputs.friction", 0.3); });
  Require(!friction || std::isfinite(*friction), "JSON holds finite numbers");
}

}  // namespace

const FuzzTarget kFuzzTarget = {Read};

}  // namespace invsim
