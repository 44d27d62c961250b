// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_IO_LZF_H_
#define INVSIM_IO_LZF_H_

// LZF, the compression inside PCD files: a byte c < 32 is followed by c + 1
// bytes taken as they are; c >= 32 stands for a run copied from the output:
// its top three bits are the length less two (7: a byte to add follows), its
// low five bits and the next byte the distance back less one.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace invsim {

// The `size` bytes that `packed` stands for; nothing if it is damaged or
// stands for another number of bytes. No three packed bytes stand for more
// than 264, so memory is bounded by the input.
std::optional<std::string> UnpackLzf(std::string_view packed, std::size_t size);

}  // namespace invsim

#endif  // INVSIM_IO_LZF_H_
