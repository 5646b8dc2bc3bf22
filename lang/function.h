// SPDX-License-Identifier: Apache-2.0
// Compiles functions of the text to programs, once each.
#pragma once
#include "lang/ast.h"
#include "lang/context.h"
#include "lang/program.h"

namespace vestige::lang {

/// The program of a function for a block; null if an error was reported, at `span` (the use in the
/// block) or in the function's own expression.
std::shared_ptr<const Program> programOf(Context& context, const Function& function,
                                         const Span& span);

/// The program of a function for a call in the text; null if only its tree can be evaluated, as
/// that of a function that makes strings.
const Program* programForCalls(Context& context, const Function& function);

}  // namespace vestige::lang
