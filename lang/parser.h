// SPDX-License-Identifier: Apache-2.0
// The grammar of scenes and blocks. It contains no plugin's words: schemas define which items a
// block accepts.
#pragma once
#include "lang/builder.h"
#include "lang/expressions.h"

namespace vestige::lang {

class Parser {
 public:
  Parser(Context& context, TokenStream& stream, const Vocabulary& words)
      : context_(context), stream_(stream), words_(words), expressions_(context, stream, words) {}

  /// Parses everything up to the end of the text.
  void scene(SceneDesc& scene);

  /// A value after `#declare A =` or as a macro's argument.
  struct Declared {
    Datum value;
    Span span;
  };
  Declared value(ExpressionParser::Place place);
  /// What follows the name of an array or a dictionary.
  struct Selector {
    bool isKey = false;
    std::string key;
    double index = 0;
    Span span;
  };
  /// All that follow, without lookahead.
  std::vector<Selector> selectors();
  ExpressionParser& expressions() { return expressions_; }
  const Vocabulary& words() const { return words_; }
  /// After a syntax error: to the next word that begins something outside the braces that are open
  /// beyond `level`.
  void skipToStatement(int level);

 private:
  /// The head of a block: its schema, and the declared block that it copies.
  struct Head {
    const Schema* schema = nullptr;
    Span span;
    BlockPtr base = nullptr;
    bool isOpen = false;  ///< '{' has been taken
    Span brace = {};
    std::string after = "";  ///< the parameter's word before it, if that is not its kind
  };
  enum class Braces { needed, optional };

  void statement(SceneDesc& scene);
  void addToScene(SceneDesc& scene, Block block);
  Block block();
  Block objectBlock();
  Block finishBlock(Head head, Braces braces);
  Head head(const std::string& kind, Head head);
  bool headName(const std::string& kind, Head& head);
  [[noreturn]] void unknownPlugin(const std::string& kind, const Token& found,
                                  const std::string& after = "");

  void items(BlockBuilder& b, const Span& brace);
  void neverClosed(BlockBuilder& b, const Span& brace);
  enum class Next { more, closed };
  Next item(BlockBuilder& b, bool afterComma);
  void positional(BlockBuilder& b);
  void setting(BlockBuilder& b, const Parameter& row);
  void blockSetting(BlockBuilder& b, const Parameter& row, const Span& nameSpan);
  Block blockOf(const Parameter& row, const Span& nameSpan);
  bool pigmentSetting(BlockBuilder& b, const Parameter& row, const Span& nameSpan);
  std::optional<Block> pigment();
  bool choiceSetting(BlockBuilder& b, const Parameter& row, const Span& nameSpan);
  bool listSetting(BlockBuilder& b, const Parameter& row, const Span& nameSpan);
  List list(const Parameter& row);
  List map(const Parameter& row);
  Entry mapEntry(const Parameter& row, const Parameter& entry, const List& before);
  Value entryValue(const Parameter& entry, const std::string& who);
  void addEntry(List& list, Entry entry);
  bool functionSetting(BlockBuilder& b, const Parameter& row, const Span& nameSpan);
  [[noreturn]] void misplaced(const BlockBuilder& b, const Token& found, const std::string& what,
                              const std::string& kind);
  Next nested(BlockBuilder& b, const Token& word);
  void declaredItem(BlockBuilder& b, const Token& name, const Block& declared);
  void unknownItem(BlockBuilder& b, const Token& name);
  bool isValue(const BlockBuilder& b, const Token& t, bool afterComma) const;
  void skipToItem(const BlockBuilder& b, int level);
  template <class StopsAt>
  void skip(int level, StopsAt stopsAt, bool stopsAfterBraces);

  Affine transform();
  Affine transformBlock();
  Affine matrix();
  std::optional<Numbers> transformVector(const std::string& word, Span& span);
  Declared function();
  Declared functionBehind(const Span& word);
  Declared array();
  void acceptMixed();
  Declared dictionary();
  Selector selector();
  SplinePtr spline();
  const SplinePtr* namedSpline();
  void splinePoint(Spline& s, const Span& open);
  void elements(Array& array, std::size_t level, std::size_t first);

  BlockPtr declaredBlock(const Token& name) const;
  bool isAhead(const char* word) { return stream_.peek().isWord(word); }

  Context& context_;
  TokenStream& stream_;
  const Vocabulary& words_;
  ExpressionParser expressions_;
  int assumedBraces_ = 0;  ///< '}' that were missing and may still turn up
};

}  // namespace vestige::lang
