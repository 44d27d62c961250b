// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_IO_JSON_RECORD_H_
#define INVSIM_IO_JSON_RECORD_H_

// A JSON object from disk, of which a few values are wanted: scene.json of a
// sequence, report.json of a run, the record of a sweep's run.
//
//   const JsonRecord scene = JsonRecord::Read("seq/scene.json");
//   std::string body = scene.Text("body");        // "" if there is none
//   double mu = report.Number("inputs.friction", 0.3);
//
// A key is looked up level by level, its parts apart by dots. What is not
// there, or is null, gives the fallback; what is there and of another type
// throws InputError: "seq/scene.json: body: expected a text, found a number".

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace invsim {

class JsonRecord {
 public:
  // `name` is for messages. Throws InputError if it is no JSON object.
  static JsonRecord Parse(std::string_view bytes, const std::string& name);
  // Of a file that need not be there: then nothing is in it.
  static JsonRecord Read(const std::string& path);

  bool Has(const std::string& key) const;
  std::string Text(const std::string& key,
                   const std::string& fallback = "") const;
  double Number(const std::string& key, double fallback) const;
  int Integer(const std::string& key, int fallback) const;
  std::vector<std::string> Texts(const std::string& key) const;

 private:
  struct Tree;
  JsonRecord(std::string name, std::shared_ptr<const Tree> tree);

  std::string name_;
  std::shared_ptr<const Tree> tree_;
};

}  // namespace invsim

#endif  // INVSIM_IO_JSON_RECORD_H_
