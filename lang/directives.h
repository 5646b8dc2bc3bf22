// SPDX-License-Identifier: Apache-2.0
// Directives (words after '#') and macro calls.
#pragma once
#include "lang/data_file.h"
#include "lang/parser.h"

namespace vestige::lang {

class Directives {
 public:
  Directives(Context& context, TokenStream& stream, Parser& parser, Includes& includes,
             DataFiles& dataFiles)
      : context_(context),
        stream_(stream),
        parser_(parser),
        includes_(includes),
        dataFiles_(dataFiles) {}

  /// Executes the directive that the stream has just read. Recovers from an error in it.
  void obey(const Token& directive);
  /// Reads the arguments of a macro and makes the stream read its body.
  void expand(const Token& name);
  /// The element or entry of a value that the next tokens lead to; null after an error.
  Datum* place(Symbol& whole) { return placeOf(targetOf(whole), parser_.selectors(), false); }

 private:
  using Handler = void (Directives::*)(const Token&);
  static Handler handlerOf(const std::string& word);
  /// The same, remembered.
  Handler handlerFor(const Name& word);

  // Names.
  void declare(const Token& directive);
  void declareTuple(const Token& directive);
  bool isDictionary(const Token& name);
  void assignEntry(const Token& directive, const Token& name);
  Datum* placeOf(Datum& whole, const std::vector<Parser::Selector>& path, bool makes);
  void forget(const Token& name);
  void assignElement(const Token& directive, const Token& name);
  ArrayPtr copied(const Span& span, const Array& array);
  void needSemicolon(bool isNumbers, const std::string& name);
  void undefine(const Token& directive);
  Token newName(const Token& directive, std::optional<std::size_t>* scope = nullptr);
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
  struct Indices {
    std::vector<double> values;
    std::vector<Span> spans;
  };
  Indices indices();
  std::optional<std::size_t> placeIn(const Datum& whole, const Indices& indices, std::size_t& next);
  bool isElementAhead() const;
  bool isArgumentAhead();
  Cell elementArgument(const Token& name);
  Datum& targetOf(Symbol& symbol);
  void assign(Symbol& symbol, Datum value, const Span& declared);
  bool isGiven(const Token& directive) const;
  std::optional<Deprecation> deprecated();
  bool testWhile(std::uint32_t first);
  bool isWithin(const OpenDirective& loop, const Span& span);
  void choose(std::uint32_t part);
  bool caseMatches(const std::string& word, double x);
  double loopBound();
  double loopStep();
  void countLoop(const Span& span);
  std::uint32_t here() { return stream_.frame().at - 1; }
  std::uint32_t endOf(std::uint32_t part);
  void jumpBehind(std::uint32_t index);
  std::uint32_t skipTo(std::uint32_t part);
  void skipParts(std::uint32_t part);
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
  bool refuseInclude(const std::string& path, int file, const Span& span);
  void message(const Token& directive);
  void version(const Token& directive);
  std::optional<std::string> text(const Token& directive, Span& span);

  // Files of data.
  void openFile(const Token& directive);
  void closeFile(const Token& directive);
  void writeFile(const Token& directive);
  void readFile(const Token& directive);
  DataFilePtr openedFile(const Token& directive, Token& name);
  std::optional<std::string> written(const Datum& value, const Span& span);
  bool readInto(const Token& directive, DataFile* file);
  bool nextDatum(DataFile& file, Datum& value);
  Datum datum(DataFile& file);
  double dataNumber(DataFile& file);

  void skipStatement(const Token& directive, int level);

  Context& context_;
  TokenStream& stream_;
  Parser& parser_;
  Includes& includes_;
  DataFiles& dataFiles_;
  std::vector<Handler> handlers_;  ///< by the word's id
  std::int64_t loops_ = 0;
};

}  // namespace vestige::lang
