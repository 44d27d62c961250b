// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_REPORT_BASE64_H_
#define INVSIM_REPORT_BASE64_H_

#include <string>
#include <string_view>

namespace invsim {

// Bytes as text (RFC 4648, with padding), to embed them in a page.
std::string Base64(std::string_view bytes);

}  // namespace invsim

#endif  // INVSIM_REPORT_BASE64_H_
