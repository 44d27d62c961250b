// SPDX-License-Identifier: Apache-2.0
#include "invsim/io/point_filters.h"

#include <pcl/PCLPointCloud2.h>
#include <pcl/filters/statistical_outlier_removal.h>
#include <pcl/filters/voxel_grid.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "invsim/base/error.h"

namespace invsim {
namespace {

// Clouds are exchanged as PCL's plain bytes (PCLPointCloud2), never as
// pcl::PointCloud: that one allocates through Eigen, and Eigen compiled for
// AVX here and for SSE in Debian's PCL cannot free each other's memory.
constexpr int kPointSize = 4 * sizeof(float);  // x y z and padding

pcl::PCLPointCloud2::Ptr ToBlob(const Points& points,
                                const Vector3d& centroid) {
  const auto blob = std::make_shared<pcl::PCLPointCloud2>();
  blob->width = static_cast<std::uint32_t>(points.cols());
  blob->height = 1;
  blob->point_step = kPointSize;
  blob->row_step = kPointSize * blob->width;
  blob->is_dense = 1;
  for (int c = 0; c < 3; ++c) {
    pcl::PCLPointField field;
    field.name = std::string(1, static_cast<char>('x' + c));
    field.offset = c * static_cast<std::uint32_t>(sizeof(float));
    field.datatype = pcl::PCLPointField::FLOAT32;
    field.count = 1;
    blob->fields.push_back(field);
  }
  blob->data.resize(std::size_t{kPointSize} * points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Eigen::Vector3f p = (points.col(i) - centroid).cast<float>();
    std::memcpy(&blob->data[kPointSize * i], p.data(), sizeof(p));
  }
  return blob;
}

Points FromBlob(const pcl::PCLPointCloud2& blob, const Vector3d& centroid) {
  Points points(3, static_cast<Eigen::Index>(blob.width * blob.height));
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    for (int c = 0; c < 3; ++c) {
      float value = 0;
      std::memcpy(&value,
                  &blob.data[blob.point_step * i + blob.fields[c].offset],
                  sizeof(value));
      points(c, i) = centroid[c] + value;
    }
  }
  return points;
}

// Keeps the doubles of the points that stay.
Points DropOutliers(const PointFilterOptions& options, const Points& points) {
  pcl::StatisticalOutlierRemoval<pcl::PCLPointCloud2> filter;
  filter.setInputCloud(ToBlob(points, points.rowwise().mean()));
  filter.setMeanK(options.outlier_neighbours);
  filter.setStddevMulThresh(options.outlier_deviations);
  // PCL 1.13 shortens this list to the points kept, but never lengthens it.
  pcl::Indices kept(points.cols());
  filter.filter(kept);
  return points(Eigen::all, kept);
}

// PCL numbers the voxels by an int and, if they do not fit, hands the cloud
// back as it was.
void CheckVoxelCount(const Points& points, double voxel) {
  const Vector3d extent =
      points.rowwise().maxCoeff() - points.rowwise().minCoeff();
  double count = 1;
  for (double side : extent) count *= std::floor(side / voxel) + 2;
  if (count < 2147483647.0) return;
  throw UsageError("voxel: " + std::to_string(voxel) +
                   " m: expected fewer than 2^31 voxels in the points' box");
}

Points MeansOfVoxels(double voxel, const Points& points) {
  CheckVoxelCount(points, voxel);
  const Vector3d centroid = points.rowwise().mean();
  pcl::VoxelGrid<pcl::PCLPointCloud2> filter;
  filter.setInputCloud(ToBlob(points, centroid));
  filter.setDownsampleAllData(false);  // there is nothing but x, y and z
  const auto side = static_cast<float>(voxel);
  filter.setLeafSize(side, side, side);
  pcl::PCLPointCloud2 means;
  filter.filter(means);
  return FromBlob(means, centroid);
}

// The values of rank 1 % and 99 % of a row.
std::pair<double, double> Middle(const Points& points, int axis) {
  std::vector<double> row(points.row(axis).begin(), points.row(axis).end());
  const auto at = [&](double share) {
    const auto nth =
        row.begin() + std::lround(share * static_cast<double>(row.size() - 1));
    std::nth_element(row.begin(), nth, row.end());
    return *nth;
  };
  const double low = at(0.01);
  return {low, at(0.99)};
}

}  // namespace

Points WithoutStrays(const Points& points) {
  if (points.cols() == 0) return points;
  Vector3d low, high;
  for (int c = 0; c < 3; ++c) std::tie(low[c], high[c]) = Middle(points, c);
  const double margin = (high - low).maxCoeff();
  std::vector<int> kept;
  for (int i = 0; i < points.cols(); ++i) {
    const Eigen::Array3d p = points.col(i);
    if ((p >= low.array() - margin).all() && (p <= high.array() + margin).all())
      kept.push_back(i);
  }
  return points(Eigen::all, kept);
}

void Describe(OptionTable* table, PointFilterOptions* o) {
  table->Add("voxel",
             &o->voxel,
             {.doc = "side of a cube whose points are replaced by their mean; "
                     "0: off",
              .unit = "m",
              .at_least = 0});
  table->Add(
      "outlier_neighbours",
      &o->outlier_neighbours,
      {.doc = "nearest points an outlier is judged by; 0: off", .at_least = 0});
  table->Add("outlier_deviations",
             &o->outlier_deviations,
             {.doc = "standard deviations of the mean distance above which a "
                     "point is an outlier",
              .above = 0});
}

Points FilterPoints(const PointFilterOptions& options, const Points& points) {
  Points result = points;
  // PCL's search needs the point itself beside its neighbours.
  if (options.outlier_neighbours > 0 &&
      result.cols() > options.outlier_neighbours) {
    result = DropOutliers(options, result);
  }
  if (options.voxel > 0 && result.cols() > 0) {
    result = MeansOfVoxels(options.voxel, result);
  }
  return result;
}

}  // namespace invsim
