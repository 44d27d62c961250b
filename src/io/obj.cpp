// SPDX-License-Identifier: Apache-2.0
#include "invsim/io/obj.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <limits>
#include <vector>

#include "invsim/base/error.h"
#include "invsim/io/file.h"
#include "invsim/io/text_format.h"
#include "invsim/io/text_scanner.h"

namespace invsim {
namespace {

// One corner of a face, indices from 0; texture -1: the corner names no vt.
struct Corner {
  std::int64_t vertex;
  std::int64_t texture;
};

class ObjParser {
 public:
  ObjParser(std::string_view bytes, const std::string& name)
      : name_(name), scanner_(bytes, name, '#', '\\') {}

  ObjMesh Parse() {
    while (scanner_.NextLine()) ParseStatement(scanner_.Word());
    if (vertices_.empty()) {
      throw InputError(name_ + ": no vertex: expected lines 'v x y z'");
    }
    CheckIndices();
    return Mesh();
  }

 private:
  std::int64_t num_vertices() const { return vertices_.size() / 3; }
  std::int64_t num_texture() const { return texture_.size() / 2; }

  void ParseStatement(std::string_view keyword) {
    if (keyword == "v") {
      for (const char* axis : {"x of v", "y of v", "z of v"}) {
        vertices_.push_back(scanner_.Number(axis));
      }
    } else if (keyword == "vt") {
      for (const char* axis : {"u of vt", "v of vt"}) {
        texture_.push_back(scanner_.Number(axis));
      }
    } else if (keyword == "f") {
      ParseFace();
    } else if (!std::all_of(keyword.begin(), keyword.end(), [](char c) {
                 return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
               })) {
      // Statements we do not need are words; this is some other kind of file.
      scanner_.Fail(Quoted(keyword), "expected a statement of an OBJ file");
    }
  }

  void ParseFace() {
    corners_.clear();
    for (std::string_view word = scanner_.Word(); !word.empty();
         word = scanner_.Word()) {
      corners_.push_back(ParseCorner(word));
    }
    if (corners_.size() < 3) {
      scanner_.Fail(std::to_string(corners_.size()) + " corners",
                    "expected a face of three or more");
    }
    for (const Corner& corner : corners_) {
      if (first_face_line_ == 0) {
        first_face_line_ = scanner_.line();
        has_texture_ = corner.texture >= 0;
      }
      if ((corner.texture >= 0) != has_texture_) FailMixedTexture();
    }
    for (std::size_t k = 1; k + 1 < corners_.size(); ++k) {
      triangles_.push_back({corners_[0], corners_[k], corners_[k + 1]});
      triangle_lines_.push_back(scanner_.line());
    }
  }

  // v, v/vt, v//vn or v/vt/vn.
  Corner ParseCorner(std::string_view word) {
    const std::size_t slash = word.find('/');
    Corner corner{Index(word.substr(0, slash), num_vertices(), "vertex"), -1};
    if (slash == std::string_view::npos) return corner;
    std::string_view rest = word.substr(slash + 1);
    const std::size_t second = rest.find('/');
    const std::string_view texture = rest.substr(0, second);
    if (!texture.empty()) {
      corner.texture = Index(texture, num_texture(), "vt");
    }
    if (second == std::string_view::npos) {
      if (texture.empty()) scanner_.Fail(Quoted(word), "expected v/vt");
      return corner;
    }
    scanner_.ToInteger(rest.substr(second + 1), "normal of a face corner");
    return corner;
  }

  // From 1, or from -1 backwards over the `count` elements read so far. A
  // forward reference is fine, so the upper end is checked when all is read.
  std::int64_t Index(std::string_view word,
                     std::int64_t count,
                     const char* what) {
    const std::int64_t index = scanner_.ToInteger(word, what);
    if (index > 0) return index - 1;
    if (index == 0 || index < -count) {
      scanner_.Fail(Quoted(word),
                    std::string("expected a ") + what + " number from 1, or " +
                        "one of the " + std::to_string(count) + " so far");
    }
    return count + index;
  }

