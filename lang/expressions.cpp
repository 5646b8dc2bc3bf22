// SPDX-License-Identifier: Apache-2.0
#include "lang/expressions.h"

#include <algorithm>
#include <utility>

#include "lang/builtins.h"
#include "lang/data_file.h"
#include "lang/dictionary.h"
#include "lang/predefined.h"

namespace vestige::lang {
namespace {

const Token kNoToken;

/// Deepest tree of a function.
constexpr int kDeepestFunction = 250;
/// Bytes of a node and its place among the operands.
constexpr std::size_t kNodeBytes = sizeof(Expr) + 48;

/// x, pi, true, ...; std::monostate: not a constant.
Datum constantOf(Word word, double version) {
  const auto axis = [](int size, std::size_t i) {
    Numbers n;
    n.size = size;
    n.v[i] = 1;
    return n;
  };
  switch (word) {
    case Word::x:
      return axis(3, 0);
    case Word::y:
      return axis(3, 1);
    case Word::z:
      return axis(3, 2);
    case Word::t:
      return axis(4, 3);
    case Word::u:
      return axis(2, 0);
    case Word::v:
      return axis(2, 1);
    case Word::pi:
      return Numbers(3.14159265358979323846);
    case Word::tau:
      return Numbers(6.28318530717958647692);
    case Word::isTrue:
    case Word::yes:
    case Word::on:
      return Numbers(1);
    case Word::isFalse:
    case Word::no:
    case Word::off:
      return Numbers(0);
    case Word::version:
      return Numbers(version);
    default:
      return {};
  }
}

}  // namespace

class ExpressionParser::Reads {
 public:
  Reads(ExpressionParser& parser, Reading reading, const Function* function = nullptr)
      : parser_(parser), reading_(parser.reading_), function_(parser.function_) {
    parser.reading_ = reading;
    if (reading == Reading::syntax) return;
    parser.function_ = function;
    counters_.swap(parser.counters_);
    std::swap(nodes_, parser.nodes_);
  }
  ~Reads() {
    if (parser_.reading_ != Reading::syntax) {
      counters_.swap(parser_.counters_);
      std::swap(nodes_, parser_.nodes_);
    }
    parser_.reading_ = reading_, parser_.function_ = function_;
  }
  Reads(const Reads&) = delete;
  Reads& operator=(const Reads&) = delete;

 private:
  ExpressionParser& parser_;
  Reading reading_;
  const Function* function_;
  std::vector<Counter> counters_;
  std::int64_t nodes_ = 0;
};

class ExpressionParser::Operands {
 public:
  explicit Operands(ExpressionParser& parser)
      : budget_(parser.context_.budget), stack_(parser.stack_), first_(stack_.size()) {}
  ~Operands() {
    while (stack_.size() > first_) stack_.pop_back();
  }
  Operands(const Operands&) = delete;
  Operands& operator=(const Operands&) = delete;
  void add(Operand&& operand) {
    budget_.reserveOne(operand.span, stack_);
    stack_.push_back(std::move(operand));
  }
  std::size_t size() const { return stack_.size() - first_; }
  /// Valid until the next one is added, by anybody.
  std::span<Operand> all() { return std::span(stack_).subspan(first_); }

