// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_REPORT_FRAME_WRITER_H_
#define INVSIM_REPORT_FRAME_WRITER_H_

// Body and cloth of every frame into a run folder, and what a page and its
// viewer need of them:
//
//   body/%06d.ply, cloth/%06d.ply   as each frame is done (frame_mesh.h)
//   cloth.pc2, scene.glb            at the end

#include <vector>

#include "invsim/cloth/garment.h"
#include "invsim/cloth/material.h"
#include "invsim/report/run_folder.h"
#include "invsim/report/web_page.h"
#include "invsim/sim/rollout.h"

namespace invsim {

struct FrameWriterOptions {
  bool ply = true;  // body/ and cloth/
  // Of a long sequence the page and scene.glb hold at most so many frames,
  // evenly spaced: they are for looking at.
  int most_poses = 60;
};
void Describe(OptionTable* table, FrameWriterOptions* options);

class FrameWriter {
 public:
  // All but `options` must outlive the writer; `frames_wanted` and
  // `frames_per_second` are the sequence's.
  FrameWriter(const RunFolder& folder,
              const Garment& garment,
              const Material& material,
              const Faces& body_faces,
              int frames_wanted,
              double frames_per_second,
              const FrameWriterOptions& options);

  // With the measured points of the frame (3 x P; null: there are none) the
  // cloth also carries each vertex's distance to the nearest of them.
  // Throws InputError if a file cannot be written.
  void AddFrame(const SimulatedFrame& frame, const Points* measured = nullptr);

  // cloth.pc2 and scene.glb; nothing if there was no frame.
  void WriteSequence() const;

  const std::vector<FrameStats>& stats() const { return stats_; }
  // Per frame, 99th percentile over the cloth, N/m.
  const std::vector<double>& stress() const { return stress_; }

  // For the viewer; moves the meshes out.
  void AddViewer(WebPage* page);

 private:
  const RunFolder& folder_;
  const Garment& garment_;
  const Material& material_;
  const double frames_per_second_;
  const FrameWriterOptions options_;
  int stride_;  // of the frames kept for looking at
  std::vector<Points> cloth_;
  std::vector<FrameStats> stats_;
  std::vector<double> stress_;
  std::vector<double> page_times_;
  PageMesh page_body_, page_cloth_;
};

}  // namespace invsim

#endif  // INVSIM_REPORT_FRAME_WRITER_H_
