// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_APPS_INSPECTION_H_
#define INVSIM_APPS_INSPECTION_H_

// What a file or directory is, and whether it can be used.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace invsim {

struct Inspection {
  std::string kind;  // "body model", "garment", "point cloud", ...
  // Numbers, texts and lists of numbers, by name.
  nlohmann::ordered_json facts = nlohmann::ordered_json::object();
  // Why it cannot be used, in one line; empty if it can.
  std::string problem = "";
  // What is odd about it but does not prevent its use.
  std::vector<std::string> warnings = {};
};

// Knows body models and motions (npz), garments and meshes (obj), point clouds
// (ply pcd obj xyz txt npy), directories of them, point caches (pc2), cloth
// materials (json) and run folders. Throws InputError if it is none of them,
// is damaged, or is not there.
Inspection Inspect(const std::string& path);

}  // namespace invsim

#endif  // INVSIM_APPS_INSPECTION_H_
