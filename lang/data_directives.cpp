// SPDX-License-Identifier: Apache-2.0
// #fopen, #read, #write and #fclose, with POV-Ray's format of numbers.
#include <cstdio>

#include "lang/data_file.h"
#include "lang/directives.h"

namespace vestige::lang {

// '#fopen' name string ('read' | 'write' | 'append')
void Directives::openFile(const Token& directive) {
  const Token name = newName(directive);
  if (const Datum* before = context_.symbols.value(name.text))
    context_.reporter.syntaxError(
        name.span, std::holds_alternative<DataFilePtr>(*before)
                       ? "'" + *name.text + "' is an open file: #fclose it first"
                       : "'" + *name.text + "' has a value already: choose another name");
  Span span;
  const auto file = text(directive, span);
  const Token word = stream_.peekRaw();
  const bool isRead = word.isWord("read"), isWrite = word.isWord("write");
  if (!isRead && !isWrite && !word.isWord("append"))
    context_.reporter.syntaxError(
        word.span, "expected read, write or append, found " + describe(word, context_.sources));
  stream_.nextRaw();
  stream_.acceptRaw(";");
  const auto mode = isRead    ? DataFile::Mode::read
                    : isWrite ? DataFile::Mode::write
                              : DataFile::Mode::append;
  Datum value;
  if (file)
    if (auto opened = dataFiles_.open(*file, mode, directive.span.file, span)) value = opened;
  context_.events.declared(name, value);
  *context_.symbols.declare(name.text) = {std::move(value), name.span};
}

/// The open file of the name that comes next; null if the name's own error was reported before.
DataFilePtr Directives::openedFile(const Token& directive, Token& name) {
  name = plainName("#" + *directive.text);
  context_.used(name);
  const Datum* value = context_.symbols.value(name.text);
  if (value && isBroken(*value)) return nullptr;
  const auto* file = value ? std::get_if<DataFilePtr>(value) : nullptr;
  if (file && (*file)->isOpen) return *file;
  context_.reporter.syntaxError(
      name.span, "'" + *name.text +
                     "' is no open file: #fopen opens one, and the end of its data " +
                     "closes it, which '#ifdef (" + *name.text + ")' shows");
}

// '#fclose' name                 of a file that its end has closed: nothing
void Directives::closeFile(const Token& directive) {
  const Token next = stream_.peekRaw();
  if (next.isName() && !context_.symbols.value(next.text)) {
    stream_.nextRaw();
  } else {
    Token name;
    if (const DataFilePtr file = openedFile(directive, name)) dataFiles_.close(*file, name.span);
    context_.symbols.undefine(name.text);
  }
  stream_.acceptRaw(";");
}

// ---------------------------------------------------------------- #write
/// A number, a vector (with a blank behind it) or a string as POV-Ray writes it; nothing after an
/// error.
std::optional<std::string> Directives::written(const Datum& value, const Span& span) {
  const auto number = [](double x) {
    char buffer[40];
    std::snprintf(buffer, sizeof buffer, "%g", x);
    return std::string(buffer);
  };
  if (const auto* s = std::get_if<TextPtr>(&value)) return **s;
  const Numbers* n = numbers(value);
  if (!n) {
    if (!isBroken(value))
      context_.reporter.error(
          span, "#write takes numbers, vectors and strings, found " + describe(value));
    return {};
  }
  if (n->size == 1) return number(n->v[0]);
  std::string s = "<";
  for (int i = 0; i < n->size; ++i) s.append(i ? "," : "").append(number(n->v[std::size_t(i)]));
  return s.append("> ");
}

// '#write' '(' name { [','] value } ')'
void Directives::writeFile(const Token& directive) {
  const Span open = stream_.peekRaw().span;
  if (!stream_.acceptRaw("(")) parser_.expressions().unexpected("'(' and an open file");
  Token name;
  const DataFilePtr file = openedFile(directive, name);
  if (file && !file->isWritten())
    context_.reporter.syntaxError(name.span, "'" + file->name + "' was opened to be read");
  while (stream_.accept(",") || !stream_.peek().is(")")) {
    if (stream_.peek().is(")")) break;
    const auto value = parser_.expressions().evaluate(ExpressionParser::Place::setting);
    const auto part = written(value.value, value.span);
    if (file && part) dataFiles_.write(*file, *part, value.span);
  }
  parser_.expressions().expect(")", open, "(");
  stream_.acceptRaw(";");
}

// ---------------------------------------------------------------- #read
// '#read' '(' name { [','] name } ')'
// After an error the file is closed, so that a loop to its end does end.
void Directives::readFile(const Token& directive) {
  const Span open = stream_.peekRaw().span;
  if (!stream_.acceptRaw("(")) parser_.expressions().unexpected("'(' and an open file");
  Token name;
  const DataFilePtr file = openedFile(directive, name);
  const auto close = [&] {
    if (file) file->isOpen = false;
    context_.symbols.undefine(name.text);
  };
  try {
    if (file && file->isWritten())
      context_.reporter.syntaxError(name.span, "'" + file->name + "' was opened to be written");
    if (!readInto(directive, file.get())) close();
    parser_.expressions().expect(")", open, "(");
  } catch (const SyntaxError&) {
    if (!file || !file->isWritten()) close();
    throw;
  }
  stream_.acceptRaw(";");
}

/// The names behind the file; false if its end has been reached.
bool Directives::readInto(const Token& directive, DataFile* file) {
  bool isOpen = file != nullptr;
  while (stream_.acceptRaw(",") || !stream_.peekRaw().is(")")) {
    if (stream_.peekRaw().is(")")) break;
    const Token target = newName(directive);
    Datum value;
    if (isOpen) isOpen = nextDatum(*file, value);
    if (isBroken(value)) continue;
    context_.events.declared(target, value);
    *context_.symbols.declare(target.text) = {std::move(value), target.span};
  }
  return isOpen;
}

// data := [ datum { ',' datum } [','] ]
/// The next value, if there is one; false if none follows it.
bool Directives::nextDatum(DataFile& file, Datum& value) {
  const auto& tokens = file.tokens->tokens;
  if (tokens[file.at].kind == Token::Kind::end) return false;
  value = datum(file);
  const Token& after = file.tokens->token(file.at);
  if (after.kind == Token::Kind::end) return false;
  if (!after.is(","))
    context_.reporter.syntaxError(after.span, "expected ',' between the data of '" + file.name +
                                                  "', found " + describe(after, context_.sources));
  ++file.at;
  return true;
}

// datum := string | number | '<' number { [','] number } '>'          2 to 5 components
Datum Directives::datum(DataFile& file) {
  const Token first = file.tokens->token(file.at);
  context_.step(first.span);
  if (first.kind == Token::Kind::string) {
    ++file.at;
    return context_.budget.text(first.span, *first.text);
  }
  if (!first.is("<")) return Numbers(dataNumber(file));
  ++file.at;
  Numbers n;
  for (n.size = 0; !file.tokens->token(file.at).is(">");) {
    if (n.size == 5) context_.reporter.syntaxError(first.span, "a vector has 2 to 5 components");
    n.v[std::size_t(n.size++)] = dataNumber(file);
    if (file.tokens->token(file.at).is(",")) ++file.at;
  }
  ++file.at;
  if (n.size < 2) context_.reporter.syntaxError(first.span, "a vector has 2 to 5 components");
  return n;
}

// number := ['+' | '-'] digits
double Directives::dataNumber(DataFile& file) {
  Token t = file.tokens->token(file.at);
  const bool isNegative = t.is("-");
  if (isNegative || t.is("+")) t = file.tokens->token(++file.at);
  if (t.kind == Token::Kind::bad) context_.reporter.syntaxError(t.span, *t.text);
  if (t.kind != Token::Kind::number)
    context_.reporter.syntaxError(t.span,
                                  "a file of data holds numbers, vectors and strings, found " +
                                      describe(t, context_.sources));
  ++file.at;
  return isNegative ? -t.number : t.number;
}

}  // namespace vestige::lang
