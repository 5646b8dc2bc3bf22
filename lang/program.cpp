// SPDX-License-Identifier: Apache-2.0
#include "lang/program.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <unordered_map>

#include "lang/program_steps.h"
#include "lang/value.h"

namespace vestige::lang {
namespace {

using Code = Program::Code;

constexpr double kHalfTurn = 3.14159265358979323846;

double truth(bool b) { return b ? 1 : 0; }
bool areEqual(double x, double y) { return x == y || std::abs(x - y) <= kTruth; }
int whole(double x) { return std::isnan(x) ? 0 : int(std::clamp(x, -2147483648.0, 2147483647.0)); }

/// A value that the language complains about.
double doubtful(double x, bool& doubt) {
  doubt = true;
  return x;
}

/// acos and asin outside [-1, 1]: the nearer end.
double unit(double x, bool& doubt) {
  return std::abs(x) > 1 ? doubtful(std::clamp(x, -1.0, 1.0), doubt) : x;
}

}  // namespace

double applyStep(Code code, const double* a, int n, bool& doubt) noexcept {
  switch (code) {
    case Code::choose:
      return isTrue(a[0]) ? a[1] : a[2];
    case Code::plus:
      return a[0] + a[1];
    case Code::minus:
      return a[0] - a[1];
    case Code::negate:
      return -a[0];
    case Code::times:
      return a[0] * a[1];
    case Code::over:
      return a[1] == 0 ? doubtful(HUGE_VAL, doubt) : a[0] / a[1];
    case Code::modulo:
      return a[1] == 0 ? doubtful(HUGE_VAL, doubt) : std::fmod(a[0], a[1]);
    case Code::mod:
      return a[1] == 0 ? doubtful(NAN, doubt) : std::fmod(a[0], a[1]);
    case Code::invert:
      return truth(!isTrue(a[0]));
    case Code::both:
      return truth(isTrue(a[0]) && isTrue(a[1]));
    case Code::either:
      return truth(isTrue(a[0]) || isTrue(a[1]));
    case Code::equal:
      return truth(areEqual(a[0], a[1]));
    case Code::notEqual:
      return truth(!areEqual(a[0], a[1]));
    case Code::less:
      return truth(a[0] < a[1]);
    case Code::lessEqual:
      return truth(a[0] < a[1] || areEqual(a[0], a[1]));
    case Code::greater:
      return truth(a[0] > a[1]);
    case Code::greaterEqual:
      return truth(a[0] > a[1] || areEqual(a[0], a[1]));
    case Code::abs:
      return std::fabs(a[0]);
    case Code::acos:
      return std::acos(unit(a[0], doubt));
    case Code::acosh:
      return std::acosh(a[0]);
    case Code::asin:
      return std::asin(unit(a[0], doubt));
    case Code::asinh:
      return std::asinh(a[0]);
    case Code::atan:
      return std::atan(a[0]);
    case Code::atan2:
      return std::atan2(a[0], a[1]);
    case Code::atanh:
      return std::atanh(a[0]);
    case Code::bitwiseAnd:
    case Code::bitwiseOr:
    case Code::bitwiseXor: {
      int bits = whole(a[0]);
      for (int i = 1; i < n; ++i)
        bits = code == Code::bitwiseAnd  ? bits & whole(a[i])
               : code == Code::bitwiseOr ? bits | whole(a[i])
                                         : bits ^ whole(a[i]);
      return bits;
    }
    case Code::ceil:
      return std::ceil(a[0]);
    case Code::cos:
      return std::cos(a[0]);
    case Code::cosh:
      return std::cosh(a[0]);
    case Code::degrees:
      return a[0] * (180 / kHalfTurn);
    case Code::div:
      return a[1] == 0 ? doubtful(HUGE_VAL, doubt) : std::trunc(a[0] / a[1]);
    case Code::exp:
      return std::exp(a[0]);
    case Code::floor:
      return std::floor(a[0]);
    case Code::integer:
      return std::trunc(a[0]);
    case Code::ln:
      return a[0] > 0 ? std::log(a[0]) : doubtful(std::log(a[0]), doubt);
    case Code::log:
      return a[0] > 0 ? std::log10(a[0]) : doubtful(std::log10(a[0]), doubt);
    case Code::max:
      return *std::max_element(a, a + n);
    case Code::min:
      return *std::min_element(a, a + n);
    case Code::pow: {
      const double x = std::pow(a[0], a[1]);
      return std::isnan(x) ? doubtful(x, doubt) : x;
    }
    case Code::radians:
      return a[0] * (kHalfTurn / 180);
    case Code::select:
      if (a[0] < 0) return a[1];
      return n == 3 || a[0] == 0 ? a[2] : a[3];
    case Code::sin:
      return std::sin(a[0]);
    case Code::sinh:
      return std::sinh(a[0]);
    case Code::sqrt:
      return a[0] < 0 ? doubtful(NAN, doubt) : std::sqrt(a[0]);
    case Code::tan:
      return std::tan(a[0]);
    case Code::tanh:
      return std::tanh(a[0]);
    case Code::argument:
    case Code::constant:
    case Code::inner:
    case Code::skipUnless:
    case Code::skipIf:
    case Code::unknown:
      break;
  }
  return NAN;
}

Code Program::codeOf(std::string_view builtin) {
  static const std::unordered_map<std::string_view, Code> all = {{"abs", Code::abs},
                                                                 {"acos", Code::acos},
                                                                 {"acosh", Code::acosh},
                                                                 {"asin", Code::asin},
                                                                 {"asinh", Code::asinh},
                                                                 {"atan", Code::atan},
                                                                 {"atan2", Code::atan2},
                                                                 {"atanh", Code::atanh},
                                                                 {"bitwise_and", Code::bitwiseAnd},
                                                                 {"bitwise_or", Code::bitwiseOr},
                                                                 {"bitwise_xor", Code::bitwiseXor},
                                                                 {"ceil", Code::ceil},
                                                                 {"cos", Code::cos},
                                                                 {"cosh", Code::cosh},
                                                                 {"degrees", Code::degrees},
                                                                 {"div", Code::div},
                                                                 {"exp", Code::exp},
                                                                 {"floor", Code::floor},
                                                                 {"int", Code::integer},
                                                                 {"ln", Code::ln},
                                                                 {"log", Code::log},
                                                                 {"max", Code::max},
                                                                 {"min", Code::min},
                                                                 {"mod", Code::mod},
                                                                 {"pow", Code::pow},
                                                                 {"radians", Code::radians},
                                                                 {"select", Code::select},
                                                                 {"sin", Code::sin},
                                                                 {"sinh", Code::sinh},
                                                                 {"sqrt", Code::sqrt},
                                                                 {"tan", Code::tan},
                                                                 {"tanh", Code::tanh}};
  const auto found = all.find(builtin);
  return found == all.end() ? Code::unknown : found->second;
}

Code Program::codeOf(Op op) {
  switch (op) {
    case Op::plus:
      return Code::plus;
    case Op::minus:
      return Code::minus;
    case Op::times:
      return Code::times;
    case Op::over:
      return Code::over;
    case Op::modulo:
      return Code::modulo;
    case Op::less:
      return Code::less;
    case Op::lessEqual:
      return Code::lessEqual;
    case Op::equal:
      return Code::equal;
    case Op::greaterEqual:
      return Code::greaterEqual;
    case Op::greater:
      return Code::greater;
    case Op::notEqual:
      return Code::notEqual;
    case Op::both:
      return Code::both;
    case Op::either:
      return Code::either;
    case Op::invert:
      return Code::invert;
    case Op::none:
      break;
  }
  return Code::unknown;
}

double Program::run(const double* args, Run& notes) const noexcept {
  notes.steps += std::int64_t(steps.size());
  double stack[kStack];
  double* top = stack;  // one past the last number
  const Step* const first = steps.data();
  const Step* const last = first + steps.size();
  for (const Step* s = first; s != last; ++s) {
    switch (s->code) {
      case Code::argument:
        *top++ = args[s->index];
        break;
      case Code::constant:
        *top++ = constants[s->index];
        break;
      case Code::plus:  // the most frequent steps without a call
        --top, top[-1] += *top;
        break;
      case Code::minus:
        --top, top[-1] -= *top;
        break;
      case Code::times:
        --top, top[-1] *= *top;
        break;
      case Code::skipUnless:
      case Code::skipIf:
        if (isTrue(top[s->code == Code::skipIf ? -2 : -1]) == (s->code == Code::skipIf)) {
          *top++ = 0;
          notes.steps -= first + s->index - 1 - s;
          s = first + s->index - 1;
        }
        break;
      case Code::inner:
        top -= s->count;
        *top = inner[s->index]->run(top, notes);
        ++top;
        break;
      default:
        top -= s->count;
        *top = applyStep(s->code, top, s->count, notes.doubt);
        ++top;
    }
  }
  return stack[0];
}

/// FNV-1a [Fowler, Noll, Vo], byte by byte.
void Program::finish() {
  print_ = 0xcbf29ce484222325ull;
  const auto note = [this](std::uint64_t bits) {
    for (int i = 0; i < 8; ++i) {
      print_ ^= static_cast<unsigned char>(bits >> (8 * i));
      print_ *= 0x100000001b3ull;
    }
  };
  note(std::uint64_t(arity_));
  for (const Step& s : steps) {
    note(std::uint64_t(s.code));
    note(s.count);
    note(s.index);
  }
  for (const double x : constants) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &x, sizeof bits);
    note(bits);
  }
  for (const auto& p : inner) note(p->fingerprint());
}

}  // namespace vestige::lang
