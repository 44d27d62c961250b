// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SRC_CONTACT_SLIPPED_VERTICES_H_
#define INVSIM_SRC_CONTACT_SLIPPED_VERTICES_H_

// Which cloth vertices may have slipped past the faces that hold them.
//
// A contact is a plane, that of the face or edge nearest to the vertex when the
// step begins. Where the body is convex it serves wherever the vertex slides
// to. Where it is hollow the next face rises above that plane, and a vertex
// that slides on to it within the step ends inside the body with every contact
// satisfied.

#include <vector>

#include "invsim/contact/body_contact.h"

namespace invsim {

// Vertices no deeper inside than this need no further contact, m.
inline constexpr double kLetIn = 1e-4;

// Those with contacts that end a step, at x1 = x0 + dt v1 on `body1`, over none
// of the faces that hold them. Not among them is what was pressed through a
// plane by more than kLetIn: it is held by that, and not enough.
std::vector<int> OffTheirFaces(const BodyContactOptions& options,
                               double dt,
                               const Faces& body_faces,
                               const Points& body1,
                               const Points& x1,
                               const Points& v1,
                               const std::vector<Contact>& contacts,
                               const std::vector<BodyContact>& sources);

}  // namespace invsim

#endif  // INVSIM_SRC_CONTACT_SLIPPED_VERTICES_H_
