// SPDX-License-Identifier: Apache-2.0
// The texts that spans refer to, and the macro calls and includes through which a token came.
#pragma once
#include <algorithm>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include <vestige/diagnostic.h>

#include "lang/share.h"

namespace vestige::lang {

/// One text: a file, or a definition from the command line.
struct Text {
  std::string name;  ///< as the user gave it, or where an include was found
  std::string text;
  std::vector<std::uint32_t> lineStarts;  ///< byte offsets
};

/// The reason why a piece of text was read: a macro call, or an #include.
struct Expansion {
  enum class Kind { macro, include };
  Kind kind = Kind::macro;
  const std::string* name = nullptr;  ///< of the macro or the file; owned by Sources
  Span call;      ///< span of the call or of the #include; its own `via` leads further out
  int depth = 1;  ///< length of the chain
};

/// A place in a text, all from 0.
struct Position {
  int line = 0;
  int column = 0;       ///< characters before it in its line
  int utf16Column = 0;  ///< UTF-16 code units before it in its line, as language servers count
};

class Sources {
 public:
  /// Texts and expansions from now on count as bytes of `memory`.
  void countOn(Total memory) { memory_ = std::move(memory); }
  int add(std::string name, std::string text);
  /// The same call through the same chain is the same expansion, so that loops cost nothing.
  /// Equal names must be equal pointers.
  int expand(Expansion::Kind kind, const std::string* name, const Span& call);

  int size() const noexcept { return int(texts_.size()); }
  const Text& text(int file) const { return texts_[std::size_t(file)]; }
  const Expansion& expansion(int via) const { return expansions_[std::size_t(via)]; }
  int depth(int via) const { return via < 0 ? 0 : expansion(via).depth; }
  /// The text of a span, cut after `most` bytes.
  std::string excerpt(const Span& span, std::size_t most = std::string::npos) const;
  /// From 0.
  int lineOf(int file, std::uint32_t offset) const;
  /// An offset beyond the text counts as its end. A byte that is no UTF-8 is one character.
  Position position(int file, std::uint32_t offset) const;
  /// The inverse. A line or column beyond the text is the last one there is; the middle of a
  /// character is its beginning.
  std::uint32_t offset(int file, int line, int utf16Column) const;
  /// The span from the beginning of one to the end of the other; if they came through different
  /// calls, in the innermost text that contains both.
  Span join(const Span& a, const Span& b) const {
    if (a.via != b.via || a.file != b.file || a.file < 0) return joinAcross(a, b);
    return {a.file, std::min(a.begin, b.begin), std::max(a.end, b.end), a.via};
  }

 private:
  Span joinAcross(Span a, Span b) const;

  std::vector<Text> texts_;
  std::vector<Expansion> expansions_;
  struct CallHash {
    std::size_t operator()(const Expansion& e) const noexcept;
  };
  struct SameCall {
    bool operator()(const Expansion& a, const Expansion& b) const noexcept;
  };
  std::unordered_set<std::string> names_;
  std::unordered_map<Expansion, int, CallHash, SameCall> known_;
  Total memory_ = std::make_shared<std::atomic<std::int64_t>>(0);
};

}  // namespace vestige::lang
