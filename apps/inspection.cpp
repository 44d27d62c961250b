// SPDX-License-Identifier: Apache-2.0
#include "inspection.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <variant>

#include "invsim/base/error.h"
#include "invsim/base/names.h"
#include "invsim/body/body_model.h"
#include "invsim/body/motion.h"
#include "invsim/body/rotation.h"
#include "invsim/cloth/garment.h"
#include "invsim/cloth/material_file.h"
#include "invsim/geometry/mesh.h"
#include "invsim/geometry/topology.h"
#include "invsim/io/file.h"
#include "invsim/io/input_frame.h"
#include "invsim/io/npz.h"
#include "invsim/io/obj.h"
#include "invsim/io/pc2.h"
#include "invsim/io/ply.h"
#include "invsim/io/point_cloud.h"
#include "invsim/io/point_sequence.h"
#include "invsim/io/text_scanner.h"

namespace invsim {
namespace {

namespace fs = std::filesystem;

bool IsDirectory(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

bool Exists(const fs::path& path) {
  std::error_code error;
  return fs::exists(path, error);
}

// To micrometres, so that a float does not show as 0.10000000149.
double Rounded(double value) { return std::round(1e6 * value) / 1e6; }

nlohmann::ordered_json List(const Vector3d& v) {
  return {Rounded(v.x()), Rounded(v.y()), Rounded(v.z())};
}

void AddBox(const Points& points, nlohmann::ordered_json* facts) {
  (*facts)["box_min"] = List(points.rowwise().minCoeff());
  (*facts)["box_max"] = List(points.rowwise().maxCoeff());
}

// Box, unit and up axis of points on a person.
void AddPerson(const Points& points, Inspection* result) {
  AddBox(points, &result->facts);
  const InputFrameGuess guess = GuessInputFrame(points);
  result->facts["guessed_unit"] = Name(guess.frame.unit);
  result->facts["guessed_up"] = Name(guess.frame.up);
  result->facts["height_m"] = Rounded(guess.height);
  result->warnings.insert(
      result->warnings.end(), guess.warnings.begin(), guess.warnings.end());
}

// Runs a check that throws InputError and keeps its message.
template <typename Check>
std::string ProblemOf(const Check& check) {
  try {
    check();
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

Inspection InspectBodyModel(const std::string& path) {
  Inspection result{"body model"};
  const BodyModel body = ReadBodyModel(path);
  const BodyModelData& data = body.data();
  result.facts["vertices"] = body.num_vertices();
  result.facts["faces"] = body.faces().cols();
  result.facts["joints"] = kNumJoints;
  result.facts["shape_directions"] = kNumShape;
  result.facts["pose_directions"] = data.posedirs.cols();
  AddPerson(data.v_template, &result);
  return result;
}

// Where the root's rotation takes the body's own up axis, on average.
UpAxis GuessUp(const Motion& motion) {
  Vector3d up = Vector3d::Zero();
  for (const PoseVector& pose : motion.poses) {
    up += Exp(pose.head<3>()) * Vector3d::UnitY();
  }
  return std::abs(up.z()) > std::abs(up.y()) ? UpAxis::kZ : UpAxis::kY;
}

Inspection InspectMotion(const std::string& path) {
  Inspection result{"motion"};
  result.problem = ProblemOf([&] {
    const Motion motion = ReadMotion(path);
    const int frames = motion.num_frames();
    result.facts["frames"] = frames;
    result.facts["frames_per_second"] = motion.frame_rate;
    result.facts["seconds"] = Rounded(frames / motion.frame_rate);
    result.facts["gender"] = Printable(motion.gender);
    Points translations(3, frames);
    for (int t = 0; t < frames; ++t) {
      translations.col(t) = motion.translations[t];
    }
    result.facts["trans_min"] = List(translations.rowwise().minCoeff());
    result.facts["trans_max"] = List(translations.rowwise().maxCoeff());
    const UpAxis up = GuessUp(motion);
    result.facts["guessed_up"] = Name(up);
    if (up == UpAxis::kZ) {
      result.warnings.push_back("z looks like the up axis, not y");
    }
  });
  return result;
}

Inspection InspectNpz(const std::string& path) {
  const Npz npz = ReadNpz(path);
  if (npz.Has("v_template")) return InspectBodyModel(path);
  if (npz.Has("poses")) return InspectMotion(path);
  throw InputError(path + ": arrays " + Printable(Join(npz.Names())) +
                   ": expected a body model (v_template, ...) or a motion "
                   "(poses, trans)");
}

Inspection InspectPoints(const std::string& path) {
  Inspection result{"point cloud"};
  int num_dropped = 0;
  const Points points =
      ReadPoints(path, {.drop_non_finite = true}, &num_dropped);
  result.facts["points"] = points.cols();
  if (num_dropped > 0) {
    result.facts["non_finite_points"] = num_dropped;
    result.warnings.push_back(std::to_string(num_dropped) +
                              " points are not finite and must be dropped");
  }
  AddPerson(points, &result);
  return result;
}

// Faces, holes and pieces of what is a surface.
void AddSurface(const Points& vertices,
                const Faces& faces,
                Inspection* result) {
  result->facts["area_m2"] = Rounded(FaceAreas(vertices, faces).sum());
  result->facts["openings"] = BoundaryLoops(faces).size();
  const std::vector<int> pieces =
      VertexComponents(faces, static_cast<int>(vertices.cols()));
  result->facts["pieces"] = *std::max_element(pieces.begin(), pieces.end()) + 1;
}

Inspection InspectObj(const std::string& path) {
  const ObjMesh mesh = ReadObj(path);
  if (mesh.faces.cols() == 0) return InspectPoints(path);
  Inspection result{"garment"};
  result.facts["vertices"] = mesh.vertices.cols();
  result.facts["faces"] = mesh.faces.cols();
  result.facts["pattern_points"] = mesh.texture.cols();
  result.facts["rest_shape"] =
      mesh.texture_faces.cols() > 0 ? "pattern (vt)" : "as placed (v)";
  AddBox(mesh.vertices, &result.facts);
  result.problem = ProblemOf([&] {
    const Garment garment = ReadGarment(path);
    AddSurface(garment.placed, garment.faces, &result);
    if (result.facts["openings"] == 0) {
      result.warnings.push_back("no opening: nobody can put it on");
    }
    result.facts["rest_area_m2"] = Rounded(VertexAreas(garment).sum());
  });
  return result;
}

Inspection InspectPly(const std::string& path) {
  Inspection result = InspectPoints(path);
  const PlyMesh mesh = ReadPly(path, {.allow_non_finite = true});
  if (mesh.faces.cols() > 0) result.facts["faces"] = mesh.faces.cols();
  if (!mesh.properties.empty()) {
    result.facts["properties"] = nlohmann::ordered_json::array();
    for (const PlyProperty& property : mesh.properties) {
      result.facts["properties"].push_back(Printable(property.name));
    }
  }
  return result;
}

Inspection InspectPointCache(const std::string& path) {
  Inspection result{"point cache"};
  const PointCache cache = ReadPc2(path);
  result.facts["samples"] = cache.samples.size();
  if (cache.samples.empty()) {
    result.problem = path + ": no sample: expected one or more";
    return result;
  }
  result.facts["vertices"] = cache.samples[0].cols();
  AddBox(cache.samples[0], &result.facts);
  return result;
}

Inspection InspectMaterial(const std::string& path) {
  Inspection result{"cloth material"};
  const Material material = ReadMaterial(path);
  result.facts["name"] = material.name;
  result.facts["density_kg_m2"] = material.density;
  const bool is_measured =
      std::holds_alternative<MeasuredStretch>(material.stretch);
  result.facts["stretch"] = is_measured ? "measured" : "linear";
  result.facts["friction"] = material.friction;
  return result;
}

Inspection InspectSequence(const std::string& path) {
  Inspection result{"point cloud sequence"};
  const PointSequence sequence = ScanPointSequence(path);
  result.facts["frames"] = sequence.files.size();
  result.facts["first"] = sequence.first;
  result.facts["step"] = sequence.step;
  Eigen::Index fewest = std::numeric_limits<Eigen::Index>::max();
  Eigen::Index most = 0;
  result.problem = ProblemOf([&] {
    for (const std::string& file : sequence.files) {
      const Points points = ReadPoints(file);
      if (&file == &sequence.files.front()) AddPerson(points, &result);
      fewest = std::min(fewest, points.cols());
      most = std::max(most, points.cols());
    }
    result.facts["fewest_points"] = fewest;
    result.facts["most_points"] = most;
  });
  return result;
}

Inspection InspectRun(const fs::path& path) {
  Inspection result{"run folder"};
  const auto count = [&path](const char* part) -> std::size_t {
    if (!IsDirectory(path / part)) return 0;
    return ScanPointSequence((path / part).string()).files.size();
  };
  result.problem = ProblemOf([&] {
    const Inspection body = InspectNpz((path / "body.npz").string());
    if (body.kind != "motion") {
      throw InputError((path / "body.npz").string() + ": is a " + body.kind +
                       ": expected a motion");
    }
    result.facts["frames"] = body.facts["frames"];
    result.problem = body.problem;
    for (const char* part : {"cloth", "body"}) {
      const std::size_t files = count(part);
      result.facts[std::string(part) + "_files"] = files;
      if (files > 0 && files != body.facts["frames"].get<std::size_t>()) {
        result.warnings.push_back(std::to_string(files) + " files in " + part +
                                  "/ for " + body.facts["frames"].dump() +
                                  " frames");
      }
    }
  });
  result.facts["has_checkpoint"] = IsDirectory(path / "checkpoint");
  return result;
}

Inspection InspectDirectory(const fs::path& path) {
  if (Exists(path / "report.json") || Exists(path / "body.npz")) {
    return InspectRun(path);
  }
  if (IsDirectory(path / "points")) {
    return InspectSequence((path / "points").string());
  }
  return InspectSequence(path.string());
}

}  // namespace

Inspection Inspect(const std::string& path) {
  if (IsDirectory(path)) return InspectDirectory(path);
  const std::string extension = LowerExtension(path);
  // A pickle is refused by the npz reader, which knows the remedy.
  if (extension == "npz" || extension == "pkl") return InspectNpz(path);
  if (extension == "obj") return InspectObj(path);
  if (extension == "ply") return InspectPly(path);
  if (extension == "pc2") return InspectPointCache(path);
  if (extension == "json") return InspectMaterial(path);
  const std::vector<std::string>& clouds = PointExtensions();
  if (std::find(clouds.begin(), clouds.end(), extension) != clouds.end()) {
    return InspectPoints(path);
  }
  throw InputError(path + ": extension " + Quoted(extension) +
                   ": expected a directory or a file npz, obj, pc2, json, " +
                   Join(clouds));
}

}  // namespace invsim
