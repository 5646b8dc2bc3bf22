// SPDX-License-Identifier: Apache-2.0
// What a run finds in a text, for tools: jumping to a declaration, colouring, completing.
#pragma once
#include <string>

#include <vestige/diagnostic.h>
#include <vestige/schema.h>

namespace vestige::lang {

enum class Declared {
  broken,  ///< the value has an error, which was reported
  number,
  vector,  ///< 2 to 5 numbers
  colour,
  string,
  block,
  transform,
  function,
  array,
  macro,
  spline,
  file,
  dictionary,
  parameter,  ///< of a macro or a function, or the counter of a sum or product
};

/// Receives events on the thread of the run, in the order of reading. Spans refer to
/// Result::sources. A span inside a macro's body is that of the body, with the call in `via`; an
/// included text likewise. What is read several times, as in a loop, gives its events each time; a
/// branch may be skipped in one turn and read in another. After an error the events go on where the
/// parsing does.
class Observer {
 public:
  virtual ~Observer() = default;
  /// A name gets a value. `span`: the name alone.
  virtual void declared(const std::string& /*name*/, const Span& /*span*/, Declared /*kind*/) {}
  /// A declared name stands at `span`, also where an element or an entry is assigned. `declaration`
  /// is where it got its value, and of a parameter where its macro or function declares it; nowhere
  /// for a name that no text declares.
  virtual void used(const std::string& /*name*/, const Span& /*span*/,
                    const Span& /*declaration*/) {}
  /// The head of a block, before its settings. `head`: its kind and plugin, as far as they are
  /// written. The schema outlives the run.
  virtual void block(const Schema& /*schema*/, const Span& /*head*/) {}
  /// A value of a block, before it is read. `span`: the word, or the first token of a value without
  /// one.
  virtual void setting(const Schema& /*schema*/, const Parameter& /*row*/, const Span& /*span*/) {}
  /// A call of a macro, before its body; of a function or a spline, behind its arguments. `span`:
  /// the call with its arguments.
  virtual void call(const std::string& /*name*/, const Span& /*span*/) {}
  /// Text between two directives that is not read: the branch of a choice that is not taken, or a
  /// loop without turns. Text of blanks and comments only is left out.
  virtual void skipped(const Span& /*span*/) {}
};

}  // namespace vestige::lang
