// SPDX-License-Identifier: Apache-2.0
#include "command.h"

namespace invsim {

void KeyFlags::Add(const std::string& flag,
                   const std::string& key,
                   const std::string& doc) {
  Entry& entry = entries_.emplace_back(Entry{flag, key, "", nullptr});
  entry.option = app_->add_option(flag, entry.text, doc)->option_text("VALUE");
}

void KeyFlags::Apply(Config* config) const {
  for (const Entry& entry : entries_) {
    if (entry.option->count() > 0) {
      config->Set(entry.key, entry.text, entry.flag);
    }
  }
}

void ReadOptions(Command* command,
                 RunOptions* run,
                 Config config,
                 OptionTable* table) {
  table->AddSection("run", run);
  command->AddOptions(table);
  command->TakeConfig(&config);
  table->Read(config);
}

void Describe(OptionTable* table, RunOptions* o) {
  table->Add("seed",
             &o->seed,
             {.doc = "of everything random; the same seed and thread count "
                     "give the same result",
              .at_least = 0});
  table->Add("threads",
             &o->threads,
             {.doc = "worker threads; 0: one per core",
              .at_least = 0,
              .at_most = 1024});
}

}  // namespace invsim
