// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_CLOTH_MATERIAL_FILE_H_
#define INVSIM_CLOTH_MATERIAL_FILE_H_

#include <string>
#include <string_view>

#include "invsim/cloth/material.h"

namespace invsim {

// Reads a measured fabric in the format of ARCSim, a JSON object with
//   density     kg/m^2
//   stretching  6 x 4, N/m   (MeasuredStretch)
//   bending     3 x 5, N m   (MeasuredBending)
// Other members are ignored. The material is named after the file. Throws
// InputError naming the file and the member.
Material ReadMaterial(const std::string& path);
// The same of a file's bytes; `path` names the material and opens messages.
Material ParseMaterial(std::string_view json, const std::string& path);

}  // namespace invsim

#endif  // INVSIM_CLOTH_MATERIAL_FILE_H_
