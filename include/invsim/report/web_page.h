// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_REPORT_WEB_PAGE_H_
#define INVSIM_REPORT_WEB_PAGE_H_

// A report as one HTML file that opens from disk, without a server or a
// network: facts, charts, and a viewer that turns and plays the meshes.
//
// Meshes are embedded as base64: positions in 16 bits of the box that holds
// all frames (0.06 mm in 4 m), a quantity per vertex in 8 bits of its range.
// At 60 poses of 10,000 vertices that is about 6 MB.

#include <string>
#include <utility>
#include <vector>

#include "invsim/base/types.h"
#include "invsim/report/chart.h"

namespace invsim {

// A mesh over time and, optionally, one quantity per vertex to colour it by.
struct PageMesh {
  std::string name;
  Faces faces;
  std::vector<Points> frames;
  Vector3d color = {0.7, 0.7, 0.7};  // red, green, blue in [0, 1]
  std::string quantity;              // "stress [N/m]"; "": none
  std::vector<VectorXd> values;      // one per frame
  // m, drawn so much further from the eye than it is: a garment touches skin
  // with its vertices, and the skin would show through faces that cut corners.
  double behind = 0;
};

struct WebPage {
  std::string title;
  std::string lead;  // one sentence: what came out
  std::vector<std::pair<std::string, std::string>> facts;
  std::vector<Chart> charts;
  std::vector<double> times;  // s, of the frames; where the charts' cursors go
  std::vector<PageMesh> meshes;  // with one frame per time; none: no viewer
  std::string details;           // preformatted text at the end
};

// Throws Error (internal) if the arrays do not fit together.
std::string FormatWebPage(const WebPage& page);

}  // namespace invsim

#endif  // INVSIM_REPORT_WEB_PAGE_H_
