// SPDX-License-Identifier: Apache-2.0
#include "fuzz_target.h"
#include "invsim/body/motion.h"
#include "mend_zip.h"

namespace invsim {
namespace {

bool Same(const Motion& a, const Motion& b) {
  return a.frame_rate == b.frame_rate && a.shape == b.shape &&
         a.poses == b.poses && a.translations == b.translations &&
         a.gender == b.gender;
}

void Read(std::string_view bytes) {
  const auto motion =
      ReadOrRefuse([&] { return ParseMotion(std::string(bytes), kFuzzName); });
  if (!motion) return;
  Require(motion->num_frames() > 0, "there is a frame");
  const std::string written = FormatNpz(MotionArrays(*motion));
  Require(
      Same(MustRead([&] { return ParseMotion(written, kFuzzName); }), *motion),
      "a motion written is read back as it was");
}

}  // namespace

const FuzzTarget kFuzzTarget = {Read, MendZip};

}  // namespace invsim
