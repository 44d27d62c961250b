// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_BASE_REGISTRY_H_
#define INVSIM_BASE_REGISTRY_H_

// A registry: name -> options and factory. It is filled in one function, one
// line per kind, so that a kind exists once it is listed and nothing depends
// on the order in which static objects are built:
//
//   using EffectRegistry = Registry<Effect, const Garment&>;
//
//   const EffectRegistry& Effects() {
//     static const EffectRegistry registry = [] {
//       EffectRegistry r("effect");
//       r.Add<MembraneOptions>("membrane", "in-plane elasticity",
//                              MakeMembrane);
//       r.Add<GravityOptions>("gravity", "uniform gravity", MakeGravity);
//       return r;
//     }();
//     return registry;
//   }
//
// where `std::unique_ptr<Effect> MakeMembrane(const MembraneOptions&,
// const Garment&)`. Choosing gives the options before anything is made, so
// that they can be read and listed:
//
//   auto choice = Effects().Choose("membrane");   // throws UsageError
//   table.AddSection("membrane", choice.get());
//   table.Read(config);
//   std::unique_ptr<Effect> effect = choice->Make(garment);

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "invsim/base/error.h"
#include "invsim/base/names.h"
#include "invsim/base/options.h"

namespace invsim {

// One registered kind with its own set of options.
template <typename Product, typename... Args>
class Choice {
 public:
  virtual ~Choice() = default;
  virtual void AddOptions(OptionTable* table) = 0;
  virtual std::unique_ptr<Product> Make(Args... args) const = 0;
};

template <typename Product, typename... Args>
void Describe(OptionTable* table, Choice<Product, Args...>* choice) {
  choice->AddOptions(table);
}

template <typename Product, typename... Args>
class Registry {
 public:
  struct Entry {
    std::string name;
    std::string doc;  // one line for `invsim list`
    std::function<std::unique_ptr<Choice<Product, Args...>>()> choose;
  };

  // `kind` opens the message about an unknown name: "effect", "loss".
  explicit Registry(std::string kind) : kind_(std::move(kind)) {}

  // `make(options, args...)` returns std::unique_ptr<Product>. A name taken
  // is a programming error (std::logic_error).
  template <typename Options, typename Factory>
  void Add(const std::string& name, const std::string& doc, Factory make) {
    if (Find(name))
      throw std::logic_error(kind_ + " '" + name + "' registered twice");
    entries_.push_back({name, doc, [make] {
                          return std::make_unique<ChoiceOf<Options, Factory>>(
                              make);
                        }});
  }

  // A fresh choice with default options. Throws UsageError with the nearest
  // registered name.
  std::unique_ptr<Choice<Product, Args...>> Choose(
      const std::string& name) const {
    const Entry* entry = Find(name);
    if (!entry) throw UsageError(UnknownName(kind_, name, names()));
    return entry->choose();
  }

  const std::string& kind() const { return kind_; }
  // In the order of registration.
  const std::vector<Entry>& entries() const { return entries_; }
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const Entry& entry : entries_) names.push_back(entry.name);
    return names;
  }

 private:
  template <typename Options, typename Factory>
  class ChoiceOf : public Choice<Product, Args...> {
   public:
    explicit ChoiceOf(Factory make) : make_(std::move(make)) {}
    void AddOptions(OptionTable* table) override { Describe(table, &options_); }
    std::unique_ptr<Product> Make(Args... args) const override {
      return make_(options_, std::forward<Args>(args)...);
    }

   private:
    Options options_;
    Factory make_;
  };

  const Entry* Find(const std::string& name) const {
    for (const Entry& entry : entries_)
      if (entry.name == name) return &entry;
    return nullptr;
  }

  std::string kind_;
  std::vector<Entry> entries_;
};

}  // namespace invsim

#endif  // INVSIM_BASE_REGISTRY_H_