 private:
  Budget& budget_;
  std::vector<Operand>& stack_;
  std::size_t first_;
};

// ---------------------------------------------------------------- from outside
ExpressionParser::Result ExpressionParser::evaluate(Place place) {
  const With mode(*this,
                  {place != Place::setting, place == Place::declaration, stream_.frame().via});
  const Reads reads(*this, Reading::values);
  Operand e = isColourAhead() ? colour() : expression();
  return {std::move(e.value), e.span};
}

std::optional<double> ExpressionParser::condition() {
  const Span open = stream_.peek().span;
  if (!stream_.accept("(")) unexpected("'(' before a condition");
  if (isColourAhead()) misplacedColour();
  const Result result = evaluate(Place::parentheses);
  expect(")", open, "(");
  if (const Numbers* n = numbers(result.value); n && n->size == 1) return n->v[0];
  if (!isBroken(result.value))
    context_.reporter.error(result.span, "expected a number here, found " + describe(result.value));
  return {};
}

ExpressionParser::Result ExpressionParser::operand() {
  const With mode(*this, {});
  const Reads reads(*this, Reading::values);
  Operand e = postfix();
  return {std::move(e.value), e.span};
}

void ExpressionParser::functionBody(Function& function) {
  const Span open = stream_.peek().span;
  if (!stream_.accept("{")) unexpected("'{' before the function's expression");
  const With mode(*this, {true, false, -1});
  const Reads reads(*this, Reading::trees, &function);
  function.body = leaf(expression());
  function.bytes = context_.budget.take(open, std::size_t(nodes_) * kNodeBytes);
  expect("}", open, "{");
}

bool ExpressionParser::begins(const Token& t) const {
  if (t.kind == Token::Kind::number || t.kind == Token::Kind::string) return true;
  if (t.kind == Token::Kind::sign)
    return t.is("<") || t.is("(") || t.is("-") || t.is("+") || t.is("!");
  if (!t.isName()) return false;
  return declared(t) || t.text->builtin || isColour(t.word()) || t.word() == Word::defined ||
         t.word() == Word::sum || t.word() == Word::prod || t.word() == Word::local ||
         t.word() == Word::global || isSetting(t.word()) || !isBroken(constantOf(t.word(), 0));
}

void ExpressionParser::expect(const char* sign, const Span& open, const char* opener) {
  if (stream_.accept(sign)) return;
  const Token found = stream_.peek();
  if (found.kind == Token::Kind::bad) unexpected("");
  const int line = context_.sources.lineOf(open.file, open.begin);
  const bool sameLine = open.file == found.span.file &&
                        line == context_.sources.lineOf(found.span.file, found.span.begin);
  const std::string closes =
      "to close '" + std::string(opener) + "' at line " + std::to_string(line + 1);
  Diagnostic& d =
      context_.reporter.error(found.span, "expected '" + std::string(sign) + "' (" + closes +
                                              "), found " + describe(found, context_.sources));
  if (!sameLine) d.notes.push_back({open, "'" + std::string(opener) + "' was opened here"});
  throw SyntaxError{};
}

void ExpressionParser::unexpected(const std::string& expected) {
  const Token found = stream_.peek();
  if (found.kind == Token::Kind::bad) {
    stream_.next();
    context_.reporter.syntaxError(found.span, *found.text);
  }
  context_.reporter.syntaxError(
      found.span, "expected " + expected + ", found " + describe(found, context_.sources));
}

void ExpressionParser::undeclared(const Token& name, const std::string& role) {
  std::vector<std::string> known = context_.symbols.names();
  for (const std::string& b : builtinNames())
    if (isAnswered(*findBuiltin(b))) known.push_back(b);
  context_.step(name.span, kFileSteps);
  std::string hint = context_.suggest(name.span, *name.text, known);
  const std::string file = context_.declaredIn ? context_.declaredIn(*name.text) : "";
  if (!file.empty()) hint = ": it is declared in '" + file + "', which is not included";
  const char* instead = insteadOf(*name.text);
  if (instead || !file.empty()) context_.reporter.withdraw();
  context_.reporter.error(name.span, instead
                                         ? "'" + *name.text + "' is a word of POV-Ray's: " + instead
                                         : "no " + role + " is called '" + *name.text + "'" + hint);
}

// ---------------------------------------------------------------- steps
Operand ExpressionParser::made(Operation o, std::span<Operand> operands) {
  o.span = o.span.file < 0 ? o.wordSpan : o.span;
  for (const Operand& operand : operands)
    if (operand.span.file >= 0) o.span = context_.sources.join(o.span, operand.span);
  if (reading_ == Reading::syntax) return {{}, o.span};
  if (isBuilding()) return tree(o, operands);
  return {evaluator_.apply(o, operands), o.span};
}

Operand ExpressionParser::tree(const Operation& o, std::span<Operand> operands) {
  auto e = std::make_unique<Expr>();
  e->operation = o;
  for (Operand& operand : operands) {
    e->operands.push_back(leaf(std::move(operand)));
    e->depth = std::max(e->depth, e->operands.back()->depth + 1);
  }
  if (e->depth > kDeepestFunction)
    context_.reporter.syntaxError(o.span, "this function's expression is too long");
  countNode(o.span);
  return {{}, o.span, std::move(e)};
}

void ExpressionParser::countNode(const Span& span) {
  constexpr std::int64_t kCheckEvery = 1024;
  if (++nodes_ % kCheckEvery == 0) context_.budget.need(span, double(nodes_) * kNodeBytes);
}

/// The tree of an operand; of a value, a new one.
ExprPtr ExpressionParser::leaf(Operand&& operand) {
  if (operand.tree) return std::move(operand.tree);
  countNode(operand.span);
  auto e = std::make_unique<Expr>();
  e->operation.span = operand.span;
  e->value = std::move(operand.value);
  return e;
}

// The next token as an operator. In a declaration the next directive of the same text ends the
// expression: a missing ';' must not make `#declare B` run before `#declare A` is done.
const Token& ExpressionParser::operatorAhead() {
  if (mode_.endsAtDirective && stream_.isRawDirective()) {
    const Token raw = stream_.peekRaw();
    if (isStatement(raw.text->word) && raw.span.via == mode_.via) return kNoToken;
  }
  return stream_.peek();
}

// ---------------------------------------------------------------- the grammar
// expression := choice                 where comparisons are welcome
//             | sum                    elsewhere: '<' may begin the next vector
Operand ExpressionParser::expression() { return mode_.comparisons ? choice() : binary(Level::sum); }

// choice := logic ['?' choice ':' choice]
Operand ExpressionParser::choice() {
  Operand condition = binary(Level::logic);
  if (!condition.mayCount() || !operatorAhead().is("?")) return condition;
  const Span question = stream_.next().span;
  const Nested nested(context_, question);
  std::optional<bool> isFirst;
  if (reading_ == Reading::values) isFirst = evaluator_.condition(condition);
  Operand operands[3] = {std::move(condition)};
  operands[1] = branch(isFirst.value_or(false));
  expect(":", question, "?");
  operands[2] = branch(!isFirst.value_or(true));
  Operation o{.kind = Operation::Kind::choose, .wordSpan = question};
  if (reading_ != Reading::values) return made(o, operands);
  Operand result;
  result.span = context_.sources.join(operands[0].span, operands[2].span);
  if (isFirst) result.value = std::move(operands[*isFirst ? 1 : 2].value);
  return result;
}

Operand ExpressionParser::branch(bool isTaken) {
  const bool drops = reading_ == Reading::values && !isTaken;
  const Reads reads(*this, drops ? Reading::syntax : reading_, function_);
  return choice();
}

// logic := comparison { ('&' | '|' | '&&' | '||') comparison }      one level, as POV-Ray
// comparison := sum { ('<' | '<=' | '=' | '==' | '>=' | '>' | '!=') sum }
// sum := product { ('+' | '-') product }
// product := signedOperand { ('*' | '/' | '%') signedOperand }
// One function for the levels from `least` on.
Operand ExpressionParser::binary(Level least) {
  Operand left = signedOperand();
  for (;;) {
    // Behind a string or a block a directive may have to wait.
    const bool looksAhead = left.mayCount() || isEnclosed();
    const Op op = operatorOf(looksAhead ? operatorAhead().sign : stream_.rawSign());
    const Level level = levelOf(op);
    if (op == Op::none || level < least) return left;
    const Operation o{.kind = Operation::Kind::binary, .op = op, .wordSpan = stream_.next().span};
    Operand right = binary(above(level));
    if (reading_ == Reading::values && evaluator_.combine(o, left.value, right.value)) {
      left.span = context_.sources.join(left.span, right.span);
      continue;
    }
    Operand operands[2] = {std::move(left), std::move(right)};
    left = made(o, operands);
  }
}

// signedOperand := ('+' | '-' | '!') signedOperand | postfix
Operand ExpressionParser::signedOperand() {
  const Token& ahead = stream_.peek();
  if (isColour(ahead.word()) || (channelOf(ahead.word()) >= 0 && !declared(ahead)))
    misplacedColour();
  const Op op = ahead.is("!") ? Op::invert : operatorOf(ahead.sign);
  if (op != Op::invert && levelOf(op) != Level::sum) return postfix();
  const Span span = ahead.span;
  const Nested nested(context_, span);
  stream_.next();
  Operand operand = signedOperand();
  return made({.kind = Operation::Kind::unary, .op = op, .wordSpan = span}, {&operand, 1});
}

// postfix := primary { '.' key | '[' expression ']' | '(' call of a spline ')' } ['.' component]
Operand ExpressionParser::postfix() {
  Operand e = primary();
  for (;;) {
    const auto sign = stream_.rawSign();  // raw: what follows an #include's name must wait
    if (sign == signCode(".")) {
      const bool isEntry =
          reading_ == Reading::syntax || std::holds_alternative<DictionaryPtr>(e.value);
      e = member(std::move(e));
      if (!isEntry) return e;  // a component has no components
    } else if (sign == signCode("[")) {
      e = element(std::move(e));
    } else if (sign == signCode("(") && isSplineCall(e)) {
      e = splineCall(std::move(e));
    } else {
      return e;
    }
  }
}

Operand ExpressionParser::member(Operand of) {
  stream_.nextRaw();
  const Token word = stream_.nextRaw();
  const bool isEntry = std::holds_alternative<DictionaryPtr>(of.value);
  if (word.isName() && (isEntry || reading_ == Reading::syntax)) {
    Operand operands[2] = {std::move(of), {textDatum(*word.text), word.span}};
    return made({.kind = Operation::Kind::index, .wordSpan = word.span}, operands);
  }
  if (!isComponent(word.word()))
    context_.reporter.syntaxError(
        word.span, "expected a component after '.', found " + describe(word, context_.sources) +
                       ": known are x y z t u v red green blue filter transmit gray");
  return made({.kind = Operation::Kind::member, .word = word.word(), .wordSpan = word.span},
              {&of, 1});
}

Operand ExpressionParser::element(Operand of) {
  const Span open = stream_.nextRaw().span;
  const With mode(*this, {});
  Operands operands(*this);
  operands.add(std::move(of));
  do {
    operands.add(expression());
    expect("]", open, "[");
  } while (stream_.acceptRaw("["));
  return made({.kind = Operation::Kind::index, .wordSpan = open}, operands.all());
}

// primary := number | string | '(' expression ')' | vector | name
Operand ExpressionParser::primary() {
  const Token& ahead = stream_.peek();
  if (ahead.kind == Token::Kind::number) {
    Operand number{Numbers(ahead.number), ahead.span};
    stream_.next();
    return number;
  }
  if (ahead.kind == Token::Kind::string) {
    Operand string{context_.budget.text(ahead.span, *ahead.text), ahead.span};
    stream_.next();
    return string;
  }
  if (ahead.is("<")) return vector();
  if (ahead.isName()) return name();
  if (!ahead.is("(")) unexpected("a value");
  const Span open = ahead.span;
  const Nested nested(context_, open);
  stream_.next();
  const With mode(*this, {true, false, -1});
  Operand e = expression();
  expect(")", open, "(");
  e.span = context_.sources.join(open, context_.sources.join(e.span, stream_.last()));
  if (e.tree) e.tree->operation.span = e.span;
  return e;
}

// vector := '<' sum { [','] sum } '>'                2 to 5 components
Operand ExpressionParser::vector() {
  const Span open = stream_.next().span;
  const Nested nested(context_, open);
  const With mode(*this, {});
  Operand components[5];
  std::size_t count = 0;
  do {
    Operand next = expression();
    if (count == 5) context_.reporter.syntaxError(next.span, "a vector has 2 to 5 components");
    components[count++] = std::move(next);
    if (stream_.accept(",")) continue;
  } while (!stream_.peek().is(">") && !stream_.peek().is(">=") && begins(stream_.peek()));
  if (stream_.peek().is(">="))
    context_.reporter.syntaxError(
        stream_.peek().span,
        "'>=' is one sign: write a blank behind the '>' that ends the vector, as in '> ='");
  expect(">", open, "<");
  const Span whole = context_.sources.join(open, stream_.last());
  if (count < 2)
    context_.reporter.syntaxError(whole,
                                  "a vector has 2 to 5 components, found one; "
                                  "write a plain number instead");
  return made({.kind = Operation::Kind::vector, .wordSpan = whole}, {components, count});
}

// name := parameter | identifier | constant | call | 'defined' '(' identifier ')'
Operand ExpressionParser::name() {
  Token t = stream_.next();
  if (const auto table = scope(t)) return scoped(t, *table);
  if (const auto slot = slotOf(t.text)) {
    if (context_.events.areWanted()) context_.events.used(t, declarationOf(*slot));
    return made({.kind = Operation::Kind::parameter, .slot = *slot, .wordSpan = t.span}, {});
  }
  if (const Datum* value = declared(t)) {
    context_.used(t);
    const bool isFunction = std::holds_alternative<FunctionPtr>(*value);
    return isFunction && stream_.peekRaw().is("(") ? call(t, *value) : Operand{*value, t.span};
  }
  if (t.word() == Word::defined) return definedTest(t);
  if (t.word() == Word::sum || t.word() == Word::prod) return series(t);
  if (t.text->builtin && isAnswered(*t.text->builtin)) return call(t, {});
  if (Datum d = constantOf(t.word(), context_.version); !isBroken(d)) return {std::move(d), t.span};
  if (isSetting(t.word())) {
    if (function_ && t.word() == Word::now)
      context_.reporter.error(t.span, "now cannot stand inside a function");
    return {settingOf(context_, t.word()), t.span};
  }
  return unknown(t);
}

// call := function '(' [ sum { [','] sum } ] ')'
// Commas may be left out in front of the arguments that a call must have, and of strings.
// `function`: the declared one; nothing: a built-in.
Operand ExpressionParser::call(const Token& name, const Datum& function) {
  const Builtin* builtin = isBroken(function) ? name.text->builtin : nullptr;
  const Nested nested(context_, name.span);
  Operands operands(*this);
  if (!builtin) operands.add({function, {}});
  const Span open = stream_.peek().span;
  if (!stream_.accept("(")) unexpected("'(' after the function '" + *name.text + "'");
  if (builtin && !builtin->isPure && function_)
    context_.reporter.error(name.span, *name.text + "() cannot stand inside a function");
  // Where no argument is a vector, '<' can only compare, even if a comma was left out.
  const bool takesVectors = builtin && builtin->takesVectors;
  const With mode(*this, {!takesVectors, false, -1});
  Target assigned;
  bool isMore = !stream_.peek().is(")");
  while (isMore) {
    const bool isTarget = builtin && reading_ == Reading::values &&
                          builtin->fits(operands.size() + 1) &&
                          builtin->letter(operands.size()) == 't';
    operands.add(isTarget ? target(assigned) : expression());
    isMore = stream_.accept(",");
    if (isMore || !begins(stream_.peek())) continue;
    if (builtin && operands.size() >= builtin->needsCommas) unexpected("',' or ')'");
    isMore = true;
  }
  expect(")", open, "(");
  const auto kind = builtin ? Operation::Kind::builtin : Operation::Kind::invoke;
  const Span whole = context_.sources.join(name.span, stream_.last());
  context_.events.call(*name.text, whole);
  Operand result =
      made({.kind = kind, .span = whole, .wordSpan = name.span, .name = name.text}, operands.all());
  if (assigned.place && !isBroken(result.value)) *assigned.place = context_.tracedNormal;
  return result;
}

Operand ExpressionParser::definedTest(const Token& word) {
  const Span open = stream_.peekRaw().span;
  if (!stream_.acceptRaw("(")) unexpected("'(' after 'defined'");
  const Token name = stream_.nextRaw();
  if (!name.isName())
    context_.reporter.syntaxError(
        name.span, "expected a name after 'defined(', found " + describe(name, context_.sources));
  const bool isKnown = isDefined(name);
  if (!stream_.acceptRaw(")")) expect(")", open, "(");
  return {Numbers(isKnown ? 1 : 0), context_.sources.join(word.span, stream_.last())};
}

// { '[' sum ']' | '.' key } after a name. An index outside the array names nothing.
bool ExpressionParser::isDefined(Token name) {
  const auto table = scope(name);
  const Cell cell =
      table ? context_.symbols.findIn(*table, name.text) : context_.symbols.find(name.text);
  if (cell) {
    const auto at = table ? context_.symbols.declarationIn(*table, name.text)
                          : context_.symbols.declaration(name.text);
    context_.events.used(name, *at);
  }
  Datum value = cell ? valueOf(*cell) : Datum();
  bool isKnown = cell && !isClosed(value);
  std::size_t dimension = 0, at = 0;
  while (stream_.peekRaw().is("[") || stream_.peekRaw().is(".")) {
    const bool isNamed = stream_.peekRaw().is(".");
    const Span bracket = stream_.nextRaw().span;
    const Datum index = isNamed ? keyBehindDot() : evaluate(Place::setting).value;
    if (!isNamed) expect("]", bracket, "[");
    if (const auto* dictionary = std::get_if<DictionaryPtr>(&value)) {
      const auto* key = std::get_if<TextPtr>(&index);
      const DictionaryPtr of = *dictionary;
      const auto entry = key ? of->entries.find(**key) : of->entries.end();
      isKnown = isKnown && entry != of->entries.end() && !isBroken(entry->second);
      value = isKnown ? entry->second : Datum();
      continue;
    }
    const auto* array = std::get_if<ArrayPtr>(&value);
    const Numbers* n = numbers(index);
    const int size = array ? (*array)->sizes[dimension] : 0;
    if (!isKnown || !n || !(n->v[0] >= -kTruth && n->v[0] + kTruth < size)) {
      isKnown = false;
      continue;
    }
    at = at * std::size_t(size) + std::size_t(n->v[0] + kTruth);
    if (++dimension < (*array)->sizes.size()) continue;
    value = Datum((*array)->data[at]);
    isKnown = !isBroken(value);
    dimension = at = 0;
  }
  return isKnown;
}

// An undeclared name, with the arguments that may follow it.
Operand ExpressionParser::unknown(const Token& name) {
  const bool isCall = stream_.peekRaw().is("(");
  if (words_.opensBlock(*name.text))
    context_.reporter.syntaxError(name.span, "expected a value, found '" + *name.text + "'");
  undeclared(name, isCall ? "function or macro" : "value");
  int depth = 0;
  while (isCall) {
    const Token t = stream_.nextRaw();
    if (t.is("(")) ++depth;
    if (t.is(")")) --depth;
    if (depth == 0 || t.kind == Token::Kind::end) break;
  }
  return {{}, name.span};
}

}  // namespace vestige::lang
