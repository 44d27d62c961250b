// SPDX-License-Identifier: Apache-2.0
#include "fit_inputs.h"

#include <sstream>

#include "invsim/base/error.h"
#include "invsim/base/logging.h"
#include "invsim/base/random.h"
#include "invsim/cloth/named_materials.h"
#include "invsim/io/point_sequence.h"
#include "invsim/sim/scene.h"

namespace invsim {
namespace {

// Fewer cannot be a person, nor can more metres.
constexpr int kFewestPoints = 50;
constexpr double kLargestPerson = 5;

void Need(const std::string& value, const char* flag, const char* what) {
  if (value.empty())
    throw UsageError(std::string(flag) + " is missing: " + what);
}

// The unit, and the axis that is up, must be what the points look like unless
// the user said so in so many words. Of the frames after the first only the
// size is looked at: people bend, lie down and turn cartwheels.
void CheckInputFrame(const FitInput& input,
                     const OptionTable& options,
                     const std::string& file,
                     const Points& raw,
                     bool first) {
  const Points person = WithoutStrays(raw);
  const InputFrameGuess guess = GuessInputFrame(person);
  const Vector3d size =
      person.rowwise().maxCoeff() - person.rowwise().minCoeff();
  std::ostringstream text;
  text << file << ": the points span " << size.x() << " x " << size.y() << " x "
       << size.z() << " (x, y, z)";
  if (!options.IsSet("input.units") && guess.frame.unit != input.frame.unit) {
    text << ", which is no person in " << Name(input.frame.unit)
         << "; expected metres, or say --units " << Name(guess.frame.unit);
    throw InputError(text.str());
  }
  if (MetresPer(input.frame.unit) * size.maxCoeff() > kLargestPerson) {
    text << ", which is no person in " << Name(input.frame.unit)
         << "; expected at most " << kLargestPerson << " m";
    throw InputError(text.str());
  }
  if (first && !options.IsSet("input.up") && guess.frame.up != input.frame.up) {
    text << ", so " << Name(guess.frame.up) << " seems to be up; say --up "
         << Name(guess.frame.up) << ", or --up " << Name(input.frame.up)
         << " if that is wrong";
    throw InputError(text.str());
  }
}

void CheckEnough(const std::string& file,
                 const Points& filtered,
                 const Points& raw,
                 const std::string& option) {
  if (filtered.cols() >= kFewestPoints) return;
  throw InputError(file + ": " + option + " leaves " +
                   std::to_string(filtered.cols()) + " of " +
                   std::to_string(raw.cols()) + " points, expected at least " +
                   std::to_string(kFewestPoints));
}

// The points of one file, inside (metres, y up), outliers and voxels filtered.
// The frame is judged by what is left of the outliers.
Points CleanPoints(const FitInput& input,
                   const OptionTable& options,
                   const std::string& file,
                   const Points& raw,
                   bool first) {
  PointFilterOptions outliers = input.filter, voxels = input.filter;
  outliers.voxel = 0;
  voxels.outlier_neighbours = 0;
  const Points clean =
      FilterPoints(outliers, InsideFromInput(input.frame, raw));
  CheckEnough(file, clean, raw, "input.filter.outlier_neighbours");
  CheckInputFrame(
      input, options, file, InputFromInside(input.frame, clean), first);
  const Points thinned = FilterPoints(voxels, clean);
  CheckEnough(file, thinned, raw, "input.filter.voxel");
  return thinned;
}

Points Subsample(const Points& points, int count, Random* random) {
  const int n = static_cast<int>(points.cols());
  if (n <= count) return points;
  std::vector<int> order(n);
  for (int i = 0; i < n; ++i) order[i] = i;
  for (int i = 0; i < count; ++i)
    std::swap(order[i], order[i + random->Index(n - i)]);
  order.resize(count);
  return points(Eigen::all, order);
}

std::vector<std::string> ChosenFiles(const FitInput& input) {
  PointSequence sequence = ScanPointSequence(input.points);
  std::vector<std::string>& files = sequence.files;
  const int all = static_cast<int>(files.size());
  if (input.first >= all)
    throw UsageError("input.first_frame " + std::to_string(input.first) + ": " +
                     input.points + " has only frames 0 to " +
                     std::to_string(all - 1));
  files.erase(files.begin(), files.begin() + input.first);
  if (input.frames > 0 && input.frames < static_cast<int>(files.size()))
    files.resize(input.frames);
  return files;
}

void LoadClouds(const FitInput& input,
                const CommandContext& context,
                FitData* data) {
  const std::vector<std::string> files = ChosenFiles(input);
  for (size_t t = 0; t < files.size(); ++t) {
    int dropped = 0;
    const Points raw = ReadPoints(files[t], input.read, &dropped);
    data->dropped += dropped;
    if (raw.cols() < kFewestPoints)
      throw InputError(files[t] + ": has " + std::to_string(raw.cols()) +
                       (raw.cols() == 1 ? " point" : " points") +
                       ", expected a person's, at least " +
                       std::to_string(kFewestPoints));
    const Points clean =
        CleanPoints(input, *context.options, files[t], raw, t == 0);
    data->filtered += static_cast<int>(raw.cols() - clean.cols());
    Random random(context.run.seed, static_cast<std::uint64_t>(t));
    data->clouds.push_back(Subsample(clean, input.max_points, &random));
  }
  if (files.size() < 3)
    LOG(WARNING) << files.size() << (files.size() == 1 ? " frame" : " frames")
                 << ": smoothness in time needs three and is not asked for";
}

std::optional<BodySequence> LoadStart(const FitInput& input, int frames) {
  if (input.start.empty()) return std::nullopt;
  const Motion motion = ReadMotion(input.start);
  if (motion.num_frames() != frames)
    throw InputError(
        input.start + ": has " + std::to_string(motion.num_frames()) +
        " frames, expected one per point cloud, " + std::to_string(frames));
  return BodySequence{motion.shape, motion.poses, motion.translations};
}

}  // namespace

void Describe(OptionTable* table, FitInput* o) {
  table->Add("points",
             &o->points,
             {.doc = "folder of point clouds, one file per frame"});
  table->Add("body", &o->body, {.doc = "mannequin, or an SMPL-layout npz"});
  table->Add("garment",
             &o->garment,
             {.doc = "an authored garment, or an OBJ placed around the T-posed "
                     "body of shape zero"});
  Describe(table, &o->authored);
  table->Add("frames_per_second",
             &o->frames_per_second,
             {.doc = "of the point clouds", .unit = "1/s", .above = 0});
  table->Add("first_frame",
             &o->first,
             {.doc = "of the folder, counted from 0", .at_least = 0});
  table->Add("frames",
             &o->frames,
             {.doc = "of the folder, at most; 0: all", .at_least = 0});
  Describe(table, &o->frame);
  Describe(table, &o->read);
  table->AddSection("filter", &o->filter);
  table->Add("max_points",
             &o->max_points,
             {.doc = "points used of each frame, chosen at random",
              .at_least = kFewestPoints});
  table->Add("start",
             &o->start,
             {.doc = "AMASS npz of the body to start from; empty: it is found "
                     "from the points"});
}

void AddFitInputFlags(KeyFlags* flags) {
  flags->Add("--points", "input.points", "folder of point clouds");
  flags->Add("--body", "input.body", "mannequin or an SMPL-layout npz");
  flags->Add("--garment", "input.garment", "authored or an OBJ");
  flags->Add("--fps", "input.frames_per_second", "frames per second");
  flags->Add("--frames", "input.frames", "at most so many; 0: all");
  flags->Add("--units", "input.units", "of the points: m, cm, mm");
  flags->Add("--up", "input.up", "axis of the points that is up: y, z");
  flags->Add("--start", "input.start", "body.npz to start from");
  flags->Add("--material", "scene.material", "named or an ARCSim json");
  flags->Add("--friction", "contact.friction", "of the cloth on the body");
  flags->Add("--substeps", "step.substeps", "steps per frame");
}

std::vector<std::string> PathsOf(const FitInput& input) {
  return {input.points, input.body, input.garment, input.start};
}

FitData LoadFitData(const FitInput& input,
                    const std::string& material,
                    const CommandContext& context) {
  Need(input.points, "--points", "a folder with one point cloud per frame");
  Need(input.body, "--body", "an SMPL-layout npz, or mannequin");
  Need(
      input.garment, "--garment", "an OBJ, or the name of an authored garment");
  BodyModel body = LoadBody(input.body);
  Garment garment = LoadGarment(input.garment, body, input.authored);
  CheckGarmentFits(garment, body, ShapeVector::Zero(), input.garment);
  FitData data{{},
               0,
               0,
               std::move(body),
               std::move(garment),
               FindMaterial(material),
               {}};
  LoadClouds(input, context, &data);
  data.start = LoadStart(input, static_cast<int>(data.clouds.size()));
  return data;
}

}  // namespace invsim
