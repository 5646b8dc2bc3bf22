// SPDX-License-Identifier: Apache-2.0
// Directives (words after '#') and macro calls.
#pragma once
#include "lang/include.h"
#include "lang/parser.h"

namespace vestige::lang {

class Directives {
 public:
  Directives(Context& context, TokenStream& stream, Parser& parser, Includes& includes)
      : context_(context), stream_(stream), parser_(parser), includes_(includes) {}

  /// Executes the directive that the stream has just read. Recovers from an error in it.
  void obey(const Token& directive);
  /// Reads the arguments of a macro and makes the stream read its body.
  void expand(const Token& name);

 private:
  using Handler = void (Directives::*)(const Token&);
  static Handler handlerOf(const std::string& word);
  /// The same, remembered.
  Handler handlerFor(const Name& word);

  // Names.
  void declare(const Token& directive);
  void assignElement(const Token& directive, const Token& name);
  ArrayPtr copied(const Span& span, const Array& array);
  void needSemicolon(bool isNumbers, const std::string& name);
  void undefine(const Token& directive);
  Token newName(const Token& directive);
  Token plainName(const std::string& before);

  // Choices and loops, by index in the frame's list.
  void ifBranch(const Token& directive);
  void whileLoop(const Token& directive);
  void forLoop(const Token& directive);
  void choice(const Token& directive);
  void nextPart(const Token& directive);
  void end(const Token& directive);
  void leave(const Token& directive);
  bool holds(const std::string& word);
  bool isDefined();
  bool testWhile(std::uint32_t first);
  bool isWithin(const OpenDirective& loop, const Span& span);
  bool caseMatches(const std::string& word, double x);
  void countLoop(const Span& span);
  std::uint32_t here() { return stream_.frame().at - 1; }
  std::uint32_t endOf(std::uint32_t part);
  void jumpBehind(std::uint32_t index);
  void abandon(std::uint32_t first, std::size_t frames);
  bool isOpen(std::uint32_t part);

  // Macros and texts.
  void macro(const Token& directive);
  void macroParameters(Macro& macro);
  Cell argument(const std::string& macro);
  bool takes(const Macro& macro, std::size_t arguments, const Span& call);
  void readBody(const Macro& macro, const std::vector<Cell>& arguments, const Span& call);
  void checkMacroDepth(const Token& name);
  void include(const Token& directive);
  void missingInclude(const std::string& name, const Span& span,
                      const std::vector<std::string>& tried);
  bool refuseInclude(const std::string& path, int file, const Span& span);
  void message(const Token& directive);
  void version(const Token& directive);
  std::optional<std::string> text(const Token& directive, Span& span);

  void skipStatement(const Token& directive, int level);

  Context& context_;
  TokenStream& stream_;
  Parser& parser_;
  Includes& includes_;
  std::vector<Handler> handlers_;  ///< by the word's id
  std::int64_t loops_ = 0;
};

}  // namespace vestige::lang
