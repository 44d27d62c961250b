// SPDX-License-Identifier: Apache-2.0
#include "invsim/io/glb.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <sstream>

#include "invsim/base/error.h"
#include "invsim/io/file.h"

namespace invsim {
namespace {

static_assert(std::endian::native == std::endian::little);

void CheckMesh(const GlbMesh& mesh) {
  const auto fail = [&mesh](const std::string& what) {
    throw Error(ErrorKind::kInternal, "GLB mesh '" + mesh.name + "': " + what);
  };
  if (mesh.frames.empty() || mesh.frames[0].cols() == 0) fail("no vertex");
  for (const Points& frame : mesh.frames) {
    if (frame.cols() != mesh.frames[0].cols()) fail("frames differ in size");
    if (!frame.allFinite()) fail("not finite");
  }
  if (mesh.faces.cols() == 0 || mesh.faces.minCoeff() < 0 ||
      mesh.faces.maxCoeff() >= mesh.frames[0].cols()) {
    fail("faces do not fit the vertices");
  }
}

// Builds the model: every array is a view into one buffer, described by an
// accessor. All are of 4-byte numbers, so that everything stays aligned.
class GlbBuilder {
 public:
  explicit GlbBuilder(const GlbOptions& options) : options_(options) {
    model_.asset.version = "2.0";
    model_.asset.generator = "invsim";
    model_.buffers.emplace_back();
    model_.scenes.emplace_back();
    model_.defaultScene = 0;
  }

  void Add(const GlbMesh& mesh) {
    CheckMesh(mesh);
    const std::vector<int> poses =
        GlbPoses(static_cast<int>(mesh.frames.size()), options_.most_poses);
    tinygltf::Mesh gltf;
    gltf.name = mesh.name;
    gltf.primitives.push_back(NewPrimitive(mesh, poses));
    gltf.weights.assign(poses.size() - 1, 0.0);
    tinygltf::Node node;
    node.name = mesh.name;
    node.mesh = static_cast<int>(model_.meshes.size());
    model_.scenes[0].nodes.push_back(static_cast<int>(model_.nodes.size()));
    model_.meshes.push_back(std::move(gltf));
    model_.nodes.push_back(std::move(node));
    if (poses.size() > 1) AddAnimation(poses);
  }

  std::string Format() {
    std::ostringstream stream;
    tinygltf::TinyGLTF writer;
    if (!writer.WriteGltfSceneToStream(&model_, stream, false, true)) {
      throw Error(ErrorKind::kInternal, "GLB: tinygltf cannot write");
    }
    return std::move(stream).str();
  }

 private:
  tinygltf::Primitive NewPrimitive(const GlbMesh& mesh,
                                   const std::vector<int>& poses) {
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    const Points& base = mesh.frames[0];
    primitive.attributes["POSITION"] = AddPositions(base);
    primitive.indices = AddIndices(mesh.faces);
    primitive.material = AddMaterial(mesh.color);
    for (std::size_t p = 1; p < poses.size(); ++p) {
      primitive.targets.push_back(
          {{"POSITION", AddPositions(mesh.frames[poses[p]] - base)}});
    }
    return primitive;
  }

  int AddMaterial(const Vector3d& color) {
    tinygltf::Material material;
    auto& surface = material.pbrMetallicRoughness;
    surface.baseColorFactor = {color.x(), color.y(), color.z(), 1.0};
    surface.metallicFactor = 0;
    surface.roughnessFactor = 0.9;
    material.doubleSided = true;
    model_.materials.push_back(std::move(material));
    return static_cast<int>(model_.materials.size()) - 1;
  }

