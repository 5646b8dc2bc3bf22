// SPDX-License-Identifier: Apache-2.0
// The grammar of expressions: from tokens to trees.
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

  /// Where an expression stands, which decides where it ends.
  enum class Place {
    setting,      ///< in a block: a comparison has to stand in parentheses, `0 <1,2,3>` are two
    parentheses,  ///< comparisons are welcome
    declaration,  ///< right of `#declare A =`: comparisons, and the next directive ends it
  };
  struct Result {
    Datum value;
    Span span;
  };
  Result evaluate(Place place);
  /// '(' expression ')': a number; nothing after a complaint.
  std::optional<double> condition();
  /// A string, or another value, that is read without a look at what follows: behind it comes a
  /// directive that must not be obeyed yet.
  Result operand();
  /// '{' expression '}', the parameters being known by the function's slots.
  void functionBody(Function& function);

  /// Can an expression begin with this token?
  bool begins(const Token& token) const;
  /// Takes a sign or complains: what it closes was opened at `open`.
  void expect(const char* sign, const Span& open, const char* opener);
  /// "expected X, found Y" at the next token.
  [[noreturn]] void unexpected(const std::string& expected);
  /// Complains about a name that means nothing.
  void undeclared(const Token& name, const std::string& role);

 private:
  struct Mode {
    bool comparisons = false, endsAtDirective = false;
    std::int32_t via = -1;  ///< the text whose directives end it
  };
  class With;  ///< another mode for as long as it lives

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
  ExprPtr channels(const Token& word);
  ExprPtr call(const Token& name, const Datum& symbol);
  ExprPtr definedTest(const Token& word);
  ExprPtr unknown(const Token& name);

  using Level = ExprPtr (ExpressionParser::*)();
  ExprPtr chain(Level operand, std::initializer_list<const char*> signs);
  ExprPtr constant(Datum value, const Span& span);
  ExprPtr node(Expr::Kind kind, const Span& span, std::string word, std::vector<ExprPtr> args);
  ExprPtr bounded(ExprPtr e);

  Context& context_;
  TokenStream& stream_;
  const Vocabulary& words_;
  Evaluator evaluator_;
  Mode mode_;
  const Function* function_ = nullptr;  ///< whose body is being read
};

}  // namespace vestige::lang
