// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SRC_GEOMETRY_EMBREE_DEVICE_H_
#define INVSIM_SRC_GEOMETRY_EMBREE_DEVICE_H_

#include <embree3/rtcore.h>

namespace invsim {

// One device serves the process. No thread count is given: Embree would cap
// TBB for the whole process.
inline RTCDevice EmbreeDevice() {
  static const RTCDevice device = rtcNewDevice(nullptr);
  return device;
}

}  // namespace invsim

#endif  // INVSIM_SRC_GEOMETRY_EMBREE_DEVICE_H_
