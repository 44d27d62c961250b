// SPDX-License-Identifier: Apache-2.0
#include "slipped_vertices.h"

#include "invsim/geometry/closest_point.h"

namespace invsim {

std::vector<int> OffTheirFaces(const BodyContactOptions& options,
                               double dt,
                               const Faces& body_faces,
                               const Points& body1,
                               const Points& x1,
                               const Points& v1,
                               const std::vector<Contact>& contacts,
                               const std::vector<BodyContact>& sources) {
  enum : char { kNoContact, kOff, kHeld };
  std::vector<char> how(x1.cols(), kNoContact);
  for (const BodyContact& source : sources) {
    const int i = source.vertex;
    const Contact& c = contacts[source.contact];
    // Above the plane of the thickness.
    const double above = dt * c.normal.dot(v1.col(i) - c.velocity);
    bool held = above < -kLetIn;
    if (!held && source.feature == TriangleFeature::kFace &&
        above <= options.thickness) {
      const auto corner = [&](int k) {
        return body1.col(body_faces(k, source.face));
      };
      held = ClosestPointOnTriangle(x1.col(i), corner(0), corner(1), corner(2))
                 .feature == TriangleFeature::kFace;
    }
    if (how[i] != kHeld) how[i] = held ? kHeld : kOff;
  }
  std::vector<int> off;
  for (size_t i = 0; i < how.size(); ++i)
    if (how[i] == kOff) off.push_back(static_cast<int>(i));
  return off;
}

}  // namespace invsim
