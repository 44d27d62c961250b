// SPDX-License-Identifier: Apache-2.0
#include "invsim/io/ply.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "invsim/base/error.h"
#include "invsim/io/file.h"
#include "invsim/io/ply_body.h"
#include "invsim/io/text_scanner.h"

namespace invsim {
namespace {

int AxisOf(const std::string& name) {
  return name == "x" ? 0 : name == "y" ? 1 : name == "z" ? 2 : -1;
}

// Fills a PlyMesh from the rows of a file.
class PlyParser {
 public:
  PlyParser(std::string_view bytes, const std::string& name)
      : name_(name),
        header_(ParsePlyHeader(bytes, name)),
        body_(OpenPlyBody(bytes, header_, name)) {}

  PlyMesh Parse() {
    CheckVertexElement();
    for (const PlyElementHeader& element : header_.elements) {
      body_->BeginElement(element);
      if (element.properties.empty()) continue;
      if (element.name == "vertex") {
        ParseVertices(element);
      } else if (element.name == "face") {
        ParseFaces(element);
      } else {
        SkipElement(element);
      }
    }
    body_->Finish();
    mesh_.faces = Eigen::Map<const Faces>(
        indices_.data(), 3, static_cast<Eigen::Index>(indices_.size() / 3));
    return std::move(mesh_);
  }

 private:
  // Where the numbers of one property go; nowhere for a list.
  struct Column {
    double* first;
    int stride;
  };

  void CheckVertexElement() {
    for (const PlyElementHeader& element : header_.elements) {
      if (element.name != "vertex") continue;
      for (const char* axis : {"x", "y", "z"}) {
        const int place = element.Find(axis);
        if (place < 0 || element.properties[place].is_list) {
          throw InputError(name_ + ": element vertex without property " + axis +
                           ": expected x, y and z");
        }
      }
      if (element.count > std::numeric_limits<int>::max()) {
        throw InputError(name_ + ": " + std::to_string(element.count) +
                         " vertices: expected fewer than 2^31");
      }
      num_vertices_ = element.count;
      return;
    }
    throw InputError(name_ + ": no element vertex: expected one");
  }

  void ParseVertices(const PlyElementHeader& element) {
    mesh_.vertices.resize(3, element.count);
    mesh_.position_type = PositionType(element);
    std::vector<Column> columns;
    for (const PlyPropertyHeader& property : element.properties) {
      columns.push_back(NewColumn(property));
    }
    for (std::int64_t row = 0; row < element.count; ++row) {
      body_->BeginRow();
      for (std::size_t i = 0; i < columns.size(); ++i) {
        const PlyPropertyHeader& property = element.properties[i];
        if (property.is_list) {
          Skip(property);
        } else {
          columns[i].first[columns[i].stride * row] =
              body_->Real(property.type, property.name);
        }
      }
      body_->EndRow();
    }
  }

  // One type that holds x, y and z; a double holds them all.
  static PlyType PositionType(const PlyElementHeader& element) {
    const PlyType x = element.properties[element.Find("x")].type;
    for (const char* axis : {"y", "z"}) {
      if (element.properties[element.Find(axis)].type != x) {
        return PlyType::kFloat64;
      }
    }
    return x;
  }

  Column NewColumn(const PlyPropertyHeader& property) {
    if (property.is_list) return {nullptr, 0};
    const int axis = AxisOf(property.name);
    if (axis >= 0) {
      return {num_vertices_ > 0 ? &mesh_.vertices(axis, 0) : nullptr, 3};
    }
    mesh_.properties.push_back(
        {property.name, VectorXd(num_vertices_), property.type});
    return {mesh_.properties.back().values.data(), 1};
  }

