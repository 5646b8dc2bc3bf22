// SPDX-License-Identifier: Apache-2.0
// The words of the schemas, and replacements for words of POV-Ray that this language lacks.
#pragma once
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "lang/lang.h"
#include "lang/names.h"

namespace vestige::lang {

class Vocabulary {
 public:
  explicit Vocabulary(const SchemaSource& schemas);

  const Schema* find(const std::string& kind, const std::string& plugin) const {
    return schemas_.find(kind, plugin);
  }
  /// "brdf", "union", but not "sphere".
  bool isKind(const std::string& word) const { return kinds_.count(word) > 0; }
  bool isShape(const std::string& word) const { return schemas_.has("shape", word); }
  /// Whether a word begins a block: a kind, a shape or `object`.
  bool opensBlock(const std::string& word) const;
  /// The same, remembered.
  bool opensBlock(const Name& name) const;

  // For messages; these may be slow.
  /// Whether blocks of a kind may stand outside every other block.
  bool standsAlone(const std::string& kind) const;
  /// Kinds of blocks that may contain a block of this kind.
  std::vector<std::string> holders(const std::string& kind) const;
  /// Names of a kind's plugins; {""} for a kind without plugins.
  std::vector<std::string> plugins(const std::string& kind) const { return schemas_.names(kind); }
  /// Every word that opens a block.
  std::vector<std::string> blockWords() const;
  /// Adds a note with the reason why a plugin is missing, if one is known.
  void explain(Diagnostic& d, const std::string& kind, const std::string& plugin) const;

 private:
  /// Whether `is` holds for any schema of a kind.
  bool isAnyOf(const std::string& kind, const std::function<bool(const Schema&)>& is) const;

  const SchemaSource& schemas_;
  std::set<std::string> kinds_;
  enum class Opens : std::uint8_t { unknown, yes, no };
  mutable std::vector<Opens> opens_;  ///< by the name's id
};

/// The replacement for a word of POV-Ray that this language lacks; null for other words.
const char* insteadOf(const std::string& word);
/// All words that have one.
std::vector<std::string> replacedWords();
/// translate, rotate, scale, matrix, transform.
bool isTransformWord(const std::string& word);
inline bool isTransformWord(const Name& name) { return isTransform(name.word); }
/// Words with a fixed meaning in expressions: x, pi, rgb, true, sin, ...
bool isExpressionWord(const std::string& word);
/// "a, b or c"
std::string orList(const std::vector<std::string>& words);

}  // namespace vestige::lang
