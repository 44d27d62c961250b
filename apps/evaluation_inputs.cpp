// SPDX-License-Identifier: Apache-2.0
#include "evaluation_inputs.h"

#include <cstdio>
#include <filesystem>
#include <utility>

#include "inputs.h"
#include "invsim/base/error.h"
#include "invsim/io/json_record.h"
#include "invsim/io/obj.h"
#include "invsim/io/ply.h"
#include "invsim/io/point_cloud.h"
#include "invsim/io/point_sequence.h"

namespace invsim {
namespace {

namespace fs = std::filesystem;

std::string BodyBeside(const fs::path& folder, const JsonRecord& scene) {
  const std::string name = scene.Text("body");
  if (!name.empty() && fs::exists(folder / name))
    return (folder / name).string();
  throw UsageError(folder.string() + ": holds no body" +
                   (name.empty() ? "" : " " + name) +
                   "; give it with --body FILE.npz");
}

void LoadPoints(const fs::path& folder, Reference* reference) {
  if (!fs::is_directory(folder)) return;
  const PointSequence points = ScanPointSequence(folder.string());
  const int wanted = reference->truth.body.num_frames();
  if (static_cast<int>(points.files.size()) != wanted)
    throw InputError(
        folder.string() + ": " + std::to_string(points.files.size()) +
        " frames, expected " + std::to_string(wanted) + " as the truth has");
  reference->points = [points](int t) { return ReadPoints(points.files[t]); };
}

void LoadGarmentFaces(const fs::path& path, Reference* reference) {
  if (reference->truth.cloth.empty() || !fs::exists(path)) return;
  const ObjMesh garment = ReadObj(path.string());
  const auto wanted = reference->truth.cloth[0].cols();
  if (garment.vertices.cols() != wanted)
    throw InputError(path.string() + ": " +
                     std::to_string(garment.vertices.cols()) +
                     " vertices, expected " + std::to_string(wanted) +
                     " as the truth's cloth has");
  reference->cloth_faces = garment.faces;
}

std::optional<ClothEstimate> ReadCloth(const fs::path& run, int frame) {
  char name[32];
  std::snprintf(name, sizeof(name), "%06d.ply", frame);
  const fs::path path = run / "cloth" / name;
  if (!fs::exists(path)) return std::nullopt;
  const PlyMesh mesh = ReadPly(path.string());
  ClothEstimate cloth{mesh.vertices};
  cloth.faces = mesh.faces;
  const VectorXd* force[] = {mesh.Find("fx"), mesh.Find("fy"), mesh.Find("fz")};
  if (!force[0] || !force[1] || !force[2]) return cloth;
  cloth.force.resize(3, mesh.vertices.cols());
  for (int c = 0; c < 3; ++c) cloth.force.row(c) = force[c]->transpose();
  return cloth;
}

}  // namespace

LoadedReference LoadReference(const std::string& truth,
                              const std::string& body) {
  const fs::path given(truth);
  if (!fs::exists(given)) throw InputError(truth + ": does not exist");
  const bool folder_given = fs::is_directory(given);
  const fs::path file = folder_given ? given / "truth.npz" : given;
  const fs::path folder = folder_given ? given : given.parent_path();
  const JsonRecord scene = JsonRecord::Read((folder / "scene.json").string());
  LoadedReference loaded;
  loaded.garment = fs::path(scene.Text("garment")).stem().string();
  loaded.body = std::make_unique<BodyModel>(
      LoadBody(body.empty() ? BodyBeside(folder, scene) : body));
  loaded.reference = std::make_unique<Reference>(
      Reference{*loaded.body, Faces(3, 0), ReadTruth(file.string()), {}});
  LoadGarmentFaces(folder / "garment.obj", loaded.reference.get());
  LoadPoints(folder / "points", loaded.reference.get());
  return loaded;
}

Estimate LoadEstimate(const std::string& run) {
  const fs::path folder(run);
  Estimate estimate;
  estimate.body = ReadMotion((folder / "body.npz").string());
  estimate.cloth = [folder](int t) { return ReadCloth(folder, t); };
  const JsonRecord report = JsonRecord::Read((folder / "report.json").string());
  if (report.Has("inputs.friction"))
    estimate.friction = report.Number("inputs.friction", 0);
  return estimate;
}

}  // namespace invsim
