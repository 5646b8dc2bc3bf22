// SPDX-License-Identifier: Apache-2.0
// The words that the schemas bring, and those that POV-Ray has and this language has not.
#pragma once
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include <vestige/schema.h>

namespace vestige::lang {

class Vocabulary {
 public:
  explicit Vocabulary(std::span<const Schema> schemas);

  const Schema* find(const std::string& kind, const std::string& plugin) const;
  /// "brdf", "union", but not "sphere".
  bool isKind(const std::string& word) const { return plugins_.count(word) > 0; }
  bool isShape(const std::string& word) const { return find("shape", word) != nullptr; }
  /// Begins a block: a kind, a shape or `object`.
  bool opensBlock(const std::string& word) const;
  /// Kinds that may stand outside every other block.
  bool standsAlone(const std::string& kind) const { return isKind(kind) && !parts_.count(kind); }
  /// Names of a kind's plugins; {""} for a kind that has none.
  const std::vector<std::string>& plugins(const std::string& kind) const;
  /// Every word that opens a block.
  std::vector<std::string> blockWords() const;

 private:
  std::map<std::string, std::vector<std::string>> plugins_;  ///< by kind
  std::map<std::pair<std::string, std::string>, const Schema*> schemas_;
  std::set<std::string> parts_;  ///< kinds that only ever stand inside another block
};

/// What to write instead of a word of POV-Ray's that this language has no use for; null for others.
const char* insteadOf(const std::string& word);
/// translate, rotate, scale, matrix, transform.
bool isTransformWord(const std::string& word);
/// Kinds of blocks that have no place in space.
bool isMovable(const std::string& kind);
/// Words with a fixed meaning in expressions: x, pi, rgb, true, sin, ...
bool isExpressionWord(const std::string& word);
/// "a, b or c"
std::string orList(const std::vector<std::string>& words);

}  // namespace vestige::lang