  [[noreturn]] void FailMixedTexture() const {
    const std::string first =
        "like the face of line " + std::to_string(first_face_line_);
    if (has_texture_) {
      scanner_.Fail("corner without vt", "expected v/vt " + first);
    }
    scanner_.Fail("corner with vt", "expected none " + first);
  }

  void CheckIndices() const {
    CheckCount(num_vertices(), "vertices");
    CheckCount(num_texture(), "vt");
    for (std::size_t f = 0; f < triangles_.size(); ++f) {
      for (const Corner& corner : triangles_[f]) {
        CheckRange(corner.vertex, num_vertices(), "vertex", f);
        CheckRange(corner.texture, num_texture(), "vt", f);
      }
    }
  }

  void CheckCount(std::int64_t count, const char* what) const {
    if (count > std::numeric_limits<int>::max()) {
      throw InputError(name_ + ": " + std::to_string(count) + " " + what +
                       ": expected fewer than 2^31");
    }
  }

  void CheckRange(std::int64_t index,
                  std::int64_t count,
                  const char* what,
                  std::size_t triangle) const {
    if (index < count) return;
    throw InputError(name_ + ":" + std::to_string(triangle_lines_[triangle]) +
                     ": " + what + " " + std::to_string(index + 1) +
                     ": expected 1 to " + std::to_string(count));
  }

  ObjMesh Mesh() const {
    ObjMesh mesh;
    mesh.vertices =
        Eigen::Map<const Points>(vertices_.data(), 3, num_vertices());
    mesh.texture = Eigen::Map<const Points2>(texture_.data(), 2, num_texture());
    const auto num_faces = static_cast<Eigen::Index>(triangles_.size());
    mesh.faces.resize(3, num_faces);
    mesh.texture_faces.resize(3, has_texture_ ? num_faces : 0);
    for (Eigen::Index f = 0; f < num_faces; ++f) {
      for (int c = 0; c < 3; ++c) {
        const Corner& corner = triangles_[f][c];
        mesh.faces(c, f) = static_cast<int>(corner.vertex);
        if (has_texture_) {
          mesh.texture_faces(c, f) = static_cast<int>(corner.texture);
        }
      }
    }
    return mesh;
  }

  const std::string& name_;
  TextScanner scanner_;
  std::vector<double> vertices_;  // x y z x y z ...
  std::vector<double> texture_;   // u v u v ...
  std::vector<std::array<Corner, 3>> triangles_;
  std::vector<int> triangle_lines_;
  std::vector<Corner> corners_;  // of the face being read
  int first_face_line_ = 0;
  bool has_texture_ = false;
};

}  // namespace

ObjMesh ParseObj(std::string_view bytes, const std::string& name) {
  return ObjParser(bytes, name).Parse();
}

ObjMesh ReadObj(const std::string& path) {
  return ParseObj(ReadFileBytes(path), path);
}

std::string FormatObj(const ObjMesh& mesh) {
  std::string text;
  for (Eigen::Index i = 0; i < mesh.vertices.cols(); ++i) {
    text += 'v';
    for (int c = 0; c < 3; ++c) AppendNumber(' ', mesh.vertices(c, i), &text);
    text += '\n';
  }
  for (Eigen::Index i = 0; i < mesh.texture.cols(); ++i) {
    text += "vt";
    for (int c = 0; c < 2; ++c) AppendNumber(' ', mesh.texture(c, i), &text);
    text += '\n';
  }
  const bool has_texture = mesh.texture_faces.cols() > 0;
  for (Eigen::Index f = 0; f < mesh.faces.cols(); ++f) {
    text += 'f';
    for (int c = 0; c < 3; ++c) {
      AppendNumber(' ', mesh.faces(c, f) + 1, &text);
      if (has_texture) AppendNumber('/', mesh.texture_faces(c, f) + 1, &text);
    }
    text += '\n';
  }
  return text;
}

void WriteObj(const std::string& path, const ObjMesh& mesh) {
  WriteFileBytes(path, FormatObj(mesh));
}

}  // namespace invsim