  void ParseFaces(const PlyElementHeader& element) {
    int corners = element.Find("vertex_indices");
    if (corners < 0) corners = element.Find("vertex_index");
    if (corners < 0 || !element.properties[corners].is_list ||
        !IsInteger(element.properties[corners].type)) {
      throw InputError(name_ +
                       ": element face without corners: expected a property "
                       "list vertex_indices of whole numbers");
    }
    for (std::int64_t row = 0; row < element.count; ++row) {
      body_->BeginRow();
      for (int i = 0; i < static_cast<int>(element.properties.size()); ++i) {
        if (i == corners) {
          ParseCorners(element.properties[i]);
        } else {
          Skip(element.properties[i]);
        }
      }
      body_->EndRow();
    }
  }

  void ParseCorners(const PlyPropertyHeader& property) {
    const std::int64_t length = Length(property);
    if (length < 3) {
      body_->Fail(std::to_string(length) + " corners", "expected 3 or more");
    }
    int first = 0;
    int last = 0;
    for (std::int64_t c = 0; c < length; ++c) {
      const std::int64_t index = body_->Integer(property.type, property.name);
      if (index < 0 || index >= num_vertices_) {
        body_->Fail("vertex " + std::to_string(index),
                    "expected 0 to " + std::to_string(num_vertices_ - 1));
      }
      const int corner = static_cast<int>(index);
      if (c == 0) first = corner;
      if (c >= 2) indices_.insert(indices_.end(), {first, last, corner});
      last = corner;
    }
  }

  std::int64_t Length(const PlyPropertyHeader& property) {
    const std::int64_t length =
        body_->Integer(property.count_type, property.name);
    if (length < 0) {
      body_->Fail("list of length " + std::to_string(length),
                  "expected 0 or more");
    }
    return length;
  }

  void Skip(const PlyPropertyHeader& property) {
    const std::int64_t length = property.is_list ? Length(property) : 1;
    for (std::int64_t i = 0; i < length; ++i) {
      body_->Real(property.type, property.name);
    }
  }

  void SkipElement(const PlyElementHeader& element) {
    for (std::int64_t row = 0; row < element.count; ++row) {
      body_->BeginRow();
      for (const PlyPropertyHeader& property : element.properties) {
        Skip(property);
      }
      body_->EndRow();
    }
  }

