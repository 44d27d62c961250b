// SPDX-License-Identifier: Apache-2.0
#include "invsim/sim/scene.h"

#include <algorithm>
#include <sstream>

#include "invsim/base/error.h"
#include "invsim/cloth/mass.h"
#include "invsim/geometry/surface_index.h"

namespace invsim {
namespace {

constexpr double kMostInside = 0.25;  // share of the garment's vertices
constexpr double kNear = 0.1;         // m

}  // namespace

SceneOptions::SceneOptions() {
  for (const std::string& name : Effects().names())
    effect_options[name] = Effects().Choose(name);
}

void Describe(OptionTable* table, SceneOptions* o) {
  std::vector<std::string> names = Effects().names();
  names.push_back(kAutoEffects);
  table->Add("scene.effects",
             &o->effects,
             {.doc = "what acts on the cloth; nothing else is computed. auto: "
                     "what the scene calls for",
              .choices = names});
  table->Add("scene.material",
             &o->material,
             {.doc = "a named material, or the path of an ARCSim material"});
  for (const std::string& name : Effects().names())
    table->AddSection("effects." + name, o->effect_options.at(name).get());
  table->AddSection("contact", &o->contact);
  table->AddSection("step", &o->step);
}

void UseMaterialFriction(const OptionTable& table,
                         const Material& material,
                         SceneOptions* options) {
  if (!table.IsSet("contact.friction"))
    options->contact.friction = material.friction;
}

std::vector<std::string> ChosenEffects(const SceneOptions& options,
                                       const Garment& garment,
                                       const Material& material) {
  const std::vector<std::string>& list = options.effects;
  for (size_t k = 0; k < list.size(); ++k) {
    if (list[k] == kAutoEffects) {
      if (list.size() > 1)
        throw UsageError("scene.effects: 'auto' stands alone, not in a list");
      return EffectsOn(
          options.decisions.empty()
              ? DecideEffects(options, garment, material, SceneMotion())
              : options.decisions);
    }
    if (std::find(list.begin(), list.begin() + k, list[k]) != list.begin() + k)
      throw UsageError("effect '" + list[k] + "' is listed twice");
    if (!options.effect_options.contains(list[k]))
      throw UsageError(UnknownName("effect", list[k], Effects().names()));
  }
  return list;
}

SimulatorSetup MakeSetup(const SceneOptions& options,
                         const TriangleMesh& body,
                         const Garment& garment,
                         const Material& material) {
  SimulatorSetup setup;
  setup.faces = garment.faces;
  setup.cloth = garment.placed;
  setup.mass = VertexMasses(garment, material);
  for (const std::string& name : ChosenEffects(options, garment, material))
    setup.effects.push_back(
        options.effect_options.at(name)->Make(garment, material));
  setup.contact = options.contact;
  setup.step = options.step;
  setup.body_faces = body.faces;
  setup.body = body.vertices;
  return setup;
}

SimulatorSetup MakeSetup(const SceneOptions& options,
                         const BodyModel& body,
                         const Garment& garment,
                         const Material& material) {
  return MakeSetup(options,
                   TriangleMesh{body.Vertices({}), body.faces()},
                   garment,
                   material);
}

void CheckGarmentFits(const Garment& garment,
                      const BodyModel& body,
                      const ShapeVector& shape,
                      const std::string& name) {
  BodyParameters t_pose;
  t_pose.shape = shape;
  SurfaceIndex surface(body.Vertices(t_pose), body.faces());
  int inside = 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (const SurfacePoint& p : surface.NearestAll(garment.placed)) {
    inside += p.signed_distance < 0;
    nearest = std::min(nearest, std::abs(p.signed_distance));
  }
  const int n = garment.num_vertices();
  std::ostringstream text;
  text << name << ": ";
  if (inside > kMostInside * n) {
    text << inside << " of its " << n << " vertices are inside the body";
  } else if (nearest > kNear) {
    text << "its nearest vertex is " << nearest << " m from the body";
  } else {
    return;
  }
  text << "; expected a garment placed around the T-posed body, in metres";
  throw InputError(text.str());
}

}  // namespace invsim
