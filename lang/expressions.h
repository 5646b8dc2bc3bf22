// SPDX-License-Identifier: Apache-2.0
// Parses expressions into trees.
#pragma once
#include "lang/ast.h"
#include "lang/eval.h"
#include "lang/stream.h"
#include "lang/vocabulary.h"

namespace vestige::lang {

class ExpressionParser {
 public:
  ExpressionParser(Context& context, TokenStream& stream, const Vocabulary& words)
      : context_(context), stream_(stream), words_(words), evaluator_(context) {}

  /// The context of an expression, which decides where it ends.
  enum class Place {
    setting,      ///< in a block: comparisons need parentheses, `0 <1,2,3>` is two values
    parentheses,  ///< comparisons are allowed
    declaration,  ///< after `#declare A =`: comparisons are allowed, and the next directive ends it
  };
  struct Result {
    Datum value;
    Span span;
  };
  Result evaluate(Place place);
  /// '(' expression ')': a number; nothing if an error was reported.
  std::optional<double> condition();
  /// A string or another value, read without lookahead: a directive that follows it must not be
  /// executed yet.
  Result operand();
  /// '{' expression '}', in which parameters are referred to by their slots in the function.
  void functionBody(Function& function);

  /// Whether an expression can begin with this token.
  bool begins(const Token& token) const;
  /// Reads the indices that may follow a name: whether it, or that element, has a value.
  bool isDefined(const Token& name);
  /// Reads a closing sign or reports an error; the construct was opened at `open`.
  void expect(const char* sign, const Span& open, const char* opener);
  /// Reports "expected X, found Y" at the next token.
  [[noreturn]] void unexpected(const std::string& expected);
  /// Reports an undeclared name.
  void undeclared(const Token& name, const std::string& role);

 private:
  struct Mode {
    bool comparisons = false, endsAtDirective = false;
    std::int32_t via = -1;  ///< the text whose directives end it
  };
  class With;  ///< another mode during its lifetime
  class Tree;

  const Token& operatorAhead();
  ExprPtr expression();
  ExprPtr choice();
  ExprPtr logic();
  ExprPtr comparison();
  ExprPtr sum();
  ExprPtr product();
  ExprPtr signedOperand();
  ExprPtr postfix();
  ExprPtr primary();
  ExprPtr name();
  ExprPtr vector();
  ExprPtr colour(bool wholeSum);
  bool isChannelAhead();
  ExprPtr channels(ExprPtr base);
  ExprPtr call(const Token& name, const Datum& symbol);
  ExprPtr definedTest(const Token& word);
  ExprPtr unknown(const Token& name);

  using Level = ExprPtr (ExpressionParser::*)();
  ExprPtr chain(Level operand, std::initializer_list<const char*> signs);
  ExprPtr constant(Datum value, const Span& span);
  ExprPtr node(Expr::Kind kind, const Span& span, std::string word, std::vector<ExprPtr> args);
  ExprPtr bounded(ExprPtr e);
  void countNode(const Span& span);

  Context& context_;
  TokenStream& stream_;
  const Vocabulary& words_;
  Evaluator evaluator_;
  Mode mode_;
  std::int64_t nodes_ = 0;              ///< of the trees that exist
  const Function* function_ = nullptr;  ///< whose body is being read
};

}  // namespace vestige::lang
