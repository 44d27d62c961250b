// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_IO_PLY_BODY_H_
#define INVSIM_IO_PLY_BODY_H_

// The numbers that follow a PLY header, one after the other, whatever the
// format. The reader walks through the header's elements and asks:
//
//   for each element  { BeginElement;
//     for each row    { BeginRow; Real or Integer for each value; EndRow; } }
//   Finish;
//
// Every call throws InputError naming file, element and row if the bytes are
// not what the header promises.

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "invsim/io/ply_header.h"

namespace invsim {

class PlyBody {
 public:
  virtual ~PlyBody() = default;

  // Refuses a count for which the bytes left cannot suffice, so that memory
  // for `element.count` rows may be taken afterwards.
  virtual void BeginElement(const PlyElementHeader& element) = 0;
  virtual void BeginRow() = 0;
  // The next value, of the given type, named `name` in complaints.
  virtual double Real(PlyType type, const std::string& name) = 0;
  virtual std::int64_t Integer(PlyType type, const std::string& name) = 0;
  virtual void EndRow() = 0;
  // Refuses anything left over.
  virtual void Finish() = 0;

  // Throws InputError "file: element ROW (from 0) of COUNT: ...".
  [[noreturn]] virtual void Fail(const std::string& value,
                                 const std::string& expectation) const = 0;
};

// `bytes` is the whole file; all arguments must outlive the body.
std::unique_ptr<PlyBody> OpenPlyBody(std::string_view bytes,
                                     const PlyHeader& header,
                                     const std::string& name);

}  // namespace invsim

#endif  // INVSIM_IO_PLY_BODY_H_
