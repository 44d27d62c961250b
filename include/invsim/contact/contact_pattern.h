// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_CONTACT_CONTACT_PATTERN_H_
#define INVSIM_CONTACT_CONTACT_PATTERN_H_

// The pattern of a matrix to which contacts add G^T (...) G.
//
// A contact of one vertex adds to its diagonal block only. One of the cloth
// with itself couples vertices that are no neighbours: the pattern of the
// effects is widened by its blocks, and what is factorised analysed anew (about
// the time of one factorisation). So that this is not paid in every step,
// blocks once needed are kept while not more of them lie idle than are in use.

#include <memory>
#include <vector>

#include "invsim/algebra/block_matrix.h"
#include "invsim/contact/contact.h"

namespace invsim {

class ContactPattern {
 public:
  // `base`: of the effects, always contained.
  explicit ContactPattern(std::shared_ptr<const BlockPattern> base)
      : base_(base), pattern_(std::move(base)) {}

  // Makes pattern() hold the blocks of all contacts. True if it changed.
  bool Cover(const std::vector<Contact>& contacts);
  // Back to the base. True if it changed.
  bool Reset();

  const std::shared_ptr<const BlockPattern>& pattern() const {
    return pattern_;
  }

 private:
  std::shared_ptr<const BlockPattern> base_, pattern_;
};

}  // namespace invsim

#endif  // INVSIM_CONTACT_CONTACT_PATTERN_H_
