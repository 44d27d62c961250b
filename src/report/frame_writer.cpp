// SPDX-License-Identifier: Apache-2.0
#include "invsim/report/frame_writer.h"

#include <algorithm>

#include "invsim/base/options.h"
#include "invsim/geometry/kd_tree.h"
#include "invsim/io/glb.h"
#include "invsim/io/pc2.h"
#include "invsim/io/ply.h"
#include "invsim/report/frame_mesh.h"

namespace invsim {
namespace {

const Vector3d kSkin(0.80, 0.66, 0.57);
constexpr double kSkinBehind = 0.006;  // m, on the page
const Vector3d kFabric(0.25, 0.47, 0.66);

double Percentile99(const VectorXd& values) {
  std::vector<double> sorted(values.begin(), values.end());
  const auto at =
      sorted.begin() + static_cast<std::ptrdiff_t>(0.99 * (sorted.size() - 1));
  std::nth_element(sorted.begin(), at, sorted.end());
  return *at;
}

VectorXd Distances(const Points& from, const Points& to) {
  const std::vector<Neighbour> nearest = KdTree(to).NearestAll(from);
  VectorXd distance(from.cols());
  for (int i = 0; i < from.cols(); ++i)
    distance[i] = (from.col(i) - to.col(nearest[i].index)).norm();
  return distance;
}

GlbMesh ForGlb(const PageMesh& mesh) {
  // The page's colours are as a screen takes them, glTF's are linear.
  return {
      mesh.name, mesh.faces, mesh.frames, mesh.color.array().pow(2.2).matrix()};
}

}  // namespace

void Describe(OptionTable* table, FrameWriterOptions* o) {
  table->Add("ply",
             &o->ply,
             {.doc = "whether to write body/ and cloth/, one file per frame"});
  table->Add("most_poses",
             &o->most_poses,
             {.doc = "frames in report.html and scene.glb, at most",
              .at_least = 2,
              .at_most = 10000});
}

FrameWriter::FrameWriter(const RunFolder& folder,
                         const Garment& garment,
                         const Material& material,
                         const Faces& body_faces,
                         int frames_wanted,
                         double frames_per_second,
                         const FrameWriterOptions& options)
    : folder_(folder),
      garment_(garment),
      material_(material),
      frames_per_second_(frames_per_second),
      options_(options),
      stride_(std::max(
          1, (frames_wanted + options.most_poses - 1) / options.most_poses)) {
  page_body_.name = "body";
  page_body_.faces = body_faces;
  page_body_.color = kSkin;
  page_body_.behind = kSkinBehind;
  page_body_.quantity = "pressure [Pa]";
  page_cloth_.name = "cloth";
  page_cloth_.faces = garment.faces;
  page_cloth_.color = kFabric;
  page_cloth_.quantity = "stress [N/m]";
}

void FrameWriter::AddFrame(const SimulatedFrame& frame,
                           const Points* measured) {
  const ClothFields fields =
      MeasureCloth(garment_, material_.stretch, frame.cloth.x);
  const VectorXd pressure =
      Pressure(frame.body, page_body_.faces, frame.simulator.BodyForce());
  VectorXd distance;
  if (measured) distance = Distances(frame.cloth.x, *measured);
  if (options_.ply) {
    PlyMesh cloth = ClothFrame(
        frame.cloth, garment_.faces, frame.simulator.contact_force(), fields);
    if (measured) cloth.AddScalar("distance", distance);
    WritePly(folder_.Frame("cloth", frame.frame), cloth);
    WritePly(folder_.Frame("body", frame.frame),
             BodyFrame(frame.body, page_body_.faces, pressure));
  }
  cloth_.push_back(frame.cloth.x);
  stats_.push_back(frame.stats);
  stress_.push_back(Percentile99(fields.stress));
  if (frame.frame % stride_ != 0) return;
  page_times_.push_back(frame.frame / frames_per_second_);
  page_body_.frames.push_back(frame.body);
  page_body_.values.push_back(pressure);
  page_cloth_.frames.push_back(frame.cloth.x);
  if (measured) page_cloth_.quantity = "distance to the points [mm]";
  page_cloth_.values.push_back(measured ? VectorXd(1000 * distance)
                                        : fields.stress);
}

void FrameWriter::WriteSequence() const {
  if (cloth_.empty()) return;
  WritePc2(folder_.File("cloth.pc2"), {cloth_, 0, 1});
  GlbOptions glb;
  glb.frames_per_second = frames_per_second_ / stride_;
  glb.most_poses = options_.most_poses;
  WriteGlb(folder_.File("scene.glb"),
           {ForGlb(page_body_), ForGlb(page_cloth_)},
           glb);
}

void FrameWriter::AddViewer(WebPage* page) {
  page->times = page_times_;
  if (!page_times_.empty())
    page->meshes = {std::move(page_cloth_), std::move(page_body_)};
}

}  // namespace invsim