  // Weight p is 1 at the time of pose p + 1 and 0 at that of every other pose.
  void AddAnimation(const std::vector<int>& poses) {
    const auto num_poses = static_cast<Eigen::Index>(poses.size());
    Eigen::VectorXf times(num_poses);
    for (Eigen::Index p = 0; p < num_poses; ++p) {
      times[p] = static_cast<float>(poses[p] / options_.frames_per_second);
    }
    Eigen::MatrixXf weights = Eigen::MatrixXf::Zero(num_poses - 1, num_poses);
    weights.rightCols(num_poses - 1).setIdentity();
    tinygltf::AnimationSampler sampler;
    sampler.interpolation = "LINEAR";
    sampler.input = AddScalars(times);
    // The input of an animation must state its range.
    model_.accessors.back().minValues = {times.minCoeff()};
    model_.accessors.back().maxValues = {times.maxCoeff()};
    sampler.output = AddScalars(weights.reshaped());
    tinygltf::AnimationChannel channel;
    if (model_.animations.empty()) model_.animations.emplace_back();
    tinygltf::Animation& animation = model_.animations[0];
    channel.sampler = static_cast<int>(animation.samplers.size());
    channel.target_node = static_cast<int>(model_.nodes.size()) - 1;
    channel.target_path = "weights";
    animation.samplers.push_back(std::move(sampler));
    animation.channels.push_back(std::move(channel));
  }

  int AddPositions(const Points& positions) {
    const Eigen::Matrix3Xf floats = positions.cast<float>();
    const int accessor = AddAccessor(floats.data(),
                                     floats.size(),
                                     floats.cols(),
                                     TINYGLTF_COMPONENT_TYPE_FLOAT,
                                     TINYGLTF_TYPE_VEC3,
                                     TINYGLTF_TARGET_ARRAY_BUFFER);
    for (int c = 0; c < 3; ++c) {
      model_.accessors[accessor].minValues.push_back(floats.row(c).minCoeff());
      model_.accessors[accessor].maxValues.push_back(floats.row(c).maxCoeff());
    }
    return accessor;
  }

  int AddIndices(const Faces& faces) {
    const Eigen::Matrix<std::uint32_t, 3, Eigen::Dynamic> indices =
        faces.cast<std::uint32_t>();
    return AddAccessor(indices.data(),
                       indices.size(),
                       indices.size(),
                       TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                       TINYGLTF_TYPE_SCALAR,
                       TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
  }

  int AddScalars(const Eigen::VectorXf& values) {
    return AddAccessor(values.data(),
                       values.size(),
                       values.size(),
                       TINYGLTF_COMPONENT_TYPE_FLOAT,
                       TINYGLTF_TYPE_SCALAR,
                       0);
  }

  // `count` elements made of `num_numbers` numbers of four bytes.
  int AddAccessor(const void* numbers,
                  Eigen::Index num_numbers,
                  Eigen::Index count,
                  int component_type,
                  int type,
                  int target) {
    std::vector<unsigned char>& data = model_.buffers[0].data;
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = data.size();
    view.byteLength = 4 * static_cast<std::size_t>(num_numbers);
    view.target = target;
    const auto* bytes = static_cast<const unsigned char*>(numbers);
    data.insert(data.end(), bytes, bytes + view.byteLength);
    tinygltf::Accessor accessor;
    accessor.bufferView = static_cast<int>(model_.bufferViews.size());
    accessor.componentType = component_type;
    accessor.type = type;
    accessor.count = static_cast<std::size_t>(count);
    model_.bufferViews.push_back(std::move(view));
    model_.accessors.push_back(std::move(accessor));
    return static_cast<int>(model_.accessors.size()) - 1;
  }

  GlbOptions options_;
  tinygltf::Model model_;
};

}  // namespace

std::vector<int> GlbPoses(int num_frames, int most_poses) {
  const int num_poses = std::max(1, std::min(num_frames, most_poses));
  std::vector<int> poses = {0};
  for (std::int64_t p = 1; p < num_poses; ++p) {
    // p (num_frames - 1) / (num_poses - 1), rounded.
    poses.push_back(static_cast<int>(
        (2 * p * (num_frames - 1) + num_poses - 1) / (2 * (num_poses - 1))));
  }
  return poses;
}

std::string FormatGlb(const std::vector<GlbMesh>& meshes,
                      const GlbOptions& options) {
  GlbBuilder builder(options);
  for (const GlbMesh& mesh : meshes) builder.Add(mesh);
  return builder.Format();
}

void WriteGlb(const std::string& path,
              const std::vector<GlbMesh>& meshes,
              const GlbOptions& options) {
  WriteFileBytes(path, FormatGlb(meshes, options));
}

}  // namespace invsim
