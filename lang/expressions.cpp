// SPDX-License-Identifier: Apache-2.0
#include "lang/expressions.h"

#include <map>

#include "lang/builtins.h"

namespace vestige::lang {
namespace {

/// Deeper trees are folded to a constant immediately, so that a sum of a million terms needs no
/// stack.
constexpr int kDeepTree = 64;
/// Bytes of a node, its operator and its place among the arguments.
constexpr std::size_t kNodeBytes = sizeof(Expr) + 48;
/// A function's tree is never folded.
constexpr int kDeepestFunction = 250;

constexpr const char* kSwizzles[] = {"x",     "y",    "z",      "t",        "u",    "v",   "red",
                                     "green", "blue", "filter", "transmit", "gray", "grey"};

bool isColourWord(const Token& t) {
  if (t.kind != Token::Kind::name) return false;
  static const std::set<std::string> words = {"rgb",   "rgbf",  "rgbt",   "rgbft", "srgb",
                                              "srgbf", "srgbt", "srgbft", "color", "colour"};
  return words.count(*t.text) > 0;
}

constexpr const char* kChannels[] = {"red", "green", "blue", "filter", "transmit"};

/// The place of a channel in a colour; -1: not the name of one.
int channelOf(const Token& t) {
  if (t.kind != Token::Kind::name) return -1;
  for (int i = 0; i < 5; ++i)
    if (t.isWord(kChannels[i])) return i;
  return -1;
}

/// x, pi, true, ...; std::monostate: not a constant.
Datum constantOf(const std::string& word, double version) {
  static const std::map<std::string, double> numbers = {{"pi", 3.14159265358979323846},
                                                        {"tau", 6.28318530717958647692},
                                                        {"true", 1},
                                                        {"yes", 1},
                                                        {"on", 1},
                                                        {"false", 0},
                                                        {"no", 0},
                                                        {"off", 0},
                                                        {"clock", 0}};
  if (word == "version") return Numbers(version);
  if (const auto n = numbers.find(word); n != numbers.end()) return Numbers(n->second);
  static const std::map<std::string, std::pair<int, int>> axes = {
      {"x", {3, 0}}, {"y", {3, 1}}, {"z", {3, 2}}, {"t", {4, 3}}, {"u", {2, 0}}, {"v", {2, 1}}};
  const auto axis = axes.find(word);
  if (axis == axes.end()) return {};
  Numbers n;
  n.size = axis->second.first;
  n.v[std::size_t(axis->second.second)] = 1;
  return n;
}

/// Directives with an effect of their own, unlike #if or #end, which choose the text to read.
bool isStatement(const Token& t) {
  static const std::set<std::string> words = {"declare", "local",   "undef", "macro",  "include",
                                              "debug",   "warning", "error", "version"};
  return t.kind == Token::Kind::directive && words.count(*t.text) > 0;
}

}  // namespace

class ExpressionParser::With {
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

/// The nodes that an expression creates, during its lifetime.
class ExpressionParser::Tree {
 public:
  explicit Tree(ExpressionParser& parser) : parser_(parser), before_(parser.nodes_) {}
  ~Tree() { parser_.nodes_ = before_; }
  Tree(const Tree&) = delete;
  Tree& operator=(const Tree&) = delete;
  std::size_t bytes() const { return std::size_t(parser_.nodes_ - before_) * kNodeBytes; }

