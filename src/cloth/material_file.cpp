// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/material_file.h"

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "invsim/base/error.h"
#include "invsim/io/file.h"

namespace invsim {
namespace {

using Json = nlohmann::json;

// Members of one file, with errors that name both.
class MemberReader {
 public:
  MemberReader(std::string path, const Json& object)
      : path_(std::move(path)), object_(object) {}

  double Number(const std::string& key) const {
    const Json& value = Member(key);
    if (!value.is_number()) Fail(key, "expected a number");
    return value.get<double>();
  }

  template <size_t kRows, size_t kColumns>
  std::array<std::array<double, kColumns>, kRows> Table(
      const std::string& key) const {
    const std::string shape = "expected " + std::to_string(kRows) +
                              " rows of " + std::to_string(kColumns) +
                              " numbers";
    const Json& rows = Member(key);
    if (!rows.is_array()) Fail(key, shape);
    if (rows.size() != kRows)
      Fail(key, shape + ", found " + std::to_string(rows.size()) + " rows");
    std::array<std::array<double, kColumns>, kRows> table;
    for (size_t i = 0; i < kRows; ++i) {
      const std::string row = key + "[" + std::to_string(i) + "]";
      if (!rows[i].is_array() || rows[i].size() != kColumns) Fail(row, shape);
      for (size_t k = 0; k < kColumns; ++k) {
        if (!rows[i][k].is_number())
          Fail(row + "[" + std::to_string(k) + "]", "expected a number");
        table[i][k] = rows[i][k].template get<double>();
      }
    }
    return table;
  }

 private:
  const Json& Member(const std::string& key) const {
    const auto found = object_.find(key);
    if (found == object_.end()) Fail(key, "missing");
    return *found;
  }

  [[noreturn]] void Fail(const std::string& key,
                         const std::string& what) const {
    throw InputError(path_ + ": " + key + ": " + what);
  }

  std::string path_;
  const Json& object_;
};

Json Parse(std::string_view text, const std::string& path) {
  Json json;
  try {
    json = Json::parse(text);
  } catch (const Json::parse_error& error) {
    throw InputError(path + ": not JSON from byte " +
                     std::to_string(error.byte) + " on");
  } catch (const Json::out_of_range&) {
    throw InputError(path + ": holds a number too large for 64 bits");
  }
  if (!json.is_object())
    throw InputError(path + ": expected a JSON object with density, " +
                     "stretching and bending");
  return json;
}

}  // namespace

Material ParseMaterial(std::string_view text, const std::string& path) {
  const Json json = Parse(text, path);
  const MemberReader reader(path, json);
  Material material;
  material.name = std::filesystem::path(path).stem().string();
  material.density = reader.Number("density");
  material.stretch = MeasuredStretch{reader.Table<6, 4>("stretching")};
  material.bending = MeasuredBending{reader.Table<3, 5>("bending")};
  material.doc = "measured fabric from " + path;
  ValidateMaterial(material, path);
  return material;
}

Material ReadMaterial(const std::string& path) {
  return ParseMaterial(ReadFileBytes(path), path);
}

}  // namespace invsim
