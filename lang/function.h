// SPDX-License-Identifier: Apache-2.0
// Functions of the text in the form that the engine calls: a flat program on numbers.
#pragma once
#include <vestige/function.h>

#include "lang/ast.h"
#include "lang/context.h"

namespace vestige::lang {

/// The program of a function, compiled once; null if an error was reported, at `span` (the use in a
/// block) or in the function's own expression.
std::shared_ptr<const vestige::Function> programOf(Context& context, const Function& function,
                                                   const Span& span);

}  // namespace vestige::lang
