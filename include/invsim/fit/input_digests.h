// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_FIT_INPUT_DIGESTS_H_
#define INVSIM_FIT_INPUT_DIGESTS_H_

// What a fit is made from, as digests (base/digest.h): a checkpoint keeps them
// so that a fit that goes on is known to be the one that was begun.

#include <map>
#include <string>

#include "invsim/body/body_model.h"
#include "invsim/cloth/garment.h"
#include "invsim/cloth/material.h"
#include "invsim/fit/body_sequence.h"
#include "invsim/fit/cloth_rollout.h"

namespace invsim {

// By the name a message gives it: "the garment", "the points of frame 3".
using InputDigests = std::map<std::string, std::string>;

std::string DigestOf(const std::string& text);
std::string DigestOf(const Points& points);
std::string DigestOf(const BodyModel& body);
std::string DigestOf(const Garment& garment);
// Of its figures, whatever it is called.
std::string DigestOf(const Material& material);
std::string DigestOf(const BodySequence& sequence);
std::string DigestOf(const ClothReference& reference);

}  // namespace invsim

#endif  // INVSIM_FIT_INPUT_DIGESTS_H_
