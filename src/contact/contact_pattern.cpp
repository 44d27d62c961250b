// SPDX-License-Identifier: Apache-2.0
#include "invsim/contact/contact_pattern.h"

#include <span>

namespace invsim {
namespace {

// Blocks beyond the base that are kept, in units of those in use.
constexpr int kKept = 2;

std::span<const int> Stencil(const Contact& c) {
  return {c.vertex.data(), static_cast<size_t>(c.num_vertices)};
}

std::shared_ptr<const BlockPattern> Widened(
    const BlockPattern& pattern, const std::vector<Contact>& contacts) {
  BlockPatternBuilder builder(pattern);
  for (const Contact& c : contacts)
    if (c.num_vertices > 1) builder.AddStencil(Stencil(c));
  return builder.Build();
}

}  // namespace

bool ContactPattern::Cover(const std::vector<Contact>& contacts) {
  bool covered = true;
  for (const Contact& c : contacts)
    covered = covered && (c.num_vertices == 1 || pattern_->Holds(Stencil(c)));
  if (covered) return false;
  const auto needed = Widened(*base_, contacts);
  const auto kept = Widened(*pattern_, contacts);
  const int in_use = needed->num_blocks() - base_->num_blocks();
  const int all = kept->num_blocks() - base_->num_blocks();
  pattern_ = all <= kKept * in_use ? kept : needed;
  return true;
}

bool ContactPattern::Reset() {
  const bool changed = pattern_ != base_;
  pattern_ = base_;
  return changed;
}

}  // namespace invsim