  const std::string& name_;
  const PlyHeader header_;
  const std::unique_ptr<PlyBody> body_;
  std::int64_t num_vertices_ = 0;
  std::vector<int> indices_;  // three a triangle
  PlyMesh mesh_;
};

void RefuseNonFinite(const Points& vertices, const std::string& name) {
  Eigen::Index count = 0;
  Eigen::Index first = -1;
  for (Eigen::Index i = 0; i < vertices.cols(); ++i) {
    if (vertices.col(i).allFinite()) continue;
    if (count++ == 0) first = i;
  }
  if (count == 0) return;
  throw InputError(name + ": " + std::to_string(count) + " of " +
                   std::to_string(vertices.cols()) +
                   " vertices are not finite, the first is vertex " +
                   std::to_string(first) + " (from 0): expected finite ones");
}

// Appends the little-endian bytes of `value` as a number of type T.
template <typename T>
void AppendBytes(double value, std::string* bytes) {
  const T typed = static_cast<T>(value);
  bytes->append(reinterpret_cast<const char*>(&typed), sizeof(T));
}

template <typename T>
void AppendInteger(double value, std::string* bytes) {
  const double rounded = std::round(value);
  if (!(rounded >= static_cast<double>(std::numeric_limits<T>::min()) &&
        rounded <= static_cast<double>(std::numeric_limits<T>::max()))) {
    throw Error(ErrorKind::kInternal,
                "PLY: " + std::to_string(value) +
                    " does not fit the integer type of its property");
  }
  AppendBytes<T>(rounded, bytes);
}

void AppendValue(double value, PlyType type, std::string* bytes) {
  switch (type) {
    case PlyType::kInt8:
      return AppendInteger<std::int8_t>(value, bytes);
    case PlyType::kUint8:
      return AppendInteger<std::uint8_t>(value, bytes);
    case PlyType::kInt16:
      return AppendInteger<std::int16_t>(value, bytes);
    case PlyType::kUint16:
      return AppendInteger<std::uint16_t>(value, bytes);
    case PlyType::kInt32:
      return AppendInteger<std::int32_t>(value, bytes);
    case PlyType::kUint32:
      return AppendInteger<std::uint32_t>(value, bytes);
    case PlyType::kFloat32:
      return AppendBytes<float>(value, bytes);
    case PlyType::kFloat64:
      return AppendBytes<double>(value, bytes);
  }
}

void CheckProperties(const PlyMesh& mesh) {
  std::set<std::string> names = {"x", "y", "z"};
  for (const PlyProperty& property : mesh.properties) {
    if (!IsPlyWord(property.name) || !names.insert(property.name).second) {
      throw Error(ErrorKind::kInternal,
                  "PLY property " + Quoted(property.name) +
                      ": expected a word used once");
    }
    if (property.values.size() != mesh.vertices.cols()) {
      throw Error(ErrorKind::kInternal,
                  "PLY property " + property.name + ": " +
                      std::to_string(property.values.size()) + " values for " +
                      std::to_string(mesh.vertices.cols()) + " vertices");
    }
  }
}

std::string FormatHeader(const PlyMesh& mesh) {
  std::string text = "ply\nformat binary_little_endian 1.0\n";
  text += "element vertex " + std::to_string(mesh.vertices.cols()) + "\n";
  for (const char* axis : {"x", "y", "z"}) {
    text += std::string("property ") + PlyName(mesh.position_type) + " " +
            axis + "\n";
  }
  for (const PlyProperty& property : mesh.properties) {
    text += std::string("property ") + PlyName(property.type) + " " +
            property.name + "\n";
  }
  if (mesh.faces.cols() > 0) {
    text += "element face " + std::to_string(mesh.faces.cols()) + "\n";
    text += "property list uchar int vertex_indices\n";
  }
  return text + "end_header\n";
}

}  // namespace

const VectorXd* PlyMesh::Find(std::string_view name) const {
  for (const PlyProperty& property : properties) {
    if (property.name == name) return &property.values;
  }
  return nullptr;
}

void PlyMesh::AddScalar(const std::string& name, const VectorXd& values) {
  properties.push_back({name, values, PlyType::kFloat32});
}

void PlyMesh::AddVector(const std::array<std::string, 3>& names,
                        const Points& values) {
  for (int c = 0; c < 3; ++c) AddScalar(names[c], values.row(c));
}

void PlyMesh::AddColors(const Points& colors) {
  const std::array<const char*, 3> names = {"red", "green", "blue"};
  for (int c = 0; c < 3; ++c) {
    const VectorXd channel = 255 * colors.row(c).cwiseMax(0).cwiseMin(1);
    properties.push_back({names[c], channel, PlyType::kUint8});
  }
}

PlyMesh ParsePly(std::string_view bytes,
                 const std::string& name,
                 const PlyReadOptions& options) {
  PlyMesh mesh = PlyParser(bytes, name).Parse();
  if (!options.allow_non_finite) RefuseNonFinite(mesh.vertices, name);
  return mesh;
}

PlyMesh ReadPly(const std::string& path, const PlyReadOptions& options) {
  return ParsePly(ReadFileBytes(path), path, options);
}

std::string FormatPly(const PlyMesh& mesh) {
  CheckProperties(mesh);
  std::string bytes = FormatHeader(mesh);
  for (Eigen::Index i = 0; i < mesh.vertices.cols(); ++i) {
    for (int c = 0; c < 3; ++c) {
      AppendValue(mesh.vertices(c, i), mesh.position_type, &bytes);
    }
    for (const PlyProperty& property : mesh.properties) {
      AppendValue(property.values[i], property.type, &bytes);
    }
  }
  for (Eigen::Index f = 0; f < mesh.faces.cols(); ++f) {
    AppendBytes<std::uint8_t>(3, &bytes);
    for (int c = 0; c < 3; ++c) {
      AppendBytes<std::int32_t>(mesh.faces(c, f), &bytes);
    }
  }
  return bytes;
}

void WritePly(const std::string& path, const PlyMesh& mesh) {
  WriteFileBytes(path, FormatPly(mesh));
}

}  // namespace invsim
