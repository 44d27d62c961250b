// SPDX-License-Identifier: Apache-2.0
#include "invsim/io/json_record.h"

#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "invsim/base/error.h"
#include "invsim/io/file.h"

namespace invsim {
namespace {

using Json = nlohmann::json;

std::string TypeOf(const Json& value) {
  return value.is_object()    ? "an object"
         : value.is_array()   ? "a list"
         : value.is_string()  ? "a text"
         : value.is_boolean() ? "true or false"
                              : "a number";
}

[[noreturn]] void Throw(const std::string& name,
                        const std::string& key,
                        const std::string& expected,
                        const std::string& found) {
  throw InputError(name + ": " + key + ": expected " + expected + ", found " +
                   found);
}

// Null if there is no value at the key.
const Json* Find(const Json& root,
                 const std::string& name,
                 const std::string& key) {
  const Json* node = &root;
  std::istringstream parts(key);
  std::string path;
  for (std::string part; std::getline(parts, part, '.');) {
    if (!node->is_object()) Throw(name, path, "an object", TypeOf(*node));
    const auto found = node->find(part);
    if (found == node->end() || found->is_null()) return nullptr;
    node = &*found;
    path += (path.empty() ? "" : ".") + part;
  }
  return node;
}

}  // namespace

struct JsonRecord::Tree {
  Json root;
};

JsonRecord::JsonRecord(std::string name, std::shared_ptr<const Tree> tree)
    : name_(std::move(name)), tree_(std::move(tree)) {}

JsonRecord JsonRecord::Parse(std::string_view bytes, const std::string& name) {
  Json root = Json::parse(bytes.begin(), bytes.end(), nullptr, false);
  if (!root.is_object()) throw InputError(name + ": expected a JSON object");
  return JsonRecord(name, std::make_shared<const Tree>(Tree{std::move(root)}));
}

JsonRecord JsonRecord::Read(const std::string& path) {
  std::error_code unknown;  // reading will say
  const bool missing = std::filesystem::status(path, unknown).type() ==
                       std::filesystem::file_type::not_found;
  return Parse(missing ? "{}" : ReadFileBytes(path), path);
}

bool JsonRecord::Has(const std::string& key) const {
  return Find(tree_->root, name_, key) != nullptr;
}

std::string JsonRecord::Text(const std::string& key,
                             const std::string& fallback) const {
  const Json* value = Find(tree_->root, name_, key);
  if (!value) return fallback;
  if (!value->is_string()) Throw(name_, key, "a text", TypeOf(*value));
  return value->get<std::string>();
}

double JsonRecord::Number(const std::string& key, double fallback) const {
  const Json* value = Find(tree_->root, name_, key);
  if (!value) return fallback;
  if (!value->is_number()) Throw(name_, key, "a number", TypeOf(*value));
  return value->get<double>();
}

int JsonRecord::Integer(const std::string& key, int fallback) const {
  const double number = Number(key, fallback);
  using Limits = std::numeric_limits<int>;
  if (!(number >= Limits::min() && number <= Limits::max()) ||
      number != static_cast<int>(number))
    Throw(name_, key, "a whole number", std::to_string(number));
  return static_cast<int>(number);
}

std::vector<std::string> JsonRecord::Texts(const std::string& key) const {
  const Json* value = Find(tree_->root, name_, key);
  std::vector<std::string> texts;
  if (!value) return texts;
  if (!value->is_array()) Throw(name_, key, "a list of texts", TypeOf(*value));
  for (const Json& text : *value) {
    if (!text.is_string())
      Throw(name_,
            key,
            "a list of texts",
            (text.is_null() ? "null" : TypeOf(text)) + " in it");
    texts.push_back(text.get<std::string>());
  }
  return texts;
}

}  // namespace invsim
