// SPDX-License-Identifier: Apache-2.0
#include "invsim/study/clothed_sequence.h"

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "invsim/base/error.h"
#include "invsim/io/earlier_results.h"
#include "invsim/io/file.h"
#include "invsim/io/obj.h"
#include "invsim/io/ply.h"
#include "invsim/study/truth.h"

namespace invsim {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kFiles[] = {"garment.obj",
                                  "body_model.npz",
                                  "truth.npz",
                                  "scene.json",
                                  kResolvedConfig};
constexpr char kPoints[] = "points";

// What a sequence may have left in the directory.
std::vector<fs::path> FilesOfSequence(const fs::path& directory) {
  std::vector<fs::path> files;
  if (fs::is_directory(directory / kPoints))
    for (const auto& entry : fs::directory_iterator(directory / kPoints))
      if (entry.path().extension() == ".ply") files.push_back(entry.path());
  for (const char* file : kFiles) files.push_back(directory / file);
  return files;
}

// Makes the directory, empty but for what is not ours.
void PrepareDirectory(const std::string& path,
                      bool force,
                      const std::vector<std::string>& inputs) {
  try {
    if (fs::exists(path) && !fs::is_directory(path))
      throw UsageError(path + ": is a file, expected a folder");
    fs::create_directories(path);
    if (fs::is_empty(path)) return;
    if (!force)
      throw UsageError(path +
                       ": the folder is not empty; choose another one, or "
                       "--force to replace the sequence in it");
    RemoveEarlierResults(path, FilesOfSequence(path), inputs);
  } catch (const fs::filesystem_error& error) {
    throw InputError(path + ": cannot be used: " + error.code().message());
  }
}

Json MeasurementJson(const MeasurementOptions& o) {
  Json json;
  json["cover_reach_m"] = o.cover_reach;
  json["outliers_share"] = o.outliers;
  json["outlier_distance_m"] = o.outlier_distance;
  json["holes"] = o.holes;
  json["hole_radius_m"] = o.hole_radius;
  json["density_ratio"] = o.density_ratio;
  json["single_view"] = o.single_view;
  if (o.single_view) {
    const Vector3d& d = o.camera_direction;
    json["camera_direction"] = {d[0], d[1], d[2]};
    json["camera_distance_m"] = o.camera_distance;
  }
  return json;
}

std::string SceneJson(const ClothedSequenceScene& s,
                      const SceneOptions& physics,
                      const ClothedSequenceOptions& o,
                      const ClothedSequenceResult& made) {
  Json json;
  json["fps"] = s.motion.frame_rate;
  json["frames"] = s.motion.num_frames();
  json["up"] = "+y";
  json["units"] = "metres, seconds, kilograms, radians";
  json["body"] = "body_model.npz";
  json["body_source"] = s.names.body;
  json["motion"] = s.names.motion;
  json["garment"] = s.names.garment;
  json["garment_rest"] =
      s.garment.rest_angles_from_placed ? "shape of v" : "pattern (vt, metres)";
  json["garment_vertices"] = s.garment.num_vertices();
  json["material"] = s.material.name;
  json["areal_density_kg_m2"] = s.material.density;
  json["effects"] = ChosenEffects(physics, s.garment, s.material);
  json["friction_body"] = physics.contact.friction;
  json["contact_gap_m"] = physics.contact.thickness;
  json["simulator"] = "invsim";
  json["simulator_step_s"] = 1 / (s.motion.frame_rate * physics.step.substeps);
  json["steps_missed"] = made.sequence.stats.step.missed;
  json["at_rest_in_frame_0"] = made.relaxation.at_rest;
  json["points_per_frame"] = o.measurement.points;
  json["noise"] = {{"sigma_m", o.measurement.noise},
                   {"kind", "isotropic Gaussian"}};
  json["measurement"] = MeasurementJson(o.measurement);
  json["seed"] = o.seed;
  // A path may hold any bytes, JSON only UTF-8.
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

void WritePoints(const fs::path& directory, int frame, const Points& points) {
  char name[32];
  std::snprintf(name, sizeof(name), "%06d.ply", frame);
  PlyMesh mesh;
  mesh.vertices = points;
  WritePly((directory / name).string(), mesh);
}

// Simulation from the T-pose to the last frame; fills `truth`.
class Recording {
 public:
  Recording(const ClothedSequenceScene& scene,
            const SceneOptions& physics,
            const ClothedSequenceOptions& options,
            const ClothedSequenceObserver& observer)
      : scene_(scene),
        options_(options),
        observer_(observer),
        simulator_(
            MakeSetup(physics, scene.body, scene.garment, scene.material)),
        frames_(scene.motion.Frames()) {}

  ClothedSequenceResult Run(Truth* truth) {
    ClothedSequenceResult made;
    made.relaxation =
        Relax({scene_.body, scene_.garment, frames_, scene_.motion.frame_rate},
              options_.relaxation,
              &simulator_,
              [&](const RelaxationFrame& f) {
                Tell("dressing", f.frame, f.most_frames, f.stats);
              });
    if (made.relaxation.status != RunStatus::kComplete) return made;
    ClothState cloth = made.relaxation.cloth;
    const int count = scene_.motion.num_frames();
    made.sequence = SimulateSequence(
        &simulator_,
        [&](int t) { return scene_.body.Vertices(frames_[t]); },
        count,
        scene_.motion.frame_rate,
        &cloth,
        [&](const SimulatedFrame& f) {
          truth->cloth.push_back(f.cloth.x);
          truth->cloth_velocities.push_back(f.cloth.v);
          Tell("frames", f.frame + 1, count, f.stats);
        });
    return made;
  }

 private:
  void Tell(const char* what, int done, int total, const FrameStats& stats) {
    if (observer_) observer_(what, done, total, stats);
  }

  const ClothedSequenceScene& scene_;
  const ClothedSequenceOptions& options_;
  const ClothedSequenceObserver& observer_;
  Simulator simulator_;
  std::vector<BodyParameters> frames_;
};

void WriteMeasurements(const ClothedSequenceScene& scene,
                       const ClothedSequenceOptions& options,
                       const Truth& truth,
                       const fs::path& directory) {
  fs::create_directories(directory);
  const Scanner scanner(scene.body.faces(),
                        scene.garment.faces,
                        options.measurement,
                        options.seed);
  Vector3d center = Vector3d::Zero();
  for (int t = 0; t < scene.motion.num_frames(); ++t) {
    const Points body = scene.body.Vertices(scene.motion.Frame(t));
    if (t == 0)
      center = 0.5 * (body.rowwise().minCoeff() + body.rowwise().maxCoeff());
    // The cloth as it can be read back, so that both agree to the last bit.
    const Points cloth = truth.cloth[t].cast<float>().cast<double>();
    WritePoints(directory, t, scanner.Measure(t, body, cloth, center).points);
  }
}

}  // namespace

void WriteGarment(const std::string& path, const Garment& garment) {
  ObjMesh mesh;
  mesh.vertices = garment.placed;
  mesh.faces = garment.faces;
  if (!garment.rest_angles_from_placed) {
    mesh.texture = garment.rest;
    mesh.texture_faces = garment.rest_faces;
  }
  WriteObj(path, mesh);
}

ClothedSequenceResult MakeClothedSequence(
    const ClothedSequenceScene& scene,
    const SceneOptions& physics,
    const ClothedSequenceOptions& options,
    const std::string& directory,
    const ClothedSequenceObserver& observer) {
  PrepareDirectory(directory, options.force, options.inputs);
  Truth truth;
  truth.body = scene.motion;
  const ClothedSequenceResult made =
      Recording(scene, physics, options, observer).Run(&truth);
  if (made.status() != RunStatus::kComplete) return made;
  const fs::path folder(directory);
  WriteFileBytes((folder / kResolvedConfig).string(), options.config);
  WriteMeasurements(scene, options, truth, folder / kPoints);
  WriteGarment((folder / "garment.obj").string(), scene.garment);
  WriteBodyModel((folder / "body_model.npz").string(), scene.body);
  WriteTruth((folder / "truth.npz").string(), truth);
  WriteFileBytes((folder / "scene.json").string(),
                 SceneJson(scene, physics, options, made));
  return made;
}

}  // namespace invsim
