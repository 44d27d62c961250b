// SPDX-License-Identifier: Apache-2.0
#include "invsim/report/simulation_writer.h"

#include <algorithm>

#include "invsim/io/glb.h"
#include "invsim/io/pc2.h"
#include "invsim/io/ply.h"
#include "invsim/report/frame_mesh.h"

namespace invsim {
namespace {

const Vector3d kSkin(0.80, 0.66, 0.57);
const Vector3d kFabric(0.25, 0.47, 0.66);

double Percentile99(const VectorXd& values) {
  std::vector<double> sorted(values.begin(), values.end());
  const auto at =
      sorted.begin() + static_cast<std::ptrdiff_t>(0.99 * (sorted.size() - 1));
  std::nth_element(sorted.begin(), at, sorted.end());
  return *at;
}

GlbMesh ForGlb(const PageMesh& mesh) {
  // The page's colours are as a screen takes them, glTF's are linear.
  return {
      mesh.name, mesh.faces, mesh.frames, mesh.color.array().pow(2.2).matrix()};
}

}  // namespace

void Describe(OptionTable* table, SimulationWriterOptions* o) {
  table->Add("ply",
             &o->ply,
             {.doc = "whether to write body/ and cloth/, one file per frame"});
  table->Add("most_poses",
             &o->most_poses,
             {.doc = "frames in report.html and scene.glb, at most",
              .at_least = 2,
              .at_most = 10000});
}

SimulationWriter::SimulationWriter(const RunFolder& folder,
                                   const Garment& garment,
                                   const Material& material,
                                   const Faces& body_faces,
                                   int frames_wanted,
                                   double frames_per_second,
                                   const SimulationWriterOptions& options)
    : folder_(folder),
      garment_(garment),
      material_(material),
      frames_per_second_(frames_per_second),
      options_(options),
      stride_((frames_wanted + options.most_poses - 1) / options.most_poses) {
  page_body_.name = "body";
  page_body_.faces = body_faces;
  page_body_.color = kSkin;
  page_body_.quantity = "pressure [Pa]";
  page_cloth_.name = "cloth";
  page_cloth_.faces = garment.faces;
  page_cloth_.color = kFabric;
  page_cloth_.quantity = "stress [N/m]";
}

void SimulationWriter::AddFrame(const SimulatedFrame& frame) {
  const ClothFields fields =
      MeasureCloth(garment_, material_.stretch, frame.cloth.x);
  const VectorXd pressure =
      Pressure(frame.body, page_body_.faces, frame.simulator.BodyForce());
  if (options_.ply) {
    WritePly(folder_.Frame("cloth", frame.frame),
             ClothFrame(frame.cloth,
                        garment_.faces,
                        frame.simulator.contact_force(),
                        fields));
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
  page_cloth_.values.push_back(fields.stress);
}

WebPage SimulationWriter::Page(const SimulationReport& report) {
  const FrameStats& sequence = report.sequence.stats;
  WebPage page;
  page.title = "Simulation: " + report.garment + " on " + report.body;
  page.lead = Verdict(report);
  page.facts = {
      {"body", report.body},
      {"motion", report.motion},
      {"garment", report.garment},
      {"material", report.material},
      {"cloth", std::to_string(report.cloth_vertices) + " vertices"},
      {"friction", ShortNumber(report.friction)},
      {"frames",
       std::to_string(report.sequence.frames) + " of " +
           std::to_string(report.frames_wanted) + ", " +
           ShortNumber(report.frames_per_second) + " per second"},
      {"steps", std::to_string(sequence.step.substeps)},
      {"steps missed", std::to_string(sequence.step.missed)},
      {"worst residual",
       ShortNumber(sequence.step.worst_residual) + " of a vertex's weight"},
      {"penetration", ShortNumber(1000 * sequence.penetration.deepest) + " mm"},
      {"time for the sequence", ShortNumber(sequence.seconds) + " s"}};
  page.charts = SimulationCharts(report);
  page.times = page_times_;
  if (!page_times_.empty())
    page.meshes = {std::move(page_cloth_), std::move(page_body_)};
  page.details = SimulationText(report);
  return page;
}

void SimulationWriter::Finish(SimulationReport* report) {
  report->frames = stats_;
  report->stress = stress_;
  folder_.Write("report.json", SimulationJson(*report));
  folder_.Write("solver.txt", SimulationText(*report));
  if (!cloth_.empty()) {
    WritePc2(folder_.File("cloth.pc2"), {std::move(cloth_), 0, 1});
    GlbOptions glb;
    glb.frames_per_second = frames_per_second_ / stride_;
    glb.most_poses = options_.most_poses;
    WriteGlb(folder_.File("scene.glb"),
             {ForGlb(page_body_), ForGlb(page_cloth_)},
             glb);
  }
  folder_.Write("report.html", FormatWebPage(Page(*report)));
}

}  // namespace invsim
