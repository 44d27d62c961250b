// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/named_materials.h"

#include <gtest/gtest.h>

#include "invsim/base/error.h"

namespace invsim {
namespace {

TEST(NamedMaterials, AreValidAndDocumented) {
  EXPECT_GE(NamedMaterials().size(), 6u);
  for (const Material& material : NamedMaterials()) {
    EXPECT_NO_THROW(ValidateMaterial(material, material.name));
    EXPECT_FALSE(material.doc.empty()) << material.name;
    EXPECT_EQ(FindMaterial(material.name).density, material.density);
  }
}

TEST(FindMaterial, RefusesUnknownNamesWithTheNearest) {
  try {
    FindMaterial("denin");
    FAIL() << "accepted";
  } catch (const UsageError& error) {
    EXPECT_STREQ(error.what(),
                 "unknown material 'denin'; did you mean 'denim'?");
  }
  EXPECT_THROW(FindMaterial("nowhere.json"), InputError);
}

}  // namespace
}  // namespace invsim
