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
  bool isDefined(Token name);
  std::optional<std::size_t> scope(Token& name);
  /// Reads a closing sign or reports an error; the construct was opened at `open`.
  void expect(const char* sign, const Span& open, const char* opener);
  /// Reports "expected X, found Y" at the next token.
  [[noreturn]] void unexpected(const std::string& expected);
  /// Reports an undeclared name.
  void undeclared(const Token& name, const std::string& role);

 private:
  /// What becomes of the steps that are read.
  enum class Reading : std::uint8_t {
    values,  ///< they are evaluated at once
    trees,   ///< they are kept: the body of a function
    syntax,  ///< they are dropped: the branch of a choice that is not taken
  };
  struct Mode {
    bool comparisons = false, endsAtDirective = false;
    std::int32_t via = -1;  ///< the text whose directives end it
  };
  /// Another mode during its lifetime.
  class With {
   public:
    With(ExpressionParser& parser, Mode mode) : parser_(parser), before_(parser.mode_) {
      parser.mode_ = mode;
    }
    ~With() { parser_.mode_ = before_; }
    With(const With&) = delete;
    With& operator=(const With&) = delete;

   private:
    ExpressionParser& parser_;
    Mode before_;
  };
  class Reads;     ///< another way of reading during its lifetime
  class Operands;  ///< of a call, on the common stack

  const Token& operatorAhead();
  Operand expression();
  Operand choice();
  Operand branch(bool isTaken);
  Operand binary(Level least);
  Operand signedOperand();
  Operand postfix();
  Operand member(Operand of);
  Operand element(Operand of);
  bool isSplineCall(const Operand& e);
  Operand splineCall(Operand of);
  Operand primary();
  Operand name();
  Operand vector();
  Operand colour();
  bool isColourAhead();
  bool isChannelAhead();
  [[noreturn]] void misplacedColour();
  Operand channels(std::optional<Operand> base);
  Operand call(const Token& name, const Datum& function);
  /// What an argument is assigned to; null: nothing.
  struct Target {
    Cell cell = nullptr;  ///< keeps it alive
    Datum* place = nullptr;
  };
  Operand target(Target& target);
  bool isAnswered(const Builtin& builtin) const;
  Datum keyBehindDot();
  Operand scoped(const Token& name, std::size_t table);
  Operand series(const Token& word);
  Token counter();
  std::optional<int> slotOf(const Name* name) const;
  Span declarationOf(int slot) const;
  Operand definedTest(const Token& word);
  Operand unknown(const Token& name);

  /// The result of a step.
  Operand made(Operation o, std::span<Operand> operands);
  Operand tree(const Operation& o, std::span<Operand> operands);
  void countNode(const Span& span);
  ExprPtr leaf(Operand&& operand);
  /// Between parentheses macros can be expanded to look for an operator: a directive that waits
  /// is never behind the value.
  bool isEnclosed() const { return mode_.comparisons && !mode_.endsAtDirective; }
  bool isBuilding() const { return reading_ == Reading::trees; }
  const Datum* declared(const Token& name) const { return context_.symbols.value(name.text); }

  Context& context_;
  TokenStream& stream_;
  const Vocabulary& words_;
  Evaluator evaluator_;
  Mode mode_;
  Reading reading_ = Reading::values;
  const Function* function_ = nullptr;  ///< whose body is being read
  struct Counter {
    const Name* name;
    Span declared;
  };
  std::vector<Counter> counters_;  ///< of sum() and prod(), innermost last; behind the parameters
  std::int64_t nodes_ = 0;         ///< of its tree
  std::vector<Operand> stack_;     ///< the arguments of the calls that are being read
};

}  // namespace vestige::lang
