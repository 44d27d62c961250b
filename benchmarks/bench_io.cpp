// SPDX-License-Identifier: Apache-2.0

// Files in memory: how long a frame of points or a mesh takes to read and
// write.

#include "benchmarks.h"
#include "invsim/base/random.h"
#include "invsim/io/obj.h"
#include "invsim/io/ply.h"
#include "invsim/io/point_filters.h"

namespace invsim {
namespace {

Points RandomPoints(int count) {
  Random random(1);
  Points points(3, count);
  for (double& coordinate : points.reshaped()) coordinate = random.Uniform();
  return points;
}

void Add(Bench* bench,
         const std::string& name,
         int count,
         const std::function<void()>& work) {
  if (!bench->Wants(name)) return;
  bench->Add({name, count, 0, bench->Seconds(work), "s"});
}

}  // namespace

void BenchIo(Bench* bench) {
  constexpr int kCount = 8000;  // points of a frame
  PlyMesh ply;
  ply.vertices = RandomPoints(kCount);
  const std::string ply_bytes = FormatPly(ply);
  Add(bench, "io/read_ply", kCount, [&] { ParsePly(ply_bytes, "frame"); });
  Add(bench, "io/write_ply", kCount, [&] { FormatPly(ply); });
  ObjMesh obj;
  obj.vertices = ply.vertices;
  const std::string obj_bytes = FormatObj(obj);
  Add(bench, "io/read_obj", kCount, [&] { ParseObj(obj_bytes, "mesh"); });
  Add(bench, "io/write_obj", kCount, [&] { FormatObj(obj); });
  Add(bench, "io/filter_points", kCount, [&] {
    FilterPoints({.voxel = 0.05, .outlier_neighbours = 10}, ply.vertices);
  });
}

}  // namespace invsim
