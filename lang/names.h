// SPDX-License-Identifier: Apache-2.0
// Names kept once, so that equal names are equal pointers.
#pragma once
#include <deque>
#include <string>
#include <string_view>
#include <unordered_map>

#include "lang/share.h"
#include "lang/words.h"

namespace vestige::lang {

struct Builtin;  // builtins.h

/// The letters of a name, and what the language knows about it without looking at them again.
struct Name : std::string {
  Name(std::string_view letters, std::uint32_t number);
  std::uint32_t id;                  ///< counts from 0
  Word word = Word::none;            ///< none: not a word of the language, or a function
  const Builtin* builtin = nullptr;  ///< a function of the language
};

class Names {
 public:
  explicit Names(Total memory) : memory_(std::move(memory)) {}
  const Name* intern(std::string_view text) {
    if (const auto found = known_.find(text); found != known_.end()) return found->second;
    *memory_ += std::int64_t(kEntry + text.size());
    const Name& made = names_.emplace_back(text, std::uint32_t(names_.size()));
    known_[made] = &made;
    return &made;
  }

 private:
  static constexpr std::size_t kEntry = sizeof(Name) + 56;  ///< bytes of a name without its letters
  Total memory_;
  std::deque<Name> names_;
  std::unordered_map<std::string_view, const Name*> known_;
};

}  // namespace vestige::lang
