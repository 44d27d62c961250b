// SPDX-License-Identifier: Apache-2.0
#include "inputs.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "invsim/base/error.h"
#include "invsim/base/logging.h"
#include "invsim/base/names.h"
#include "invsim/body/mannequin.h"
#include "invsim/body/motion_library.h"
#include "invsim/body/rotation.h"
#include "invsim/io/input_frame.h"
#include "invsim/study/cube_toy.h"

namespace invsim {
namespace {

constexpr char kMannequin[] = "mannequin";
constexpr char kCube[] = "cube";
constexpr char kSheet[] = "sheet";
constexpr int kSheetCells = 12;
constexpr double kSheetGap = 0.01;  // m, above the body

constexpr double kEmbeddedRate = 30;
constexpr int kEmbeddedFrames = 60;

[[noreturn]] void ThrowUnknown(const std::string& kind,
                               const std::string& name,
                               const std::vector<std::string>& names,
                               const std::string& file) {
  throw UsageError(UnknownName(kind, name, names) + "; or give the path of " +
                   file);
}

bool Contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

Motion Embedded(const MotionInput& input) {
  const double rate =
      input.frames_per_second > 0 ? input.frames_per_second : kEmbeddedRate;
  const int frames = input.frames > 0 ? input.frames : kEmbeddedFrames;
  return MakeMotion(input.name, input.first + frames, rate);
}

// The model stands in the T-pose, which tells which way is up and how long a
// metre is: from the feet to the head it is y, and a person's height.
void CheckBodyFrame(const BodyModel& body, const std::string& file) {
  constexpr int kLeftFoot = 10, kRightFoot = 11, kHead = 15;
  const Points joints = body.Joints({});
  const Vector3d up = joints.col(kHead) -
                      0.5 * (joints.col(kLeftFoot) + joints.col(kRightFoot));
  std::ostringstream text;
  text << file << ": in the T-pose the head is (" << up.x() << ", " << up.y()
       << ", " << up.z() << ") from the feet";
  if (up.z() > 2 * std::abs(up.y())) {
    text << ", so z seems to be up; expected y: turn v_template, shapedirs and "
            "posedirs, (x, y, z) to (x, z, -y)";
    throw InputError(text.str());
  }
  if (-up.y() > 2 * std::abs(up.z())) {
    text << ", upside down; expected y up";
    throw InputError(text.str());
  }
  const LengthUnit unit = GuessInputFrame(body.data().v_template).frame.unit;
  if (unit != LengthUnit::kMetre) {
    text << ", so the unit seems to be " << Name(unit)
         << "; expected metres: multiply v_template, shapedirs and posedirs by "
         << MetresPer(unit);
    throw InputError(text.str());
  }
}

// Largest minus least of any number over the frames.
double Range(const std::vector<PoseVector>& poses) {
  PoseVector low = poses[0], high = poses[0];
  for (const PoseVector& pose : poses) {
    low = low.cwiseMin(pose);
    high = high.cwiseMax(pose);
  }
  return (high - low).maxCoeff();
}

// Archives such as AMASS have z up: there the body's own up axis points along
// z throughout. One who lies down, or turns a cartwheel, does not lie in this
// one direction all the time, or moves little.
void CheckMotionFrame(const MotionInput& input, const Motion& motion) {
  constexpr double kNear = 0.7;    // cosine of 45 degrees
  constexpr double kMost = 0.9;    // of the frames
  constexpr double kLittle = 0.3;  // rad; asleep
  int along_z = 0;
  for (const PoseVector& pose : motion.poses)
    along_z += (Exp(pose.head<3>()) * Vector3d::UnitY()).z() > kNear;
  if (along_z < kMost * motion.num_frames()) return;
  const std::string what =
      input.name + ": the body's up axis is along z in " +
      std::to_string(along_z) + " of " + std::to_string(motion.num_frames()) +
      " frames, so z seems to be up; say motion_up=z, or motion_up=y if the "
      "person lies";
  if (Range(motion.poses) > kLittle) throw InputError(what);
  LOG(WARNING) << what;
}

Motion FromFile(const MotionInput& input, const BodyModel& body) {
  Motion motion = ReadMotion(input.name);
  if (!input.up_is_said) CheckMotionFrame(input, motion);
  if (input.up != UpAxis::kY) TurnWorld(YUpFrom(input.up), body, &motion);
  if (input.frames_per_second > 0 &&
      input.frames_per_second != motion.frame_rate)
    motion = Resample(motion, input.frames_per_second);
  return motion;
}

// The frames asked for of those there are.
void Cut(const MotionInput& input, Motion* motion) {
  const int all = motion->num_frames();
  if (input.first >= all)
    throw UsageError("first_frame " + std::to_string(input.first) + ": " +
                     input.name + " has only frames 0 to " +
                     std::to_string(all - 1));
  const int frames = input.frames > 0
                         ? std::min(input.frames, all - input.first)
                         : all - input.first;
  const auto cut = [&](auto* values) {
    values->erase(values->begin() + input.first + frames, values->end());
    values->erase(values->begin(), values->begin() + input.first);
  };
  cut(&motion->poses);
  cut(&motion->translations);
}

void SetShape(const MotionInput& input, Motion* motion) {
  if (input.shape.empty()) return;
  if (input.shape.size() > kNumShape)
    throw UsageError("shape: " + std::to_string(input.shape.size()) +
                     " numbers, expected at most " + std::to_string(kNumShape));
  motion->shape.setZero();
  std::copy(input.shape.begin(), input.shape.end(), motion->shape.begin());
}

}  // namespace

bool IsPath(const std::string& name) {
  return name.find_first_of("/.") != std::string::npos;
}

BodyModel LoadBody(const std::string& name) {
  if (name == kMannequin) return Mannequin();
  if (name == kCube) return CubeBody();
  if (!IsPath(name))
    ThrowUnknown("body", name, {kMannequin, kCube}, "an SMPL-layout .npz");
  BodyModel body = ReadBodyModel(name);
  CheckBodyFrame(body, name);
  return body;
}

TPoseBody TPoseOf(const BodyModel& body) {
  return {
      body.Vertices({}), body.faces(), body.Joints({}), body.data().weights};
}

Garment LoadGarment(const std::string& name,
                    const BodyModel& body,
                    const AuthoredGarmentOptions& options) {
  if (Contains(AuthoredGarmentNames(), name))
    return AuthoredGarment(name, TPoseOf(body), options);
  if (name == kSheet)
    return SheetAbove(body.Vertices({}), kSheetCells, kSheetGap);
  if (!IsPath(name)) {
    std::vector<std::string> names = AuthoredGarmentNames();
    names.push_back(kSheet);
    ThrowUnknown("garment", name, names, "an .obj");
  }
  return ReadGarment(name);
}

void Describe(OptionTable* table, AuthoredGarmentOptions* o) {
  table->Add("edge",
             &o->edge_length,
             {.doc = "edge length of an authored garment",
              .unit = "m",
              .at_least = 0.008,
              .at_most = 0.08});
  table->Add("ease",
             &o->ease,
             {.doc = "least distance of an authored garment from the skin",
              .unit = "m",
              .at_least = 0.004,
              .at_most = 0.05});
}

void Describe(OptionTable* table, MotionInput* o) {
  table->Add("motion",
             &o->name,
             {.doc = "an embedded motion or the path of an AMASS npz"});
  table->Add("motion_up",
             &o->up,
             {{Name(UpAxis::kY), UpAxis::kY}, {Name(UpAxis::kZ), UpAxis::kZ}},
             {.doc = "the axis that is up in the motion's file"});
  table->Add("first_frame",
             &o->first,
             {.doc = "of the motion, at frames_per_second", .at_least = 0});
  table->Add("frames",
             &o->frames,
             {.doc = "of the motion, at most; 0: all", .at_least = 0});
  table->Add("frames_per_second",
             &o->frames_per_second,
             {.doc = "the motion is resampled to it; 0: as it is",
              .unit = "1/s",
              .at_least = 0});
  table->Add("shape",
             &o->shape,
             {.doc = "of the body, up to ten numbers; empty: as the motion has "
                     "it"});
}

Motion LoadMotion(const MotionInput& input, const BodyModel& body) {
  const bool embedded = Contains(MotionNames(), input.name);
  if (!embedded && !IsPath(input.name))
    ThrowUnknown("motion", input.name, MotionNames(), "an AMASS .npz");
  Motion motion = embedded ? Embedded(input) : FromFile(input, body);
  Cut(input, &motion);
  SetShape(input, &motion);
  return motion;
}

}  // namespace invsim
