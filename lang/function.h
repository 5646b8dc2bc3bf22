// SPDX-License-Identifier: Apache-2.0
// A function of the text as the engine calls it: a flat program of numbers.
#pragma once
#include <vestige/function.h>

#include "lang/ast.h"
#include "lang/context.h"

namespace vestige::lang {

/// The program of a function, made once; null after a complaint at `span`, where a block wants it,
/// or in the function's own expression.
std::shared_ptr<const vestige::Function> programOf(Context& context, const Function& function,
                                                   const Span& span);

}  // namespace vestige::lang
