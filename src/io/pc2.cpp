// SPDX-License-Identifier: Apache-2.0
#include "invsim/io/pc2.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "invsim/base/error.h"
#include "invsim/io/file.h"

namespace invsim {
namespace {

static_assert(std::endian::native == std::endian::little);

struct Header {
  char magic[12];
  std::int32_t version;
  std::int32_t num_points;
  float start_frame;
  float frames_per_sample;
  std::int32_t num_samples;
};
static_assert(sizeof(Header) == 32);

constexpr char kPc2Magic[12] = {
    'P', 'O', 'I', 'N', 'T', 'C', 'A', 'C', 'H', 'E', '2', '\0'};

Header ParseHeader(std::string_view bytes, const std::string& name) {
  Header header;
  if (bytes.size() < sizeof(header) ||
      std::memcmp(bytes.data(), kPc2Magic, sizeof(kPc2Magic)) != 0) {
    throw InputError(name + ": expected a point cache (POINTCACHE2)");
  }
  std::memcpy(&header, bytes.data(), sizeof(header));
  if (header.version != 1) {
    throw InputError(name + ": version " + std::to_string(header.version) +
                     ": expected 1");
  }
  if (header.num_points < 0 || header.num_samples < 0) {
    throw InputError(name + ": " + std::to_string(header.num_points) +
                     " points, " + std::to_string(header.num_samples) +
                     " samples: expected 0 or more");
  }
  if (!std::isfinite(header.start_frame) ||
      !std::isfinite(header.frames_per_sample)) {
    throw InputError(name + ": start frame " +
                     std::to_string(header.start_frame) + ", " +
                     std::to_string(header.frames_per_sample) +
                     " frames per sample: expected finite numbers");
  }
  return header;
}

// Compares the counts with the bytes before any memory is taken for them.
void CheckSize(const Header& header,
               std::size_t bytes,
               const std::string& name) {
  constexpr std::uint64_t kPoint = 3 * sizeof(float);
  // Below 2^62, while its bytes may be more than 64 bits can count.
  const std::uint64_t points =
      std::uint64_t{1} * header.num_points * header.num_samples;
  const bool fits = bytes % kPoint == 0 && bytes / kPoint == points;
  // No bytes would do for any number of samples of no points, or of points in
  // no samples; neither is written by anyone.
  const bool is_empty = header.num_samples == 0 && header.num_points == 0;
  if (fits && (bytes > 0 || is_empty)) return;
  throw InputError(name + ": " + std::to_string(bytes) +
                   " bytes after the header: expected " +
                   std::to_string(kPoint) + " for each point of " +
                   std::to_string(header.num_samples) + " samples of " +
                   std::to_string(header.num_points));
}

}  // namespace

PointCache ParsePc2(std::string_view bytes, const std::string& name) {
  const Header header = ParseHeader(bytes, name);
  bytes.remove_prefix(sizeof(Header));
  CheckSize(header, bytes.size(), name);
  PointCache cache;
  cache.start_frame = header.start_frame;
  cache.frames_per_sample = header.frames_per_sample;
  Eigen::Matrix3Xf sample(3, header.num_points);
  const std::size_t sample_size = sizeof(float) * sample.size();
  for (int s = 0; s < header.num_samples; ++s) {
    std::memcpy(sample.data(), bytes.data() + s * sample_size, sample_size);
    if (!sample.allFinite()) {
      throw InputError(name + ": sample " + std::to_string(s) +
                       " (from 0): expected finite coordinates");
    }
    cache.samples.push_back(sample.cast<double>());
  }
  return cache;
}

PointCache ReadPc2(const std::string& path) {
  return ParsePc2(ReadFileBytes(path), path);
}

std::string FormatPc2(const PointCache& cache) {
  Header header;
  std::memcpy(header.magic, kPc2Magic, sizeof(kPc2Magic));
  header.version = 1;
  header.num_points = cache.samples.empty()
                          ? 0
                          : static_cast<int>(cache.samples.front().cols());
  header.start_frame = static_cast<float>(cache.start_frame);
  header.frames_per_sample = static_cast<float>(cache.frames_per_sample);
  header.num_samples = static_cast<int>(cache.samples.size());
  std::string bytes(reinterpret_cast<const char*>(&header), sizeof(header));
  for (const Points& sample : cache.samples) {
    if (sample.cols() != header.num_points) {
      throw Error(ErrorKind::kInternal,
                  "point cache: samples of " +
                      std::to_string(header.num_points) + " and of " +
                      std::to_string(sample.cols()) + " points");
    }
    const Eigen::Matrix3Xf floats = sample.cast<float>();
    bytes.append(reinterpret_cast<const char*>(floats.data()),
                 sizeof(float) * floats.size());
  }
  return bytes;
}

void WritePc2(const std::string& path, const PointCache& cache) {
  WriteFileBytes(path, FormatPc2(cache));
}

}  // namespace invsim
