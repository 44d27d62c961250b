// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_CLOTH_NAMED_MATERIALS_H_
#define INVSIM_CLOTH_NAMED_MATERIALS_H_

// Materials by name. Their figures are typical of a kind of fabric, not
// measurements of one piece; docs/materials.md derives every figure from its
// source and says which are our own estimate.

#include <string>
#include <vector>

#include "invsim/cloth/material.h"

namespace invsim {

const std::vector<Material>& NamedMaterials();

// A named material, or, if `name_or_path` ends in ".json", that file (see
// material_file.h). Throws UsageError with the nearest name, or InputError.
Material FindMaterial(const std::string& name_or_path);

}  // namespace invsim

#endif  // INVSIM_CLOTH_NAMED_MATERIALS_H_
