// SPDX-License-Identifier: Apache-2.0
#include "invsim/fit/input_digests.h"

#include "invsim/base/digest.h"

namespace invsim {
namespace {

template <typename... Values>
std::string Of(const Values&... values) {
  Digest digest;
  (digest.Add(values), ...);
  return digest.text();
}

void Add(const IsotropicStretch& s, Digest* digest) {
  digest->Add(s.stiffness);
  digest->Add(s.poisson);
}

void Add(const OrthotropicStretch& s, Digest* digest) {
  for (const double c : {s.c11, s.c12, s.c22, s.c33}) digest->Add(c);
}

void Add(const MeasuredStretch& s, Digest* digest) {
  for (const auto& row : s.table) digest->Add(std::span<const double>(row));
}

void Add(const IsotropicBending& b, Digest* digest) {
  digest->Add(b.stiffness);
}

void Add(const MeasuredBending& b, Digest* digest) {
  for (const auto& row : b.table) digest->Add(std::span<const double>(row));
}

}  // namespace

std::string DigestOf(const std::string& text) {
  return Of(std::string_view(text));
}

std::string DigestOf(const Points& points) { return Of(points); }

std::string DigestOf(const BodyModel& body) {
  const BodyModelData& d = body.data();
  return Of(d.v_template,
            d.shapedirs,
            d.posedirs,
            d.joint_regressor,
            d.weights,
            std::span<const int>(d.parents),
            d.faces);
}

std::string DigestOf(const Garment& garment) {
  return Of(garment.placed,
            garment.faces,
            garment.rest,
            garment.rest_faces,
            static_cast<int>(garment.rest_angles_from_placed));
}

std::string DigestOf(const Material& material) {
  Digest digest;
  digest.Add(material.density);
  digest.Add(material.friction);
  const auto add = [&](const auto& model) {
    digest.Add(static_cast<int>(model.index()));
    std::visit([&](const auto& figures) { Add(figures, &digest); }, model);
  };
  add(material.stretch);
  add(material.bending);
  return digest.text();
}

std::string DigestOf(const BodySequence& sequence) {
  Digest digest;
  digest.Add(sequence.shape);
  for (const PoseVector& pose : sequence.poses) digest.Add(pose);
  for (const Vector3d& translation : sequence.translations)
    digest.Add(translation);
  return digest.text();
}

std::string DigestOf(const ClothReference& reference) {
  return Of(reference.body, reference.cloth.x, reference.cloth.v);
}

}  // namespace invsim