 private:
  ExpressionParser& parser_;
  std::int64_t before_;
};

// ---------------------------------------------------------------- from outside
ExpressionParser::Result ExpressionParser::evaluate(Place place) {
  const With mode(*this,
                  {place != Place::setting, place == Place::declaration, stream_.frame().via});
  const Tree tree(*this);
  const Function* around = std::exchange(function_, nullptr);
  const ExprPtr e = expression();
  function_ = around;
  return {evaluator_.evaluate(*e), e->span};
}

std::optional<double> ExpressionParser::condition() {
  const Span open = stream_.peek().span;
  if (!stream_.accept("(")) unexpected("'(' before a condition");
  const Result result = evaluate(Place::parentheses);
  expect(")", open, "(");
  if (const Numbers* n = numbers(result.value); n && n->size == 1) return n->v[0];
  if (!isBroken(result.value))
    context_.reporter.error(result.span, "expected a number here, found " + describe(result.value));
  return {};
}

ExpressionParser::Result ExpressionParser::operand() {
  const With mode(*this, {});
  const Tree tree(*this);
  const ExprPtr e = postfix();
  return {evaluator_.evaluate(*e), e->span};
}

void ExpressionParser::functionBody(Function& function) {
  const Span open = stream_.peek().span;
  if (!stream_.accept("{")) unexpected("'{' before the function's expression");
  const With mode(*this, {true, false, -1});
  const Tree tree(*this);
  const Function* around = std::exchange(function_, &function);
  try {
    function.body = expression();
  } catch (...) {
    function_ = around;
    throw;
  }
  function_ = around;
  function.bytes = context_.budget.take(open, tree.bytes());
  expect("}", open, "{");
}

bool ExpressionParser::begins(const Token& t) const {
  if (t.kind == Token::Kind::number || t.kind == Token::Kind::string) return true;
  if (t.kind == Token::Kind::sign)
    return t.is("<") || t.is("(") || t.is("-") || t.is("+") || t.is("!");
  if (t.kind != Token::Kind::name) return false;
  return context_.symbols.find(t.text) || findBuiltin(*t.text) || isColourWord(t) ||
         t.isWord("defined") || !isBroken(constantOf(*t.text, 0));
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
  for (const std::string& b : builtinNames()) known.push_back(b);
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

// ---------------------------------------------------------------- building
ExprPtr ExpressionParser::constant(Datum value, const Span& span) {
  countNode(span);
  auto e = std::make_unique<Expr>();
  e->value = std::move(value);
  e->span = span;
  return e;
}

/// Bounds the nodes that exist at one time, in all unfinished expressions.
void ExpressionParser::countNode(const Span& span) {
  constexpr std::int64_t kCheckEvery = 1024;
  if (++nodes_ % kCheckEvery == 0) context_.budget.need(span, double(nodes_) * kNodeBytes);
}

ExprPtr ExpressionParser::bounded(ExprPtr e) {
  for (const ExprPtr& arg : e->args)
    if (arg) {
      e->depth = std::max(e->depth, arg->depth + 1);
      e->size += arg->size;
    }
  if (function_) {
    if (e->depth > kDeepestFunction)
      context_.reporter.syntaxError(e->span, "this function's expression is too long");
    return e;
  }
  if (e->depth <= kDeepTree) return e;
  Datum value = evaluator_.evaluate(*e);
  nodes_ -= e->size;
  return constant(std::move(value), e->span);
}

ExprPtr ExpressionParser::node(Expr::Kind kind, const Span& span, std::string word,
                               std::vector<ExprPtr> args) {
  countNode(span);
  auto e = std::make_unique<Expr>();
  e->kind = kind;
  e->span = e->wordSpan = span;
  e->word = std::move(word);
  e->args = std::move(args);
  for (const ExprPtr& arg : e->args)
    if (arg) e->span = context_.sources.join(e->span, arg->span);
  return bounded(std::move(e));
}

// The next token as an operator. In a declaration the next directive of the same text ends the
// expression: a missing ';' must not make `#declare B` run before `#declare A` is done.
const Token& ExpressionParser::operatorAhead() {
  static const Token nothing;  // no sign
  if (mode_.endsAtDirective) {
    const Token raw = stream_.peekRaw();
    if (isStatement(raw) && raw.span.via == mode_.via) return nothing;
  }
  return stream_.peek();
}

// ---------------------------------------------------------------- the grammar
// expression := choice                 where comparisons are welcome
//             | sum                    elsewhere: '<' may begin the next vector
ExprPtr ExpressionParser::expression() { return mode_.comparisons ? choice() : sum(); }

// choice := logic ['?' choice ':' choice]
ExprPtr ExpressionParser::choice() {
  ExprPtr condition = logic();
  if (!condition->mayCount() || !operatorAhead().is("?")) return condition;
  const Span question = stream_.next().span;
  const Nested nested(context_, question);
  std::vector<ExprPtr> args;
  args.push_back(std::move(condition));
  args.push_back(choice());
  expect(":", question, "?");
  args.push_back(choice());
  return node(Expr::Kind::choose, question, "?", std::move(args));
}

// logic := comparison { ('&' | '|' | '&&' | '||') comparison }      one level, as POV-Ray
ExprPtr ExpressionParser::logic() {
  return chain(&ExpressionParser::comparison, {"&", "|", "&&", "||"});
}

// comparison := sum { ('<' | '<=' | '=' | '==' | '>=' | '>' | '!=') sum }
ExprPtr ExpressionParser::comparison() {
  return chain(&ExpressionParser::sum, {"<", "<=", "=", "==", ">=", ">", "!="});
}

// sum := product { ('+' | '-') product } | colour [channels] | channels
ExprPtr ExpressionParser::sum() {
  if (isColourWord(stream_.peek())) {
    ExprPtr plain = colour(true);
    // `filter "box"` is the next setting of a block.
    const bool isSetting = stream_.peekRaw(1).kind == Token::Kind::string;
    return isChannelAhead() && !isSetting ? channels(std::move(plain)) : std::move(plain);
  }
  if (isChannelAhead() && !context_.symbols.find(stream_.peek().text)) return channels(nullptr);
  return chain(&ExpressionParser::product, {"+", "-"});
}

// product := signedOperand { ('*' | '/' | '%') signedOperand }
ExprPtr ExpressionParser::product() {
  return chain(&ExpressionParser::signedOperand, {"*", "/", "%"});
}

ExprPtr ExpressionParser::chain(Level operand, std::initializer_list<const char*> signs) {
  ExprPtr left = (this->*operand)();
  for (;;) {
    // No operator can follow a string or a block, so a directive there may have to wait.
    const Token ahead = left->mayCount() ? operatorAhead() : stream_.peekRaw();
    if (ahead.kind != Token::Kind::sign ||
        std::none_of(signs.begin(), signs.end(), [&](const char* s) { return ahead.is(s); }))
      break;
    const Token sign = stream_.next();
    std::string word = *sign.text;
    if (word == "&&" || word == "||" || word == "==") word.pop_back();
    std::vector<ExprPtr> args;
    args.push_back(std::move(left));
    args.push_back((this->*operand)());
    left = node(Expr::Kind::binary, sign.span, std::move(word), std::move(args));
  }
  return left;
}

// signedOperand := ('+' | '-' | '!') signedOperand | colour | postfix
ExprPtr ExpressionParser::signedOperand() {
  const Token t = stream_.peek();
  if (isColourWord(t)) return colour(false);
  if (!t.is("+") && !t.is("-") && !t.is("!")) return postfix();
  const Nested nested(context_, t.span);
  stream_.next();
  std::vector<ExprPtr> args;
  args.push_back(signedOperand());
  return node(Expr::Kind::unary, t.span, *t.text, std::move(args));
}

// postfix := primary { '.' component | '[' expression ']' }
ExprPtr ExpressionParser::postfix() {
  ExprPtr e = primary();
  for (;;) {
    const Token ahead = stream_.peekRaw();  // raw: what follows an #include's name must wait
    std::vector<ExprPtr> args;
    if (ahead.is(".")) {
      stream_.nextRaw();
      const Token member = stream_.nextRaw();
      if (member.kind != Token::Kind::name ||
          std::none_of(std::begin(kSwizzles), std::end(kSwizzles),
                       [&](const char* s) { return member.isWord(s); }))
        context_.reporter.syntaxError(
            member.span, "expected a component after '.', found " +
                             describe(member, context_.sources) +
                             ": known are x y z t u v red green blue filter transmit gray");
      args.push_back(std::move(e));
      e = node(Expr::Kind::member, member.span, *member.text, std::move(args));
    } else if (ahead.is("[")) {
      stream_.nextRaw();
      const With mode(*this, {});
      args.push_back(std::move(e));
      do {
        args.push_back(expression());
        expect("]", ahead.span, "[");
      } while (stream_.acceptRaw("["));
      e = node(Expr::Kind::index, ahead.span, "[", std::move(args));
    } else {
      return e;
    }
  }
}

// primary := number | string | '(' expression ')' | vector | name
ExprPtr ExpressionParser::primary() {
  const Token t = stream_.peek();
  if (t.kind == Token::Kind::number) {
    stream_.next();
    return constant(Numbers(t.number), t.span);
  }
  if (t.kind == Token::Kind::string) {
    stream_.next();
    return constant(context_.budget.text(t.span, *t.text), t.span);
  }
  if (t.is("<")) return vector();
  if (t.kind == Token::Kind::name) return name();
  if (!t.is("(")) unexpected("a value");
  const Nested nested(context_, t.span);
  stream_.next();
  const With mode(*this, {true, false, -1});
  ExprPtr e = expression();
  expect(")", t.span, "(");
  e->span = context_.sources.join(t.span, context_.sources.join(e->span, stream_.last()));
  return e;
}

// vector := '<' sum { [','] sum } '>'                2 to 5 components
ExprPtr ExpressionParser::vector() {
  const Span open = stream_.next().span;
  const Nested nested(context_, open);
  const With mode(*this, {});
  std::vector<ExprPtr> args;
  do {
    args.push_back(expression());
    if (args.size() > 5)
      context_.reporter.syntaxError(args.back()->span, "a vector has 2 to 5 components");
    if (stream_.accept(",")) continue;
  } while (!stream_.peek().is(">") && !stream_.peek().is(">=") && begins(stream_.peek()));
  if (!stream_.acceptVectorEnd()) expect(">", open, "<");
  const Span whole = context_.sources.join(open, stream_.last());
  if (args.size() < 2)
    context_.reporter.syntaxError(whole,
                                  "a vector has 2 to 5 components, found one; "
                                  "write a plain number instead");
  return node(Expr::Kind::vector, whole, "<", std::move(args));
}

// colour := ('rgb' | 'rgbf' | 'rgbt' | 'rgbft' | 'srgb' ...) sum
//         | ('color' | 'colour') (colour | channels | sum)
// Within a sum the word binds only the next operand.
ExprPtr ExpressionParser::colour(bool wholeSum) {
  const Token word = stream_.next();
  const Nested nested(context_, word.span);
  const bool isBare = word.isWord("color") || word.isWord("colour");
  if (isBare && isColourWord(stream_.peek())) return colour(wholeSum);
  if (isBare && channelOf(stream_.peek()) >= 0) return channels(nullptr);
  std::vector<ExprPtr> args;
  args.push_back(wholeSum ? sum() : signedOperand());
  return node(Expr::Kind::colour, word.span, *word.text, std::move(args));
}

bool ExpressionParser::isChannelAhead() {
  return channelOf(stream_.peek()) >= 0 && begins(stream_.peekRaw(1));
}

// channels := { ('red' | 'green' | 'blue' | 'filter' | 'transmit') sum }      the last one counts
// `base`: a colour whose channels they replace; null: black.
ExprPtr ExpressionParser::channels(ExprPtr base) {
  const Token first = stream_.peek();
  std::vector<ExprPtr> args(6);
  args[5] = std::move(base);
  do {
    const int channel = channelOf(stream_.next());
    args[std::size_t(channel)] = chain(&ExpressionParser::product, {"+", "-"});
  } while (channelOf(stream_.peek()) >= 0);
  return node(Expr::Kind::channels, first.span, *first.text, std::move(args));
}

// name := parameter | identifier | constant | call | 'defined' '(' identifier ')'
ExprPtr ExpressionParser::name() {
  const Token t = stream_.next();
  if (function_)
    for (std::size_t i = 0; i < function_->parameters.size(); ++i)
      if (function_->parameters[i] == t.text) {
        ExprPtr e = constant({}, t.span);
        e->kind = Expr::Kind::parameter;
        e->slot = int(i);
        return e;
      }
  if (const Cell cell = context_.symbols.find(t.text)) {
    const bool isFunction = std::holds_alternative<FunctionPtr>(cell->value);
    return isFunction && stream_.peekRaw().is("(") ? call(t, cell->value)
                                                   : constant(cell->value, t.span);
  }
  if (t.isWord("defined")) return definedTest(t);
  if (findBuiltin(*t.text)) return call(t, {});
  if (Datum d = constantOf(*t.text, context_.version); !isBroken(d))
    return constant(std::move(d), t.span);
  return unknown(t);
}

// call := function '(' [ sum { [','] sum } ] ')'
ExprPtr ExpressionParser::call(const Token& name, const Datum& symbol) {
  const Builtin* builtin = isBroken(symbol) ? findBuiltin(*name.text) : nullptr;
  const Nested nested(context_, name.span);
  const Span open = stream_.peek().span;
  if (!stream_.accept("(")) unexpected("'(' after the function '" + *name.text + "'");
  if (builtin && !builtin->isPure && function_)
    context_.reporter.error(name.span, *name.text + "() cannot stand inside a function");
  // Where no argument is a vector, '<' can only compare, even if a comma was left out.
  const bool takesVectors =
      builtin && std::string_view(builtin->signature).find('v') != std::string_view::npos;
  const With mode(*this, {!takesVectors, false, -1});
  std::vector<ExprPtr> args;
  while (!stream_.peek().is(")")) {
    args.push_back(expression());
    if (!stream_.accept(",") && !begins(stream_.peek())) break;
  }
  expect(")", open, "(");
  ExprPtr e = node(builtin ? Expr::Kind::builtin : Expr::Kind::invoke, name.span, *name.text,
                   std::move(args));
  if (e->isConstant()) return e;
  e->span = context_.sources.join(e->span, stream_.last());
  e->function = builtin;
  e->value = symbol;
  return e;
}

ExprPtr ExpressionParser::definedTest(const Token& word) {
  const Span open = stream_.peekRaw().span;
  if (!stream_.acceptRaw("(")) unexpected("'(' after 'defined'");
  const bool isKnown = isDefined(stream_.nextRaw());
  if (!stream_.acceptRaw(")")) expect(")", open, "(");
  return constant(Numbers(isKnown ? 1 : 0), context_.sources.join(word.span, stream_.last()));
}

// { '[' sum ']' } after a name. An index outside the array names nothing.
bool ExpressionParser::isDefined(const Token& name) {
  const Cell cell = context_.symbols.find(name.text);
  Datum value = cell ? cell->value : Datum();
  bool isKnown = cell != nullptr;
  std::size_t dimension = 0, at = 0;
  while (stream_.peekRaw().is("[")) {
    const Span bracket = stream_.nextRaw().span;
    const Datum index = evaluate(Place::setting).value;
    expect("]", bracket, "[");
    const auto* array = std::get_if<ArrayPtr>(&value);
    const Numbers* n = numbers(index);
    const int size = array ? (*array)->sizes[dimension] : 0;
    if (!isKnown || !n || !(n->v[0] > -1 && n->v[0] < size)) {
      isKnown = false;
      continue;
    }
    at = at * std::size_t(size) + std::size_t(n->v[0]);
    if (++dimension < (*array)->sizes.size()) continue;
    value = Datum((*array)->data[at]);
    isKnown = !isBroken(value);
    dimension = at = 0;
  }
  return isKnown;
}

// An undeclared name, with the arguments that may follow it.
ExprPtr ExpressionParser::unknown(const Token& name) {
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
  return constant({}, name.span);
}

}  // namespace vestige::lang
